//! What a drift cannot be computed from.

use thiserror::Error;

use crate::number::{Number, scaled};

/// Wrong input of a Kepler drift.
#[derive(Clone, PartialEq, Error)]
pub enum KeplerDriftError {
    /// A gravity parameter that does not attract.
    #[error("the gravity parameter μ of a Kepler drift must be positive and finite, but it is {0}")]
    Gravity(f64),
    /// A time that is infinite or NaN.
    #[error("the time of a Kepler drift must be finite, but it is {0}")]
    Time(f64),
    /// Position and velocity of different dimensions, or of none.
    #[error(
        "a Kepler drift needs as many velocities as positions, and one at least, but it has {positions} positions and \
            {velocities} velocities"
    )]
    Dimensions {
        /// of positions
        positions: usize,
        /// of velocities
        velocities: usize,
    },
    /// A position or velocity that is infinite or NaN.
    #[error("the state of a Kepler drift must be finite, but {letter}[{index}] is {value}")]
    State {
        /// q or v
        letter: char,
        /// from 0
        index: usize,
        /// as an `f64`
        value: f64,
    },
    /// q = 0.
    #[error("the position of a Kepler drift must not be the centre, q = 0")]
    Centre,
}

shadowstep_schemes::debug_as_text!(KeplerDriftError);

/// Checks the input of a drift, in every lane.
pub(super) fn check<N: Number>(mu: &N, time: &N, q: &[N], v: &[N]) -> Result<(), KeplerDriftError> {
    if q.is_empty() || q.len() != v.len() {
        return Err(KeplerDriftError::Dimensions { positions: q.len(), velocities: v.len() });
    }
    for lane in 0..N::LANES {
        let value = |x: &N| {
            let (m, n) = x.lane(lane);
            scaled(m, n)
        };
        if !(mu.lane(lane).0 > 0.0 && mu.lane(lane).0.is_finite()) {
            return Err(KeplerDriftError::Gravity(value(mu)));
        }
        if !time.lane(lane).0.is_finite() {
            return Err(KeplerDriftError::Time(value(time)));
        }
        for (letter, numbers) in [('q', q), ('v', v)] {
            if let Some(index) = numbers.iter().position(|x| !x.lane(lane).0.is_finite()) {
                return Err(KeplerDriftError::State { letter, index, value: value(&numbers[index]) });
            }
        }
        if q.iter().all(|q| q.lane(lane).0 == 0.0) {
            return Err(KeplerDriftError::Centre);
        }
    }
    Ok(())
}
