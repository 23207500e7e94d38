//! What follows from the newest states of a window besides H̄: the effect of round-off on the energy, the angle by which the fastest
//! motion turns, and whether the states belong to the increments.

use std::f64::consts::TAU;

use super::roughness::{Rough, Roughness};
use crate::number::{Ordered, epsilon};
use crate::shadow::estimator::EstimatorError;
use crate::shadow::walk::{add_squares, add_squares_of_increments, kick_factor};
use crate::step_size::StepSize;
use crate::system::{Increments, System};

/// States that the turning needs: three second differences.
pub(super) const STATES: usize = 5;
/// A fourth difference of p is off by less than so many last places of p: rms by √(20 s) · 0.2123, s the stages of a step.
const LAST_PLACES: f64 = 10.0;

/// The newest states of a window, and sums over all windows.
#[derive(Clone, Debug)]
pub(super) struct Recent<N> {
    /// The newest last.
    q: [Vec<N>; 3],
    p: [Vec<N>; STATES],
    /// Evaluations of the gradient up to the state before the newest, and up to the newest.
    evaluations: [u64; 2],
    /// Whether round-off is that of the increments.
    compensated: bool,
    /// (c ε/h)²
    factor: N,
    /// Σ kick² over all windows, and that of the newest.
    kicks: N,
    square_kick: N,
    /// Over all windows, and in the newest.
    sums: Sums<N>,
    window: Sums<N>,
    /// Σ (p δ²p)² over all windows.
    weighted: N,
    roughness: Roughness<N>,
    /// (10⁶ ε)²
    rounding: N,
    /// Whether a state of this window differs from its increments.
    mismatch: bool,
    /// The number of windows with such a state.
    mismatches: u64,
    /// Whether q has changed in a last step of a window.
    moves: bool,
    /// Σ ½(p_0 + p_1)ᵀ(q_1 − q_0) over the last steps of the windows.
    action: N,
    /// Intermediate results.
    x: N,
    y: N,
    z: N,
}

/// Over the windows, and over the coordinates of each; δ²p and δ⁴p are second and fourth differences, centred at the same state.
///
/// Of δ²p_0 + δ²p_2 = 2 cos θ δ²p_1 short steps would lose θ: it is δ⁴p that keeps it.
#[derive(Clone, Debug)]
pub(super) struct Sums<N> {
    /// Σ (δ²p)²
    squares: N,
    /// Σ δ²p δ⁴p
    products: N,
    /// Σ (δ⁴p)²
    fourths: N,
}

impl<N: Ordered> Sums<N> {
    pub(super) fn zero(context: &N::Context) -> Self {
        let zero = || N::zero(context);
        Sums { squares: zero(), products: zero(), fourths: zero() }
    }

