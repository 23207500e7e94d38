//! Numbers and tables for people; machines get every digit.

use std::ops::Range;

use comfy_table::{CellAlignment, LineStyle, Table, presets};
pub(crate) use shadowstep_scenes::readable::{shortened, wrapped, wrapped_to};
use shadowstep_schemes::symbolic::decimal::{from_text, to_significant};

/// A decimal text rounded to `digits` significant digits: `1.235e-110`.
pub(crate) fn rounded(text: &str, digits: usize) -> String {
    from_text(text).map_or_else(|_| text.to_owned(), |value| to_significant(&value, digits))
}

/// A table with lines above, below the header, and below; the columns of numbers are flush right.
pub(crate) fn table<H, R>(header: H, rows: Vec<R>, numbers: Range<usize>) -> String
where
    H: IntoIterator<Item = &'static str>,
    R: IntoIterator<Item = String>,
{
    let mut table = Table::new();
    table.load_style(presets::UTF8_HORIZONTAL_ONLY);
    table.set_header(header.into_iter().collect::<Vec<_>>());
    table.add_rows(rows.into_iter().map(|row| row.into_iter().collect::<Vec<_>>()));
    table.style_mut().row_separator = LineStyle::none();
    table.column_iter_mut().for_each(|column| {
        column.set_padding((1, 0));
    });
    for column in table.column_iter_mut().skip(numbers.start).take(numbers.len()) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.trim_fmt()
}
