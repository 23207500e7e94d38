//! The tables that come with the library: every file of `tables/`.

use crate::fault::Source;

const SHIPPED: &[(&str, &str)] = &include!(concat!(env!("OUT_DIR"), "/shipped.rs"));

/// Where shipped tables are, in messages; no file has such a path.
const FOLDER: &str = "<shipped>/";

/// The names of the shipped tables, sorted.
pub fn shipped_names() -> Vec<&'static str> {
    SHIPPED.iter().map(|(name, _)| *name).collect()
}

/// A shipped table by its name, with or without `.toml`.
pub fn shipped(name: &str) -> Option<Source> {
    let name = name.strip_suffix(".toml").unwrap_or(name);
    SHIPPED
        .iter()
        .find(|(known, _)| *known == name)
        .map(|(known, text)| Source { path: format!("{FOLDER}{known}.toml"), text: (*text).to_owned() })
}

impl Source {
    /// Whether it is a shipped table. Its base is a shipped table too, whatever files of that name there may be.
    pub fn is_shipped(&self) -> bool {
        self.path.starts_with(FOLDER)
    }
}
