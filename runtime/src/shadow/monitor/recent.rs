//! What follows from the newest states of a window besides H̄: the effect of round-off on the energy, the angle by which the fastest
//! motion turns, and whether the states belong to the increments.

use super::arithmetic::{integer, quotient};
use super::fastest::Fastest;
use super::roughness::{Rough, Roughness};
use super::schedule::Schedule;
use super::turning::{STATES, Sums, Turning, assign_second_difference, turning};
use crate::Rational;
use crate::number::instructions::{self, copy};
use crate::number::partial_sums::PartialSums;
use crate::number::{Real, epsilon};
use crate::shadow::estimator::EstimatorError;
use crate::shadow::expected_round_off::{add_squares_of_increments, kick_factor};
use crate::steps::step_size::StepSize;
use crate::systems::system::System;

/// The states that are kept, with second differences.
const KEPT: usize = 3;
/// After this number of windows a part of them is enough, for all but the comparison of states with their increments.
const ALL_WINDOWS: u64 = 256;
/// A fourth difference of p is off by less than this number of last places of p: rms by √(20 s) · 0.2123, s the stages of a step.
const LAST_PLACES: f64 = 10.0;

/// The newest states of a window, and sums over windows.
#[derive(Clone, Debug)]
pub(super) struct Recent<N> {
    /// For each in turn q, p, and δ²p of it and the two states before it.
    states: Vec<N>,
    /// The place of the newest.
    newest: usize,
    /// Evaluations of the gradient up to the state before the newest, and up to the newest.
    evaluations: [u64; 2],
    /// The most of them that are counted as stages of a step.
    most_stages: u64,
    /// Whether round-off comes from the increments only.
    compensated: bool,
    /// (c ε/h)²
    factor: N,
    /// States that are still to be skipped, and those since then.
    skipped: u64,
    taken: usize,
    /// Windows that ended, and how many of them were not skipped; all sums are over the latter.
    ended: u64,
    windows: u64,
    /// Σ T
    kinetic: N,
    /// Σ kick² over these windows, and kick² of the newest.
    kicks: N,
    square_kick: N,
    /// Over these windows, and in the newest.
    sums: Sums<N>,
    window: Sums<N>,
    /// Σ (p δ²p)²
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
    two: PartialSums<N, 2>,
    three: PartialSums<N, 3>,
    four: PartialSums<N, 4>,
    x: N,
    y: N,
    z: N,
}

impl<N: Real> Recent<N> {
    pub(super) fn new(
        states: usize,
        h: &StepSize,
        dimension: usize,
        context: &N::Context,
    ) -> Result<Self, EstimatorError> {
        let zero = || N::zero(context);
        let sums = || Sums::zero(context);
        let mut epsilon: N = epsilon(context);
        let factor = kick_factor(&epsilon, h.exact(), context);
        epsilon.multiply_integer(1_000_000);
        let mut rounding = zero();
        rounding.assign_square(&epsilon);
        Ok(Recent {
            states: vec![zero(); KEPT * 3 * dimension],
            newest: 0,
            evaluations: [0; 2],
            most_stages: u64::MAX,
            compensated: false,
            factor,
            skipped: 0,
            taken: 0,
            ended: 0,
            windows: 0,
            kinetic: zero(),
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
            two: PartialSums::new(context),
            three: PartialSums::new(context),
            four: PartialSums::new(context),
            x: zero(),
            y: zero(),
            z: zero(),
        })
    }

    /// A step has at most this number of stages, whatever is evaluated between steps.
    pub(super) fn with_most_stages(self, most_stages: u64) -> Self {
        Recent { most_stages, ..self }
    }

    /// Takes the next state of a window, to which an augmented step may have led.
    #[inline(always)]
    pub(super) fn push<M: System<Number = N> + ?Sized>(&mut self, system: &M, is_augmented: bool) {
        let (q, p, added) = (system.q(), system.p(), system.state().increments());
        self.newest = if self.newest + 1 < KEPT { self.newest + 1 } else { 0 };
        let [before, last, own] = in_order(&mut self.states, self.newest, q.len());
        copy(q, own.q);
        copy(p, own.p);
        if is_augmented && added.has_vectors() {
            let Recent { rounding, three, x, y, .. } = self;
            let mut differs =
                |before: &[N], after: &[N], added: &[N]| differ([before, after, added], rounding, three, [x, y]);
            self.mismatch |= differs(last.q, q, added.q) | differs(last.p, p, added.p);
        }
        self.evaluations = [self.evaluations[1], system.state().evaluations()];
        self.compensated = system.state().is_compensated();
        if self.skipped > 0 {
            self.skipped -= 1;
            return;
        }
        self.taken += 1;
        instructions::widest_if_long(
            N::IN_VECTORS,
            p.len(),
            #[inline(always)]
            || {
                for (second, ((p0, p1), p2)) in own.second.iter_mut().zip(before.p.iter().zip(&*last.p).zip(p)) {
                    assign_second_difference(second, p0, p1, p2);
                }
            },
        );
        if self.roughness.takes() {
            self.roughness.push(q, p, is_augmented.then_some(added));
        }
    }

