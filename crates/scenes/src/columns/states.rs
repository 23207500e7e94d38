//! Positions and momenta, at states or at crossings of a surface.

use super::group::{Due, Group};
use crate::columns::at::{At, Place};
use crate::document::reserved_names::LISTS;
use crate::results::{Cell, Name};
use crate::scene::{Outputs, SceneNumber, System};
use crate::texts::error::Error;

pub(super) struct States<'a> {
    every: Option<u64>,
    system: &'a System,
}

pub(super) fn of<'a>(output: &Outputs, system: &'a System) -> Option<States<'a>> {
    output.has_states().then_some(States { every: output.trajectory, system })
}

impl<N: SceneNumber> Group<N> for States<'_> {
    /// t has its column already, where it is a coordinate; it is in the list of these.
    fn names(&self) -> Vec<Name> {
        let own = self.system.coordinates_of_columns();
        let q = self.system.coordinates.iter().enumerate().map(|(i, name)| Name::of_list(name, LISTS[0], i < own));
        let p = self.system.momenta.iter().map(|name| Name::of_list(name, LISTS[1], true));
        q.chain(p).collect()
    }

    fn due(&self) -> Due {
        let places: &[_] = if self.every.is_some() { &[Place::PhysicalEnd] } else { &[Place::Crossing] };
        Due { every: self.every, places }
    }

    fn append(&mut self, at: &mut At<'_, '_, N>, cells: &mut Vec<Cell<N>>) -> Result<(), Error> {
        let (q, p) = at.shown_state();
        cells.extend(q.iter().chain(p).cloned().map(Cell::Number));
        Ok(())
    }
}
