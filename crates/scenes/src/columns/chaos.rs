//! Indicators of chaos up to the state; one that is not defined, as at t = 0, is NaN.

use super::group::{Due, Fixed};
use crate::columns::at::At;
use crate::results::Cell;
use crate::scene::{Outputs, SceneNumber};
use crate::texts::error::Error;

pub(super) const NAMES: [&str; 4] = ["lyapunov", "megno", "mean_megno", "sali"];

pub(super) fn of<N: SceneNumber>(output: &Outputs) -> Option<Fixed<N>> {
    output.chaos.map(|every| Fixed { names: &NAMES, due: Due { every: Some(every), places: &[] }, append })
}

fn append<N: SceneNumber>(at: &mut At<'_, '_, N>, cells: &mut Vec<Cell<N>>) -> Result<(), Error> {
    let run = at.vectors().expect("runs with these columns have tangent vectors");
    let growth = run.growths()[0];
    let indicators = [growth.lyapunov(), Some(growth.megno()), growth.mean_megno(), run.sali()];
    cells.extend(indicators.map(|found| Cell::Double(found.unwrap_or(f64::NAN))));
    Ok(())
}
