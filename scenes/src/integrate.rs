//! A run into memory: states at equal intervals of steps, with their energies and modified energies.
//!
//! ```
//! use shadowstep::StepSize;
//! use shadowstep::tables::Source;
//! use shadowstep_scenes::arithmetic::Arithmetic;
//! use shadowstep_scenes::integrate::{Integration, KeptStates};
//! use shadowstep_scenes::propagator::for_system;
//! use shadowstep_scenes::run::Run;
//! use shadowstep_scenes::{System, library};
//!
//! let text = "[problem]\nname = \"kepler\"".to_owned();
//! let (system, _) = System::read(&Source { path: "kepler".to_owned(), text }, Arithmetic::DOUBLE)?;
//! let scheme = for_system(library::scheme("yoshida4")?, &system)?;
//! let h = StepSize::try_from("1/20").unwrap();
//! let run = Run { propagator: &scheme.name, h: &h, steps: 1000, order: None, windows: Run::WINDOWS };
//! let integration =
//!     Integration { system: &system, scheme: &scheme.scheme, run, compensated: false, displaced: false, until: None, ends: None, kept: KeptStates::Every(100),
//!     estimator: None };
//! let samples = integration.run::<f64>(&(), &mut ())?;
//! assert_eq!(samples.n, (0..=10).map(|i| 100 * i).collect::<Vec<_>>());
//! assert!(samples.energy.iter().all(|energy| (energy + 0.5).abs() < 1e-3));
//! # Ok::<(), shadowstep_scenes::Error>(())
//! ```

use std::ops::ControlFlow;

use shadowstep::Carried;
use shadowstep::Rational;
use shadowstep::shadow::run::{NotFinite, Quantity, RunError};
use shadowstep::shadow::{Estimate, EstimatorSettings};
use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep::systems::system::Visitor;
use shadowstep::tables::{AtRunTime, TableScheme};

use crate::computation::RunNumber;
use crate::crossings::{Crossings, NEEDS_PARTS_OF_STEPS};
use crate::error::Error;
use crate::expression::Condition;
use crate::follow::Follower;
use crate::observer::{Observer, report};
use crate::pace::Pace;
use crate::physical_end::{Ends, find_end, last_step};
use crate::run::Run;
use crate::scene::split::ShownCoordinates;
use crate::scene::{self, EnergyAt};
use crate::start::{Begin, Steps};
use crate::steps::{End, MOST_STEPS};
use crate::watch::{Approaches, Energies, Interactions, Watch};

/// A run whose states are kept.
#[derive(Clone, Copy)]
pub struct Integration<'a> {
    /// H and the initial state.
    pub system: &'a scene::System,
    /// The scheme, valid for the [system](crate::propagator::for_system).
    pub scheme: &'a TableScheme<AtRunTime>,
    /// The steps.
    pub run: Run<'a>,
    /// Whether q and p are sums with remainders.
    pub compensated: bool,
    /// Whether gradient kicks are by displaced forces, which the scheme must [allow](crate::library::check_displaced).
    pub displaced: bool,
    /// The physical time at which the run ends, where time is transformed: after whole steps up to then it makes one of the exact remainder. The number of
    /// steps of the run is then not used.
    pub until: Option<&'a Rational>,
    /// The condition that ends the run before, checked for the system.
    pub ends: Option<&'a Condition>,
    /// Which states are kept.
    pub kept: KeptStates<'a>,
    /// The estimator of the modified energy, if that is wanted; crossings have none.
    pub estimator: Option<&'a EstimatorSettings>,
}

/// Which states of a run are kept.
#[derive(Clone, Copy, Debug)]
pub enum KeptStates<'a> {
    /// The states n = 0, m, 2m, …, and the last one.
    Every(u64),
    /// Where the trajectory crosses a surface that was [checked](scene::System::section) for the system: each is a part of a step after the state n.
    Crossings(&'a scene::Surface),
}

