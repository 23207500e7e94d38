//! The energy H.

use super::group::{Due, Fixed};
use crate::columns::at::{At, Place};
use crate::results::Cell;
use crate::scene::{Outputs, SceneNumber};
use crate::texts::error::Error;

pub(super) const NAMES: [&str; 1] = ["energy"];

pub(super) fn of<N: SceneNumber>(output: &Outputs) -> Option<Fixed<N>> {
    let due = Due { every: output.energy, places: &[Place::Crossing, Place::PhysicalEnd] };
    output.energy.map(|_| Fixed { names: &NAMES, due, append })
}

fn append<N: SceneNumber>(at: &mut At<'_, '_, N>, cells: &mut Vec<Cell<N>>) -> Result<(), Error> {
    cells.push(Cell::Number(at.energy()?.clone()));
    Ok(())
}
