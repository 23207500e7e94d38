//! What is measured along one run.

use std::cell::Cell;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};
use shadowstep::number::{AnyLimbs, LimbCount, Number, Real};
use shadowstep::shadow::exact_flow::ExactFlow;
use shadowstep::shadow::run::{Finding, RunError, ShadowRun, States, Trajectory};
use shadowstep::shadow::{BuildEstimator, Estimate, Estimator, EstimatorSettings};
use shadowstep::{Integrator as _, Rational};
use shadowstep_scenes::propagator::{Propagator, motion, stepper};
use shadowstep_scenes::run::Run as Steps;

use crate::Error;
use crate::figures::escape::Escape;
use crate::figures::run::Run;
use crate::figures::states::{Interruptible, Recorded};

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Drift {
    pub(crate) drift: String,
    /// None where the estimator gives no errors.
    pub(crate) permanent: Option<Permanent>,
    pub(crate) orders: (u32, u32),
}

/// The permanent change of the modified energy: that between states with small estimated errors.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Permanent {
    pub(crate) change: String,
    pub(crate) largest_jump: String,
    /// The change is resolved if it exceeds this.
    pub(crate) resolution: String,
    pub(crate) resolved: bool,
}

/// One value a step, or between the steps.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Energies {
    pub(crate) times: Vec<f64>,
    /// |q|
    pub(crate) distances: Vec<f64>,
    pub(crate) values: Vec<String>,
    pub(crate) orders: Vec<u32>,
    /// log₁₀ of the estimated errors and of the last terms; none of 0, and where none is known.
    pub(crate) errors: Vec<Option<f64>>,
    pub(crate) last_terms: Vec<Option<f64>>,
}

/// The positions of a body in the plane.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Orbit {
    pub(crate) x: Vec<f64>,
    pub(crate) y: Vec<f64>,
}

/// The numbers in which errors are summed.
const TWO_LIMBS: LimbCount = LimbCount::of_bits(128).expect("two limbs");

/// How often, at most, a computation asks whether it is to continue.
const OFTEN: Duration = Duration::from_millis(50);

/// Estimates along states of any source.
type Estimates<'a> = ShadowRun<&'a mut dyn States<Number = AnyLimbs>, Box<dyn Estimator<AnyLimbs>>>;

/// A run that is measured.
pub(crate) struct Measure<'a> {
    pub(crate) run: &'a Run,
    /// The states of the exact flow, if it is used.
    pub(crate) flow: Option<&'a Recorded>,
    /// Gets the part that is done, from 0 to 1; returns whether to continue.
    pub(crate) continues: &'a dyn Fn(f64) -> bool,
}

