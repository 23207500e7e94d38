//! How numbers and tables look to a person; machines get every digit.

use std::ops::Range;

use comfy_table::{CellAlignment, LineStyle, Table, presets};
use shadowstep::Rational;
use shadowstep_symbolic::decimal::{from_text, to_significant, to_text};

/// The exact text, or so many digits of it where it is longer.
pub(crate) fn shortened(value: &Rational, digits: usize) -> String {
    let exact = to_text(value);
    if exact.len() <= digits + 2 { exact } else { format!("{}…", to_significant(value, digits)) }
}

/// A decimal text rounded to so many digits: `1.235e-110`.
pub(crate) fn rounded(text: &str, digits: usize) -> String {
    from_text(text).map_or_else(|_| text.to_owned(), |value| to_significant(&value, digits))
}

/// A text in lines of at most 100 characters, each of which begins with `margin`.
pub(crate) fn wrapped(text: &str, margin: &str) -> String {
    let mut lines = String::new();
    for paragraph in text.lines() {
        let mut line = margin.to_owned();
        for word in paragraph.split_whitespace() {
            if line.len() > margin.len() && line.chars().count() + 1 + word.chars().count() > 100 {
                lines += &format!("{}\n", line.trim_end());
                line = margin.to_owned();
            }
            line += &format!("{}{word}", if line.len() > margin.len() { " " } else { "" });
        }
        lines += &format!("{}\n", line.trim_end());
    }
    lines
}

/// A table with lines above, below the header, and below; the columns of numbers are flush right.
pub(crate) fn table<const N: usize>(header: [&str; N], rows: Vec<[String; N]>, numbers: Range<usize>) -> String {
    let mut table = Table::new();
    table.load_style(presets::UTF8_HORIZONTAL_ONLY).set_header(header).add_rows(rows);
    table.style_mut().row_separator = LineStyle::none();
    for column in table.column_iter_mut().skip(numbers.start).take(numbers.len()) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.trim_fmt()
}