    /// Ends a window of this schedule with the kinetic energy T in its middle.
    #[inline(always)]
    pub(super) fn end(&mut self, schedule: &Schedule, kinetic: &N, fastest: &mut Fastest<N>) {
        self.ended += 1;
        self.mismatches += u64::from(std::mem::take(&mut self.mismatch));
        let states = schedule.states();
        if self.taken < states {
            return;
        }
        self.windows += 1;
        self.kinetic.add(kinetic);
        self.add_sums(states, fastest);
        if self.ended > ALL_WINDOWS {
            self.skipped = schedule.pause(self.windows);
            self.taken = 0;
            self.roughness.restart();
        }
    }

    #[inline(always)]
    fn add_sums(&mut self, states: usize, fastest: &mut Fastest<N>) {
        self.add_kick_and_action(fastest.dimension());
        if states >= STATES {
            self.add_turning(fastest);
        }
        if self.roughness.is_complete() {
            let angle = turning(&self.window, &mut self.x).map(|turning| turning.angle);
            self.roughness.end(angle, &self.square_kick);
        }
    }

    /// Adds s (cε/h)² Σ ((Δq p)² + (Δp q)²): T_p is Δq/h, U_q is −Δp/h, and s stages round q and p by cε|q| and cε|p| each; where sums are
    /// compensated, Δq and Δp.
    #[inline(always)]
    fn add_kick_and_action(&mut self, dimension: usize) {
        let Recent { states, newest, two, x, y, z, .. } = self;
        let [before, s0, s1] = in_order(states, *newest, dimension);
        self.moves = self.moves || s0.q != s1.q;
        let [kick, action] = two.of([s0.q, s1.q, s0.p, s1.p], |[q0, q1, p0, p1], [kick, action]| {
            let (mut x, mut y) = (x.register(), y.register());
            x.assign_difference(q1, q0);
            y.assign_sum(p0, p1);
            action.add_product(&x, &y);
            x.multiply(p1);
            kick.add_product(&x, &x);
            y.assign_difference(p1, p0);
            y.multiply(q1);
            kick.add_product(&y, &y);
        });
        z.assign(&action);
        z.divide_integer(2);
        self.action.add(z);
        z.assign(&kick);
        if self.compensated {
            z.assign_zero();
            add_squares_of_increments(z, [before.q, s0.q, s1.q], [before.p, s0.p, s1.p], [x, y]);
        }
        let stages = self.evaluations[1].saturating_sub(self.evaluations[0]).min(self.most_stages).max(1);
        z.multiply_integer(i32::try_from(stages).unwrap_or(i32::MAX));
        self.square_kick.assign_product(z, &self.factor);
        self.kicks.add(&self.square_kick);
    }

    #[inline(always)]
    fn add_turning(&mut self, fastest: &mut Fastest<N>) {
        let Recent { states, newest, window, four, x, y, .. } = self;
        let [s2, s3, s4] = in_order(states, *newest, fastest.dimension());
        let [squares, products, fourths, weighted] = four.of(
            [s2.second, s3.second, s4.second, s2.p],
            |[before, second, after, p], [squares, products, fourths, weighted]| {
                let (mut x, mut y) = (x.register(), y.register());
                assign_second_difference(&mut *y, before, second, after);
                squares.add_product(second, second);
                products.add_product(second, &y);
                fourths.add_product(&y, &y);
                x.assign_product(second, p);
                weighted.add_product(&x, &x);
            },
        );
        fastest.add([s2.second, s3.second, s4.second], s2.p);
        self.weighted.add(&weighted);
        window.squares.assign(&squares);
        window.products.assign(&products);
        window.fourths.assign(&fourths);
        self.sums.squares.add(&squares);
        self.sums.products.add(&products);
        self.sums.fourths.add(&fourths);
    }

    /// The number of windows in which a state differs from its increments.
    pub(super) fn mismatches(&self) -> u64 {
        self.mismatches
    }

    /// Whether q has changed in a window.
    pub(super) fn moves(&self) -> bool {
        self.moves
    }

