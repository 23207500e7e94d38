//! Indicators of chaos up to the state.

use super::{Due, Group};
use crate::at::At;
use crate::error::Error;
use crate::results::{Cell, Name};
use crate::run_number::RunNumber;
use crate::scene::Outputs;

pub(super) const NAMES: [&str; 4] = ["lyapunov", "megno", "mean_megno", "sali"];

struct Chaos {
    every: u64,
}

pub(super) fn of<N: RunNumber>(output: &Outputs) -> Option<Box<dyn Group<N>>> {
    output.chaos.map(|every| Box::new(Chaos { every }) as Box<_>)
}

impl<N: RunNumber> Group<N> for Chaos {
    fn names(&self) -> Vec<Name> {
        NAMES.map(Name::from).to_vec()
    }

    fn due(&self) -> Due {
        Due { every: Some(self.every), places: &[] }
    }

    /// One that is not defined, as at t = 0, is NaN.
    fn append(&mut self, at: &mut At<'_, '_, N>, cells: &mut Vec<Cell<N>>) -> Result<(), Error> {
        let run = at.vectors().expect("runs with these columns have tangent vectors");
        let growth = run.growths()[0];
        let indicators = [growth.lyapunov(), Some(growth.megno()), growth.mean_megno(), run.sali()];
        cells.extend(indicators.map(|found| Cell::Double(found.unwrap_or(f64::NAN))));
        Ok(())
    }
}
