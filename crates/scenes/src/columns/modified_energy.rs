//! The modified energy, its estimated error, and the order of the estimate.

use super::group::{Due, Fixed};
use crate::columns::at::At;
use crate::results::Cell;
use crate::scene::{Outputs, SceneNumber};
use crate::texts::error::Error;

pub(super) const NAMES: [&str; 3] = ["modified_energy", "estimate", "order"];

pub(super) fn of<N: SceneNumber>(output: &Outputs) -> Option<Fixed<N>> {
    output.modified_energy.as_ref().map(|(_, every)| Fixed {
        names: &NAMES,
        due: Due { every: Some(*every), places: &[] },
        append,
    })
}

fn append<N: SceneNumber>(at: &mut At<'_, '_, N>, cells: &mut Vec<Cell<N>>) -> Result<(), Error> {
    let found = at.estimate.expect("runs with this column have an estimator");
    let error = found.error.map_or(Cell::None, |error| Cell::Number(error.clone()));
    cells.extend([Cell::Number(found.value.clone()), error, Cell::Order(found.order)]);
    Ok(())
}
