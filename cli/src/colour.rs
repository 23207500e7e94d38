//! Colours on a terminal; none in pipes, in files, or where NO_COLOR is set.

use std::io;

use anstream::{AutoStream, ColorChoice};
use anstyle::{AnsiColor, Style};

const BOLD: Style = Style::new().bold();
pub(crate) const ERROR: Style = AnsiColor::Red.on_default().bold();
pub(crate) const NOTE: Style = AnsiColor::Yellow.on_default().bold();
pub(crate) const HINT: Style = AnsiColor::Cyan.on_default().bold();
const GOOD: Style = AnsiColor::Green.on_default().bold();

/// A text in a style; `stderr` removes it where there are no colours.
pub(crate) fn styled(text: &str, style: Style) -> String {
    format!("{}{text}{}", style.render(), style.render_reset())
}

/// The style of a verdict.
pub(crate) fn of_verdict(fine: bool) -> Style {
    if fine { GOOD } else { ERROR }
}

/// A heading, in bold letters where there are colours.
pub(crate) fn heading(text: &str, coloured: bool) -> String {
    if coloured { styled(text, BOLD) } else { text.to_owned() }
}

/// Whether stdout shows colours.
pub(crate) fn on_stdout() -> bool {
    AutoStream::choice(&io::stdout()) != ColorChoice::Never
}
