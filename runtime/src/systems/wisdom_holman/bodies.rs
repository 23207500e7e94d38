//! The bodies of a planetary system: the gravitational constant and the masses.

use num_traits::Signed;
use shadowstep_symbolic::decimal::to_significant;
use thiserror::Error;

use crate::Rational;

/// The gravitational constant and the masses of the bodies, the central one first. All are exact.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bodies {
    pub(super) g: Rational,
    pub(super) masses: Vec<Rational>,
}

impl Bodies {
    /// Bodies of these masses.
    ///
    /// # Errors
    /// Fewer than two bodies; a mass or a gravitational constant that is not positive.
    pub fn new(g: Rational, masses: Vec<Rational>) -> Result<Self, BodiesError> {
        if masses.len() < 2 {
            return Err(BodiesError::Count { found: masses.len() });
        }
        if !g.is_positive() {
            return Err(BodiesError::Constant { found: to_significant(&g, 6) });
        }
        match masses.iter().position(|mass| !mass.is_positive()) {
            Some(body) => Err(BodiesError::Mass { body, found: to_significant(&masses[body], 6) }),
            None => Ok(Bodies { g, masses }),
        }
    }

    /// How many there are, the central one included.
    pub fn count(&self) -> usize {
        self.masses.len()
    }

    /// The masses, the central one first.
    pub fn masses(&self) -> &[Rational] {
        &self.masses
    }

    /// η_i = m_0 + … + m_i
    pub(super) fn sums(&self) -> Vec<Rational> {
        let mut sum = Rational::from_integer(0.into());
        self.masses
            .iter()
            .map(|mass| {
                sum += mass;
                sum.clone()
            })
            .collect()
    }
}

/// Bodies that are not a planetary system.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum BodiesError {
    /// A distance of shells that is not positive.
    #[error("the distance below which planets are close must be positive")]
    Shells,
    /// A substep that is not positive.
    #[error("the substep must be positive")]
    Substep,
    /// Fewer than two.
    #[error("a planetary system needs a central body and at least one planet, not {found} bodies")]
    Count {
        /// How many there are.
        found: usize,
    },
    /// The gravitational constant is not positive.
    #[error("the gravitational constant must be positive, not {found}")]
    Constant {
        /// Its value.
        found: String,
    },
    /// A mass is not positive.
    #[error("the mass of body {body} must be positive, not {found}")]
    Mass {
        /// The body; the central one is 0.
        body: usize,
        /// Its mass.
        found: String,
    },
    /// A potential of positions with more or fewer coordinates.
    #[error("a potential of {found} coordinates is not one of {bodies} bodies in {dimensions} dimensions")]
    Potential {
        /// The dimension of the potential.
        found: usize,
        /// How many bodies there are.
        bodies: usize,
        /// The dimensions of their positions.
        dimensions: usize,
    },
    /// A potential beside the attraction in heliocentric coordinates.
    #[error(
        "in heliocentric coordinates kicks move the planets, so that a potential beside their attraction has no exact flow with them"
    )]
    NoFlow,
    /// An initial value is infinite or NaN.
    #[error("the initial value of {name} is not finite")]
    NotFinite {
        /// Such as q1, counted from 1.
        name: String,
    },
    /// A state of another dimension.
    #[error("{bodies} bodies in {dimensions} dimensions have {} coordinates, not {found}", bodies * dimensions)]
    State {
        /// The dimension of q or p.
        found: usize,
        /// How many bodies there are.
        bodies: usize,
        /// In how many dimensions.
        dimensions: usize,
    },
}
