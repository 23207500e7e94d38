//! The parts of a study by their names.

use shadowstep_schemes::symbolic::suggestion;

use crate::Error;

/// The parts with these names, in the order of the list; all, if none is named. `what` is the word for a part: figure,
/// case.
///
/// # Errors
/// An unknown name.
pub(crate) fn named<'a, T>(
    parts: &'a [T],
    name: fn(&T) -> &'static str,
    what: &str,
    wanted: &[String],
) -> Result<Vec<&'a T>, Error> {
    let known: Vec<&str> = parts.iter().map(name).collect();
    if let Some(name) = wanted.iter().find(|name| !known.contains(&name.as_str())) {
        return Err(Error::usage(format!("there is no {what} `{name}`"), suggestion(name, &known)));
    }
    let is_wanted = |part: &&T| wanted.is_empty() || wanted.iter().any(|wanted| wanted == name(part));
    Ok(parts.iter().filter(is_wanted).collect())
}
