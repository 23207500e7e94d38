//! The maps of a scheme with their weights: steps one by one, or merged where they meet.

use std::ops::Range;

use crate::number::Number;
use crate::steps::scheme::Scheme;
use crate::steps::weights::WeightLists;
use crate::systems::maps::{Flows, MapKind, MapSequence};

/// The maps of steps one by one, with weights such as those of a [`Stepper`](crate::Stepper).
pub(crate) struct Maps<'a, S: Scheme, N: Number> {
    scheme: &'a S,
    weights: &'a S::Weights<N>,
}

impl<'a, S: Scheme, N: Number> Maps<'a, S, N> {
    pub(crate) fn new(scheme: &'a S, weights: &'a S::Weights<N>) -> Self {
        Maps { scheme, weights }
    }

    #[inline(always)]
    fn weight(&self, (kind, place): (MapKind, usize)) -> &'a N {
        &self.weights.view().of(kind)[place]
    }

    /// The weight of the middle parts after the map at this index.
    #[inline(always)]
    fn middle_weight(&self, index: usize) -> Option<&'a N> {
        let place = *self.scheme.sequence().middle_parts.get(index)?;
        Some(&self.weights.view().middle_parts[place])
    }
}

impl<S: Scheme, N: Number> MapSequence<N> for Maps<'_, S, N> {
    #[inline(always)]
    fn each(&self, steps: Range<u64>, _: u64, flows: &mut impl Flows<Number = N>) {
        if S::IS_INLINED {
            // no `for_each`: what it calls is not inlined into it, and not compiled for the instructions of the caller
            for _ in steps {
                self.scheme.forward(self.weights, flows);
            }
            return;
        }
        for _ in steps {
            for (index, &map) in self.scheme.sequence().maps.iter().enumerate() {
                flows.apply(map.0, self.weight(map), self.middle_weight(index));
            }
        }
    }
}

/// The maps of steps of H of two parts where the last map of a step and the first of the next, which are of one kind,
/// are made as one.
pub(crate) struct MergedMaps<'a, S: Scheme, N: Number> {
    pub(crate) maps: Maps<'a, S, N>,
    /// The weight of the merged map.
    pub(crate) weight: &'a N,
}

impl<S: Scheme, N: Number> MapSequence<N> for MergedMaps<'_, S, N> {
    #[inline(always)]
    fn each(&self, steps: Range<u64>, count: u64, flows: &mut impl Flows<Number = N>) {
        let MergedMaps { maps, weight: merged } = self;
        let &[first, ref middle @ .., last] = maps.scheme.sequence().maps else { return };
        if steps.start == 0 && !steps.is_empty() {
            flows.apply(first.0, maps.weight(first), None);
        }
        for step in steps {
            for &map in middle {
                flows.apply(map.0, maps.weight(map), None);
            }
            flows.apply(last.0, if step + 1 < count { merged } else { maps.weight(last) }, None);
        }
    }
}
