//! What follows from the numbers of a diagnosis.

use super::changes::Jump;
use super::diagnosis::Diagnosis;
use super::misfit::Differences;
use super::roughness::Smoothness;
use super::thresholds::{
    ALIKE, AT_HOME, CANCELS, COARSE, ISOLATED, JUMPS, JUMPS_ISOLATED, KINKS, LARGEST_MISFIT, LEAST_OF_KINKS, LITTLE,
    MOTION_EXCESS, MOVED, MUCH, NOISE, NOISE_EXCESS, NOISE_OF_FORCES, NOISY_ENERGY, OF_ROUNDING, OF_WORK, RANGE,
    ROUNDED, SINGLE, SMOOTH_ENERGY, WANDERING,
};
use crate::shadow::rules::KINETIC_LIMIT;

impl Diagnosis {
    /// Whether the steps are too large whatever the forces are.
    pub(super) fn is_too_large_a_step(&self) -> bool {
        self.method_error >= KINETIC_LIMIT * self.usual_kinetic
    }

    /// Whether H̄ changes independently from step to step, and by about the same.
    pub(super) fn is_independent(&self) -> bool {
        let [least, most] = self.window.thresholds().independent;
        (least..most).contains(&self.growth) && self.isolation < ALIKE
    }

    /// Whether H̄ changes slowly beside the steps.
    fn is_slow(&self) -> bool {
        let [_, most] = self.window.thresholds().independent;
        self.growth >= most && self.isolation < ALIKE
    }

    fn is_very_slow(&self) -> bool {
        self.is_slow() && self.growth >= self.window.thresholds().very_slow
    }

    /// Whether H̄ changes at few states, by as much as the kinetic energy: steps that are too large there, or another
    /// state.
    pub(super) fn has_large_jumps(&self) -> bool {
        self.isolation > ISOLATED && self.energy_error >= KINETIC_LIMIT * self.usual_kinetic
    }

    /// Whether H̄ goes to and fro.
    fn is_swaying(&self) -> bool {
        let [least, _] = self.window.thresholds().independent;
        self.growth < least
    }

    /// Whether the steps resolve the motion, as the forces show.
    pub(super) fn is_resolved(&self) -> bool {
        self.smoothness.is_some_and(|forces| forces.differences < self.window.thresholds().unresolved * forces.size)
    }

    /// Whether what the motion has of the forces between the steps is what H̄ changes by: it is much, and H̄ goes to
    /// and fro, or it is more, and that of few states.
    fn is_of_motion(&self) -> bool {
        let Some(forces) = self.smoothness else { return false };
        let [to_and_fro, at_few] =
            self.window.thresholds().too_large.map(|part| forces.differences > part * forces.size);
        self.is_swaying() && to_and_fro || self.isolation > ISOLATED && at_few
    }

    /// Whether H̄ did not move beyond its errors.
    pub(super) fn is_at_rest(&self) -> bool {
        self.moved < MOVED * self.energy_error
    }

    /// Whether H̄ is at rest and known to a small part of the energy error.
    pub(super) fn is_conserved(&self) -> bool {
        let is_known = self.known_to < MOVED * self.energy_error;
        self.is_at_rest() && is_known && self.range < RANGE * self.energy_error
    }

    /// Whether that may be so because estimates are means over nine states.
    pub(super) fn may_cancel(&self) -> bool {
        let is_seen = self.range >= CANCELS * self.energy_error;
        self.is_conserved() && is_seen && (!self.is_resolved() || self.is_swaying())
    }

    /// Whether the states are not those of steps.
    pub(super) fn is_of_other_steps(&self) -> bool {
        self.reordered.is_some() || self.differences.is_some_and(is_of_other_steps)
    }

    /// Whether the work of what differs from the steps is what moves H̄.
    pub(super) fn is_moved_by_other_steps(&self) -> bool {
        (OF_WORK..OF_WORK.recip()).contains(&(self.work / self.range)) && !self.has_rounded_work()
    }

    /// The size of the errors of U, where H̄ is at rest but for them.
    pub(super) fn noise_of_energy(&self) -> Option<f64> {
        let of_energy = self.energy_smoothness.filter(|_| self.is_at_rest())?;
        let is_noise = of_energy.exponent < NOISE && of_energy.differences > NOISY_ENERGY * self.in_a_step;
        (is_noise && self.is_swaying() && self.is_resolved()).then_some(of_energy.differences)
    }

    /// How smooth the forces are, and the excess, where these show anything.
    pub(super) fn forces(&self) -> Option<(Smoothness, f64)> {
        let shows = |forces: &Smoothness, excess: f64| !forces.exponent.is_nan() && !excess.is_nan();
        self.smoothness.zip(self.excess).filter(|(forces, excess)| shows(forces, *excess) && !self.has_large_jumps())
    }

