//! The names that columns of every system may have.

use super::{chaos, energy, modified_energy};

/// The names of the columns of n and t, which each row has.
pub(super) const OF_EACH_ROW: [&str; 2] = ["n", "t"];

/// The names that columns of every system may have; no coordinate and no column of a formula has one of them.
pub fn fixed_names() -> impl Iterator<Item = &'static str> {
    let groups: [&[&str]; 4] = [&OF_EACH_ROW, &energy::NAMES, &modified_energy::NAMES, &chaos::NAMES];
    groups.into_iter().flatten().copied()
}
