//! The modified energy, its estimated error, and the order of the estimate.

use super::{Due, Group};
use crate::at::At;
use crate::error::Error;
use crate::results::{Cell, Name};
use crate::run_number::RunNumber;
use crate::scene::Outputs;

pub(super) const NAMES: [&str; 3] = ["modified_energy", "estimate", "order"];

struct ModifiedEnergy {
    every: u64,
}

pub(super) fn of<N: RunNumber>(output: &Outputs) -> Option<Box<dyn Group<N>>> {
    output.modified_energy.as_ref().map(|(_, every)| Box::new(ModifiedEnergy { every: *every }) as Box<_>)
}

impl<N: RunNumber> Group<N> for ModifiedEnergy {
    fn names(&self) -> Vec<Name> {
        NAMES.map(Name::from).to_vec()
    }

    fn due(&self) -> Due {
        Due { every: Some(self.every), places: &[] }
    }

    fn append(&mut self, at: &mut At<'_, '_, N>, cells: &mut Vec<Cell<N>>) -> Result<(), Error> {
        let found = at.estimate.expect("runs with this column have an estimator");
        let error = found.error.map_or(Cell::None, |error| Cell::Number(error.clone()));
        cells.extend([Cell::Number(found.value.clone()), error, Cell::Order(found.order)]);
        Ok(())
    }
}
