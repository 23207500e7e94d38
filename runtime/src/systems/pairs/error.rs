//! Bodies and a pair's energy that do not fit together.

use shadowstep_schemes::symbolic::Separation;
use thiserror::Error;

use super::pair::Pair;

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

impl PairsError {
    /// Refuses an empty sum, a formula in d where there is a reason, and properties that are not those of `given` bodies.
    pub(super) fn refuse(
        pair: &impl Pair,
        [bodies, dimensions, given]: [usize; 3],
        formula_in_d: Option<PairsError>,
    ) -> Result<(), PairsError> {
        if bodies == 0 || dimensions == 0 {
            return Err(PairsError::Empty);
        }
        if let Some(reason) = formula_in_d.filter(|_| pair.separation() == Separation::Difference) {
            return Err(reason);
        }
        match pair.properties().into_iter().find(|values| *values != given) {
            Some(values) => Err(PairsError::Property { values, bodies: given }),
            None => Ok(()),
        }
    }
}