impl Measure<'_> {
    pub(crate) fn drift(&self, settings: &EstimatorSettings) -> Result<Drift, Error> {
        let found = self.with_estimates(settings, &mut |mut estimates| estimates.drift())?;
        let permanent = found.permanent.map(|permanent| Permanent {
            change: permanent.change.to_text(),
            largest_jump: permanent.largest_jump.to_text(),
            resolution: permanent.resolution.to_text(),
            resolved: permanent.finding == Finding::Resolved,
        });
        Ok(Drift { drift: found.drift.to_text(), permanent, orders: found.orders })
    }

    pub(crate) fn energies(&self, settings: &EstimatorSettings) -> Result<Energies, Error> {
        let h = self.run.h();
        self.with_estimates(settings, &mut |mut estimates| {
            let mut all = Energies::default();
            while let Some((n, estimate)) = estimates.advance()? {
                all.include(time_of_value(h.exact(), n, settings), &estimate);
            }
            Ok(all)
        })
    }

    pub(crate) fn orbit(&self) -> Result<Orbit, Error> {
        let mut orbit = Orbit::default();
        self.states(|q, _| {
            orbit.x.push(q[0].to_f64());
            orbit.y.push(q[1].to_f64());
        })?;
        Ok(orbit)
    }

    pub(crate) fn escape(&self) -> Result<Escape, Error> {
        let h = f64::from_rational(self.run.h().exact(), &());
        let mut escape = Escape::default();
        let mut n = 0_u32;
        self.states(|q, p| {
            let numbers = |vector: &[AnyLimbs]| [vector[0].to_f64(), vector[1].to_f64()];
            escape.include(f64::from(n) * h, h, numbers(q), numbers(p));
            n += 1;
        })?;
        Ok(escape)
    }

    /// The largest |q − q of the exact flow|.
    pub(crate) fn coordinate_error(&self) -> Result<String, Error> {
        let mut exact = self.flow.expect("its exact flow is recorded").states(0);
        let mut largest = AnyLimbs::zero(TWO_LIMBS);
        self.states(|q, _| {
            let Ok(Some(state)) = exact.advance() else { return };
            let mut square = AnyLimbs::zero(TWO_LIMBS);
            for (q, exact) in q.iter().zip(state.q) {
                let mut difference = *q;
                difference -= exact;
                let difference = difference.resized(TWO_LIMBS);
                square.add_product(&difference, &difference);
            }
            largest.make_at_least(&square.sqrt());
        })?;
        Ok(largest.to_text())
    }

    /// H at the end less H at the start.
    pub(crate) fn transit(&self) -> Result<String, Error> {
        let mut system = motion(&self.run.setup(), &self.run.limbs());
        let first = system.energy();
        let (q, p) = self.states(|_, _| ())?;
        let mut change = system.energy_at(&q, &p);
        change -= &first;
        Ok(change.to_text())
    }

    /// The states of the exact flow, with `reach` of them before 0 and after the end.
    pub(crate) fn recorded(&self, reach: usize) -> Result<Recorded, Error> {
        self.with_states(reach, &mut |states| Recorded::of(states, reach))
    }

    /// Gives the estimates along the run to `measure`.
    fn with_estimates<T>(
        &self,
        settings: &EstimatorSettings,
        measure: &mut dyn FnMut(Estimates<'_>) -> Result<T, RunError>,
    ) -> Result<T, Error> {
        let (h, context) = (self.run.h(), self.run.limbs());
        let estimator = BuildEstimator::<AnyLimbs>::build(settings, &h, self.run.dimension(), &context);
        let mut estimator = Some(estimator.expect("figures have valid orders"));
        let reach = (estimator.as_ref().map_or(1, |estimator| estimator.states()) - 1) / 2;
        self.with_states(reach, &mut |states| {
            let estimator = estimator.take().expect("the states are given once");
            measure(ShadowRun::of(states, estimator, &h))
        })
    }

    /// Gives the states n = −reach, …, steps + reach to `measure`.
    fn with_states<T>(
        &self,
        reach: usize,
        measure: &mut dyn FnMut(&mut dyn States<Number = AnyLimbs>) -> Result<T, RunError>,
    ) -> Result<T, Error> {
        let (run, setup, h) = (self.run, self.run.setup(), self.run.h());
        let steps =
            Steps { propagator: &run.propagator, h: &h, steps: run.steps(), order: None, windows: Steps::WINDOWS };
        let failed = |error| steps.failed(&error);
        let watch = |from: i64| self.watch(from, run.steps() as f64 + reach as f64);
        let limbs = run.limbs();
        if let Some(flow) = self.flow {
            return measure(&mut Interruptible { states: flow.states(reach), continues: watch(-(reach as i64)) })
                .map_err(failed);
        }
        let propagator = Propagator::read(&run.propagator, &setup)?;
        let Some(scheme) = propagator.scheme() else {
            let states = ExactFlow::<AnyLimbs>::new(&setup, &self.run.h(), run.steps(), reach, &limbs);
            let states = states.map_err(|error| steps.not_followed(&error))?;
            return measure(&mut Interruptible { states, continues: watch(-(reach as i64)) }).map_err(failed);
        };
        let stepper = stepper(scheme, steps, &limbs);
        let start = motion(&setup, &limbs);
        let states = Trajectory::new(stepper.with(start), run.steps(), reach).map_err(failed)?;
        measure(&mut Interruptible { states, continues: watch(-(reach as i64)) }).map_err(failed)
    }

    /// Asks whether to continue, but not at every state from this one to the last.
    fn watch(&self, from: i64, last: f64) -> impl FnMut(i64) -> bool + '_ {
        let asked = Cell::new(Instant::now());
        move |n| {
            if asked.get().elapsed() < OFTEN {
                return true;
            }
            asked.set(Instant::now());
            (self.continues)((n - from) as f64 / (last - from as f64))
        }
    }

    /// Gives q and p of each state of a scheme to `take`, without increments; returns the last q and p.
    fn states(&self, mut take: impl FnMut(&[AnyLimbs], &[AnyLimbs])) -> Result<(Vec<AnyLimbs>, Vec<AnyLimbs>), Error> {
        let (run, setup, h) = (self.run, self.run.setup(), self.run.h());
        let steps =
            Steps { propagator: &run.propagator, h: &h, steps: run.steps(), order: None, windows: Steps::WINDOWS };
        let failed = |error| steps.failed(&error);
        let propagator = Propagator::read(&run.propagator, &setup)?;
        let stepper = stepper(propagator.scheme().expect("it is a scheme"), steps, &run.limbs());
        let start = motion(&setup, &run.limbs());
        let states = Trajectory::plain(stepper.with(start), 0, run.steps()).map_err(failed)?;
        let mut states = Interruptible { states, continues: self.watch(0, run.steps() as f64) };
        while let Some(state) = states.advance().map_err(failed)? {
            take(state.q, state.p);
        }
        let integrator = &*states.states.integrator();
        let state = integrator.state();
        Ok((state.q().to_vec(), state.p().to_vec()))
    }
}

/// The time of the n-th value: n h, or (n + 1/2) h where values belong to the middle between states.
fn time_of_value(h: &Rational, n: i64, settings: &EstimatorSettings) -> f64 {
    let halves = 2 * n + i64::from(settings.is_between());
    f64::from_rational(&(h * Rational::new(halves.into(), 2.into())), &())
}

impl Energies {
    fn include(&mut self, time: f64, estimate: &Estimate<'_, AnyLimbs>) {
        let size = |number: Option<&AnyLimbs>| number.map(Real::log10_abs).filter(|size| size.is_finite());
        self.times.push(time);
        self.distances.push(estimate.q.iter().map(|q| q.to_f64().powi(2)).sum::<f64>().sqrt());
        self.values.push(estimate.value.to_text());
        self.orders.push(estimate.order);
        self.errors.push(size(estimate.error));
        self.last_terms.push(size(estimate.last_term));
    }
}
