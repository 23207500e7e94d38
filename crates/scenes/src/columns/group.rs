//! A group of columns: their names, when they are due, and their cells at a state.

use crate::columns::at::{At, Place};
use crate::results::{Cell, Name};
use crate::scene::SceneNumber;
use crate::texts::error::Error;

/// Columns that are due together.
pub(crate) trait Group<N: SceneNumber> {
    /// Their names.
    fn names(&self) -> Vec<Name>;

    /// When they are due.
    fn due(&self) -> Due;

    /// Appends a cell for each name.
    fn append(&mut self, at: &mut At<'_, '_, N>, cells: &mut Vec<Cell<N>>) -> Result<(), Error>;
}

type Append<N> = fn(&mut At<'_, '_, N>, &mut Vec<Cell<N>>) -> Result<(), Error>;

/// Columns that have the same names in all systems.
pub(super) struct Fixed<N: SceneNumber> {
    pub(super) names: &'static [&'static str],
    pub(super) due: Due,
    pub(super) append: Append<N>,
}

impl<N: SceneNumber> Group<N> for Fixed<N> {
    fn names(&self) -> Vec<Name> {
        self.names.iter().copied().map(Name::from).collect()
    }

    fn due(&self) -> Due {
        self.due
    }

    fn append(&mut self, at: &mut At<'_, '_, N>, cells: &mut Vec<Cell<N>>) -> Result<(), Error> {
        (self.append)(at, cells)
    }
}

/// When columns are due.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Due {
    /// At the states whose n is a multiple of this.
    pub(crate) every: Option<u64>,
    /// And at all of these places.
    pub(crate) places: &'static [Place],
}

impl Due {
    pub(super) fn is_at<N: SceneNumber>(self, at: &At<'_, '_, N>) -> bool {
        let is_multiple = |every: u64| at.is_met || at.n.unsigned_abs().is_multiple_of(every);
        self.places.contains(&at.place) || (at.place == Place::State && self.every.is_some_and(is_multiple))
    }
}
