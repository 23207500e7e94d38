//! States of another program, with the steps between them made again.

use super::error::RecordedError;
use super::misfit::{Differences, Misfit};
use crate::shadow::run::{RunError, ShadowRun, States, TrajectoryState};
use crate::shadow::{BuildEstimator, Estimator};
use crate::steps::integrator::Integrator;
use crate::systems::increments::{Carried, Increments};

/// The states q, p that another program has computed by a scheme, n = 0, 1, …: from each the step is made again by the
/// same scheme, which gives its increments of q, p and β.
///
/// It is for every scheme and system, where [`Recorded`](super::Recorded) is for velocity Verlet; and it needs the
/// system, with its potential, where that needs what was logged. By how much the ends of the steps differ from the next
/// logged states is [known](Repeated::differences).
///
/// ```
/// use shadowstep::shadow::recorded::Repeated;
/// use shadowstep::tables::{Source, read};
/// use shadowstep::{Motion, Stepper, UnitMasses, problems::Pendulum, shadow::Bilinear};
///
/// // what a program has computed by position Verlet: half a drift, a kick, half a drift
/// let h = 0.1;
/// let (mut q, mut p) = (vec![1.0_f64], vec![0.0_f64]);
/// for n in 0..100 {
///     let middle = q[n] + h / 2.0 * p[n];
///     p.push(p[n] - h * middle.sin());
///     q.push(middle + h / 2.0 * p[n + 1]);
/// }
///
/// let text = r#"
/// name = "position-verlet"
/// order = 2
/// kinetic = "any"
/// reference = "L. Verlet, Phys. Rev. 159 (1967) 98-103"
///
/// [stages]
/// kick  = [0, 1]
/// drift = ["1/2", "1/2"]
/// "#;
/// let source = Source { path: "position-verlet.toml".to_owned(), text: text.to_owned() };
/// let stepper = Stepper::new(read(&source, &|_, _| None, None).unwrap(), h)?;
/// let pendulum = Motion::new(Pendulum, UnitMasses, vec![0.0], vec![0.0])?;
/// let mut estimates = Repeated::new(stepper.with(pendulum), &q, &p)?.estimates(&Bilinear::with_error(8))?;
/// let mut modified = Vec::new();
/// while let Some((_, found)) = estimates.advance()? {
///     modified.push(*found.value);
/// }
/// assert!(modified.iter().all(|value| (value - modified[0]).abs() < 1e-12)); // the energy varies by 1e-4
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Repeated<'a, I> {
    integrator: I,
    q: &'a [f64],
    p: &'a [f64],
    next: usize,
    misfits: [Misfit; 2],
}

impl<'a, I: Integrator<Number = f64>> Repeated<'a, I> {
    /// States q and p, of each as many numbers as the system has coordinates, one after the other. The present state of
    /// the system has no effect.
    ///
    /// # Errors
    /// Arrays that are not of as many states; steps that do not suit the system: see [`Integrator::check`].
    pub fn new(integrator: I, q: &'a [f64], p: &'a [f64]) -> Result<Self, RecordedError> {
        integrator.check().map_err(RunError::from)?;
        let columns = integrator.state().q().len();
        let rows = q.len() / columns;
        for (name, found) in [("q", q.len()), ("p", p.len())] {
            if found != rows * columns {
                return Err(RecordedError::Shape { name, found, rows, columns });
            }
        }
        Ok(Repeated { integrator, q, p, next: 0, misfits: [Misfit::new(columns), Misfit::new(columns)] })
    }

    /// The modified energies at the states, from the first one that has enough states before it.
    ///
    /// # Errors
    /// Settings of the estimator that are not valid.
    pub fn estimates<E: Estimator<f64>>(
        self,
        settings: &impl BuildEstimator<f64, Estimator = E>,
    ) -> Result<ShadowRun<Self, E>, RecordedError> {
        let h = self.integrator.step_size().clone();
        let estimator = settings.build(&h, self.integrator.state().q().len(), &())?;
        Ok(ShadowRun::of(self, estimator, &h))
    }

    /// By how much q and p of the states so far differ from the increments of the steps to them; `None` before the
    /// first step.
    pub fn differences(&self) -> Option<[Differences; 2]> {
        let [of_q, of_p] = &self.misfits;
        Some([of_q.found()?, of_p.found()?])
    }
}

impl<'a, I: Integrator<Number = f64>> States for Repeated<'a, I> {
    type Number = f64;

    fn advance(&mut self) -> Result<Option<TrajectoryState<'_, f64>>, RunError> {
        let (n, dimension) = (self.next, self.integrator.state().q().len());
        let row = |numbers: &'a [f64], n: usize| numbers.get(n * dimension..(n + 1) * dimension);
        let Some((q, p)) = row(self.q, n).zip(row(self.p, n)) else { return Ok(None) };
        self.next += 1;
        let before = n.checked_sub(1).and_then(|before| row(self.q, before).zip(row(self.p, before)));
        let increments = match before {
            Some((q_before, p_before)) => {
                self.integrator.system().state_mut().set(q_before, p_before);
                self.integrator.step(Carried::Increments);
                let increments = self.integrator.state().increments();
                let [of_q, of_p] = &mut self.misfits;
                of_q.add_step(n as i64, [q_before, q], increments.q);
                of_p.add_step(n as i64, [p_before, p], increments.p);
                increments
            }
            None => Increments::of_beta(&0.0),
        };
        let state = TrajectoryState { n: n as i64, q, p, increments };
        state.check()?;
        Ok(Some(state))
    }
}
