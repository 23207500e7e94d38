//! Steppers that do not fit a system.

use thiserror::Error;

/// A stepper that does not fit a system.
#[derive(Clone, PartialEq, Eq, Error)]
pub enum MismatchError {
    /// The weights of the stepper have another precision than the numbers of the system.
    #[error("the weights of the stepper have another precision than the system: make both with the same context")]
    Precision,
    /// The scheme has gradient kicks, which the system does not support.
    #[error(
        "{scheme} has gradient kicks, which this system has not: its potential needs a Hessian–vector product (write \
         it as a formula, or implement `Potential::hessian`), or displaced forces in its place \
         (`Stepper::displacements`)"
    )]
    NoGradientKicks {
        /// The scheme's name.
        scheme: String,
    },
}

shadowstep_schemes::debug_as_text!(MismatchError);
