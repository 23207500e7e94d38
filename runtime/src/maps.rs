//! Sequences of kicks, drifts, gradient kicks and middle parts, such as the steps of a run.

use std::ops::Range;

pub use shadowstep_schemes::MapKind;

/// The order in which the middle parts H_2, …, H_(n−1) of H flow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PartOrder {
    /// From H_2 to H_(n−1): after a kick.
    Ascending,
    /// From H_(n−1) to H_2: after a drift.
    Descending,
}

impl PartOrder {
    /// The order after a map.
    pub fn after(kind: MapKind) -> PartOrder {
        match kind {
            MapKind::Drift => PartOrder::Descending,
            MapKind::Kick | MapKind::GradientKick => PartOrder::Ascending,
        }
    }
}

/// The maps of a run of steps, one after the other.
///
/// Its type knows the scheme, so that a loop over the maps of generated code is unrolled wherever it is compiled.
pub trait MapSequence<N> {
    /// Calls `map` for the maps of these steps of a run of so many: its kind, its weight, and the weight of the middle parts after it, in
    /// the order that is [theirs](PartOrder::after) there; `None` for H of two parts. All steps but the first and the last have the same maps.
    ///
    /// ```
    /// use shadowstep::System;
    /// use shadowstep::scheme::{MapKind, MapSequence};
    ///
    /// fn advance<M: System>(system: &mut M, maps: &impl MapSequence<M::Number>, count: u64) {
    ///     maps.each(0..count, count, |kind, weight, _| match kind {
    ///         MapKind::Kick => system.kick(weight),
    ///         MapKind::Drift => system.drift(weight),
    ///         MapKind::GradientKick => system.gradient_kick(weight),
    ///     });
    /// }
    /// ```
    fn each(&self, steps: Range<u64>, count: u64, map: impl FnMut(MapKind, &N, Option<&N>));
}
