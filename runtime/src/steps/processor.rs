//! The pre-map and the post-map of a processed scheme, with a step size.

use crate::Rational;
use crate::number::Number;
use crate::steps::scheme::Scheme;
use crate::systems::increments::Carried;
use crate::systems::maps::{Flows, MapKind};
use crate::systems::system::{Carrying, System};

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

    /// The same for steps of a part of h: each weight times the part, rounded once more.
    pub(crate) fn of_part(&self, part: &N) -> Self {
        let times = |(kind, weight): &(MapKind, N)| {
            let mut product = weight.clone();
            product.multiply(part);
            (*kind, product)
        };
        Processor { pre: self.pre.iter().map(times).collect(), post: self.post.iter().map(times).collect() }
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
    let mut flows = Carrying { system, carried: Carried::Nothing };
    maps.iter().for_each(|(kind, weight)| flows.apply(*kind, weight, None));
}
