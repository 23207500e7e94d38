//! A list of numbers of a source.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::sources::numbers::Id;

/// A list of numbers.
#[derive(Clone, Debug)]
pub(super) struct List {
    /// Its name in the source, such as `scheme.gamma`; empty where it has none.
    pub(super) name: String,
    /// The function or type in which it stands.
    pub(super) owner: String,
    pub(super) entries: Vec<Id>,
    pub(super) at: Range<usize>,
    /// Whether it is of constants that have a name each.
    pub(super) is_group: bool,
    /// How many lists have its name, as the rows of a table.
    pub(super) rows: usize,
}

/// Lists of one name are named by their index.
pub(super) fn index(lists: &mut [List]) {
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for list in lists.iter().filter(|list| !list.is_group && !list.name.is_empty()) {
        *counts.entry(list.name.clone()).or_default() += 1;
    }
    let mut seen: BTreeMap<String, usize> = BTreeMap::new();
    for list in lists.iter_mut().filter(|list| !list.is_group) {
        list.rows = counts.get(&list.name).copied().unwrap_or(1);
        if list.rows > 1 {
            let seen = seen.entry(list.name.clone()).or_default();
            list.name += &format!("[{seen}]");
            *seen += 1;
        }
    }
}
