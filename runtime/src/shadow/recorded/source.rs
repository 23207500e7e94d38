//! The states of a log as a source for estimators.

use super::error::RecordedError;
use super::judge::is_of_other_steps;
use super::log::Log;
use super::misfit::Differences;
use super::steps::LoggedSteps;
use super::text::other_steps;
use crate::shadow::run::{RunError, ShadowRun, States, TrajectoryState};
use crate::shadow::{BuildEstimator, Estimator};
use crate::steps::step_size::StepSize;

/// The states of a [`Log`] with the increments of the steps of velocity Verlet between them, n = 0, 1, ….
///
/// $$\Delta q = h M^{-1} \left( p_n - \tfrac h2 U_q(q_n) \right), \quad
/// \Delta p = -\tfrac h2 \left( U_q(q_n) + U_q(q_{n+1}) \right), \quad
/// \Delta\beta = \tfrac h2 \left( r_n + r_{n+1} \right), \quad r = q^{\mathsf T} U_q - 2U$$
///
/// (β by Moan & Niesen, eq. 2, whose printed sign is wrong). So the round-off of differences of logged states,
/// ε|q||p|/h in an energy, does not enter; by how much these differ from the increments is
/// [known](Recorded::differences). q is counted from the first state: a constant displacement of q is a canonical
/// transformation, and does not change H̄. Where rates are logged and no gradients, Δq and Δp are differences of
/// states, and q is as logged.
///
/// ```
/// use shadowstep::shadow::recorded::{Log, Recorded};
/// use shadowstep::{StepSize, shadow::Bilinear};
///
/// // what a program has logged of a pendulum, U = −cos q
/// let h = 0.1;
/// let (mut q, mut p) = (vec![1.0_f64], vec![0.0_f64]);
/// for n in 0..100 {
///     let half = p[n] - h / 2.0 * q[n].sin();
///     q.push(q[n] + h * half);
///     p.push(half - h / 2.0 * q[n + 1].sin());
/// }
/// let energies: Vec<f64> = q.iter().map(|q| -q.cos()).collect();
/// let gradients: Vec<f64> = q.iter().map(|q| q.sin()).collect();
///
/// let log = Log::with_gradients(1, [&q, &p, &gradients], &energies)?;
/// let h = StepSize::try_from(h)?;
/// let mut estimates = Recorded::new(log, &h, &[1.0])?.estimates(&h, &Bilinear::with_error(8))?;
/// let (mut modified, mut energy) = (Vec::new(), Vec::new());
/// while let Some((n, found)) = estimates.advance()? {
///     assert!(*found.error.unwrap() < 1e-12);
///     modified.push(*found.value);
///     energy.push(p[n as usize].powi(2) / 2.0 + energies[n as usize]);
/// }
/// let width = |values: &[f64]| values.iter().fold(f64::MIN, |a, b| a.max(*b)) - values.iter().fold(f64::MAX, |a, b| a.min(*b));
/// assert!(width(&energy) > 1e-4 && width(&modified) < 1e-12);
/// # Ok::<(), shadowstep::shadow::recorded::RecordedError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Recorded<'a> {
    log: Log<'a>,
    next: usize,
    steps: LoggedSteps,
}

impl<'a> Recorded<'a> {
    /// The states of a log of steps of size h, of coordinates with these masses.
    ///
    /// # Errors
    /// Masses that are not one for each coordinate, positive and finite; a logged number that is not finite.
    pub fn new(log: Log<'a>, h: &StepSize, masses: &[f64]) -> Result<Self, RecordedError> {
        let steps = LoggedSteps::new(h, masses)?;
        for (n, state) in (0..).map_while(|n| log.state(n)).enumerate() {
            steps.check(n as i64, &state)?;
        }
        Ok(Recorded { log, next: 0, steps })
    }

    /// The modified energies at the states, from the first one that has enough states before it.
    ///
    /// # Errors
    /// Settings of the estimator that are not valid.
    pub fn estimates<E: Estimator<f64>>(
        self,
        h: &StepSize,
        settings: &impl BuildEstimator<f64, Estimator = E>,
    ) -> Result<ShadowRun<Self, E>, RecordedError> {
        let estimator = settings.build(h, self.log.dimension(), &())?;
        Ok(ShadowRun::of(self, estimator, h))
    }

    /// By how much q and p of the states so far differ from the increments of steps; `None` before the first step, and
    /// where no gradients are logged.
    pub fn differences(&self) -> Option<[Differences; 2]> {
        self.steps.differences()
    }

    /// Why the states so far are not those of velocity Verlet with these masses, gradients and step size, a sentence;
    /// `None` if they are, or no gradients are logged. The rule is that of
    /// [`Cause::OtherSteps`](super::Cause::OtherSteps).
    pub fn other_steps(&self) -> Option<String> {
        let (reordered, differences) = (self.steps.reordered(), self.steps.differences());
        (reordered.is_some() || differences.is_some_and(is_of_other_steps)).then(|| other_steps(reordered, differences))
    }
}

impl States for Recorded<'_> {
    type Number = f64;

    fn advance(&mut self) -> Result<Option<TrajectoryState<'_, f64>>, RunError> {
        let Some(logged) = self.log.state(self.next) else { return Ok(None) };
        self.next += 1;
        self.steps.push(&logged)?;
        Ok(Some(self.steps.state()))
    }
}
