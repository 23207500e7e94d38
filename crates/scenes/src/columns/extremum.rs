//! The least or the greatest value of an expression along a run.

use shadowstep::Real;

/// Which of the two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extremum {
    /// The least value.
    Least,
    /// The greatest value.
    Greatest,
}

impl Extremum {
    /// Whether a value takes the place of the one found so far: one that is not finite does not, and of equal ones the
    /// first stays.
    pub fn is_beyond<N: Real>(self, value: &N, found: Option<&N>) -> bool {
        value.is_finite()
            && found.is_none_or(|found| match self {
                Extremum::Least => value < found,
                Extremum::Greatest => value > found,
            })
    }
}
