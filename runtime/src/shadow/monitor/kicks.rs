//! By how much round-off moves the energy, and the action of the steps.

use std::mem::take;

use super::state_view::{STATES_KEPT, StateView};
use crate::number::partial_sums::PartialSums;
use crate::number::saved::Fields;
use crate::number::{Real, epsilon};
use crate::shadow::expected_round_off::{add_squares_of_increments, kick_factor};
use crate::steps::step_size::StepSize;
use crate::systems::system::System;

/// Sums over the last steps of the windows.
#[derive(Clone, Debug)]
pub(super) struct Kicks<N> {
    /// Evaluations of the gradient up to the newest state, and in the step to it.
    evaluations: u64,
    stages: u64,
    /// The newest state is one that was restored: evaluations up to the next one are not those of its step alone, which
    /// are taken for the same as those of the step before.
    pub(super) restored: bool,
    /// The most of them that are counted as stages of a step.
    pub(super) most_stages: u64,
    /// Whether round-off comes from the increments only.
    compensated: bool,
    /// (c ε/h)²
    factor: N,
    /// Σ kick², and kick² of the newest window.
    pub(super) sum: N,
    pub(super) newest: N,
    /// Whether q has changed.
    pub(super) moves: bool,
    /// Σ ½(p_0 + p_1)ᵀ(q_1 − q_0)
    pub(super) action: N,
    /// Intermediate results.
    two: PartialSums<N, 2>,
    x: N,
    y: N,
    z: N,
}

impl<N: Real> Kicks<N> {
    pub(super) fn new(h: &StepSize, context: &N::Context) -> Self {
        let zero = || N::zero(context);
        Kicks {
            evaluations: 0,
            stages: 0,
            restored: false,
            most_stages: u64::MAX,
            compensated: false,
            factor: kick_factor(&epsilon(context), h.exact(), context),
            sum: zero(),
            newest: zero(),
            moves: false,
            action: zero(),
            two: PartialSums::new(context),
            x: zero(),
            y: zero(),
            z: zero(),
        }
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        let Kicks { stages, compensated, sum, newest, moves, action, .. } = self;
        to.count(stages);
        [compensated, moves].into_iter().for_each(|flag| to.flag(flag));
        [sum, newest, action].into_iter().for_each(|sum| to.number(sum));
        to.restore(&mut self.restored);
    }

    /// Takes how the newest state was made.
    #[inline(always)]
    pub(super) fn take<M: System<Number = N> + ?Sized>(&mut self, system: &M) {
        let evaluations = system.state().evaluations();
        if !take(&mut self.restored) {
            self.stages = evaluations.saturating_sub(self.evaluations);
        }
        self.evaluations = evaluations;
        self.compensated = system.state().is_compensated();
    }

    /// Adds s (cε/h)² Σ ((Δq p)² + (Δp q)²): T_p is Δq/h, U_q is −Δp/h, and s stages round q and p by cε|q| and cε|p|
    /// each; where sums are compensated, Δq and Δp.
    #[inline(always)]
    pub(super) fn add(&mut self, [before, s0, s1]: &[StateView<'_, N>; STATES_KEPT]) {
        let Kicks { two, x, y, z, .. } = self;
        self.moves = self.moves || s0.q != s1.q;
        let [kick, action] = two.of([&*s0.q, &*s1.q, &*s0.p, &*s1.p], |[q0, q1, p0, p1], [kick, action]| {
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
            add_squares_of_increments(z, [&*before.q, &*s0.q, &*s1.q], [&*before.p, &*s0.p, &*s1.p], [x, y]);
        }
        let stages = self.stages.min(self.most_stages).max(1);
        z.multiply_integer(i32::try_from(stages).unwrap_or(i32::MAX));
        self.newest.assign_product(z, &self.factor);
        self.sum.add(&self.newest);
    }
}
