//! Exact numbers as a person writes them.

use shadowstep::Rational;
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::NUMBER_EXAMPLES;
use shadowstep_symbolic::parse;

/// The number that a flag is given.
pub(crate) fn number(flag: &str, text: &str) -> Result<Rational, Error> {
    shadowstep::exact(text).map_err(|error| {
        let place = character(text, error.range().start);
        Error::usage(format!("{flag} `{text}`, character {place}: {error}"), NUMBER_EXAMPLES)
    })
}

/// `name=expression` in two; the expression is evaluated where its names are known.
pub(crate) fn assignment(text: &str) -> Result<(String, String), Error> {
    let Some((name, expression)) = text.split_once('=') else {
        return Err(Error::usage(format!("--set {text} has no `=`"), "write a name and a value: --set x=1/2"));
    };
    if name.trim().is_empty() {
        return Err(Error::usage(format!("--set {text} names nothing before its `=`"), "write --set x=1/2"));
    }
    if let Err(error) = parse(expression) {
        let place = character(expression, error.range.start);
        return Err(Error::usage(format!("--set {text}: `{expression}`, character {place}: {error}"), NUMBER_EXAMPLES));
    }
    Ok((name.trim().to_owned(), expression.trim().to_owned()))
}

/// Counted from 1, as people count.
fn character(text: &str, byte: usize) -> usize {
    text.char_indices().take_while(|(at, _)| *at < byte).count() + 1
}
