//! The newest states of a window, and what follows from them besides H̄: the effect of round-off on the energy
//! ([`Kicks`]), the angle by which the fastest motion turns ([`TurningSums`]), and whether the states belong to the
//! increments ([`Consistency`]).

use super::arithmetic::{integer, quotient};
use super::consistency::Consistency;
use super::fastest::Fastest;
use super::kicks::Kicks;
use super::roughness::{Rough, Roughness};
use super::schedule::Schedule;
use super::state_view::{STATES_KEPT, in_order};
use super::turning::{STATES, Turning, assign_second_difference, turning};
use super::turning_sums::TurningSums;
use crate::Rational;
use crate::number::Real;
use crate::number::instructions::{self, copy};
use crate::number::saved::Fields;
use crate::shadow::estimator::EstimatorError;
use crate::shadow::run::TrajectoryState;
use crate::steps::step_size::StepSize;
use crate::systems::system::System;

/// After this number of windows a part of them is enough, for all but the comparison of states with their increments.
const ALL_WINDOWS: u64 = 256;

/// The newest states of a window, and what follows from them over all windows.
#[derive(Clone, Debug)]
pub(super) struct NewestStates<N> {
    /// For each in turn q, p, and δ²p of it and the two states before it.
    states: Vec<N>,
    /// The place of the newest.
    newest: usize,
    /// States that are still to be skipped, and those since then.
    skipped: u64,
    taken: usize,
    /// Windows that ended, and how many of them were not skipped; all sums are over the latter.
    ended: u64,
    windows: u64,
    /// Σ T of their last states
    kinetic: N,
    consistency: Consistency<N>,
    kicks: Kicks<N>,
    turning: TurningSums<N>,
    roughness: Roughness<N>,
    /// An intermediate result.
    angle: N,
}

impl<N: Real> NewestStates<N> {
    pub(super) fn new(
        states: usize,
        h: &StepSize,
        dimension: usize,
        context: &N::Context,
    ) -> Result<Self, EstimatorError> {
        Ok(NewestStates {
            states: vec![N::zero(context); STATES_KEPT * 3 * dimension],
            newest: 0,
            skipped: 0,
            taken: 0,
            ended: 0,
            windows: 0,
            kinetic: N::zero(context),
            consistency: Consistency::new(context),
            kicks: Kicks::new(h, context),
            turning: TurningSums::new(context),
            roughness: Roughness::new(states, h, dimension, context)?,
            angle: N::zero(context),
        })
    }

    /// The newest state was restored after evaluations elsewhere.
    pub(super) fn restored(&mut self) {
        self.kicks.restored = true;
    }

    /// A step has at most this number of stages, whatever is evaluated between steps.
    pub(super) fn with_most_stages(mut self, most_stages: u64) -> Self {
        self.kicks.most_stages = most_stages;
        self
    }

