//! The maps of a scheme with their weights: steps one by one, or merged where they meet.

use std::ops::Range;

use crate::maps::{MapKind, MapSequence};
use crate::scheme::Scheme;

/// Those of steps one by one, with weights such as those of a [`Stepper`](crate::Stepper).
#[derive(Debug)]
pub(crate) struct Maps<'a, S, N> {
    scheme: &'a S,
    weights: &'a [N],
}

impl<'a, S: Scheme, N> Maps<'a, S, N> {
    pub(crate) fn new(scheme: &'a S, weights: &'a [N]) -> Self {
        Maps { scheme, weights }
    }

    #[inline(always)]
    fn weight(&self, (kind, place): (MapKind, usize)) -> &'a N {
        let kicks = self.scheme.maps().0;
        match kind {
            MapKind::Kick => &self.weights[place],
            MapKind::Drift => &self.weights[kicks + place],
            MapKind::GradientKick => &self.weights[self.weights.len() - self.scheme.gradient_kicks() + place],
        }
    }

    /// Of the middle parts after the map at this index.
    #[inline(always)]
    fn middle_weight(&self, index: usize) -> Option<&'a N> {
        let (count, middle) = self.scheme.middle();
        let place = middle.get(index)?;
        Some(&self.weights[self.weights.len() - self.scheme.gradient_kicks() - count + place])
    }
}

impl<S: Scheme, N> MapSequence<N> for Maps<'_, S, N> {
    #[inline(always)]
    fn each(&self, steps: Range<u64>, _: u64, mut map: impl FnMut(MapKind, &N, Option<&N>)) {
        for _ in steps {
            for (index, &own) in self.scheme.maps().1.iter().enumerate() {
                map(own.0, self.weight(own), self.middle_weight(index));
            }
        }
    }
}

/// Those of steps of H of two parts where the last map of a step and the first of the next, which are of one kind, are made as one.
#[derive(Debug)]
pub(crate) struct MergedMaps<'a, S, N> {
    pub(crate) maps: Maps<'a, S, N>,
    /// That of the merged map.
    pub(crate) weight: &'a N,
}

impl<S: Scheme, N> MapSequence<N> for MergedMaps<'_, S, N> {
    #[inline(always)]
    fn each(&self, steps: Range<u64>, count: u64, mut map: impl FnMut(MapKind, &N, Option<&N>)) {
        let MergedMaps { maps, weight: merged } = self;
        let &[first, ref middle @ .., last] = maps.scheme.maps().1 else { return };
        if steps.start == 0 && !steps.is_empty() {
            map(first.0, maps.weight(first), None);
        }
        for step in steps {
            for &own in middle {
                map(own.0, maps.weight(own), None);
            }
            map(last.0, if step + 1 < count { merged } else { maps.weight(last) }, None);
        }
    }
}
