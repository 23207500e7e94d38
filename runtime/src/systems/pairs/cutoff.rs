//! Where the energy of a pair ends: at a distance, abruptly or smoothly, in open space or in a periodic box.

use num_traits::{Signed, Zero};
use thiserror::Error;

use crate::Rational;

/// The most continuous derivatives that a switch has.
pub const MOST_DERIVATIVES: u32 = 8;

/// The distance r_c from which on two bodies do not interact, in D dimensions.
///
/// Without a [switch](Cutoff::switched) the energy of a pair is u(r²) up to r_c and 0 from there on. It jumps at r_c by
/// u(r_c²), and so does the force: no scheme conserves such an energy, and orders gain nothing. With a switch it is
/// S(t) u(r²), where t = (r_c² − r²)/(r_c² − r_s²) falls from 1 to 0 between r_s and r_c, and S is the polynomial of
/// degree 2n + 1 whose first n derivatives vanish at both ends: n continuous derivatives of U.
///
/// In a [box](Cutoff::in_box) a body interacts with the nearest image of each other one.
///
/// ```
/// use shadowstep::{exact, systems::pairs::Cutoff};
///
/// let side = exact("10.229*3.405")?;
/// let cutoff = Cutoff::<3>::at(exact("2.25*3.405")?)?
///     .switched(exact("2*3.405")?, 3)?
///     .in_box([side.clone(), side.clone(), side])?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cutoff<const D: usize> {
    radius: Rational,
    switch: Option<Switch>,
    sides: Option<[Rational; D]>,
}

/// From where on the energy of a pair falls to 0, and with how many continuous derivatives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Switch {
    /// r_s
    pub from: Rational,
    /// n ≥ 1
    pub derivatives: u32,
}

impl<const D: usize> Cutoff<D> {
    /// An abrupt cutoff at the distance r_c, in open space.
    ///
    /// # Errors
    /// A distance that is not positive.
    pub fn at(radius: Rational) -> Result<Self, CutoffError> {
        match radius.is_positive() {
            true => Ok(Cutoff { radius, switch: None, sides: None }),
            false => Err(CutoffError::Radius),
        }
    }

    /// The same cutoff, to which the energy falls smoothly from the distance r_s on, with this number of continuous
    /// derivatives.
    ///
    /// # Errors
    /// A distance that is negative or not below r_c; derivatives that are not 1 to [`MOST_DERIVATIVES`].
    pub fn switched(self, from: Rational, derivatives: u32) -> Result<Self, CutoffError> {
        if from.is_negative() || from >= self.radius {
            return Err(CutoffError::Switch);
        }
        if !(1..=MOST_DERIVATIVES).contains(&derivatives) {
            return Err(CutoffError::Derivatives);
        }
        Ok(Cutoff { switch: Some(Switch { from, derivatives }), ..self })
    }

    /// The same cutoff in a box with these sides, periodic along each axis: a body interacts with the nearest image of
    /// another one. Positions stay unwrapped.
    ///
    /// # Errors
    /// A side shorter than 2 r_c, where two images of a body would interact with another one.
    pub fn in_box(self, sides: [Rational; D]) -> Result<Self, CutoffError> {
        let least = &self.radius * Rational::from_integer(2.into());
        match sides.iter().position(|side| *side < least) {
            Some(axis) => Err(CutoffError::Side { axis: axis + 1 }),
            None => Ok(Cutoff { sides: Some(sides), ..self }),
        }
    }

    /// r_c
    pub(crate) fn radius(&self) -> &Rational {
        &self.radius
    }

    /// Where the energy begins to fall; none of an abrupt cutoff.
    pub(crate) fn switch(&self) -> Option<&Switch> {
        self.switch.as_ref()
    }

    /// The sides of the box; none in open space.
    pub(crate) fn sides(&self) -> Option<&[Rational; D]> {
        self.sides.as_ref()
    }

    /// r_c², r_s², and 1/(r_c² − r_s²): r_s is r_c of an abrupt cutoff, and the last one 0.
    pub(super) fn squares(&self) -> [Rational; 3] {
        let squared = &self.radius * &self.radius;
        let from = self.switch.as_ref().map_or_else(|| squared.clone(), |switch| &switch.from * &switch.from);
        let width = &squared - &from;
        let reciprocal = if width.is_zero() { width } else { width.recip() };
        [squared, from, reciprocal]
    }
}

/// A cutoff that cannot be.
#[derive(Clone, Copy, PartialEq, Eq, Error)]
pub enum CutoffError {
    /// r_c ≤ 0
    #[error("the cutoff must be a positive distance")]
    Radius,
    /// r_s < 0 or r_s ≥ r_c
    #[error("the distance from which on the energy falls must be below the cutoff, and not negative")]
    Switch,
    /// n is 0 or too large.
    #[error("the number of continuous derivatives must be 1 to {MOST_DERIVATIVES}")]
    Derivatives,
    /// A body would interact with two images of another one.
    #[error("the box must be at least twice as long as the cutoff along each axis; axis {axis} is shorter")]
    Side {
        /// Counted from 1.
        axis: usize,
    },
}

shadowstep_schemes::debug_as_text!(CutoffError);
