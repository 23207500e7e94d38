//! States with their modified energies.

use std::collections::VecDeque;

use crate::number::Real;
use crate::shadow::run::error::{Quantity, RunError, check_value};
use crate::shadow::run::state::{States, TrajectoryState};
use crate::shadow::run::trajectory::Trajectory;
use crate::shadow::{BuildEstimator, Estimate, Estimator};
use crate::steps::integrator::Integrator;
use crate::steps::step_size::StepSize;

/// An estimate and its n: the state n, or the middle between it and the next one.
pub(crate) type Estimated<'a, N> = (i64, Estimate<'a, N>);

/// The same with the source of states.
type EstimatedAlong<'a, T> = (Estimated<'a, <T as States>::Number>, &'a mut T);

/// States with the modified energies of n = 0, …, steps, or between them.
pub struct ShadowRun<T: States, E> {
    states: T,
    estimator: E,
    h: StepSize,
    reach: i64,
    /// How many states after the n of an estimate it needs: as many, or one more where it belongs to n + 1/2.
    after: i64,
    /// How many states must still come before the one that completes the first estimate.
    missing: usize,
    /// Of how many coordinates the modified energy is: the first ones.
    massive: usize,
    /// Positions and momenta of the coordinates after these, from the state of the next estimate on.
    particles: VecDeque<[Vec<T::Number>; 2]>,
}

impl<I: Integrator<Number: Real>, E: Estimator<I::Number>> ShadowRun<Trajectory<I>, E> {
    /// Begins at the system's present state; makes the states before it that the estimator needs.
    ///
    /// # Errors
    /// As [`Trajectory::new`]; settings of the estimator that are not valid.
    pub fn new(
        integrator: I,
        steps: u64,
        settings: &impl BuildEstimator<I::Number, Estimator = E>,
    ) -> Result<Self, RunError> {
        let mut run = Self::resume(integrator, 0, steps, settings)?;
        run.states.step_back(run.reach as usize)?;
        Ok(run)
    }

    /// Resumes a run: the estimates of n = `from` + reach + 1, …, steps, with the bits of the run from 0.
    ///
    /// The system is at the state `from` of that run. An estimate depends only on the states n − reach, …, n + reach
    /// and the increments between them. States after 0 are all made by steps forward; those before 0 are not, so the
    /// estimates of n ≤ reach cannot be computed this way.
    ///
    /// # Errors
    /// An energy at `from` that is not finite; settings of the estimator that are not valid.
    pub fn resume(
        mut integrator: I,
        from: i64,
        steps: u64,
        settings: &impl BuildEstimator<I::Number, Estimator = E>,
    ) -> Result<Self, RunError> {
        let (h, dimension) = (integrator.step_size().clone(), integrator.system().massive_coordinates());
        let estimator = settings.build(&h, dimension, &integrator.state().context())?;
        let mut run = ShadowRun::of(Trajectory::after(integrator, from)?, estimator, &h);
        run.massive = dimension;
        run.states.extend(steps, run.reach as usize);
        Ok(run)
    }

    /// The system with its stepper, for energies and counts.
    pub fn integrator(&mut self) -> &mut I {
        self.states.integrator()
    }
}

impl<T: States, E: Estimator<T::Number>> ShadowRun<T, E> {
    /// The estimates along states of any source with the step size h, recorded ones for example.
    ///
    /// The states begin as many before the first estimate as the estimator needs, which is [`reach`](ShadowRun::reach):
    /// (`states()` − 1)/2, rounded down.
    pub fn of(states: T, estimator: E, h: &StepSize) -> Self {
        let missing = estimator.states() - 1;
        let reach = missing / 2;
        ShadowRun {
            states,
            estimator,
            h: h.clone(),
            reach: reach as i64,
            after: (missing - reach) as i64,
            missing,
            massive: usize::MAX,
            particles: VecDeque::new(),
        }
    }

    /// Whether the states are from [compensated](crate::State::is_compensated) sums.
    pub(crate) fn is_compensated(&self) -> bool {
        self.states.is_compensated()
    }

    /// The step size.
    pub fn step_size(&self) -> &StepSize {
        &self.h
    }

    /// How many states before 0, and after the last one, the estimator needs.
    pub fn reach(&self) -> i64 {
        self.reach
    }

    /// Whether the estimates belong to the times between the states, (n + 1/2)h, n = 0, …, steps − 1.
    pub fn is_between(&self) -> bool {
        self.after > self.reach
    }

