//! The error of a run beside a reference, and how well it is known.

use crate::work_precision::run::PositionError;
use crate::work_precision::size::Size;

/// The error of a position is this multiple of that of the reference, where it is said to be known.
const RESOLVED: f64 = 20.0;

/// Of what an error is at most where it is below five times the error of the reference, which adds one.
const WITH_REFERENCE: f64 = 1.2;

/// The error of a run over all of the time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verified {
    /// This, to a tenth: the error of the reference is less than a 20th of it.
    Error(Size),
    /// At most this: the error of the reference is a part of it.
    AtMost(Size),
    /// At most this, which is all that the reference resolves.
    Unresolved(Size),
}

impl Verified {
    /// The error, or what it is at most.
    pub fn size(self) -> Size {
        match self {
            Verified::Error(size) | Verified::AtMost(size) | Verified::Unresolved(size) => size,
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
            PositionError::Below(size) => Some(Verified::Unresolved(size.times_power_of_ten(WITH_REFERENCE.log10()))),
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
        assert!(matches!(verified(PositionError::Below(resolved)), Verified::Unresolved(_)));
        assert!(matches!(verified(PositionError::Known(size(5.1e-9))), Verified::AtMost(_)));
        assert_eq!(verified(PositionError::Known(size(2.1e-8))), Verified::Error(size(2.1e-8)));
    }
}
