//! The errors by which schemes are compared.

use serde::{Deserialize, Serialize};

use crate::work_precision::run::{Measurement, PositionError};
use crate::work_precision::size::Size;

/// The error by which schemes are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Of {
    /// That of the position at the end, where the reference resolves it.
    Position,
    /// The largest error of H.
    Energy,
    /// The permanent change of the modified energy, above which one is excluded.
    Permanent,
}

impl Of {
    /// Its description.
    pub fn name(self) -> &'static str {
        match self {
            Of::Position => "error of the position at the end",
            Of::Energy => "largest error of H",
            Of::Permanent => "permanent change of the modified energy, at most",
        }
    }

    /// The error of a run; `None` where it failed or the reference does not resolve it.
    pub(crate) fn error(self, run: &Measurement) -> Option<Size> {
        let error = match self {
            Of::Position => run.position.known()?,
            Of::Energy => run.energy,
            Of::Permanent => run.modified?.bound?,
        };
        (run.failed.is_none() && error.is_finite()).then_some(error)
    }

    /// The error of a run, or what it is at most where the reference does not resolve it; `None` where it failed.
    pub(crate) fn at_most(self, run: &Measurement) -> Option<Size> {
        match (self, run.position, run.failed) {
            (Of::Position, PositionError::Below(bound), None) if bound.is_finite() => Some(bound),
            _ => self.error(run),
        }
    }

    /// By which factor the error grows if the run is twice as long; 1 where that is not known.
    pub(crate) fn growth(self, run: &Measurement) -> f64 {
        let (position, energy) = run.in_first_half;
        let decades = match self {
            Of::Position => {
                run.largest_position.known().zip(position.known()).map_or(0.0, |(all, half)| all.log10() - half.log10())
            }
            Of::Energy => run.energy.log10() - energy.log10(),
            // like the time
            Of::Permanent => 2_f64.log10(),
        };
        if decades.is_finite() { 10_f64.powf(decades.max(0.0)) } else { 1.0 }
    }
}
