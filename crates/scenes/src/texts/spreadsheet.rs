//! Cells of CSV that a spreadsheet would compute.

use std::borrow::Cow;

use shadowstep_schemes::symbolic::decimal::from_text;

/// The beginnings of formulas, and blanks that are left out before them; `'` is the mark itself.
const MARKED: [char; 8] = ['=', '+', '-', '@', '\t', '\r', '\n', '\''];

/// A text as a cell: with `'` before it where a spreadsheet would take it for a formula, and where it begins with `'`,
/// so that who reads cells takes one away. Numbers stay as they are.
///
/// ```
/// use shadowstep_scenes::spreadsheet::cell;
///
/// assert_eq!(["=1+1", "-x^2", "@SUM(A1)", "'"].map(cell), ["'=1+1", "'-x^2", "'@SUM(A1)", "''"]);
/// assert_eq!(["-7/24", "+1e-5", "-inf", "yoshida4", ""].map(cell), ["-7/24", "+1e-5", "-inf", "yoshida4", ""]);
/// ```
pub fn cell(text: &str) -> Cow<'_, str> {
    let is_number = || text.parse::<f64>().is_ok() || from_text(text).is_ok();
    match text.starts_with(MARKED) && !is_number() {
        true => Cow::Owned(format!("'{text}")),
        false => Cow::Borrowed(text),
    }
}
