//! The m of the estimator of the modified energy.

use shadowstep::shadow::{Central, Stop};

/// Beyond this m the exact weights take longer than any run.
pub(crate) const HIGHEST_M: u32 = 1000;

/// The largest m that is tried where none is asked for.
pub(crate) const DEFAULT_LARGEST_M: u32 = 200;

/// The m of the estimator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Order {
    Fixed(u32),
    Best(u32, Stop),
}

impl Order {
    /// The estimator; a fixed order estimates its error only if asked to.
    pub(crate) fn method(self, with_error: bool) -> Central {
        match self {
            Order::Fixed(m) => Central::Fixed { m, with_error },
            Order::Best(largest, stop) => Central::best(largest, stop),
        }
    }
}
