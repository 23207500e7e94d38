//! What moves the energy of a recorded trajectory, with the thresholds.

use super::changes::{Changes, Jump, median};
use super::forces::{ForceDifferences, Smoothness};
use super::misfit::Differences;
use super::value::Value;
use super::window::Window;
use crate::shadow::KINETIC_LIMIT;

/// Estimates that a statement needs.
const LEAST_ESTIMATES: usize = 32;
/// Logged states differ from the steps by more than this part of the increments,
const LARGEST_MISFIT: f64 = 1e-3;
/// and by more than this part of themselves, a few last places of an `f32`, and are not rounded each by itself.
const SINGLE: f64 = 2.4e-7;
const ROUNDED: f64 = -0.3;
/// Numbers that differ by more than this part of themselves are not rounded ones.
const COARSE: f64 = 1e-2;
/// H̄ moved if its range is this part of the energy error or more, beyond errors on both sides.
const MOVED: f64 = 0.1;
/// H̄ is not known well enough to exclude a change, if its error is this part of the energy error or more.
const UNKNOWN: f64 = 0.25;
/// An estimate may be wrong by this many times its error.
const ERROR_FACTOR: f64 = 3.0;
/// H̄ moves by more than the forces' differences explain where the excess is above the first, and by much less below the second.
const EXCESS: [f64; 2] = [8.0, 0.03];
/// Noise of the forces makes an excess of 1, and above this; motion that the steps do not resolve makes one below it.
const NOISE_EXCESS: f64 = 0.1;
/// Forces that jump, or whose derivatives do, make an excess below this: from it on, noise beside the motion may have their exponent.
const JUMPS_EXCESS: f64 = 0.7;
/// H̄ changes at few states only where the isolation is above this.
const ISOLATED: f64 = 3.0;
/// The steps do not resolve the motion where differences of smooth forces are this part of the forces or more: both are six steps a turn.
const fn unresolved(window: Window) -> f64 {
    match window {
        Window::Nine => 0.05,
        Window::Seventeen => 0.01,
    }
}
/// Exponents of forces that are noise, jump, or have a derivative that jumps, are below these.
const NOISE: f64 = 0.5;
const JUMPS: f64 = 2.0;
const KINKS: f64 = 4.0;
/// Where H̄ moves by more than the forces' differences explain, forces are smooth from this exponent on: nine states see more of the smooth part.
const fn smooth(window: Window) -> f64 {
    match window {
        Window::Nine => 3.0,
        Window::Seventeen => 2.0,
    }
}

/// What moves the energy of a trajectory that another program has computed.
///
/// H̄ is constant but for what is not a step of the scheme in a smooth potential, so what it changes by is the size of the cause. The energy error, max − min of
/// H, contains the part H − H̄ of the method in addition, which oscillates. Printed, it is a few lines with the numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// How many states follow each other at least.
    pub window: Window,
    /// How many states were taken.
    pub states: u64,
    /// How many estimates H̄ with errors there are.
    pub estimates: usize,
    /// The mean kinetic energy.
    pub kinetic: f64,
    /// The energy error: max − min of H.
    pub energy_error: f64,
    /// The method's part of it: max − min of H − H̄.
    pub method_error: f64,
    /// H̄ of the first estimate.
    pub first: f64,
    /// The last one less the first.
    pub change: f64,
    /// max − min of H̄.
    pub range: f64,
    /// That beyond three errors of the estimates on both sides, or 0.
    pub moved: f64,
    /// The median of the estimated errors of H̄; in windows of nine states with three times the scatter of H̄, the part that does not add up.
    pub known_to: f64,
    /// The time from the first estimate to the last.
    pub time: f64,
    /// How smooth the forces are; `None` where no gradients are logged.
    pub smoothness: Option<Smoothness>,
    /// The mean square of what H̄ changes by in a step, as a multiple of what errors of the forces would make that are independent from step to step and
    /// of the size of their differences, h²Σ(σv)²: 1 for noise of the forces.
    pub excess: Option<f64>,
    /// The rms of what H̄ changes by from state to state, as a multiple of the rms of a normal distribution with the same median: 1 for noise, large where H̄
    /// changes at few states only.
    pub isolation: f64,
    /// These states, with the largest change first.
    pub jumps: Vec<Jump>,
    /// By how much logged q and p differ from the steps; `None` where no gradients are logged.
    pub differences: Option<[Differences; 2]>,
    /// The first state whose coordinates are those of the step in another order, as where a file is not sorted by atoms.
    pub reordered: Option<i64>,
    /// What moves the energy.
    pub cause: Cause,
}

