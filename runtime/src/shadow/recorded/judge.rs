//! The thresholds that tell apart what moves the energy.
//!
//! They were chosen on trajectories like those of `tests/tests/recorded/verdicts.rs`, drawn with other seeds than its
//! tests have.

use super::cause::Cause;
use super::changes::Jump;
use super::diagnosis::Diagnosis;
use super::misfit::Differences;
use super::roughness::Smoothness;
use super::window::Window;
use crate::shadow::KINETIC_LIMIT;

/// Estimates that a statement needs.
pub(super) const LEAST_ESTIMATES: usize = 32;
/// Logged states differ from the steps by more than this part of the increments,
const LARGEST_MISFIT: f64 = 1e-3;
/// and by more than this part of themselves, a few last places of an `f32`, and are not rounded each by itself:
const SINGLE: f64 = 2.4e-7;
/// the correlation of rounded ones is below this, or, where they change by less than their last digit in a step, below
/// the second, and these do not wander.
const ROUNDED: [f64; 2] = [-0.2, 0.3];
const WANDERING: f64 = 0.5;
/// Of differences whose work is what H̄ ranges over, these are below this: a thermostat's do not wander as far as
/// independent ones.
const AT_HOME: f64 = 0.3;
/// Numbers that differ by more than this part of themselves are not rounded ones.
const COARSE: f64 = 1e-2;
/// H̄ moved if its range is this part of the energy error or more, beyond errors on both sides.
const MOVED: f64 = 0.1;
/// It is at rest if it is known to that part, and ranges over less than this one with its errors.
const RANGE: f64 = 0.25;
/// From this part on that is certain only where the steps resolve the motion and H̄ does not go to and fro: estimates
/// are means over nine states, in which what U jumps by, or forces that are not −U_q, may cancel.
const CANCELS: f64 = 0.02;
/// States that are rounded make errors of H̄ that are smaller than the work of the differences in a step; this many
/// times that is none.
const OF_ROUNDING: f64 = 5.0;
/// The work of the differences from steps is what moves H̄, if it is this part of its range or more, up to the inverse.
const OF_WORK: f64 = 0.3;
/// H̄ moves by more than the forces' differences explain where the excess is above this,
const MUCH: f64 = 8.0;
/// and by much less below this.
const LITTLE: f64 = 0.03;
/// Noise of the forces makes an excess of 1, and above this;
const NOISE_EXCESS: f64 = 0.5;
/// motion that the steps do not resolve makes one below this.
const MOTION_EXCESS: f64 = 0.05;
/// Forces that jump, or whose derivatives do, make an excess below this: from it on, noise beside the motion may have
/// their exponent.
const fn of_kinks(window: Window) -> f64 {
    match window {
        Window::Nine => 0.5,
        Window::Seventeen => 0.6,
    }
}
/// H̄ changes at few states only where the isolation is above this; what grows unevenly has one up to the second.
const ISOLATED: f64 = 3.0;
const JUMPS_ISOLATED: f64 = 5.0;
/// What H̄ changes by in one step and in another is independent where the growth is between these, which windows of
/// nine states know worse, and
const fn independent(window: Window) -> [f64; 2] {
    match window {
        Window::Nine => [0.4, 4.0],
        Window::Seventeen => [0.7, 1.6],
    }
}
/// the isolation below this.
const ALIKE: f64 = 2.0;
/// U is too smooth for the changes of H̄ where its differences are below this part of them, and may be noisy where they
/// are above the second.
const SMOOTH_ENERGY: f64 = 0.15;
const NOISY_ENERGY: f64 = 2.2;
/// The steps do not resolve the motion where differences of smooth forces are this part of the forces or more: both are
/// six steps a turn.
const fn unresolved(window: Window) -> f64 {
    match window {
        Window::Nine => 0.05,
        Window::Seventeen => 0.01,
    }
}
/// They are too large for it where these are this part: about four steps a turn; or the second, where H̄ does not go to
/// and fro.
const fn too_large(window: Window) -> [f64; 2] {
    match window {
        Window::Nine => [0.15, 0.25],
        Window::Seventeen => [0.1, 0.15],
    }
}
/// H̄ changes slowly, also where the steps do not resolve the motion, from this growth on.
const fn very_slow(window: Window) -> f64 {
    match window {
        Window::Nine => 4.5,
        Window::Seventeen => 2.1,
    }
}
/// Exponents of a U that is noise are below this, of forces that are below the second; between it and the third they
/// may have kinks.
const NOISE: f64 = 0.5;
const NOISE_OF_FORCES: f64 = 0.25;
const LEAST_OF_KINKS: f64 = 0.75;
/// Exponents of numbers that jump, or have a derivative that jumps, are below these.
const JUMPS: f64 = 2.0;
const KINKS: f64 = 4.0;

