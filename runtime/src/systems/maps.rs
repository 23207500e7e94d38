//! The maps that a scheme composes: kicks, drifts, gradient kicks and middle parts, and sequences of them.

use std::ops::Range;

pub use shadowstep_schemes::MapKind;

use crate::number::Number;

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

/// What the maps of a step act on: each map is a flow of a part of H for the time `weight`.
///
/// Those of a [`System`](crate::System), with what a step carries along, are made by a [`Stepper`](crate::Stepper).
pub trait Flows {
    /// The type of its numbers.
    type Number: Number;

    /// The flow of the part of kicks, U(q) or H_1, of that of drifts, T(p) or H_n, or of −½U_qᵀM⁻¹U_q.
    fn map(&mut self, kind: MapKind, weight: &Self::Number);

    /// The flows of H_2, …, H_(n−1), one after the other.
    fn middle_parts(&mut self, weight: &Self::Number, order: PartOrder);

    /// The flow of the part of kicks.
    #[inline(always)]
    fn kick(&mut self, weight: &Self::Number) {
        self.map(MapKind::Kick, weight);
    }

    /// The flow of the part of drifts.
    #[inline(always)]
    fn drift(&mut self, weight: &Self::Number) {
        self.map(MapKind::Drift, weight);
    }

    /// The flow of −½U_qᵀM⁻¹U_q.
    #[inline(always)]
    fn gradient_kick(&mut self, weight: &Self::Number) {
        self.map(MapKind::GradientKick, weight);
    }

    /// A map, and after it the middle parts where their weight is given.
    #[inline(always)]
    fn apply(&mut self, kind: MapKind, weight: &Self::Number, middle: Option<&Self::Number>) {
        self.map(kind, weight);
        if let Some(weight) = middle {
            self.middle_parts(weight, PartOrder::after(kind));
        }
    }
}

/// The maps of a step in their order.
#[derive(Clone, Copy, Debug)]
pub struct Sequence<'a> {
    /// The kind of each map, and the place of its weight among the [`Weights`](crate::steps::scheme::Weights) of this
    /// kind.
    pub maps: &'a [(MapKind, usize)],
    /// Of H of [three parts and more](crate::systems::many_parts): between each map and the next the place of the
    /// weight of the middle parts. Other schemes have none.
    pub middle_parts: &'a [usize],
}

/// The maps of a run of steps, one after the other.
///
/// Its type knows the scheme, so that a loop over the maps of generated code is unrolled wherever it is compiled.
pub trait MapSequence<N> {
    /// Applies the maps of these steps of a run of `count`. All steps but the first and the last have the same maps.
    fn each(&self, steps: Range<u64>, count: u64, flows: &mut impl Flows<Number = N>);
}

/// Kicks and drifts with their weights, and how often they are made.
pub(crate) type Repeated<N> = (Vec<(MapKind, N)>, u64);
