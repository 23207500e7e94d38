//! What moves the energy of a recorded trajectory.

/// What moves the modified energy. The first that applies is given:
///
/// 1. **not decided: states**: there are fewer than 32 estimates with errors.
/// 1. **other steps**: the order of the coordinates changes; or q or p of the states differ from the steps by more than
///    1e-3 of their increments, rms, and not as numbers that are stored with few digits, which are off by less than
///    1e-2 of q.
/// 1. **time step**: the method's part of the energy error is 0.4 of the median of the kinetic energy or more, as for
///    the [monitor](crate::shadow::ShadowEnergy).
/// 1. **nothing**: H̄ moved by less than a tenth of the energy error, beyond three times its errors, is known to a
///    tenth of it, and ranges over less than a quarter of it with its errors; from 0.02 of it on also the motion is
///    resolved, and H̄ does not go to and fro.
/// 1. **digits**: else, if it moved by less than that, and q or p differs from the steps as numbers that are stored
///    with few digits, by so much that it makes errors of this size.
/// 1. **not decided: means**: else, if it would be nothing but for that: estimates are means over nine states, in which
///    what U jumps by, or forces that are not −U_q, may cancel.
/// 1. **noisy energy**: else, if it moved by less than that and goes to and fro, the motion is resolved, the exponent
///    of U is below 0.5, and its differences are above 2.2 of what H̄ changes by in a step.
/// 1. **other steps**: else, if the work of the differences of the states from the steps is what H̄ ranges over, within
///    a factor of three, and these are not those of rounded numbers.
/// 1. **not decided: jumps**: the isolation is above 3, and the energy error is 0.4 of the kinetic energy or more.
/// 1. **jumps**: the excess is above 8, the isolation above 5.
/// 1. **not the gradient**: the excess is above 8, the isolation 3 at most, and the differences of U are below 0.15 of
///    what H̄ changes by in a step.
/// 1. **energy not smooth**: the same, but the exponent of U is below 2, the motion is resolved, and H̄ does not go to
///    and fro.
/// 1. **not the gradient**: the same, but the exponent of U is 4 or more, and H̄ changes slowly.
/// 1. **noise**: the exponent is below 0.25, the excess from 0.5 to 8, and H̄ changes independently from step to step.
/// 1. **not the gradient**: the exponent is 4 or more, and H̄ changes slowly and the motion is resolved, or the growth
///    is 2.1 (4.5) or more and the excess 0.05 or more.
/// 1. **forces not smooth**: the exponent is from 0.75 to 4, the excess from 0.03 to 0.6 (0.5 in windows of nine
///    states), the isolation below 2, and the motion is resolved.
/// 1. **time step**: H̄ moved, the exponent is 2 or more, the excess below 0.05, and H̄ goes to and fro and the
///    differences of the forces are above 0.1 of these (0.15 in windows of nine states), or the isolation is above 3
///    and they are above 0.15 (0.25).
/// 1. **not decided**: none of these, or no gradients are logged.
///
/// The motion is resolved if the differences of the forces are below 0.01 of these (0.05 in windows of nine states). H̄
/// goes to and fro where the growth is below 0.7 (0.4), and changes slowly where it is 1.6 or more (4) and the
/// isolation below 2; between these it changes independently from step to step.
///
/// The excess, the growth, the isolation and the exponents are defined at [`Diagnosis`](super::Diagnosis);
/// `docs/recorded-trajectories.md` has measured values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cause {
    /// The states are not from velocity Verlet with these masses, gradients and step size: a thermostat, a constraint,
    /// another integrator.
    OtherSteps,
    /// Nothing that is resolved: H̄ is conserved.
    Nothing,
    /// The states are stored with too few digits to know H̄.
    Digits,
    /// The logged U has errors that are independent from state to state and do not add up.
    NoisyEnergy {
        /// Their root mean square.
        size: f64,
    },
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
        self.words().0
    }

    /// Its name, and what it says.
    pub(super) fn words(self) -> (&'static str, &'static str) {
        match self {
            Cause::OtherSteps => ("other-steps", "other steps"),
            Cause::Nothing => ("nothing", "nothing moves the energy"),
            Cause::Digits => ("digits", "too few digits"),
            Cause::NoisyEnergy { .. } => ("noisy-energy", "noise of the logged U"),
            Cause::Jumps { .. } => ("jumps", "jumps"),
            Cause::NotTheGradient => ("not-the-gradient", "not the gradient"),
            Cause::EnergyNotSmooth { .. } => ("energy-not-smooth", "the energy is not smooth"),
            Cause::Noise { .. } => ("noise", "noise of the forces"),
            Cause::ForcesNotSmooth => ("forces-not-smooth", "the forces are not smooth"),
            Cause::TimeStep => ("time-step", "the time step"),
            Cause::Undecided => ("undecided", "not decided"),
        }
    }

    /// For noise of the forces, its size in these; for jumps and noise of U, the size in the energy.
    pub fn size(self) -> Option<f64> {
        match self {
            Cause::Jumps { size }
            | Cause::EnergyNotSmooth { size }
            | Cause::Noise { size }
            | Cause::NoisyEnergy { size } => Some(size),
            _ => None,
        }
    }
}
