//! The tables that come with the library: every file of `tables/`.

use crate::fault::Source;

const SHIPPED: &[(&str, &str)] = &include!(concat!(env!("OUT_DIR"), "/shipped.rs"));

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
        .map(|(known, text)| Source { path: format!("{known}.toml"), text: (*text).to_owned() })
}