/// The states of a run.
#[derive(Clone, Debug, Default)]
pub struct Samples<N> {
    /// The numbers of the states: t = n h; of a crossing that of the state before.
    pub n: Vec<i64>,
    /// Their physical times.
    pub t: Vec<N>,
    /// Positions, one state after the other.
    pub q: Vec<N>,
    /// Momenta, in the same form.
    pub p: Vec<N>,
    /// H
    pub energy: Vec<N>,
    /// The modified energies of these states, or of the middles between them and the next ones; the last one is then missing.
    pub modified: Vec<Modified<N>>,
    /// Evaluations of the gradient, those for the states beyond both ends included.
    pub evaluations: u64,
    /// What the kept states show of the interactions of planets; `None` of other systems.
    pub interactions: Option<Interactions>,
}

/// A modified energy.
#[derive(Clone, Debug)]
pub struct Modified<N> {
    /// The modified energy H̄.
    pub value: N,
    /// Its estimated error, where there is one.
    pub error: Option<N>,
    /// The k of E_k, or the m of D_m.
    pub order: u32,
}

impl Integration<'_> {
    /// Makes the run, with a summary for an observer that [wants](Observer::summarises) one.
    ///
    /// # Errors
    /// Crossings with displaced forces; a state or an energy that is not finite; settings of the estimator that are not valid; an observer that stops.
    ///
    /// # Panics
    /// If the scheme is not valid for the system.
    pub fn run<N: RunNumber>(self, context: &N::Context, observer: &mut dyn Observer) -> Result<Samples<N>, Error> {
        let Integration { system, scheme, compensated, displaced, until, .. } = self;
        if displaced && matches!(self.kept, KeptStates::Crossings(_)) {
            return Err(Error::usage(NEEDS_PARTS_OF_STEPS, "write gradient_kicks = \"exact\", or remove the section"));
        }
        let steps = Steps { scheme, h: self.run.h, compensated, displaced, begin: Begin::InitialState };
        let at_start = || system.integrator(steps, system.start(context), context);
        let end = match (Ends { until, condition: self.ends }) {
            Ends { until: None, condition: None } => End { steps: self.run.steps, is_met: false },
            ends => {
                let most = if until.is_some() { MOST_STEPS } else { self.run.steps };
                find_end(&mut *at_start()?, system, ends, (self.run.h.exact(), most), context)
            }
        };
        let until = until.filter(|_| !end.is_met);
        let run = Run { steps: end.steps, ..self.run };
        let mut integrator = at_start()?;
        let named = |error: RunError| run.failed_naming(&error, &system.coordinates, &system.momenta);
        let energy_of = system.energy_of_rows(context);
        let energies = match (self.kept, &energy_of) {
            (KeptStates::Every(every), None) => Energies::Given(every.max(1)),
            _ => Energies::Windows,
        };
        let watch = observer.summarises().then(|| Watch::of_run(system, &mut *integrator, (run, 0), energies, context));
        let mut keeper = Keeper {
            integration: Integration { run, ..self },
            context,
            observer,
            shown: system.shown(context),
            energy_of,
            samples: Samples {
                n: Vec::new(),
                t: Vec::new(),
                q: Vec::new(),
                p: Vec::new(),
                energy: Vec::new(),
                modified: Vec::new(),
                evaluations: 0,
                interactions: None,
            },
            approaches: Approaches::of(system),
            crossings: match self.kept {
                KeptStates::Every(_) => None,
                KeptStates::Crossings(surface) => Some(Crossings::new(surface, system, context)),
            },
            watch: watch.transpose().map_err(named)?,
            last: None,
            pace: Pace::new(0),
        };
        // no follower of samples ends the run
        let _ = N::follow(&mut *integrator, (None, run.steps), self.estimator, &mut keeper)?;
        // the estimates between two states end before the last one
        if let Some(last) = keeper.last.take() {
            if self.estimator.is_some_and(EstimatorSettings::is_between) {
                keeper.keep_state(run.steps, &mut *integrator, last.clone())?;
            }
            if let Some(until) = until
                && keeper.crossings.is_none()
                && last_step(&mut *integrator, (&last.0, &last.1), (run, until))?
            {
                keeper.keep(run.steps + 1, &mut *integrator)?;
            }
        }
        keeper.samples.evaluations = integrator.state().evaluations();
        if let Some(summary) = keeper.watch.take().and_then(|watch| watch.summary(run)) {
            keeper.observer.summary(&summary);
        }
        keeper.samples.interactions = keeper.approaches.map(|approaches| approaches.found());
        Ok(keeper.samples)
    }

    fn keeps(&self, n: u64) -> bool {
        match self.kept {
            KeptStates::Every(every) => n.is_multiple_of(every.max(1)) || n == self.run.steps,
            KeptStates::Crossings(_) => false,
        }
    }

    /// The n of the first state after n that is kept, or is needed to find a crossing.
    fn next(&self, n: u64) -> u64 {
        match self.kept {
            KeptStates::Every(every) => (n / every.max(1) + 1).saturating_mul(every.max(1)),
            KeptStates::Crossings(_) => n + 1,
        }
    }
}

