//! The angle by which a motion turns from step to step, from second and fourth differences of its momenta.

use std::f64::consts::TAU;

use crate::number::Real;
use crate::number::saved::Fields;

/// States that the turning needs: three second differences.
pub(super) const STATES: usize = 5;

/// Over the windows, and over the coordinates of each; δ²p and δ⁴p are second and fourth differences, centred at the
/// same state.
///
/// With short steps, δ²p_0 + δ²p_2 = 2 cos θ δ²p_1 would lose θ; δ⁴p keeps it.
#[derive(Clone, Debug)]
pub(super) struct Sums<N> {
    /// Σ (δ²p)²
    pub(super) squares: N,
    /// Σ δ²p δ⁴p
    pub(super) products: N,
    /// Σ (δ⁴p)²
    pub(super) fourths: N,
}

impl<N: Real> Sums<N> {
    pub(super) fn zero(context: &N::Context) -> Self {
        let zero = || N::zero(context);
        Sums { squares: zero(), products: zero(), fourths: zero() }
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        let Sums { squares, products, fourths } = self;
        [squares, products, fourths].into_iter().for_each(|sum| to.number(sum));
    }
}

/// How the fastest motion turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Turning {
    /// θ, from one step to the next.
    pub(super) angle: f64,
    /// The part of δ⁴p that is not −4 sin²(θ/2) δ²p: 0 for one oscillation, 1 for noise.
    pub(super) irregular: f64,
    /// By how much round-off of p may change 4 sin²(θ/2), which is θ² for short steps.
    pub(super) round_off: f64,
}

/// `None` where nothing turns; without the effect of round-off.
pub(super) fn turning<N: Real>(Sums { squares, products, fourths }: &Sums<N>, quotient: &mut N) -> Option<Turning> {
    let mut ratio = |a: &N| {
        quotient.assign_quotient(a, squares);
        quotient.to_f64()
    };
    // 4 sin²(θ/2) = 2 − 2 cos θ
    let (square, rest) = (-ratio(products), ratio(fourths));
    let angle = 2.0 * (square.sqrt() / 2.0).asin();
    let turning = Turning { angle, irregular: (rest - square * square) / 2.0, round_off: 0.0 };
    (turning.angle.is_finite() && turning.irregular.is_finite()).then_some(turning)
}

impl Turning {
    /// In how many steps it turns once.
    pub(super) fn steps(self) -> f64 {
        TAU / self.angle
    }
}

/// out ← a − 2b + c
pub(super) fn assign_second_difference<N: Real>(out: &mut N, a: &N, b: &N, c: &N) {
    out.assign_sum(a, c);
    out.subtract(b);
    out.subtract(b);
}
