//! The tables that come with the library: every file of `tables/`.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use crate::symbolic::nearest;

use crate::document::Source;
use crate::parse;
use crate::spelling::spelling;

const SHIPPED: &[(&str, &str)] = &include!(concat!(env!("OUT_DIR"), "/shipped.rs"));

/// Where shipped tables are, in messages; no file has such a path.
const FOLDER: &str = "<shipped>/";

/// The names of the shipped tables, sorted.
pub fn shipped_names() -> Vec<&'static str> {
    SHIPPED.iter().map(|(name, _)| *name).collect()
}

/// A shipped table by its name or one of its aliases, with or without `.toml`: `pefrl`, `PEFRL`, `BM4`, `SofSpa10`.
///
/// Small and capital letters, hyphens, blanks and the like make no difference.
pub fn shipped(name: &str) -> Option<Source> {
    index(name).map(source)
}

/// How many tables are shipped.
pub(crate) const COUNT: usize = SHIPPED.len();

/// The index of a shipped table, by its name or one of its aliases.
pub(crate) fn index(name: &str) -> Option<usize> {
    let name = name.strip_suffix(".toml").unwrap_or(name);
    let exact = SHIPPED.iter().position(|(known, _)| *known == name);
    exact.or_else(|| NAMES.get(&spelling(name)).copied())
}

/// The hint for a table that does not exist: names that begin alike or are spelt most like it.
pub fn shipped_hint(name: &str) -> String {
    let (names, word) = (shipped_names(), spelling(name));
    if index(name).is_some() {
        return format!("`{name}` is a shipped table, which this library of base tables does not have");
    }
    let begins = |known: &&&str| word.len() >= LEAST_BEGINNING && spelling(known).starts_with(&word);
    let beginning: Vec<_> = names.iter().filter(begins).map(|name| format!("`{name}`")).collect();
    let of_alias = || Some(SHIPPED[NAMES[nearest(&word, NAMES.keys().map(String::as_str))?]].0);
    match nearest(name, names.iter().copied()).or_else(of_alias) {
        _ if !beginning.is_empty() => format!("did you mean {}?", beginning.join(", ")),
        Some(near) => format!("did you mean `{near}`?"),
        None => "no shipped table has a name like that".to_owned(),
    }
}

/// The least number of letters of a word for which names that begin with it are suggested.
const LEAST_BEGINNING: usize = 3;

/// The text of a shipped table.
pub(crate) fn source(index: usize) -> Source {
    let (name, text) = SHIPPED[index];
    Source { path: format!("{FOLDER}{name}.toml"), text: text.to_owned() }
}

/// The spellings of all names and aliases, with the index of their tables.
static NAMES: LazyLock<BTreeMap<String, usize>> = LazyLock::new(|| {
    let mut names = BTreeMap::new();
    for (index, (name, _)) in SHIPPED.iter().enumerate() {
        let aliases = parse::table(&source(index)).0.map_or_else(Vec::new, |table| table.aliases);
        names.extend(aliases.iter().map(|alias| (spelling(&alias.value), index)));
        names.insert(spelling(name), index);
    }
    names
});

impl Source {
    /// Whether it is a shipped table. Its base is a shipped table too, whatever files of that name there may be.
    pub(crate) fn is_shipped(&self) -> bool {
        self.path.starts_with(FOLDER)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_tables_share_a_name() {
        let mut names: BTreeMap<String, &str> = BTreeMap::new();
        for (index, (name, _)) in SHIPPED.iter().enumerate() {
            let table = parse::table(&source(index)).0.expect("shipped tables are TOML");
            assert_eq!(table.name.value, *name, "a table is named as its file");
            let aliases = table.aliases.iter().map(|alias| alias.value.as_str());
            for word in aliases.chain([*name]) {
                let other = names.insert(spelling(word), name);
                assert_eq!(other, None, "`{word}` is a name of {name} too");
                assert_eq!(shipped(word).expect("it is found").path, format!("{FOLDER}{name}.toml"));
            }
        }
    }

    #[test]
    fn names_are_found_however_they_are_spelt() {
        for word in ["stormer-verlet", "stormer-verlet.toml", "StormerVerlet", "stormer_verlet", "STORMER VERLET.toml"]
        {
            assert_eq!(shipped(word).expect(word).path, "<shipped>/stormer-verlet.toml");
        }
        assert_eq!(shipped("stormer-verle"), None);
        assert_eq!(shipped("-"), None);
    }
}