impl Diagnosis {
    /// The same with its cause.
    pub(super) fn judged(self) -> Diagnosis {
        Diagnosis { cause: cause(&self), ..self }
    }

    /// Whether the steps are too large whatever the forces are.
    pub(super) fn is_too_large_a_step(&self) -> bool {
        self.method_error >= KINETIC_LIMIT * self.usual_kinetic
    }

    /// Whether H̄ changes independently from step to step, and by about the same.
    pub(super) fn is_independent(&self) -> bool {
        let [least, most] = independent(self.window);
        (least..most).contains(&self.growth) && self.isolation < ALIKE
    }

    /// Whether H̄ changes slowly beside the steps.
    fn is_slow(&self) -> bool {
        let [_, most] = independent(self.window);
        self.growth >= most && self.isolation < ALIKE
    }

    fn is_very_slow(&self) -> bool {
        self.is_slow() && self.growth >= very_slow(self.window)
    }

    /// Whether H̄ changes at few states, by as much as the kinetic energy: steps that are too large there, or another
    /// state.
    pub(super) fn has_large_jumps(&self) -> bool {
        self.isolation > ISOLATED && self.energy_error >= KINETIC_LIMIT * self.usual_kinetic
    }

    /// Whether H̄ goes to and fro.
    fn is_swaying(&self) -> bool {
        let [least, _] = independent(self.window);
        self.growth < least
    }

    /// Whether the steps resolve the motion, as the forces show.
    pub(super) fn is_resolved(&self) -> bool {
        self.smoothness.is_some_and(|forces| forces.differences < unresolved(self.window) * forces.size)
    }

    /// Whether what the motion has of the forces between the steps is what H̄ changes by: it is much, and H̄ goes to
    /// and fro, or it is more, and that of few states.
    fn is_of_motion(&self) -> bool {
        let Some(forces) = self.smoothness else { return false };
        let [to_and_fro, at_few] = too_large(self.window).map(|part| forces.differences > part * forces.size);
        self.is_swaying() && to_and_fro || self.isolation > ISOLATED && at_few
    }

    /// Whether H̄ did not move beyond its errors.
    fn is_at_rest(&self) -> bool {
        self.moved < MOVED * self.energy_error
    }

    /// Whether H̄ is at rest and known to a small part of the energy error.
    fn is_conserved(&self) -> bool {
        let is_known = self.known_to < MOVED * self.energy_error;
        self.is_at_rest() && is_known && self.range < RANGE * self.energy_error
    }

    /// Whether that may be so because estimates are means over nine states.
    pub(super) fn may_cancel(&self) -> bool {
        let is_seen = self.range >= CANCELS * self.energy_error;
        self.is_conserved() && is_seen && (!self.is_resolved() || self.is_swaying())
    }
}

fn cause(found: &Diagnosis) -> Cause {
    if found.estimates < LEAST_ESTIMATES {
        return Cause::Undecided;
    }
    if found.reordered.is_some() || found.differences.is_some_and(is_of_other_steps) {
        return Cause::OtherSteps;
    }
    if found.is_too_large_a_step() {
        return Cause::TimeStep;
    }
    if found.is_at_rest()
        && let Some(cause) = at_rest(found)
    {
        return cause;
    }
    if (OF_WORK..OF_WORK.recip()).contains(&(found.work / found.range)) && !has_rounded_work(found) {
        return Cause::OtherSteps;
    }
    match of_forces(found) {
        Cause::TimeStep if found.is_at_rest() => Cause::Undecided,
        cause => cause,
    }
}