    /// Adds δ²p and δ⁴p of one coordinate.
    pub(super) fn add(&mut self, second: &N, fourth: &N) {
        self.squares.add_product(second, second);
        self.products.add_product(second, fourth);
        self.fourths.add_product(fourth, fourth);
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

impl<N: Ordered> Recent<N> {
    pub(super) fn new(
        states: usize,
        h: &StepSize,
        dimension: usize,
        context: &N::Context,
    ) -> Result<Self, EstimatorError> {
        let zero = || N::zero(context);
        let zeros = || vec![zero(); dimension];
        let sums = || Sums::zero(context);
        let mut epsilon: N = epsilon(context);
        let factor = kick_factor(&epsilon, h.exact(), context);
        epsilon.multiply_integer(1_000_000);
        let mut rounding = zero();
        rounding.assign_square(&epsilon);
        Ok(Recent {
            q: std::array::from_fn(|_| zeros()),
            p: std::array::from_fn(|_| zeros()),
            evaluations: [0; 2],
            compensated: false,
            factor,
            kicks: zero(),
            square_kick: zero(),
            sums: sums(),
            window: sums(),
            weighted: zero(),
            roughness: Roughness::new(states, h, dimension, context)?,
            rounding,
            mismatch: false,
            mismatches: 0,
            moves: false,
            action: zero(),
            x: zero(),
            y: zero(),
            z: zero(),
        })
    }

    /// Takes the next state of a window, and what the step to it added, where that is known.
    pub(super) fn push<M: System<Number = N>>(&mut self, system: &M, added: Option<Increments<'_, N>>) {
        self.q.rotate_left(1);
        self.p.rotate_left(1);
        let ([.., q], [.., p]) = (&mut self.q, &mut self.p);
        q.iter_mut().zip(system.q()).for_each(|(own, q)| own.assign(q));
        p.iter_mut().zip(system.p()).for_each(|(own, p)| own.assign(p));
        self.evaluations = [self.evaluations[1], system.evaluations()];
        self.compensated = system.is_compensated();
        self.roughness.push(system.q(), system.p(), added);
        if let Some(added) = added.filter(|added| added.has_vectors()) {
            self.mismatch |= self.differs_from(added);
        }
    }

    /// Whether the newest state differs from the one before plus its increments, by more than 1/1000 of these and 1000 ε of q and p.
    ///
    /// Increments that a plain step left behind are those of an earlier step, or 0.
    fn differs_from(&mut self, added: Increments<'_, N>) -> bool {
        let Recent { q: [_, q0, q1], p: [.., p0, p1], rounding, x, y, z, .. } = self;
        [(q0, q1, added.q), (p0, p1, added.p)].into_iter().any(|(before, after, added)| {
            y.assign_zero(); // what is off, 1000 times, squared
            z.assign_zero(); // what it may be
            for ((before, after), added) in before.iter().zip(after).zip(added) {
                x.assign_difference(after, before);
                z.add_product(x, x);
                x.subtract(added);
                x.multiply_integer(1000);
                y.add_product(x, x);
                x.assign_product(after, rounding);
                z.add_product(x, after);
            }
            // false for NaN, which is found elsewhere
            *y > *z
        })
    }

    /// Ends a window of `states` states.
    pub(super) fn end(&mut self, states: usize) {
        self.mismatches += u64::from(std::mem::take(&mut self.mismatch));
        self.moves |= self.q[1] != self.q[2];
        self.add_kick();
        self.add_action();
        if states >= STATES {
            self.add_turning();
        }
        let angle = turning(&self.window, &mut self.x).map(|turning| turning.angle);
        self.roughness.end(angle, &self.square_kick);
    }

    /// Adds s (cε/h)² Σ ((Δq p)² + (Δp q)²): T_p is Δq/h, U_q is −Δp/h, and s stages round q and p by cε|q| and cε|p| each; where sums are
    /// compensated, Δq and Δp.
    fn add_kick(&mut self) {
        let Recent { q: [q0, q1, q2], p: [.., p0, p1, p2], x, y, z, .. } = self;
        z.assign_zero();
        if self.compensated {
            add_squares_of_increments(z, [q0, q1, q2], [p0, p1, p2], [x, y]);
        } else {
            add_squares(z, [q1, q2], [p1, p2], [x, y]);
        }
        let stages = self.evaluations[1].saturating_sub(self.evaluations[0]).max(1);
        z.multiply_integer(i32::try_from(stages).unwrap_or(i32::MAX));
        self.square_kick.assign_product(z, &self.factor);
        self.kicks.add(&self.square_kick);
    }

    fn add_action(&mut self) {
        let Recent { q: [_, q0, q1], p: [.., p0, p1], action, x, y, .. } = self;
        for (((q0, q1), p0), p1) in q0.iter().zip(q1).zip(p0).zip(p1) {
            x.assign_difference(q1, q0);
            y.assign_sum(p0, p1);
            y.divide_integer(2);
            action.add_product(x, y);
        }
    }

    fn add_turning(&mut self) {
        let Recent { p: [p0, p1, p2, p3, p4], window: sums, weighted, x, y, z, .. } = self;
        sums.squares.assign_zero();
        sums.products.assign_zero();
        sums.fourths.assign_zero();
        for ((((p0, p1), p2), p3), p4) in p0.iter().zip(p1).zip(p2).zip(p3).zip(p4) {
            assign_differences([x, y], z, [p0, p1, p2, p3, p4]);
            sums.add(x, y);
            x.multiply(p2);
            weighted.add_product(x, x);
        }
        self.sums.squares.add(&sums.squares);
        self.sums.products.add(&sums.products);
        self.sums.fourths.add(&sums.fourths);
    }

    /// p of the newest states, if a window of `states` states has as many.
    pub(super) fn momenta(&self, states: usize) -> Option<&[Vec<N>; STATES]> {
        (states >= STATES).then_some(&self.p)
    }

    /// The number of windows in which a state differs from its increments.
    pub(super) fn mismatches(&self) -> u64 {
        self.mismatches
    }

    /// Whether q has changed in a window.
    pub(super) fn moves(&self) -> bool {
        self.moves
    }

    /// Σ ½(p_0 + p_1)ᵀ(q_1 − q_0) over the last steps of the windows: h Σ 2T where a step is a small part of a turn, and
    /// sin φ/φ of that where it turns by φ.
    pub(super) fn action(&self) -> &N {
        &self.action
    }

    /// The root mean square of last terms.
    pub(super) fn last_term(&self) -> N {
        self.roughness.last_term()
    }

    /// The forces, where they are not smooth.
    pub(super) fn rough(&self) -> Option<Rough> {
        self.roughness.found()
    }

    /// The mean of kick² over the windows.
    pub(super) fn mean_square_kick(&self, windows: &N) -> N {
        let mut mean = self.kicks.clone();
        mean.divide(windows);
        mean
    }

    /// `None` where the windows are too short, or nothing moves.
    pub(super) fn turning(&self) -> Option<Turning> {
        let mut quotient = self.x.clone();
        let turning = turning(&self.sums, &mut quotient)?;
        // Σ δ²p δ⁴p is off by √Σ (δ²p r)² where each δ⁴p is off by r
        quotient.assign_quotient(&self.weighted, &self.sums.squares);
        quotient.multiply(&self.rounding);
        quotient.divide(&self.sums.squares);
        Some(Turning { round_off: LAST_PLACES / 1e6 * quotient.to_f64().sqrt(), ..turning })
    }
}

/// `None` where nothing turns; without the effect of round-off.
pub(super) fn turning<N: Ordered>(Sums { squares, products, fourths }: &Sums<N>, quotient: &mut N) -> Option<Turning> {
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

/// The second and the fourth difference of p in the middle of five states.
pub(super) fn assign_differences<N: Ordered>(
    [second, fourth]: [&mut N; 2],
    x: &mut N,
    [p0, p1, p2, p3, p4]: [&N; STATES],
) {
    assign_second_difference(second, p1, p2, p3);
    assign_second_difference(fourth, p0, p1, p2);
    assign_second_difference(x, p2, p3, p4);
    fourth.add(x);
    fourth.subtract(second);
    fourth.subtract(second);
}

/// out ← a − 2b + c
pub(super) fn assign_second_difference<N: Ordered>(out: &mut N, a: &N, b: &N, c: &N) {
    out.assign_sum(a, c);
    out.subtract(b);
    out.subtract(b);
}

#[cfg(test)]
mod tests {
    use crate::problems::Kepler;
    use crate::shadow::{Bilinear, ShadowEnergy};
    use crate::{Motion, Stepper, UnitMasses, tables::shipped};

    /// On a circle θ is h + O(h³), which round-off hides from 1e-4 downwards.
    #[test]
    fn round_off_bounds_the_error_of_the_turning() {
        for h in [1e-1, 1e-2, 1e-3, 3e-4, 1e-4, 5e-5, 2e-5, 1e-5] {
            let stepper = Stepper::new(shipped("stormer-verlet").unwrap(), h).unwrap();
            let mut motion = Motion::new(Kepler, UnitMasses, [1.0, 0.0], [0.0, 1.0]).unwrap();
            let mut monitor = ShadowEnergy::new(stepper, &mut motion, &Bilinear::new(8)).unwrap().every(20);
            for _ in 0..4000 {
                monitor.step(&mut motion).unwrap();
                // where round-off makes θ² negative there is none
                let Some(turning) = monitor.recent.turning() else { continue };
                let off = (turning.angle.powi(2) - h * h).abs();
                assert!(off <= turning.round_off + 3.0 * h.powi(4), "h = {h:e}: θ² is off by {off:e}, {turning:?}");
            }
            let round_off = monitor.recent.turning().map(|turning| turning.round_off);
            let hides = round_off.is_none_or(|round_off| round_off > h * h);
            assert!(if h <= 5e-5 { hides } else { h == 1e-4 || !hides }, "h = {h:e}: {round_off:?}");
        }
    }
}