/// Keeps the states of a run.
struct Keeper<'a, N: RunNumber> {
    integration: Integration<'a>,
    context: &'a N::Context,
    observer: &'a mut dyn Observer,
    /// Converts states, where those of the steps have other coordinates.
    shown: Option<ShownCoordinates<N>>,
    /// H, where the steps conserve another function.
    energy_of: Option<EnergyAt<N>>,
    samples: Samples<N>,
    /// Of planets.
    approaches: Option<Approaches>,
    /// Finds the crossings of a surface of section.
    crossings: Option<Crossings<N>>,
    /// Follows the run for a summary.
    watch: Option<Watch<N>>,
    /// The last state, where estimates belong to the middles between states, or the run ends at a physical time.
    last: Option<(Vec<N>, Vec<N>)>,
    /// Of asking the observer.
    pace: Pace,
}

impl<N: RunNumber> Keeper<'_, N> {
    /// Keeps the present state.
    fn keep(&mut self, n: u64, integrator: &mut VectorIntegrator<'_, N>) -> Result<(), Error> {
        let energy = self.energy(integrator);
        self.push(n, (integrator.state().q(), integrator.state().p()), energy, None)
    }

    /// H of the present state.
    fn energy(&mut self, integrator: &mut VectorIntegrator<'_, N>) -> N {
        match &mut self.energy_of {
            Some(energy_of) => energy_of(integrator.state().q(), integrator.state().p()),
            None => integrator.system().energy(),
        }
    }

    /// Keeps the crossing between the state n, which is the present one, and the state before, if there is one.
    fn keep_crossing(&mut self, n: u64, integrator: &mut VectorIntegrator<'_, N>) -> Result<(), Error> {
        let Some(mut crossings) = self.crossings.take() else { return Ok(()) };
        let number = i64::try_from(n).unwrap_or(i64::MAX);
        let kept = crossings.state(number, integrator, |integrator, part| {
            let time = self.integration.run.time_of_crossing(number - 1, part, self.context);
            let energy = self.energy(integrator);
            self.push(n - 1, (integrator.state().q(), integrator.state().p()), energy, Some(time))
        });
        self.crossings = Some(crossings);
        kept.unwrap_or(Ok(()))
    }

    /// Keeps a state that is not the present one of the system.
    fn keep_state(
        &mut self,
        n: u64,
        integrator: &mut VectorIntegrator<'_, N>,
        (mut q, mut p): (Vec<N>, Vec<N>),
    ) -> Result<(), Error> {
        integrator.postprocess_state(&mut q, &mut p);
        let energy = match &mut self.energy_of {
            Some(energy_of) => energy_of(&q, &p),
            None => integrator.energy_at(&q, &p),
        };
        self.push(n, (&q, &p), energy, None)
    }

    /// `time` is that of a state that is not at t = n h.
    fn push(&mut self, n: u64, (q, p): (&[N], &[N]), energy: N, time: Option<N>) -> Result<(), Error> {
        let Integration { run, system, .. } = self.integration;
        let number = i64::try_from(n).unwrap_or(i64::MAX);
        let quantities = (0..q.len()).map(Quantity::Position).chain((0..p.len()).map(Quantity::Momentum));
        let values = quantities.zip(q.iter().chain(p)).chain([(Quantity::Energy, &energy)]);
        if let Some((quantity, value)) = values.into_iter().find(|(_, value)| !value.is_finite()) {
            let value = NotFinite { quantity, value: value.to_text() };
            let error = RunError::NotFinite { step: number, value };
            return Err(run.failed_naming(&error, &system.coordinates, &system.momenta));
        }
        if let Some(approaches) = &mut self.approaches {
            approaches.include(number, (q, p));
        }
        if let (Some(watch), None, None) = (&mut self.watch, &self.energy_of, &time)
            && n <= run.steps
        {
            watch.include_energy(number, &energy);
        }
        let samples = &mut self.samples;
        samples.n.push(number);
        let time = time.unwrap_or_else(|| run.time_in(number, self.context));
        samples.t.push(system.time_of(q).cloned().unwrap_or(time));
        samples.energy.push(energy);
        let (q, p) = match &mut self.shown {
            Some(shown) => shown.of_state(q, p),
            None => (q, p),
        };
        samples.q.extend_from_slice(q);
        samples.p.extend_from_slice(p);
        Ok(())
    }
}

