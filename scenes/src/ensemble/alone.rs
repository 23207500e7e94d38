//! Trajectories one by one: of systems that are not computed in lanes.

use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::thread;

use shadowstep::shadow::ensemble::Outcome;
use shadowstep::shadow::run::TrajectoryState;
use shadowstep::shadow::{BuildEstimator, Estimator, FixedBilinear};
use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep::{Carried, Integrator as _, VectorState};

use super::settings::Observed;
use crate::error::Error;
use crate::scene::Scene;

type EstimatorOf = <FixedBilinear as BuildEstimator<f64>>::Estimator;

/// The interruption is looked for after this number of steps.
const AT_ONCE: u64 = 128;

/// The outcomes of all trajectories in their order, whichever thread computes them.
pub(super) fn on_all_cores(
    trajectories: usize,
    one: impl Fn(usize) -> Result<Outcome, Error> + Sync,
) -> Result<Vec<Outcome>, Error> {
    let threads = thread::available_parallelism().map_or(1, NonZero::get).min(trajectories);
    let next = AtomicUsize::new(0);
    let work = || {
        let taken = std::iter::repeat_with(|| next.fetch_add(1, Relaxed)).take_while(|t| *t < trajectories);
        taken.map(|t| (t, one(t))).collect::<Vec<_>>()
    };
    let mut all = match threads {
        0 | 1 => work(),
        _ => thread::scope(|scope| {
            let threads: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
            let found = threads.into_iter().map(|thread| thread.join());
            found.flat_map(|found| found.unwrap_or_else(|panic| std::panic::resume_unwind(panic))).collect()
        }),
    };
    all.sort_by_key(|(t, _)| *t);
    all.into_iter().map(|(_, outcome)| outcome).collect()
}

/// What becomes of the trajectory of a scene; `continues` is asked now and then.
pub(super) fn outcome(scene: &Scene, observed: Observed, continues: &dyn Fn() -> bool) -> Result<Outcome, Error> {
    let mut integrator = scene.integrator::<f64>(&())?;
    let mut outcome = follow(&mut *integrator, scene.steps(), observed, continues)?;
    if let Some(mut shown) = scene.system.shown::<f64>(&()) {
        let (q, p) = shown.of_state(&outcome.q, &outcome.p);
        (outcome.q, outcome.p) = (q.to_vec(), p.to_vec());
    }
    Ok(outcome)
}

/// A trajectory from its beginning to its end.
fn follow(
    integrator: &mut VectorIntegrator<'_, f64>,
    steps: u64,
    Observed { every, modified_energy }: Observed,
    continues: &dyn Fn() -> bool,
) -> Result<Outcome, Error> {
    let dimension = integrator.system().massive_coordinates();
    let estimator = modified_energy.map(|k| FixedBilinear::new(k).build(integrator.step_size(), dimension, &()));
    let estimator = estimator.transpose();
    let estimator = estimator.map_err(|error| Error::usage(error.to_string(), "give another order"))?;
    let mut seen = Seen::new(at_output(integrator, |integrator| integrator.system().energy()), estimator);
    let mut window_end = 0;
    for n in 0..steps {
        if n % every == 0 {
            // the states from here on up to the end of the window go to the estimator
            window_end = seen.begin_window(integrator, n, window_end);
        }
        if n < window_end {
            integrator.step(Carried::Increments);
            seen.push(integrator);
        } else {
            integrator.step(Carried::Nothing);
        }
        let made = n + 1;
        if made % every == 0 || made == steps {
            at_output(integrator, |integrator| seen.look(integrator, made));
        }
        if made % AT_ONCE == 0 && !continues() {
            return Err(Error::run("the ensemble was interrupted", "run it again"));
        }
    }
    integrator.postprocess();
    Ok(seen.outcome(integrator.state()))
}

/// What is seen of a trajectory.
struct Seen {
    initial: f64,
    newest: f64,
    largest_error: f64,
    not_finite: Option<u64>,
    /// Without states, and with those of the present window.
    estimator: Option<EstimatorOf>,
    window: Option<EstimatorOf>,
    /// The least and the largest modified energy; NaN before the first one.
    modified: [f64; 2],
    /// The first and the newest.
    modified_ends: [f64; 2],
}

impl Seen {
    fn new(initial: f64, estimator: Option<EstimatorOf>) -> Self {
        let not_finite = (!initial.is_finite()).then_some(0);
        Seen {
            initial,
            newest: initial,
            largest_error: 0.0,
            not_finite,
            estimator,
            window: None,
            modified: [f64::NAN; 2],
            modified_ends: [f64::NAN; 2],
        }
    }

    /// Looks at the state after n steps.
    fn look(&mut self, integrator: &mut VectorIntegrator<'_, f64>, n: u64) {
        let energy = integrator.system().energy();
        self.newest = energy;
        let state = integrator.state();
        let is_finite = energy.is_finite() && state.q().iter().chain(state.p()).all(|x| x.is_finite());
        if self.not_finite.is_none() && !is_finite {
            self.not_finite = Some(n);
        }
        if self.not_finite.is_none() {
            self.largest_error = self.largest_error.max((energy - self.initial).abs());
        }
    }

    /// A window of states for the modified energy begins at the present one, or the present window goes on; the n at which it ends.
    fn begin_window(&mut self, integrator: &mut VectorIntegrator<'_, f64>, n: u64, window_end: u64) -> u64 {
        let Some(estimator) = &self.estimator else { return 0 };
        let states = estimator.states() as u64;
        if n >= window_end {
            self.window = Some(estimator.clone());
            self.push(integrator);
        }
        n + states - 1
    }

    fn push(&mut self, integrator: &mut VectorIntegrator<'_, f64>) {
        let Some(window) = &mut self.window else { return };
        let TrajectoryState { q, p, increments, .. } = TrajectoryState::massive(integrator.system(), 0);
        let Some(estimate) = window.push(q, p, increments) else { return };
        self.modified_ends[1] = *estimate.value;
        if estimate.value.is_finite() {
            if self.modified_ends[0].is_nan() {
                self.modified_ends[0] = *estimate.value;
            }
            // `min` and `max` ignore NaN
            self.modified = [self.modified[0].min(*estimate.value), self.modified[1].max(*estimate.value)];
        }
    }

    fn outcome(&self, state: &VectorState<f64>) -> Outcome {
        let drift = self.modified[1] - self.modified[0];
        let drift = Some(drift).filter(|drift| drift.is_finite());
        let ends = |[first, last]: [f64; 2]| [first, if self.not_finite.is_none() { last } else { f64::NAN }];
        Outcome {
            q: state.q().to_vec(),
            p: state.p().to_vec(),
            energies: ends([self.initial, self.newest]),
            energy_error: self.largest_error / self.initial.abs(),
            modified_drift: drift,
            modified_energies: drift.map(|_| ends(self.modified_ends)),
            not_finite: self.not_finite,
        }
    }
}