/// What moves the modified energy. The first that applies is given:
///
/// | cause | if |
/// | --- | --- |
/// | not decided: states | there are fewer than 32 estimates with errors |
/// | other steps | the order of the coordinates changes; or q or p of the states differ from the steps by more than 1e-3 of their increments, rms, and not as numbers that are stored with few digits, which are off by less than 1e-2 of q |
/// | time step | the method's part of the energy error is 0.4 of the mean kinetic energy or more, as for the [monitor](crate::shadow::ShadowEnergy) |
/// | nothing | H̄ moved by less than a tenth of the energy error, beyond three times its errors, and is known to a quarter of it |
/// | digits | else, if it is not known to that, and q differs from the steps as numbers that are stored with few digits |
/// | jumps | the excess is above 8, the isolation above 3 |
/// | not the gradient | the excess is above 8, the exponent 2 or more (3 in windows of nine states) |
/// | energy not smooth | the excess is above 8 |
/// | noise | the exponent is below 0.5, and the excess 0.1 or more |
/// | forces not smooth | the exponent is below 2, the excess below 0.7, and the differences of the forces are below 0.01 of these (0.05 in windows of nine states) |
/// | time step | the exponent is 2 or more; and the excess is at most 0.03, or it is below 0.1 and the differences are 0.01 of the forces or more (0.05 in windows of nine states) |
/// | forces not smooth | the exponent is from 2 to 4, the excess below 0.7, and the differences are below that |
/// | not decided | none of these, or no gradients are logged |
///
/// The excess, the isolation and the exponent are defined at [`Diagnosis`]; `docs/recorded-trajectories.md` has measured values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cause {
    /// The states are not from velocity Verlet with these masses, gradients and step size: a thermostat, a constraint, another integrator.
    OtherSteps,
    /// Nothing that is resolved: H̄ is conserved.
    Nothing,
    /// The states are stored with too few digits to know H̄.
    Digits,
    /// The energy jumps now and then: a list of neighbours that is renewed too late, a state that is changed.
    Jumps {
        /// The root mean square of these jumps.
        size: f64,
    },
    /// Smooth forces that are not −U_q of the logged U.
    NotTheGradient,
    /// U jumps, all the time: a truncated potential.
    EnergyNotSmooth {
        /// What that changes the energy by in a step, rms.
        size: f64,
    },
    /// Errors of the forces that are independent from step to step.
    Noise {
        /// Their root mean square for a component.
        size: f64,
    },
    /// The forces, or their derivatives, jump: a cutoff.
    ForcesNotSmooth,
    /// The time step: forces are smooth, and the steps do not resolve the motion.
    TimeStep,
    /// Not decided by these states.
    Undecided,
}

impl Cause {
    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Cause::OtherSteps => "other-steps",
            Cause::Nothing => "nothing",
            Cause::Digits => "digits",
            Cause::Jumps { .. } => "jumps",
            Cause::NotTheGradient => "not-the-gradient",
            Cause::EnergyNotSmooth { .. } => "energy-not-smooth",
            Cause::Noise { .. } => "noise",
            Cause::ForcesNotSmooth => "forces-not-smooth",
            Cause::TimeStep => "time-step",
            Cause::Undecided => "undecided",
        }
    }

    /// For noise, the size in the forces; for jumps of U, the size in the energy.
    pub fn size(self) -> Option<f64> {
        match self {
            Cause::Jumps { size } | Cause::EnergyNotSmooth { size } | Cause::Noise { size } => Some(size),
            _ => None,
        }
    }
}

/// What a diagnosis is made of.
pub(super) struct Evidence<'a> {
    pub(super) window: Window,
    pub(super) h: f64,
    pub(super) states: u64,
    pub(super) values: &'a [Value],
    pub(super) kinetic: f64,
    pub(super) changes: &'a Changes,
    pub(super) forces: &'a ForceDifferences,
    pub(super) differences: Option<[Differences; 2]>,
    pub(super) reordered: Option<i64>,
}