impl<N: RunNumber> Follower<N> for Keeper<'_, N> {
    fn carried(&self) -> Carried {
        self.watch.as_ref().map_or(Carried::Nothing, Watch::carried)
    }

    fn next(&self, n: i64) -> i64 {
        let n = n.unsigned_abs();
        let kept = self.integration.next(n);
        let watched = self.watch.as_ref().map_or(u64::MAX, |watch| n.saturating_add(watch.idle()).saturating_add(1));
        i64::try_from(kept.min(watched).min(self.pace.next(n))).unwrap_or(i64::MAX)
    }

    fn visitor(&mut self) -> Option<&mut dyn Visitor<N>> {
        self.watch.as_mut().map(|watch| -> &mut dyn Visitor<N> { watch })
    }

    fn state(&mut self, n: i64, integrator: &mut VectorIntegrator<'_, N>) {
        let Integration { estimator, run, until, .. } = self.integration;
        let wanted = estimator.is_some_and(EstimatorSettings::is_between) || until.is_some();
        let is_last = n.unsigned_abs() == run.steps;
        if wanted && is_last {
            self.last = Some((integrator.state().q().to_vec(), integrator.state().p().to_vec()));
        }
        // not of the states beyond both ends, which only the estimates need
        let own = n > 0 && n.unsigned_abs() <= run.steps;
        if let Some(watch) = self.watch.as_mut().filter(|_| own) {
            watch.include(n, integrator);
            if is_last {
                watch.include_energy(n, &at_output(integrator, |integrator| integrator.system().energy()));
            }
        }
    }

    fn output(
        &mut self,
        n: i64,
        estimate: Option<&Estimate<'_, N>>,
        integrator: &mut VectorIntegrator<'_, N>,
    ) -> Result<ControlFlow<()>, Error> {
        let n = n.unsigned_abs();
        if self.pace.looks_up(n) {
            report(self.observer, self.integration.run, n)?;
        }
        if estimate.is_none() {
            self.keep_crossing(n, integrator)?;
        }
        if self.integration.keeps(n) {
            match estimate {
                None => at_output(integrator, |integrator| self.keep(n, integrator))?,
                Some(found) => {
                    let (value, error) = (found.value.clone(), found.error.cloned());
                    self.samples.modified.push(Modified { value, error, order: found.order });
                    self.keep_state(
                        n,
                        integrator,
                        found.state().map(|numbers| numbers.cloned().collect::<Vec<_>>()).into(),
                    )?;
                }
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    fn failed(&mut self, error: RunError) -> Result<(), Error> {
        let Integration { run, system, .. } = self.integration;
        Err(run.failed_naming(&error, &system.coordinates, &system.momenta))
    }
}

impl<N> Samples<N> {
    /// The same states in other numbers, as texts for example.
    pub fn map<T>(self, number: impl Fn(&N) -> T) -> Samples<T> {
        let all = |numbers: &[N]| numbers.iter().map(&number).collect();
        let modified = |found: &Modified<N>| Modified {
            value: number(&found.value),
            error: found.error.as_ref().map(&number),
            order: found.order,
        };
        Samples {
            t: all(&self.t),
            q: all(&self.q),
            p: all(&self.p),
            energy: all(&self.energy),
            modified: self.modified.iter().map(modified).collect(),
            n: self.n,
            evaluations: self.evaluations,
            interactions: self.interactions,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;
    use crate::observer::KeptSummary;
    use shadowstep::tables::Source;

    fn integration(scene: &Scene, every: u64) -> Integration<'_> {
        Integration {
            system: &scene.system,
            scheme: &scene.scheme.scheme,
            run: scene.as_run(),
            compensated: false,
            displaced: false,
            until: None,
            ends: None,
            kept: KeptStates::Every(every),
            estimator: scene.output.modified_energy.as_ref().map(|(settings, _)| settings),
        }
    }

    /// Whatever a run computes besides, its summary is that of the scene; only H may be computed at other states.
    #[test]
    fn the_summary_is_that_of_the_scene() {
        let kepler = "problem.name = \"kepler\"\nrun = { scheme = \"SCHEME\", step = \"1/20\", until = 100, digits = \"double\" }\n";
        let planets = "problem = { name = \"outer-solar-system\", parts = \"wisdom-holman\" }\n\
                       run = { scheme = \"saba4\", step = 100, until = 100000, digits = \"double\" }\n";
        for (text, estimated) in [
            (kepler.replace("SCHEME", "yoshida4"), false),
            (kepler.replace("SCHEME", "yoshida4"), true),
            (kepler.replace("SCHEME", "bcm6-13"), false),
            (planets.to_owned(), false),
        ] {
            let rows = if estimated {
                "output.modified_energy = { estimator = \"bilinear\", order = 8, every = 100 }\n"
            } else {
                "output.energy = { every = 100 }\n"
            };
            let scene = Scene::read(Source { path: "test.toml".to_owned(), text: text + rows }).unwrap();
            let mut of_scene = KeptSummary::default();
            scene.run_into(&mut Vec::new(), &mut of_scene).unwrap();
            let mut own = KeptSummary::default();
            integration(&scene, 100).run::<f64>(&(), &mut own).unwrap();
            let [of_scene, own] = [of_scene, own].map(|kept| kept.0.unwrap());
            assert_eq!(own.verdict_with_reason(), of_scene.verdict_with_reason());
            assert_eq!((own.to, own.encounters), (of_scene.to, of_scene.encounters));
        }
    }

    /// H of the states that are kept is in the summary, each once, whether windows or estimates are there before.
    #[test]
    fn the_error_of_h_is_over_all_states_that_are_kept() {
        let kepler = "problem.name = \"kepler\"\nrun = { scheme = \"SCHEME\", step = \"1/20\", until = \"UNTIL\", digits = \"double\" }\n";
        let estimates = "output.modified_energy = { estimator = \"bilinear\", order = 8 }\n";
        for (scheme, until) in [("yoshida4", "100"), ("yoshida4", "2"), ("bcm6-13", "100"), ("bcm6-13", "2")] {
            for rows in ["output.energy = true\n", estimates] {
                let text = kepler.replace("SCHEME", scheme).replace("UNTIL", until) + rows;
                let scene = Scene::read(Source { path: "test.toml".to_owned(), text }).unwrap();
                let mut kept = KeptSummary::default();
                let samples = integration(&scene, 1).run::<f64>(&(), &mut kept).unwrap();
                let found = kept.0.unwrap().energy;
                // of a processed scheme the kernel's first state is H(0) but for round-off
                let initial: f64 = found.initial.parse().unwrap();
                let errors: Vec<f64> = samples.energy.iter().map(|energy| (energy - initial).abs()).collect();
                let largest = errors.iter().copied().fold(0.0, f64::max);
                assert_eq!(found.states, errors.len() as u64, "{scheme} {until} {rows}");
                assert_eq!(found.largest.parse::<f64>().unwrap(), largest);
                assert_eq!(errors[usize::try_from(found.at).unwrap()], largest);
                assert_eq!(found.last.parse::<f64>().unwrap().abs(), *errors.last().unwrap());
            }
        }
    }
}
