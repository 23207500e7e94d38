//! What calculations are.

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::Error;

/// Asked during a calculation with the part of it that is done, from 0 to 1: whether it is to continue.
pub type Continues<'a> = &'a dyn Fn(f64) -> bool;

/// Something to compute, identified by its JSON: calculations with equal JSON are made once.
///
/// Calculations of different types may share a store only if their JSON differs, as that of an `enum` does. Numbers of
/// more than 64 bits must be texts.
pub trait Calculation: Serialize + Sync + Sized {
    /// Floating-point numbers in it must be finite, because JSON has no others.
    type Outcome: Serialize + DeserializeOwned;
    /// What a group of calculations has in common; `()` where each is made alone.
    type Shared: Default;

    /// Calculations with the same group are made together, since they share what is expensive; `None` for one alone.
    fn group(&self) -> Option<String> {
        None
    }

    /// Computes what a group shares.
    fn share(group: &[&Self], continues: Continues<'_>) -> Self::Shared {
        let _ = (group, continues);
        Self::Shared::default()
    }

    /// The approximate time of that.
    fn cost_of_shared(group: &[&Self]) -> f64 {
        let _ = group;
        0.0
    }

    /// The approximate time of the calculation without what is shared, in a unit common to all calculations of a study.
    fn cost(&self) -> f64;

    /// Makes the calculation in one thread. One that is asked not to continue ends soon, with any result, which is
    /// dropped.
    ///
    /// # Errors
    /// A calculation that fails; the others continue.
    fn compute(&self, shared: &Self::Shared, continues: Continues<'_>) -> Result<Self::Outcome, Error>;
}