impl Diagnosis {
    pub(super) fn of(evidence: &Evidence<'_>) -> Diagnosis {
        let Evidence { window, h, states, values, kinetic, changes, forces, differences, reordered } = *evidence;
        let largest = |of: &dyn Fn(&Value) -> f64| values.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        let width = |of: &dyn Fn(&Value) -> f64| largest(of) + largest(&|value| -of(value));
        // the error of seventeen states contains it
        let scatter = if window == Window::Nine { changes.scatter() } else { 0.0 };
        let error = |value: &Value| value.error.hypot(scatter);
        // an error of seventeen states is a range of what scatters
        let known_to = |value: &Value| value.error.hypot(ERROR_FACTOR * scatter);
        let beyond = |sign: f64| largest(&|value| sign * value.modified - ERROR_FACTOR * error(value));
        let (first, last) = (values.first(), values.last());
        let modified = |value: Option<&Value>| value.map_or(f64::NAN, |value| value.modified);
        let smoothness = forces.found();
        let square = changes.square_in_a_step();
        let mut diagnosis = Diagnosis {
            window,
            states,
            estimates: values.len(),
            kinetic,
            energy_error: width(&|value| value.energy),
            method_error: width(&|value| value.energy - value.modified),
            first: modified(first),
            change: modified(last) - modified(first),
            range: width(&|value| value.modified),
            moved: (beyond(1.0) + beyond(-1.0)).max(0.0),
            known_to: median(values.iter().map(known_to).collect()),
            time: h.abs() * last.zip(first).map_or(0.0, |(last, first)| (last.n - first.n) as f64),
            smoothness,
            excess: smoothness.map(|_| square / (h * h * forces.power())),
            isolation: changes.isolation(),
            jumps: changes.jumps(),
            differences,
            reordered,
            cause: Cause::Undecided,
        };
        diagnosis.cause = diagnosis.judge(square.sqrt());
        diagnosis
    }

    fn judge(&self, in_a_step: f64) -> Cause {
        if self.estimates < LEAST_ESTIMATES {
            return Cause::Undecided;
        }
        if self.reordered.is_some() || self.differences.is_some_and(is_of_other_steps) {
            return Cause::OtherSteps;
        }
        if self.is_too_large_a_step() {
            return Cause::TimeStep;
        }
        let is_unknown = self.known_to >= UNKNOWN * self.energy_error;
        if self.moved < MOVED * self.energy_error {
            let is_rounded = self.differences.is_some_and(|[of_q, _]| of_q.correlation < ROUNDED);
            return match (is_unknown, is_rounded) {
                (false, _) => Cause::Nothing,
                (true, true) => Cause::Digits,
                (true, false) => self.of_forces(in_a_step),
            };
        }
        self.of_forces(in_a_step)
    }

    /// Whether the steps are too large whatever the forces are.
    pub(super) fn is_too_large_a_step(&self) -> bool {
        self.method_error >= KINETIC_LIMIT * self.kinetic
    }

    fn of_forces(&self, in_a_step: f64) -> Cause {
        let Some((Smoothness { gradient, exponent, differences }, excess)) = self.smoothness.zip(self.excess) else {
            return Cause::Undecided;
        };
        let [above, below] = EXCESS;
        let is_isolated = self.isolation > ISOLATED;
        if excess > above {
            let rms = |jumps: &[Jump]| {
                (jumps.iter().map(|jump| jump.energy * jump.energy).sum::<f64>() / jumps.len() as f64).sqrt()
            };
            return if is_isolated {
                Cause::Jumps { size: rms(&self.jumps) }
            } else if exponent >= smooth(self.window) {
                Cause::NotTheGradient
            } else {
                Cause::EnergyNotSmooth { size: in_a_step }
            };
        }
        let is_unresolved = differences >= unresolved(self.window) * gradient;
        match exponent {
            _ if excess.is_nan() || exponent.is_nan() => Cause::Undecided,
            ..NOISE if excess >= NOISE_EXCESS => Cause::Noise { size: differences },
            ..NOISE => Cause::Undecided,
            ..JUMPS if is_unresolved || excess >= JUMPS_EXCESS => Cause::Undecided,
            ..JUMPS => Cause::ForcesNotSmooth,
            _ if is_unresolved && excess < NOISE_EXCESS || excess <= below => Cause::TimeStep,
            _ if is_unresolved => Cause::Undecided,
            ..KINKS if excess < JUMPS_EXCESS => Cause::ForcesNotSmooth,
            _ => Cause::Undecided,
        }
    }
}

fn is_of_other_steps([of_q, of_p]: [Differences; 2]) -> bool {
    let differs = |of: Differences| of.of_increments > LARGEST_MISFIT && of.of_numbers > SINGLE;
    // momenta may be written with a few digits of the smallest
    differs(of_q) && (of_q.correlation > ROUNDED || of_q.of_numbers > COARSE)
        || differs(of_p) && of_p.correlation > ROUNDED
}
