//! The error of a run beside a reference, and how well it is known.

use crate::run::PositionError;
use crate::size::Size;

/// The error of a position is this multiple of that of the reference, where it is said to be known.
const RESOLVED: f64 = 20.0;

/// The error of a run over all of the time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verified {
    /// This, to a tenth: the error of the reference is less than a 20th of it.
    Error(Size),
    /// At most this: the reference resolves no more.
    AtMost(Size),
}

impl Verified {
    /// The error, or what it is at most.
    pub fn size(self) -> Size {
        match self {
            Verified::Error(size) | Verified::AtMost(size) => size,
        }
    }

    /// Of a position beside a reference with this error; `None` where it is not known, or the run failed.
    pub(crate) fn of_position(position: PositionError, error: Size) -> Option<Verified> {
        let ten = |size: Size| 10_f64.powf(size.log10());
        match position {
            PositionError::Known(size) if error.log10() <= size.log10() - RESOLVED.log10() => {
                Some(Verified::Error(size))
            }
            PositionError::Known(size) => {
                Some(Verified::AtMost(size.times_power_of_ten((1.0 + ten(error) / ten(size)).log10())))
            }
            // below five times the error, of which one is that of the reference
            PositionError::Below(size) => Some(Verified::AtMost(size.times_power_of_ten(1.2_f64.log10()))),
            PositionError::None => None,
        }
    }
}
