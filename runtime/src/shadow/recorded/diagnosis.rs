//! The numbers that show what moves the energy of a recorded trajectory.

use super::cause::Cause;
use super::changes::Jump;
use super::misfit::Differences;
use super::roughness::Smoothness;
use super::units::Units;
use super::window::Window;

/// What moves the energy of a trajectory that another program has computed.
///
/// H̄ is constant but for what is not a step of the scheme in a smooth potential, so what it changes by is the size of
/// the cause. The energy error, max − min of H, contains the part H − H̄ of the method in addition, which oscillates.
/// Printed, it is a few lines with the numbers.
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
    /// Its median, which is not of a few last states that explode.
    pub usual_kinetic: f64,
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
    /// The median of the estimated errors of H̄; in windows of nine states with three times the scatter of H̄, the part
    /// that does not add up.
    pub known_to: f64,
    /// The time from the first estimate to the last.
    pub time: f64,
    /// How smooth the forces are; `None` where no gradients are logged.
    pub smoothness: Option<Smoothness>,
    /// How smooth the logged U is; `None` before the first estimate.
    pub energy_smoothness: Option<Smoothness>,
    /// What H̄ changes by in a step, rms, if what it does in one step and in another is independent.
    pub in_a_step: f64,
    /// The mean square of what H̄ changes by in a step, as a multiple of what errors of the forces would make that are
    /// independent from step to step and of the size of their differences, h²Σ(σv)²: 1 for noise of the forces.
    pub excess: Option<f64>,
    /// The mean square of what H̄ changes by over eight steps, or from window to window, divided by that over one step,
    /// each reduced to one step as if what it does in one step and in another were independent: 1 if it is, 2 and more
    /// where it changes slowly, small where it goes to and fro.
    pub growth: f64,
    /// The rms of what H̄ changes by from state to state, as a multiple of the rms of a normal distribution with the
    /// same median: 1 for noise, large where H̄ changes at few states only.
    pub isolation: f64,
    /// These states, with the largest change first.
    pub jumps: Vec<Jump>,
    /// By how much logged q and p differ from the steps; `None` where no gradients are logged.
    pub differences: Option<[Differences; 2]>,
    /// max − min of the work of these differences, Σ g·r_q + v·r_p over the steps: what H̄ changes by, if the states
    /// are from other steps.
    pub work: f64,
    /// The rms of the work g·r_q, and v·r_p, of a step, if the differences of the coordinates are independent, as those
    /// of rounded states are.
    pub work_in_a_step: [f64; 2],
    /// The first state whose coordinates are those of the step in another order, as where a file is not sorted by
    /// atoms.
    pub reordered: Option<i64>,
    /// What moves the energy.
    pub cause: Cause,
    pub(super) units: Units,
}

impl Diagnosis {
    /// The same, with texts in these units.
    #[must_use]
    pub fn in_units(self, units: Units) -> Diagnosis {
        Diagnosis { units, ..self }
    }
}
