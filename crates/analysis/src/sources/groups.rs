//! Constants of one name and an index that are set one after the other: lists that have no brackets.

use std::collections::BTreeSet;

use crate::sources::list::List;
use crate::sources::numbers::{Id, Numbers};

/// Bytes between two constants of a group.
const FAR: usize = 600;

/// Longer groups are data.
const LONGEST: usize = 300;

/// The constants that were set one after the other last.
#[derive(Default)]
pub(super) struct Group {
    constants: Vec<(String, Id)>,
}

impl Group {
    /// Takes a constant; the lists of the group before, where this one does not belong to it.
    pub(super) fn add(&mut self, name: &str, id: Id, numbers: &Numbers, owner: &str) -> Vec<List> {
        let ended = if self.goes_on(name, id, numbers) { Vec::new() } else { self.end(numbers, owner) };
        self.constants.push((name.to_owned(), id));
        ended
    }

    /// Whether a constant is the next of its name: a1, a2, or a1, b1, a2, b2.
    fn goes_on(&self, name: &str, id: Id, numbers: &Numbers) -> bool {
        let Some((last_name, last)) = self.constants.last() else { return true };
        let ((before, last_index), (stem, index)) = (self::stem(last_name), self::stem(name));
        let is_near = numbers.get(id).at.start < numbers.get(*last).at.end + FAR;
        let is_next = |(index, last): (u64, u64)| index.abs_diff(last) == 1;
        if !is_near || self.constants.len() >= LONGEST {
            return false;
        }
        let is_new = || !self.constants.iter().any(|(known, _)| known == name);
        let stems = || self.constants.iter().map(|(name, _)| self::stem(name).0).collect::<BTreeSet<_>>();
        (stem == before && index.zip(last_index).is_some_and(is_next))
            || (index.is_some() && is_new() && (stems().contains(stem) || stems().len() < 2))
    }

    /// The lists of all constants of one name.
    pub(super) fn end(&mut self, numbers: &Numbers, owner: &str) -> Vec<List> {
        let constants = std::mem::take(&mut self.constants);
        let mut stems: Vec<(&str, Vec<(&str, Id)>)> = Vec::new();
        for (name, id) in &constants {
            let stem = stem(name).0;
            match stems.iter_mut().find(|(known, _)| *known == stem) {
                Some((_, members)) => members.push((name, *id)),
                None => stems.push((stem, vec![(name, *id)])),
            }
        }
        stems.into_iter().filter_map(|(_, members)| list(&members, numbers, owner)).collect()
    }
}

/// The list of constants with their names, if they have enough digits.
fn list(members: &[(&str, Id)], numbers: &Numbers, owner: &str) -> Option<List> {
    let entries: Vec<_> = members.iter().map(|(_, id)| *id).collect();
    if !numbers.are_telling(&entries.iter().copied().collect()) {
        return None;
    }
    let places = || entries.iter().map(|id| &numbers.get(*id).at);
    let at = places().map(|at| at.start).min()?..places().map(|at| at.end).max()?;
    let name = match members {
        [(name, _)] => (*name).to_owned(),
        [(first, _), .., (last, _)] => format!("{first} … {last}"),
        [] => return None,
    };
    Some(List { name, owner: owner.to_owned(), entries, at, is_group: true, rows: 1 })
}

/// The letters of a name and the number at its end: `w_12` is `w_` and 12.
fn stem(name: &str) -> (&str, Option<u64>) {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    (stem, name[stem.len()..].parse().ok())
}
