//! Numbers and texts for people; machines get every digit.

use shadowstep::Rational;
use shadowstep_schemes::symbolic::decimal::{round_significant, to_significant, to_text};

/// The most digits of a number in a message.
pub const LONGEST_NUMBER: usize = 20;

/// The exact text of a number, or `digits` significant digits, and `…` where it has more.
///
/// ```
/// use shadowstep_scenes::readable::shortened;
///
/// assert_eq!(shortened(&shadowstep::exact("1/10").unwrap(), 4), "1/10");
/// assert_eq!(shortened(&shadowstep::exact("123456789/1001").unwrap(), 4), "123300…");
/// assert_eq!(shortened(&shadowstep::exact("1e300").unwrap(), 20), "1e300");
/// ```
pub fn shortened(value: &Rational, digits: usize) -> String {
    let exact = to_text(value);
    if exact.len() <= digits + 2 {
        return exact;
    }
    let is_all = round_significant(value, digits as u32) == *value;
    to_significant(value, digits) + if is_all { "" } else { "…" }
}

/// A text in lines of at most 80 characters, each of which begins with `margin`.
///
/// ```
/// assert_eq!(shadowstep_scenes::readable::wrapped("The step size h.", "# "), "# The step size h.\n");
/// ```
pub fn wrapped(text: &str, margin: &str) -> String {
    wrapped_to(text, margin, 80)
}

/// A text in lines of at most `width` characters, each of which begins with `margin`.
pub fn wrapped_to(text: &str, margin: &str, width: usize) -> String {
    let mut lines = String::new();
    for paragraph in text.lines() {
        let mut line = margin.to_owned();
        for word in paragraph.split_whitespace() {
            if line.len() > margin.len() && line.chars().count() + 1 + word.chars().count() > width {
                lines += &format!("{}\n", line.trim_end());
                line = margin.to_owned();
            }
            line += &format!("{}{word}", if line.len() > margin.len() { " " } else { "" });
        }
        lines += &format!("{}\n", line.trim_end());
    }
    lines
}
