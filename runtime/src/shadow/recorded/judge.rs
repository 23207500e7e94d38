//! The thresholds that tell apart what moves the energy.
//!
//! They were chosen on trajectories like those of `tests/tests/recorded/verdicts.rs`, drawn with other seeds than its tests have.

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
/// the correlation of rounded ones is below this, or, where they change by less than their last digit in a step, below the second, and these do not wander.
const ROUNDED: [f64; 2] = [-0.3, 0.3];
const WANDERING: f64 = 0.5;
/// Numbers that differ by more than this part of themselves are not rounded ones.
const COARSE: f64 = 1e-2;
/// H̄ moved if its range is this part of the energy error or more, beyond errors on both sides.
const MOVED: f64 = 0.1;
/// It is at rest if it is known to that part, and ranges over less than this one with its errors.
const RANGE: f64 = 0.25;
/// States that are rounded make errors of H̄ that are smaller than the work of the differences in a step; this many times that is none.
const OF_ROUNDING: f64 = 5.0;
/// The work of the differences from steps is what moves H̄, if it is this part of its range or more, up to the inverse.
const OF_WORK: f64 = 0.3;
/// H̄ moves by more than the forces' differences explain where the excess is above this,
const MUCH: f64 = 8.0;
/// and by much less below this.
const LITTLE: f64 = 0.03;
/// Noise of the forces makes an excess of 1, and above this;
const NOISE_EXCESS: f64 = 0.35;
/// motion that the steps do not resolve makes one below this.
const MOTION_EXCESS: f64 = 0.1;
/// Forces that jump, or whose derivatives do, make an excess below this: from it on, noise beside the motion may have their exponent.
const JUMPS_EXCESS: f64 = 0.7;
/// H̄ changes at few states only where the isolation is above this.
const ISOLATED: f64 = 3.0;
/// What H̄ changes by in one step and in another is independent where the growth is between these, which windows of nine states know worse, and
const fn independent(window: Window) -> [f64; 2] {
    match window {
        Window::Nine => [0.4, 3.6],
        Window::Seventeen => [0.7, 1.6],
    }
}
/// the isolation below this.
const ALIKE: f64 = 2.0;
/// U is too smooth for the changes of H̄ where its differences are below this part of them, and noisy where they are above the second.
const SMOOTH_ENERGY: f64 = 0.25;
const NOISY_ENERGY: f64 = 1.5;
/// The steps do not resolve the motion where differences of smooth forces are this part of the forces or more: both are six steps a turn.
const fn unresolved(window: Window) -> f64 {
    match window {
        Window::Nine => 0.05,
        Window::Seventeen => 0.01,
    }
}
/// They are too large for it where these are this part: about four steps a turn.
const fn too_large(window: Window) -> f64 {
    match window {
        Window::Nine => 0.15,
        Window::Seventeen => 0.1,
    }
}
/// Exponents of numbers that are noise, jump, or have a derivative that jumps, are below these.
const NOISE: f64 = 0.5;
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

    /// Whether H̄ changes at few states, by as much as the kinetic energy: steps that are too large there, or another state.
    pub(super) fn has_large_jumps(&self) -> bool {
        self.isolation > ISOLATED && self.energy_error >= KINETIC_LIMIT * self.usual_kinetic
    }

    /// Whether H̄ goes to and fro.
    fn is_swaying(&self) -> bool {
        let [least, _] = independent(self.window);
        self.growth < least
    }

    /// Whether the steps resolve the motion, as the forces show.
    fn is_resolved(&self) -> bool {
        self.smoothness.is_some_and(|forces| forces.differences < unresolved(self.window) * forces.size)
    }

    /// Whether what the motion has of the forces between the steps can be what H̄ changes by: it goes to and fro, or is that of few states, or much.
    fn is_of_motion(&self) -> bool {
        let is_much = self.smoothness.is_some_and(|forces| forces.differences > too_large(self.window) * forces.size);
        !self.is_slow() && (is_much || !self.is_independent())
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
    let is_at_rest = found.moved < MOVED * found.energy_error;
    if is_at_rest && let Some(cause) = at_rest(found) {
        return cause;
    }
    if (OF_WORK..OF_WORK.recip()).contains(&(found.work / found.range)) && !is_of_rounding(found) {
        return Cause::OtherSteps;
    }
    match of_forces(found) {
        Cause::TimeStep if is_at_rest => Cause::Undecided,
        cause => cause,
    }
}

/// The cause where H̄ did not move beyond its errors.
fn at_rest(found: &Diagnosis) -> Option<Cause> {
    if found.known_to < MOVED * found.energy_error && found.range < RANGE * found.energy_error {
        return Some(Cause::Nothing);
    }
    if is_of_rounding(found) {
        return Some(Cause::Digits);
    }
    let of_energy = found.energy_smoothness?;
    let is_noise = of_energy.exponent < NOISE && of_energy.differences > NOISY_ENERGY * found.in_a_step;
    (is_noise && found.is_swaying() && found.is_resolved())
        .then_some(Cause::NoisyEnergy { size: of_energy.differences })
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
        ..NOISE if excess >= NOISE_EXCESS => Cause::Noise { size: differences },
        ..NOISE => Cause::Undecided,
        KINKS.. if found.is_slow() && is_resolved => Cause::NotTheGradient,
        JUMPS.. if found.is_slow() && excess >= MOTION_EXCESS => Cause::NotTheGradient,
        ..KINKS if is_resolved && (LITTLE..JUMPS_EXCESS).contains(&excess) => Cause::ForcesNotSmooth,
        JUMPS.. if excess < MOTION_EXCESS && !is_resolved && found.is_of_motion() => Cause::TimeStep,
        _ => Cause::Undecided,
    }
}

/// The cause where H̄ changes by more than errors of the forces explain.
fn of_energy(found: &Diagnosis) -> Cause {
    if found.isolation > ISOLATED {
        let squares = found.jumps.iter().map(|Jump { energy, .. }| energy * energy).sum::<f64>();
        return Cause::Jumps { size: (squares / found.jumps.len() as f64).sqrt() };
    }
    let Some(of_energy) = found.energy_smoothness else { return Cause::Undecided };
    if of_energy.differences < SMOOTH_ENERGY * found.in_a_step {
        Cause::NotTheGradient
    } else if of_energy.exponent < JUMPS && !found.is_swaying() {
        Cause::EnergyNotSmooth { size: found.in_a_step }
    } else if found.is_slow() {
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