/// The cause where H̄ did not move beyond its errors.
fn at_rest(found: &Diagnosis) -> Option<Cause> {
    if found.is_conserved() && !found.may_cancel() {
        return Some(Cause::Nothing);
    }
    if is_of_rounding(found) {
        return Some(Cause::Digits);
    }
    if found.may_cancel() {
        return Some(Cause::Undecided);
    }
    let of_energy = found.energy_smoothness?;
    let is_noise = of_energy.exponent < NOISE && of_energy.differences > NOISY_ENERGY * found.in_a_step;
    (is_noise && found.is_swaying() && found.is_resolved())
        .then_some(Cause::NoisyEnergy { size: of_energy.differences })
}

/// Whether the work of the differences of the states from the steps, of q or of p, whichever is more, is that of
/// rounded numbers.
fn has_rounded_work(found: &Diagnosis) -> bool {
    let [of_q, of_p] = found.work_in_a_step;
    let most = found.differences.map(|[q, p]| if of_q > of_p { q } else { p });
    let [alike, _] = ROUNDED;
    most.is_some_and(|most| most.correlation < alike || is_of_rounding(found) && most.wandering < AT_HOME)
}

/// Whether q or p is rounded, and makes errors of the size of those of H̄.
fn is_of_rounding(found: &Diagnosis) -> bool {
    let both = found.differences.iter().flatten().zip(found.work_in_a_step);
    let squares: f64 = both.filter(|(of, _)| is_rounded(**of)).map(|(_, work)| work * work).sum();
    found.known_to < OF_ROUNDING * squares.sqrt()
}

fn of_forces(found: &Diagnosis) -> Cause {
    let Some((Smoothness { exponent, differences, .. }, excess)) = found.smoothness.zip(found.excess) else {
        return Cause::Undecided;
    };
    if excess.is_nan() || exponent.is_nan() || found.has_large_jumps() {
        return Cause::Undecided;
    }
    if excess > MUCH {
        return of_energy(found);
    }
    let is_resolved = found.is_resolved();
    match exponent {
        ..NOISE_OF_FORCES if excess >= NOISE_EXCESS && found.is_independent() => Cause::Noise { size: differences },
        ..LEAST_OF_KINKS => Cause::Undecided,
        KINKS.. if found.is_slow() && is_resolved => Cause::NotTheGradient,
        KINKS.. if found.is_very_slow() && excess >= MOTION_EXCESS => Cause::NotTheGradient,
        ..KINKS if is_resolved && found.isolation < ALIKE && (LITTLE..of_kinks(found.window)).contains(&excess) => {
            Cause::ForcesNotSmooth
        }
        JUMPS.. if excess < MOTION_EXCESS && found.is_of_motion() => Cause::TimeStep,
        _ => Cause::Undecided,
    }
}

/// The cause where H̄ changes by more than errors of the forces explain.
fn of_energy(found: &Diagnosis) -> Cause {
    if found.isolation > JUMPS_ISOLATED {
        let squares = found.jumps.iter().map(|Jump { energy, .. }| energy * energy).sum::<f64>();
        return Cause::Jumps { size: (squares / found.jumps.len() as f64).sqrt() };
    }
    let Some(of_energy) = found.energy_smoothness.filter(|_| found.isolation <= ISOLATED) else {
        return Cause::Undecided;
    };
    if of_energy.differences < SMOOTH_ENERGY * found.in_a_step {
        Cause::NotTheGradient
    } else if of_energy.exponent < JUMPS && !found.is_swaying() {
        // where the steps do not resolve the motion, U has no larger exponent
        if found.is_resolved() { Cause::EnergyNotSmooth { size: found.in_a_step } } else { Cause::Undecided }
    } else if of_energy.exponent >= KINKS && found.is_slow() {
        Cause::NotTheGradient
    } else {
        Cause::Undecided
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