    /// The next n with its estimate, of the state n or of the middle between it and the next one; `None` after the
    /// last.
    ///
    /// # Errors
    /// A state that is not finite, up to the last one that the estimator needs, or a modified energy that is not.
    pub fn advance(&mut self) -> Result<Option<Estimated<'_, T::Number>>, RunError> {
        Ok(self.advance_with(|_, _| ())?.map(|(estimated, _)| estimated))
    }

    /// As [`advance`](Self::advance), and calls `watch` with the n of each state on the way and the source of states,
    /// which is there: those before and after the run, which only the estimator needs, included. Returns the source of
    /// states, too.
    ///
    /// # Errors
    /// As [`advance`](Self::advance).
    pub fn advance_with(
        &mut self,
        mut watch: impl FnMut(i64, &mut T),
    ) -> Result<Option<EstimatedAlong<'_, T>>, RunError> {
        loop {
            let Some(state) = self.states.advance()? else { return Ok(None) };
            let massive = self.massive.min(state.q.len());
            if massive < state.q.len() {
                let recent = self.particles.len() as i64 > self.after;
                let mut kept = recent.then(|| self.particles.pop_front()).flatten().unwrap_or_default();
                for (kept, all) in kept.iter_mut().zip([state.q, state.p]) {
                    kept.clear();
                    kept.extend_from_slice(&all[massive..]);
                }
                self.particles.push_back(kept);
            }
            let TrajectoryState { n, q, p, increments } = state.of_first(massive);
            if self.missing > 0 {
                self.missing -= 1;
                self.estimator.push(q, p, increments);
                watch(n, &mut self.states);
                continue;
            }
            let estimate = self.estimator.push(q, p, increments);
            watch(n, &mut self.states);
            let Some(estimate) = estimate else { return Ok(None) };
            let n = n - self.after;
            check_value(estimate.value, Quantity::ModifiedEnergy, n)?;
            let particles = self.particles.front().map_or((&[][..], &[][..]), |[q, p]| (q, p));
            return Ok(Some(((n, Estimate { particles, ..estimate }), &mut self.states)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shadow::{Central, SelectionRule, StoppingRule};
    use crate::steps::stepper::Stepper;
    use crate::steps::tables::{TableScheme, shipped};
    use crate::systems::kinetic::UnitMasses;
    use crate::systems::motion::Motion;
    use crate::systems::problems::Kepler;

    type Comet = Motion<f64, Vec<f64>, Kepler, UnitMasses>;

    fn motion(q: &[f64], p: &[f64]) -> Comet {
        Motion::new(Kepler, UnitMasses, q.to_vec(), p.to_vec()).unwrap()
    }

    fn start() -> Comet {
        motion(&[0.4, 0.0], &[0.0, 2.0])
    }

    /// n, value, error and m.
    type Owned = (i64, f64, Option<f64>, u32);

    fn estimates<E: Estimator<f64>>(mut run: ShadowRun<impl States<Number = f64>, E>) -> Vec<Owned> {
        let mut all = Vec::new();
        while let Some((n, found)) = run.advance().unwrap() {
            all.push((n, *found.value, found.error.copied(), found.order));
        }
        all
    }

    /// q and p of the states from 0 on.
    fn states(stepper: &Stepper<TableScheme, f64>, steps: u64) -> Vec<(Vec<f64>, Vec<f64>)> {
        let mut trajectory = Trajectory::plain(stepper.with(start()), 0, steps).unwrap();
        let mut states = Vec::new();
        while let Some(TrajectoryState { q, p, .. }) = trajectory.advance().unwrap() {
            states.push((q.to_vec(), p.to_vec()));
        }
        states
    }

    #[test]
    fn resumed_modified_energies_are_the_same() {
        let all_settings = [
            Central::fixed_with_error(4),
            Central::fixed(1),
            Central::best(9, StoppingRule::Full),
            Central::best(20, StoppingRule::Early),
            Central::best_with_error(9, StoppingRule::Full, SelectionRule::Robust),
        ];
        for name in ["stormer-verlet", "yoshida4", "ruth3"] {
            let stepper = Stepper::new(shipped(name).unwrap(), "1/20").unwrap();
            let states = states(&stepper, 60);
            for settings in &all_settings {
                let run = ShadowRun::new(stepper.with(start()), 60, settings).unwrap();
                let reach = run.reach() as usize;
                let all = estimates(run);
                assert_eq!(all.len(), 61);
                for from in [0, 1, 17, 59] {
                    let system = motion(&states[from].0, &states[from].1);
                    let run = ShadowRun::resume(stepper.with(system), from as i64, 60, settings).unwrap();
                    let expected = all.get(from + reach + 1..).unwrap_or_default();
                    assert_eq!(estimates(run), expected, "{name}, {settings:?}, from {from}");
                }
            }
        }
    }
}
