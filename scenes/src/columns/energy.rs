//! The energy H.

use super::{Due, Group};
use crate::at::{At, Place};
use crate::error::Error;
use crate::results::{Cell, Name};
use crate::run_number::RunNumber;
use crate::scene::Outputs;

pub(super) const NAMES: [&str; 1] = ["energy"];

struct Energy {
    every: u64,
}

pub(super) fn of<N: RunNumber>(output: &Outputs) -> Option<Box<dyn Group<N>>> {
    output.energy.map(|every| Box::new(Energy { every }) as Box<_>)
}

impl<N: RunNumber> Group<N> for Energy {
    fn names(&self) -> Vec<Name> {
        NAMES.map(Name::from).to_vec()
    }

    fn due(&self) -> Due {
        Due { every: Some(self.every), places: &[Place::Crossing, Place::PhysicalEnd] }
    }

    fn append(&mut self, at: &mut At<'_, '_, N>, cells: &mut Vec<Cell<N>>) -> Result<(), Error> {
        cells.push(Cell::Number(at.energy()?.clone()));
        Ok(())
    }
}
