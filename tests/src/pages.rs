//! Pages of the documentation that are generated, and kept true.

use std::path::Path;
use std::{env, fs};

/// A page of `docs/` is what is generated; with `UPDATE_DOCS=1` in the environment it becomes that.
///
/// # Panics
/// If it is not, with the first line that differs.
pub fn assert_page(name: &str, generated: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs").join(name);
    if env::var_os("UPDATE_DOCS").is_some() {
        fs::write(&path, generated).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    }
    let page = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let (mut found, mut expected) = (page.lines(), generated.lines());
    for number in 1.. {
        match (found.next(), expected.next()) {
            (None, None) => break,
            (found, expected) => assert_eq!(
                found, expected,
                "docs/{name}, line {number}, left, is no longer what is generated; write it again with UPDATE_DOCS=1"
            ),
        }
    }
}