    /// Σ ½(p_0 + p_1)ᵀ(q_1 − q_0) over the last steps of the windows, as a part of h Σ 2T: 1 where a step is a small part of a turn, and
    /// sin φ/φ where it turns by φ.
    pub(super) fn action(&self, h: &Rational) -> f64 {
        let mut whole = N::from_rational(h, &self.kinetic.context());
        whole.multiply(&self.kinetic);
        whole.multiply_integer(2);
        quotient(&self.action, &whole).to_f64()
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
    pub(super) fn mean_square_kick(&self) -> N {
        quotient(&self.kicks, &integer(self.windows.max(1), &self.kicks.context()))
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

/// A state that is kept.
struct StateView<'a, N> {
    q: &'a mut [N],
    p: &'a mut [N],
    second: &'a mut [N],
}

/// The states from the oldest to the newest.
#[inline(always)]
fn in_order<N>(states: &mut [N], newest: usize, dimension: usize) -> [StateView<'_, N>; KEPT] {
    let length = 3 * dimension;
    let (a, others) = states.split_at_mut(length);
    let (b, others) = others.split_at_mut(length);
    let c = &mut others[..length];
    let [a, b, c] = match newest {
        0 => [b, c, a],
        1 => [c, a, b],
        _ => [a, b, c],
    };
    [StateView::of(a, dimension), StateView::of(b, dimension), StateView::of(c, dimension)]
}

impl<'a, N> StateView<'a, N> {
    #[inline(always)]
    fn of(row: &'a mut [N], dimension: usize) -> Self {
        let (q, others) = row.split_at_mut(dimension);
        let (p, second) = others.split_at_mut(dimension);
        StateView { q, p, second }
    }
}

/// Whether a state differs from the one before plus its increments, by more than 1/1000 of these and 1000 ε of its numbers: of q, or of p.
///
/// Increments that a plain step left behind belong to an earlier step, or are 0.
#[inline(always)]
fn differ<N: Real>(
    [before, after, added]: [&[N]; 3],
    rounding: &N,
    three: &mut PartialSums<N, 3>,
    [x, y]: [&mut N; 2],
) -> bool {
    let [off, changes, sizes] =
        three.of([after, before, &added[..after.len()]], |[after, before, added], [off, changes, sizes]| {
            let mut difference = x.register();
            difference.assign_difference(after, before);
            changes.add_product(&difference, &difference);
            difference.subtract(added);
            off.add_product(&difference, &difference);
            sizes.add_product(after, after);
        });
    // what is off, 1000 times, squared; and what it may be
    let (mut x, mut y) = (x.register(), y.register());
    x.assign(&off);
    x.multiply_integer(1_000_000);
    y.assign(&changes);
    y.add_product(&sizes, rounding);
    // false for NaN, which is found elsewhere
    *x > *y
}

#[cfg(test)]
mod tests {
    use super::ALL_WINDOWS;
    use crate::shadow::{Bilinear, BilinearEstimator, ShadowEnergy};
    use crate::steps::tables::{TableScheme, shipped};
    use crate::systems::problems::Kepler;
    use crate::{Motion, Stepper, UnitMasses};

    type Monitor = ShadowEnergy<TableScheme, f64, BilinearEstimator<f64>>;

    fn on_a_circle(every: u64) -> (Monitor, Motion<f64, [f64; 2], Kepler, UnitMasses>) {
        let stepper = Stepper::new(shipped("stormer-verlet").unwrap(), 0.1).unwrap();
        let mut motion = Motion::new(Kepler, UnitMasses, [1.0, 0.0], [0.0, 1.0]).unwrap();
        let monitor = ShadowEnergy::new(stepper, &mut motion, &Bilinear::new(8)).unwrap().every(every);
        (monitor, motion)
    }

    #[test]
    fn a_part_of_many_windows_is_enough() {
        for (every, one_in) in [(1, 36), (4, 9), (20, 4)] {
            let (mut monitor, mut motion) = on_a_circle(every);
            for _ in 0..20_000 {
                monitor.step(&mut motion).unwrap();
            }
            let recent = &monitor.recent;
            let expected = ALL_WINDOWS + (recent.ended - ALL_WINDOWS) / one_in;
            assert!(recent.windows.abs_diff(expected) <= expected / 20, "{every}: {} {expected}", recent.windows);
            // θ is 0.1 but for O(h³), and the action 1 but for O(θ²)
            assert!((recent.turning().unwrap().angle - 0.1).abs() < 1e-3, "{every}: {:?}", recent.turning());
            let action = recent.action(monitor.stepper().h());
            assert!((action - 1.0).abs() < 0.01, "{every}: {action}");
        }
    }

    #[test]
    fn a_state_that_is_changed_is_found_in_every_window() {
        for (every, changed) in [(1, 10_000), (1, 10_017), (20, 10_000)] {
            let (mut monitor, mut motion) = on_a_circle(every);
            let mut is_changed = false;
            for n in 0..10_100 {
                monitor.step(&mut motion).unwrap();
                if n >= changed && monitor.needs_increments() && !is_changed {
                    motion.q_mut()[0] += 1e-3;
                    is_changed = true;
                }
            }
            assert!(
                is_changed && monitor.recent.mismatches() == 1,
                "{every}, {changed}: {}",
                monitor.recent.mismatches()
            );
        }
    }

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
