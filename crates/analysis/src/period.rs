//! A step that repeats a shorter one, as four quarter steps do: what is stable for the one is stable for the other.
//!
//! The trace of a product of matrices does not change when the first factor becomes the last. So the maps are a ring,
//! in which neighbours of one kind merge. If the ring repeats a part n times, the step is similar to the n-th power of
//! a matrix P of determinant 1, and |tr Pⁿ| ≤ 2 wherever |tr P| ≤ 2; where |tr P| > 2, so is |tr Pⁿ|.

use num_traits::Zero;
use shadowstep_schemes::map::Map;

/// The shortest part whose repetition is the step, up to the place where the ring is cut.
pub(crate) fn repeated_part(maps: &[Map]) -> Vec<Map> {
    let ring = ring(maps);
    let repeats = |length: &usize| ring.len().is_multiple_of(*length) && ring[*length..] == ring[..ring.len() - length];
    let length = (1..ring.len()).find(repeats).unwrap_or(ring.len());
    ring[..length].to_vec()
}

/// The maps with both ends joined: they differ in kind, unless one map is left.
fn ring(maps: &[Map]) -> Vec<Map> {
    let mut ring = maps.to_vec();
    while ring.len() > 1 && ring[0].kind == ring[ring.len() - 1].kind {
        let last = ring.pop().expect("it has maps");
        ring[0].weight += last.weight;
        if ring[0].weight.is_zero() {
            ring.remove(0);
        }
    }
    ring
}

#[cfg(test)]
mod tests {
    use shadowstep_schemes::MapKind::{self, Drift, Kick};
    use shadowstep_schemes::symbolic::Rational;

    use super::*;

    fn maps(weights: &[(MapKind, i64)]) -> Vec<Map> {
        weights.iter().map(|&(kind, n)| Map { kind, weight: Rational::from_integer(n.into()) }).collect()
    }

    #[test]
    fn the_ends_of_a_ring_merge() {
        let leapfrogs = maps(&[(Kick, 1), (Drift, 2), (Kick, 2), (Drift, 2), (Kick, 2), (Drift, 2), (Kick, 1)]);
        assert_eq!(repeated_part(&leapfrogs), maps(&[(Kick, 2), (Drift, 2)]));
        // a processed step: C P P C⁻¹
        let processed = maps(&[(Drift, 5), (Kick, 1), (Drift, 2), (Kick, 1), (Drift, -3)]);
        assert_eq!(repeated_part(&processed), maps(&[(Drift, 2), (Kick, 1)]));
    }

    #[test]
    fn what_does_not_repeat_stays_whole() {
        let other = maps(&[(Kick, 1), (Drift, 2), (Kick, 3), (Drift, 2), (Kick, 1), (Drift, 3)]);
        assert_eq!(repeated_part(&other), other);
        // two drifts with a kick of no effect
        assert_eq!(repeated_part(&maps(&[(Kick, 1), (Drift, 3), (Kick, -1)])), maps(&[(Drift, 3)]));
    }
}
