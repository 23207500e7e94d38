//! Bodies and a pair's energy that do not fit together.

use thiserror::Error;

/// Bodies and a pair's energy that do not fit together.
#[derive(Clone, Copy, PartialEq, Eq, Error)]
pub enum PairsError {
    /// There is nothing to sum over.
    #[error("a sum over pairs needs at least one body and one dimension")]
    Empty,
    /// A formula in d for bodies that are not on a line.
    #[error("a formula in d is for bodies on a line, not in {dimensions} dimensions; write it in r2")]
    Separation {
        /// The dimensions.
        dimensions: usize,
    },
    /// A formula in d with a cutoff.
    #[error("a cutoff is for formulas in r2; write the pair's energy in r2")]
    Cutoff,
    /// A property with too few or too many values.
    #[error("a property has {values} values for {bodies} bodies; give one for each body")]
    Property {
        /// The number of its values.
        values: usize,
        /// The number of bodies.
        bodies: usize,
    },
    /// Walls at the ends of a chain of bodies with properties.
    #[error("fixed ends are for pairs without properties, as walls have none")]
    WallsWithoutProperties,
}

shadowstep_schemes::debug_as_text!(PairsError);
