//! The areas ω(δ₁, δ₂) = δq₁·δp₂ − δp₁·δq₂ of pairs of tangent vectors, which symplectic maps leave as they are.

use serde::{Deserialize, Serialize};
use shadowstep::number::Dual;
use shadowstep::problems::HenonHeiles;
use shadowstep::tangent::{vector, with_derivatives};
use shadowstep::{Motion, System as _, UnitMasses};

/// An orbit of Hénon and Heiles' potential with two pairs of tangent vectors.
pub(crate) type Star = Motion<Dual<f64, 4>, [Dual<f64, 4>; 2], HenonHeiles, UnitMasses>;

/// After this number of steps the vectors of the second pair are replaced by unit vectors.
pub(crate) const BLOCK: u64 = 100;

/// A regular orbit of the energy 0.055.
const START: [[f64; 2]; 2] = [[0.0, 0.1], [0.3, 0.1]];

/// All pairs of coordinates of (q₁, q₂, p₁, p₂), of whose unit vectors the areas are 0 or 1.
const PAIRS: [[usize; 2]; 6] = [[0, 2], [0, 1], [1, 3], [0, 3], [2, 3], [1, 2]];

/// Round-off adds to an area at random: its change is a deviate with a standard deviation that is proportional to the
/// square root of the sum of (|δ₁| |δ₂|)² over all steps.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Change {
    /// The change of the area.
    pub(crate) area: f64,
    /// √Σ (|δ₁| |δ₂|)²
    pub(crate) size: f64,
}

impl Change {
    /// A change that is not finite becomes one that is too large.
    fn of(area: f64, square: f64) -> Change {
        let finite = area.is_finite() && square.is_finite();
        if finite { Change { area, size: square.sqrt() } } else { Change { area: f64::MAX, size: 1.0 } }
    }
}

/// How areas changed.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Areas {
    /// Of one pair, after each of the requested numbers of steps.
    pub(crate) of_one_pair: Vec<Change>,
    /// Of pairs that are replaced: the sum of their changes.
    pub(crate) of_many_pairs: Change,
    /// How long the vectors of the one pair became.
    pub(crate) length: f64,
}

impl Areas {
    /// Along steps that are made by `block`, [`BLOCK`] of them at once, up to each of these numbers of steps.
    pub(crate) fn along(
        mut block: impl FnMut(&mut Star),
        steps: &[u64],
        mut continues: impl FnMut(f64) -> bool,
    ) -> Areas {
        let unit = |k: usize| std::array::from_fn::<f64, 4, _>(|i| f64::from(i == k));
        let mut star = star([unit(0), unit(2), unit(0), unit(2)]);
        let (mut areas, mut squares, mut block_number) = (Areas::default(), [0.0; 2], 0);
        let most = *steps.last().expect("there are some");
        for until in steps {
            while block_number < until / BLOCK {
                let pair = PAIRS[block_number as usize % PAIRS.len()];
                replace(&mut star, pair.map(unit));
                block(&mut star);
                block_number += 1;
                let vectors: [Vec<f64>; 4] = std::array::from_fn(|k| vector(star.state(), k));
                let squared = |a: usize, b: usize| norm(&vectors[a]).powi(2) * norm(&vectors[b]).powi(2);
                squares[0] += squared(0, 1) * BLOCK as f64;
                // from 1 at the begin of the block
                squares[1] += (1.0 + squared(2, 3)) / 2.0 * BLOCK as f64;
                areas.of_many_pairs.area += area(&vectors[2], &vectors[3]) - area(&unit(pair[0]), &unit(pair[1]));
                areas.length = norm(&vectors[0]).max(norm(&vectors[1]));
                if block_number.is_multiple_of(1024) && !continues((block_number * BLOCK) as f64 / most as f64) {
                    return areas;
                }
            }
            let [one, other] = [0, 1].map(|k| vector(star.state(), k));
            areas.of_one_pair.push(Change::of(area(&one, &other) - 1.0, squares[0]));
        }
        areas.of_many_pairs = Change::of(areas.of_many_pairs.area, squares[1]);
        areas.length = areas.length.min(f64::MAX);
        areas
    }
}

fn star(vectors: [[f64; 4]; 4]) -> Star {
    let dual = |half: usize| {
        let of_half = std::array::from_fn(|k| &vectors[k][2 * half..2 * half + 2]);
        with_derivatives(&START[half], of_half).try_into().expect("there are two")
    };
    Motion::new(HenonHeiles, UnitMasses, dual(0), dual(1)).expect("it has two coordinates")
}

/// The second pair ← these vectors.
fn replace(star: &mut Star, vectors: [[f64; 4]; 2]) {
    let state = star.state();
    let (mut q, mut p) = (state.q().to_vec(), state.p().to_vec());
    for (i, x) in q.iter_mut().chain(&mut p).enumerate() {
        x.derivatives[2..].copy_from_slice(&vectors.map(|vector| vector[i]));
    }
    star.state_mut().set(&q, &p);
}

fn area(a: &[f64], b: &[f64]) -> f64 {
    a[0] * b[2] + a[1] * b[3] - a[2] * b[0] - a[3] * b[1]
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().fold(0.0, |norm: f64, x| norm.hypot(*x))
}

#[cfg(test)]
mod tests {
    //! Protects that areas are conserved by steps of a scheme, and that a map which is nearly symplectic is seen.

    use shadowstep::Stepper;
    use shadowstep::tables::shipped;

    use super::*;

    const STEPS: [u64; 2] = [10_000, 100_000];

    /// The changes of both kinds of pairs in units of round-off, where vectors shrink by a factor in each block.
    fn changes(factor: f64) -> [f64; 2] {
        let stepper = Stepper::new(shipped("yoshida4").unwrap(), "1/10").unwrap();
        let block = |star: &mut Star| {
            stepper.steps(std::slice::from_mut(star), BLOCK);
            let (mut q, mut p) = (star.q().to_vec(), star.p().to_vec());
            q.iter_mut().chain(&mut p).for_each(|x| x.derivatives.iter_mut().for_each(|x| *x *= factor));
            star.state_mut().set(&q, &p);
        };
        let areas = Areas::along(block, &STEPS, |_| true);
        assert!(areas.length > 100.0, "{areas:?}");
        [areas.of_one_pair[1], areas.of_many_pairs].map(|change| change.area.abs() / (f64::EPSILON * change.size))
    }

    #[test]
    fn maps_that_are_not_symplectic_are_seen() {
        let [one, many] = changes(1.0);
        assert!(one < 1.0 && many < 1.0, "{one} {many}");
        let [one, many] = changes(1.0 - 1e-12);
        assert!(many > 100.0, "{one} {many}");
        let [one, _] = changes(1.0 - 1e-8);
        assert!(one > 10.0, "{one}");
    }
}
