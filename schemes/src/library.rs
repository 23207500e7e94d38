//! Where the base table of a composition is: beside the table that names it, or among the shipped ones.

use std::path::{Component, Path};

use crate::document::Source;
use crate::shipped::shipped;

/// Finds the table that a composition names as its base, as seen from the table that names it.
pub type Library<'a> = &'a dyn Fn(&str, &Source) -> Option<Source>;

/// The base table that the table `from` names: a file beside it, which `read` reads by its path, else a shipped one.
/// The bases of a shipped table are shipped.
///
/// A base is a file name without folders, with or without `.toml`; so a chain of tables ends, or comes back to a path
/// that it has had.
pub fn beside_or_shipped(base: &str, from: &Source, read: impl FnOnce(&Path) -> Option<Source>) -> Option<Source> {
    if from.is_shipped() {
        return shipped(base);
    }
    let mut parts = Path::new(base).components();
    let is_file_name = matches!((parts.next(), parts.next()), (Some(Component::Normal(_)), None));
    let file = format!("{}.toml", base.strip_suffix(".toml").unwrap_or(base));
    let beside = || read(&Path::new(&from.path).with_file_name(file));
    is_file_name.then(beside).flatten().or_else(|| shipped(base))
}