    /// Takes the next state of a window, to which an augmented step may have led. Returns whether q and p are certainly
    /// finite, if those before were.
    #[inline(always)]
    pub(super) fn push<M: System<Number = N> + ?Sized>(&mut self, system: &M, is_augmented: bool) -> bool {
        let TrajectoryState { q, p, increments: added, .. } = TrajectoryState::massive(system, 0);
        self.newest = if self.newest + 1 < STATES_KEPT { self.newest + 1 } else { 0 };
        let [before, last, own] = in_order(&mut self.states, self.newest, q.len());
        copy(q, own.q);
        copy(p, own.p);
        let are_finite = is_augmented
            && added.has_vectors()
            && self.consistency.compare(last.q, q, added.q) & self.consistency.compare(last.p, p, added.p);
        self.kicks.take(system);
        if self.skipped > 0 {
            self.skipped -= 1;
            return are_finite;
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
        are_finite
    }

    /// Ends a window of this schedule, at whose last state the system is.
    #[inline(always)]
    pub(super) fn end<M: System<Number = N> + ?Sized>(
        &mut self,
        schedule: &Schedule,
        system: &mut M,
        fastest: &mut Fastest<N>,
    ) {
        self.ended += 1;
        self.consistency.end();
        let states = schedule.states();
        if self.taken < states {
            return;
        }
        self.windows += 1;
        system.assign_kinetic_energy(None, &mut self.angle);
        self.kinetic.add(&self.angle);
        self.add_sums(states, fastest);
        if self.ended > ALL_WINDOWS {
            self.skipped = schedule.pause(self.windows);
            self.taken = 0;
            self.roughness.restart();
        }
    }

    #[inline(always)]
    fn add_sums(&mut self, states: usize, fastest: &mut Fastest<N>) {
        let states_in_order = in_order(&mut self.states, self.newest, fastest.dimension());
        self.kicks.add(&states_in_order);
        if states >= STATES {
            self.turning.add(&states_in_order, fastest);
        }
        if self.roughness.is_complete() {
            let angle = turning(&self.turning.window, &mut self.angle).map(|turning| turning.angle);
            self.roughness.end(angle, &self.kicks.newest);
        }
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        let NewestStates { states, newest, skipped, taken, ended, windows, kinetic, .. } = self;
        to.numbers(states);
        to.place(newest, STATES_KEPT);
        to.place(taken, usize::MAX);
        [skipped, ended, windows].into_iter().for_each(|count| to.count(count));
        to.number(kinetic);
        self.consistency.fields(to);
        self.kicks.fields(to);
        self.turning.fields(to);
        self.roughness.fields(to);
    }

    /// The number of windows in which a state differs from its increments.
    pub(super) fn mismatches(&self) -> u64 {
        self.consistency.mismatches()
    }

    /// Whether q has changed in a window.
    pub(super) fn moves(&self) -> bool {
        self.kicks.moves
    }

    /// Σ ½(p_0 + p_1)ᵀ(q_1 − q_0) over the last steps of the windows, as a part of h Σ 2T: 1 where a step is a small
    /// part of a turn, and sin φ/φ where it turns by φ.
    pub(super) fn action(&self, h: &Rational) -> f64 {
        let mut whole = N::from_rational(h, &self.kinetic.context());
        whole.multiply(&self.kinetic);
        whole.multiply_integer(2);
        quotient(&self.kicks.action, &whole).to_f64()
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
        quotient(&self.kicks.sum, &integer(self.windows.max(1), &self.kinetic.context()))
    }

    /// `None` where the windows are too short, or nothing moves.
    pub(super) fn turning(&self) -> Option<Turning> {
        self.turning.found()
    }
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
            let newest = &monitor.newest_states;
            let expected = ALL_WINDOWS + (newest.ended - ALL_WINDOWS) / one_in;
            assert!(newest.windows.abs_diff(expected) <= expected / 20, "{every}: {} {expected}", newest.windows);
            // θ is 0.1 but for O(h³), and the action 1 but for O(θ²)
            assert!((newest.turning().unwrap().angle - 0.1).abs() < 1e-3, "{every}: {:?}", newest.turning());
            let action = newest.action(monitor.stepper().h());
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
                is_changed && monitor.newest_states.mismatches() == 1,
                "{every}, {changed}: {}",
                monitor.newest_states.mismatches()
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
                let Some(turning) = monitor.newest_states.turning() else { continue };
                let off = (turning.angle.powi(2) - h * h).abs();
                assert!(off <= turning.round_off + 3.0 * h.powi(4), "h = {h:e}: θ² is off by {off:e}, {turning:?}");
            }
            let round_off = monitor.newest_states.turning().map(|turning| turning.round_off);
            let hides = round_off.is_none_or(|round_off| round_off > h * h);
            assert!(if h <= 5e-5 { hides } else { h == 1e-4 || !hides }, "h = {h:e}: {round_off:?}");
        }
    }
}
