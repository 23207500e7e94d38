//! The pre-map and the post-map of a processed scheme, with a step size.

use crate::Rational;
use crate::maps::MapKind;
use crate::number::Number;
use crate::scheme::Scheme;
use crate::system::{Remainders, System};

/// χ and χ⁻¹ of a processed scheme χ⁻¹ ∘ kernelⁿ ∘ χ, their weights times h; both are the identity for other schemes.
#[derive(Clone, Debug)]
pub(crate) struct Processor<N> {
    pre: Vec<(MapKind, N)>,
    post: Vec<(MapKind, N)>,
}

impl<N: Number> Processor<N> {
    /// h·w of each weight w, an exact product rounded once; the pre-map has the same maps backwards with the negatives.
    pub(crate) fn of(scheme: &impl Scheme, h: &Rational, context: &N::Context) -> Self {
        let maps = scheme.processor();
        let times = |h: Rational| {
            move |(kind, weight): &(MapKind, Rational)| (*kind, N::from_rational(&(&h * weight), context))
        };
        Processor { pre: maps.iter().rev().map(times(-h)).collect(), post: maps.iter().map(times(h.clone())).collect() }
    }

    pub(crate) fn is_identity(&self) -> bool {
        self.post.is_empty()
    }

    pub(crate) fn preprocess(&self, system: &mut impl System<Number = N>) {
        act(&self.pre, system);
    }

    pub(crate) fn postprocess(&self, system: &mut impl System<Number = N>) {
        act(&self.post, system);
    }
}

fn act<N: Number>(maps: &[(MapKind, N)], system: &mut impl System<Number = N>) {
    for (kind, weight) in maps {
        match kind {
            MapKind::Kick => system.kick(weight),
            MapKind::Drift => system.drift(weight),
            MapKind::GradientKick => unreachable!("a processor has kicks and drifts only"),
        }
    }
}

/// A state that a system leaves and comes back to, to the last bit.
pub(crate) struct Kept<N> {
    q: Vec<N>,
    p: Vec<N>,
    remainders: Remainders<N>,
}

impl<N: Number> Kept<N> {
    pub(crate) fn of(system: &impl System<Number = N>) -> Self {
        Kept { q: system.q().to_vec(), p: system.p().to_vec(), remainders: system.remainders() }
    }

    pub(crate) fn restore(&self, system: &mut impl System<Number = N>) {
        system.set_state(&self.q, &self.p);
        system.set_remainders(&self.remainders);
    }
}