    /// Whether H̄ changes by more than errors of the forces explain.
    fn moves_more(&self) -> bool {
        self.forces().is_some_and(|(_, excess)| excess > MUCH)
    }

    /// How smooth U is, where H̄ does that at all states alike.
    fn energy(&self) -> Option<Smoothness> {
        self.energy_smoothness.filter(|_| self.moves_more() && self.isolation <= ISOLATED)
    }

    /// The rms of the jumps, where H̄ changes by them.
    pub(super) fn size_of_jumps(&self) -> Option<f64> {
        let squares = self.jumps.iter().map(|Jump { energy, .. }| energy * energy).sum::<f64>();
        (self.moves_more() && self.isolation > JUMPS_ISOLATED).then(|| (squares / self.jumps.len() as f64).sqrt())
    }

    /// Whether U and the forces are too smooth for the changes of H̄, or these are slow.
    pub(super) fn is_not_the_gradient(&self) -> bool {
        if self.moves_more() {
            let is_smooth = |of: Smoothness| of.differences < SMOOTH_ENERGY * self.in_a_step;
            return self.energy().is_some_and(|of| is_smooth(of) || of.exponent >= KINKS && self.is_slow());
        }
        let is_slow = |excess| self.is_slow() && self.is_resolved() || self.is_very_slow() && excess >= MOTION_EXCESS;
        self.forces().is_some_and(|(forces, excess)| forces.exponent >= KINKS && is_slow(excess))
    }

    /// Whether U jumps all the time; where the steps do not resolve the motion, no U has a larger exponent.
    pub(super) fn is_energy_not_smooth(&self) -> bool {
        self.energy().is_some_and(|of| of.exponent < JUMPS) && !self.is_swaying() && self.is_resolved()
    }

    /// The size of errors of the forces that are independent from step to step.
    pub(super) fn noise_of_forces(&self) -> Option<f64> {
        let (forces, excess) = self.forces()?;
        let is_noise = forces.exponent < NOISE_OF_FORCES && (NOISE_EXCESS..=MUCH).contains(&excess);
        (is_noise && self.is_independent()).then_some(forces.differences)
    }

    /// Whether the forces, or their derivatives, jump.
    pub(super) fn has_kinks(&self) -> bool {
        let are_of_kinks = |(Smoothness { exponent, .. }, excess): (Smoothness, f64)| {
            let least = LITTLE..self.window.thresholds().of_kinks;
            (LEAST_OF_KINKS..KINKS).contains(&exponent) && least.contains(&excess)
        };
        self.forces().is_some_and(are_of_kinks) && self.is_resolved() && self.isolation < ALIKE
    }

    /// Whether the motion between the steps is what moves H̄.
    pub(super) fn is_of_large_steps(&self) -> bool {
        let is_smooth = |(forces, excess): (Smoothness, f64)| forces.exponent >= JUMPS && excess < MOTION_EXCESS;
        self.forces().is_some_and(is_smooth) && self.is_of_motion() && !self.is_at_rest()
    }

    /// Whether the work of the differences of the states from the steps, of q or of p, whichever is more, is that of
    /// rounded numbers.
    fn has_rounded_work(&self) -> bool {
        let [of_q, of_p] = self.work_in_a_step;
        let most = self.differences.map(|[q, p]| if of_q > of_p { q } else { p });
        let [alike, _] = ROUNDED;
        most.is_some_and(|most| most.correlation < alike || self.is_of_rounding() && most.wandering < AT_HOME)
    }

    /// Whether q or p is rounded, and makes errors of the size of those of H̄.
    pub(super) fn is_of_rounding(&self) -> bool {
        let both = self.differences.iter().flatten().zip(self.work_in_a_step);
        let squares: f64 = both.filter(|(of, _)| is_rounded(**of)).map(|(_, work)| work * work).sum();
        self.known_to < OF_ROUNDING * squares.sqrt()
    }
}

/// Whether q or p of the states differ from steps, and not as rounded numbers do.
pub(super) fn is_of_other_steps([of_q, of_p]: [Differences; 2]) -> bool {
    let differs = |of: Differences| of.of_increments > LARGEST_MISFIT && of.of_numbers > SINGLE;
    // momenta may be written with a few digits of the smallest
    differs(of_q) && (!is_rounded(of_q) || of_q.of_numbers > COARSE) || differs(of_p) && !is_rounded(of_p)
}

/// Whether each number is rounded by itself.
fn is_rounded(of: Differences) -> bool {
    let [alike, apart] = ROUNDED;
    of.correlation < alike || of.correlation < apart && of.wandering < WANDERING
}
