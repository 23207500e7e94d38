//! The error of a run beside a reference, and how well it is known.

use crate::run::PositionError;
use crate::size::Size;

/// The error of a position is this multiple of that of the reference, where it is said to be known.
const RESOLVED: f64 = 20.0;

/// What errors are at most that are below five times the error of the reference, which adds one.
fn at_most(resolved: Size) -> Size {
    resolved.times_power_of_ten(1.2_f64.log10())
}

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

    /// Whether this is all that a reference says which resolves errors above a size.
    pub(crate) fn is_unresolved(self, resolved: Size) -> bool {
        matches!(self, Verified::AtMost(bound) if bound <= at_most(resolved))
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
            PositionError::Below(size) => Some(Verified::AtMost(at_most(size))),
            PositionError::None => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_reference_does_not_resolve_is_told_from_an_error() {
        let size = |x: f64| Size::of(&x);
        let (error, resolved) = (size(1e-9), size(5e-9));
        let verified = |position| Verified::of_position(position, error).unwrap();
        assert!(verified(PositionError::Below(resolved)).is_unresolved(resolved));
        assert!(!verified(PositionError::Known(size(5.1e-9))).is_unresolved(resolved));
        assert_eq!(verified(PositionError::Known(size(2.1e-8))), Verified::Error(size(2.1e-8)));
    }
}
