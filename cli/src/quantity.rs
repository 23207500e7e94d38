//! Exact numbers as a person writes them.

use shadowstep::Rational;
use shadowstep_symbolic::parse;

use crate::complaint::Complaint;

pub(crate) const EXAMPLES: &str = "write an exact number, such as 1/10, 0.05, 1e-3 or sqrt(2)/20";

/// The number that a flag is given.
pub(crate) fn number(flag: &str, text: &str) -> Result<Rational, Complaint> {
    shadowstep::exact(text).map_err(|error| {
        let place = character(text, error.range().start);
        Complaint::usage(format!("{flag} `{text}`, character {place}: {error}"), EXAMPLES)
    })
}

/// `name=expression` in two; the expression is evaluated where its names are known.
pub(crate) fn assignment(text: &str) -> Result<(String, String), Complaint> {
    let Some((name, expression)) = text.split_once('=') else {
        return Err(Complaint::usage(format!("--set {text} has no `=`"), "write a name and a value: --set x=1/2"));
    };
    if name.trim().is_empty() {
        return Err(Complaint::usage(format!("--set {text} names nothing before its `=`"), "write --set x=1/2"));
    }
    if let Err(error) = parse(expression) {
        let place = character(expression, error.range.start);
        return Err(Complaint::usage(format!("--set {text}: `{expression}`, character {place}: {error}"), EXAMPLES));
    }
    Ok((name.trim().to_owned(), expression.trim().to_owned()))
}

/// Counted from 1, as people count.
fn character(text: &str, byte: usize) -> usize {
    text.char_indices().take_while(|(at, _)| *at < byte).count() + 1
}
