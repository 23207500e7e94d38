//! Why a run cannot begin or cannot continue.

use std::fmt;

use thiserror::Error;

use crate::number::Real;
use crate::shadow::EstimatorError;
use crate::steps::MismatchError;

/// What may help: at the start no step has been made.
fn remedy(step: i64) -> &'static str {
    if step == 0 {
        "choose other initial values or parameters"
    } else {
        "try a smaller step size or other initial values"
    }
}

/// A run that cannot begin or cannot continue.
#[derive(Clone, PartialEq, Eq, Error)]
pub enum RunError {
    /// A value is infinite or NaN.
    #[error("the run stopped at step {step}: {value}; {}", remedy(*step))]
    NotFinite {
        /// n of the state that is not finite (negative before the start).
        step: i64,
        /// The first such value.
        value: NotFinite,
    },
    /// The source of the states ended before their last one, because it was asked to.
    #[error("the run was stopped at step {step}")]
    Stopped {
        /// n of the state that was to come next.
        step: i64,
    },
    /// The system is not the one with which a monitor began.
    #[error(
        "the system has {coordinates} coordinates, and the one at the start had {begun}; a monitor follows one system"
    )]
    Dimension {
        /// Its coordinates.
        coordinates: usize,
        /// The coordinates of the system at the start.
        begun: usize,
    },
    /// The stepper does not fit the system.
    #[error(transparent)]
    Mismatch(#[from] MismatchError),
    /// The settings of the estimator are not valid.
    #[error(transparent)]
    Estimator(#[from] EstimatorError),
}

shadowstep_schemes::debug_as_text!(RunError);

/// A value that is infinite or NaN, or a position whose square is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotFinite {
    /// What it is a value of.
    pub quantity: Quantity,
    /// The value as text: `NaN`, `inf` or `-inf`; or such as `1e160, whose square overflows`.
    pub value: String,
}

/// What a run computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// A coordinate of q, counted from 0.
    Position(usize),
    /// A component of p, counted from 0.
    Momentum(usize),
    /// What a step added to β.
    Beta,
    /// H
    Energy,
    /// H̄
    ModifiedEnergy,
    /// The estimated error of H̄.
    ModifiedEnergyError,
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Quantity::Position(index) => write!(f, "q{}", index + 1),
            Quantity::Momentum(index) => write!(f, "p{}", index + 1),
            Quantity::Beta => f.write_str("the increment of β, for the modified energy,"),
            Quantity::Energy => f.write_str("the energy"),
            Quantity::ModifiedEnergy => f.write_str("the modified energy"),
            Quantity::ModifiedEnergyError => f.write_str("the estimated error of the modified energy"),
        }
    }
}

impl fmt::Display for NotFinite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.quantity {
            Quantity::Position(_) | Quantity::Momentum(_) => {
                write!(f, "{} = {}", self.quantity, self.value)
            }
            _ => write!(f, "{} is {}", self.quantity, self.value),
        }
    }
}

/// Refuses a value that is not finite. States may be finite where their products overflow.
#[inline]
pub(crate) fn check_value<N: Real>(value: &N, quantity: Quantity, step: i64) -> Result<(), RunError> {
    if value.is_finite() {
        return Ok(());
    }
    Err(RunError::NotFinite { step, value: NotFinite { quantity, value: value.to_text() } })
}

/// Refuses an energy that is not finite; names the position from which that comes, where its square overflows.
pub(crate) fn check_energy<N: Real>(energy: &N, q: &[N], step: i64) -> Result<(), RunError> {
    let overflows = |position: &N| position.is_finite() && !position.has_finite_square();
    // NaN is not ordered
    match q.iter().position(overflows).filter(|_| energy.partial_cmp(energy).is_none()) {
        Some(index) => {
            let value = format!("{}, whose square overflows", q[index].to_text());
            Err(RunError::NotFinite { step, value: NotFinite { quantity: Quantity::Position(index), value } })
        }
        None => check_value(energy, Quantity::Energy, step),
    }
}
