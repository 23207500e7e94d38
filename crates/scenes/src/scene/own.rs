//! A potential that the caller computes: a function in another language, for example.

use std::any::Any;
use std::fmt;

use shadowstep::{Number, Potential};

/// A potential that the caller computes, in double precision.
pub trait OwnPotential: fmt::Debug + Send + Sync {
    /// Its name in messages and metadata.
    fn name(&self) -> String;

    /// The potential.
    fn potential(&self) -> Box<dyn Potential<f64>>;
}

impl dyn OwnPotential {
    /// The potential where the numbers are doubles.
    ///
    /// # Panics
    /// If they are not, which [`System::check_digits`](super::System::check_digits) excludes.
    pub(super) fn in_numbers<N: Number + 'static>(&self) -> Box<dyn Potential<N>> {
        let potential: Box<dyn Any> = Box::new(self.potential());
        *potential.downcast().expect("the forces of the caller are in double precision")
    }
}
