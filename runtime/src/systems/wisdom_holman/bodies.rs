//! The bodies of a planetary system: the gravitational constant and the masses.

use num_traits::{Signed, Zero};
use shadowstep_schemes::symbolic::decimal::to_significant;
use thiserror::Error;

use crate::Rational;

/// The gravitational constant and the masses of the bodies, the central one first. All are exact. Bodies of mass 0,
/// *particles*, come last: they move in the field of the others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bodies {
    pub(super) g: Rational,
    /// Of those that are not particles.
    pub(super) masses: Vec<Rational>,
    pub(super) particles: usize,
}

impl Bodies {
    /// Bodies of these masses.
    ///
    /// # Errors
    /// Fewer than two bodies with mass; a negative mass, or a body without mass before one with mass; a gravitational
    /// constant that is not positive.
    pub fn new(g: Rational, mut masses: Vec<Rational>) -> Result<Self, BodiesError> {
        let massive = masses.iter().rposition(|mass| !mass.is_zero()).map_or(0, |last| last + 1);
        let particles = masses.split_off(massive).len();
        if massive < 2 {
            return Err(BodiesError::Count { found: massive });
        }
        if !g.is_positive() {
            return Err(BodiesError::Constant { found: to_significant(&g, 6) });
        }
        match masses.iter().position(|mass| !mass.is_positive()) {
            Some(body) => Err(BodiesError::Mass { body, found: to_significant(&masses[body], 6) }),
            None => Ok(Bodies { g, masses, particles }),
        }
    }

    /// The gravitational constant.
    pub fn g(&self) -> &Rational {
        &self.g
    }

    /// How many there are, the central one included.
    pub fn count(&self) -> usize {
        self.masses.len() + self.particles
    }

    /// How many have the mass 0: the last ones.
    pub fn particles(&self) -> usize {
        self.particles
    }

    /// Those with mass.
    #[must_use]
    pub fn without_particles(&self) -> Self {
        Bodies { particles: 0, ..self.clone() }
    }

    /// The masses that are not 0, the central one first.
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
#[derive(Clone, PartialEq, Eq, Error)]
pub enum BodiesError {
    /// A distance of shells that is not positive.
    #[error("the distance below which planets are close must be positive")]
    Shells,
    /// A substep that is not positive.
    #[error("the substep must be positive")]
    Substep,
    /// Fewer than two.
    #[error("a planetary system needs a central body and at least one planet with mass, not {found} bodies")]
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
    /// A mass is negative, or 0 before one that is not.
    #[error("the mass of body {body} must be positive, not {found}; bodies of mass 0 come last")]
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
        "in heliocentric coordinates kicks move the planets, so that a potential beside their attraction has no exact \
            flow with them"
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

shadowstep_schemes::debug_as_text!(BodiesError);
