//! One run: what is kept of it, or why it failed.

use std::ops::ControlFlow::{self, Break, Continue};
use std::sync::atomic::{AtomicBool, Ordering};

use serde::{Deserialize, Serialize};
use shadowstep::shadow::Estimate;
use shadowstep::shadow::run::{DriftRecorder, EnergyDrift, Finding, RunError};
use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep::systems::system::Visitor;
use shadowstep::{Carried, Real};
use shadowstep_scenes::computation::{Computation, RunNumber};
use shadowstep_scenes::evaluator::{Evaluator, Test};
use shadowstep_scenes::expression::Expression;
use shadowstep_scenes::extremum::Extremum;
use shadowstep_scenes::follow::Follower;
use shadowstep_scenes::run::Run;
use shadowstep_scenes::tangent::{FollowingVectors, TangentRun, Vectors};
use shadowstep_scenes::watch::{Energies, Watch};
use shadowstep_scenes::{EnergySummary, Error, Observer, Scene, ShownCoordinates, Summary, System};
use shadowstep_symbolic::decimal::to_text;

use crate::keep::Keep;
use crate::values::{Need, RunValue};

/// What a run has given.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Record {
    /// Its number.
    pub run: u64,
    /// The value of each column; `None` where there is none, as the time of a condition that no state meets. Empty if it failed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub values: Vec<Option<String>>,
    /// Why it failed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub failure: Option<String>,
    /// The rows of the scene's \[output\], if they are kept.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rows: Option<String>,
}

/// The values of all columns.
pub(crate) type Values = Vec<Option<String>>;

impl Record {
    pub(crate) fn of(run: u64, values: Values) -> Record {
        Record { run, values, failure: None, rows: None }
    }

    pub(crate) fn failed(run: u64, failure: String) -> Record {
        Record { run, values: Vec::new(), failure: Some(failure), rows: None }
    }
}

/// Makes a scene's run; `None` if it was stopped. A run that fails is a record, too.
pub(crate) fn measured(run: u64, scene: &Scene, keep: &Keep, stops: &AtomicBool) -> Option<Record> {
    let found = match measure(scene, keep, stops) {
        Ok(Some(values)) if keep.rows => rows(scene, stops).map(|rows| rows.map(|rows| (values, Some(rows)))),
        other => other.map(|values| values.map(|values| (values, None))),
    };
    match found {
        Ok(Some((values, rows))) => Some(Record { rows, ..Record::of(run, values) }),
        Ok(None) => None,
        Err(error) => Some(Record::failed(run, sentence(error))),
    }
}

/// The message of an error without its hint.
fn sentence(error: Error) -> String {
    match error {
        Error::Usage { message, .. } | Error::Run { message, .. } => message,
        other => other.to_string(),
    }
}

/// What is kept of a scene's run; `None` if it was stopped.
fn measure(scene: &Scene, keep: &Keep, stops: &AtomicBool) -> Result<Option<Values>, Error> {
    scene.arithmetic.compute(Measuring { scene, keep, stops })
}

/// The rows of a scene's \[output\] without their head; `None` if it was stopped.
fn rows(scene: &Scene, stops: &AtomicBool) -> Result<Option<String>, Error> {
    struct Stops<'a>(&'a AtomicBool);
    impl Observer for Stops<'_> {
        fn stops(&mut self) -> bool {
            self.0.load(Ordering::Relaxed)
        }
    }
    let mut bytes = Vec::new();
    scene.run_into(&mut bytes, &mut Stops(stops))?;
    if stops.load(Ordering::Relaxed) {
        return Ok(None);
    }
    let text = String::from_utf8(bytes).expect("rows are UTF-8");
    Ok(Some(text.lines().filter(|line| !line.starts_with('#')).flat_map(|line| [line, "\n"]).collect()))
}

/// A run in any number type.
struct Measuring<'a> {
    scene: &'a Scene,
    keep: &'a Keep,
    stops: &'a AtomicBool,
}

impl Computation for Measuring<'_> {
    type Output = Result<Option<Values>, Error>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output {
        let Measuring { scene, keep, stops } = self;
        let mut integrator = scene.integrator::<N>(context)?;
        let (run, described) = (scene.as_run(), &scene.system);
        let failed = |error: RunError| run.failed_naming(&error, &described.coordinates, &described.momenta);
        let mut following = RunFollower::begin(scene, (keep, stops), &mut *integrator, context).map_err(failed)?;
        let settings = scene.output.modified_energy.as_ref().filter(|_| keep.needs(Need::Estimates));
        if settings.is_some() {
            let drift = DriftRecorder::new(integrator.step_size().clone());
            following.drift = Some(drift.compensated_if(integrator.state().is_compensated()));
        }
        following.tangents = match keep.vectors() {
            0 => None,
            vectors => Some(scene.tangents(Vectors::Free(vectors), 1)?),
        };
        let settings = settings.map(|(settings, _)| settings);
        let ended = N::follow(&mut *integrator, (None, run.steps), settings, &mut following)?;
        if ended.is_break() && !following.is_over() {
            return Ok(None);
        }
        let drift = following.drift.take().and_then(DriftRecorder::drift);
        following.values(run, &Ended { drift, evaluations: integrator.state().evaluations() }).map(Some)
    }
}

/// What is known at the end of the steps.
struct Ended<N> {
    drift: Option<EnergyDrift<N>>,
    evaluations: u64,
}

/// What is kept, as far as the states have come.
struct RunFollower<'a, N: RunNumber> {
    run: Run<'a>,
    described: &'a System,
    keep: &'a Keep,
    stops: &'a AtomicBool,
    /// Whether numbers are longer than double precision.
    is_long: bool,
    /// Of the modified energy, where it is estimated.
    drift: Option<DriftRecorder<N>>,
    watch: Option<Watch<N>>,
    tangents: Option<FollowingVectors>,
    /// The conditions, each with the time of the first state that meets it.
    tests: Vec<(Test<N>, Option<String>)>,
    at_end: Vec<Evaluator<N>>,
    /// The least or greatest values of expressions so far.
    extremes: Vec<(Evaluator<N>, Extremum, Option<N>)>,
    /// The n of the last state: that of the run, or the one at which a condition ends it.
    last: i64,
    end: Option<End>,
    /// Converts states, where columns are in other coordinates than the steps.
    shown: Option<ShownCoordinates<N>>,
}

/// The last state.
struct End {
    expressions: Vec<Option<String>>,
    state: Vec<Option<String>>,
    /// Whether H has a value there.
    has_energy: bool,
}

impl<'a, N: RunNumber> RunFollower<'a, N> {
    fn begin(
        scene: &'a Scene,
        (keep, stops): (&'a Keep, &'a AtomicBool),
        integrator: &mut VectorIntegrator<'_, N>,
        context: &N::Context,
    ) -> Result<Self, RunError> {
        let (energies, summarised) = (keep.needs(Need::Energies), keep.needs(Need::Summary));
        let watch = match energies || summarised {
            false => None,
            true => {
                let (q, p) = scene.system.start(context);
                let initial = integrator.energy_at(&q, &p);
                let energies = if energies { Energies::All } else { Energies::Windows };
                let watch = Watch::begin(integrator, scene.as_run(), (0, initial), energies, summarised)?;
                Some(watch.of_system(&scene.system, integrator))
            }
        };
        const CHECKED: &str = "the formulas were checked with the sweep";
        let tests = keep
            .first_time
            .iter()
            .map(|(_, condition)| (Test::new(condition, &scene.system, context).expect(CHECKED), None));
        let evaluator = |text: &Expression| Evaluator::of_run(text, &scene.system, context).expect(CHECKED);
        let at_end = keep.at_end.iter().map(|(_, text)| evaluator(text));
        let extremes = keep.extremes.iter().map(|(_, text, extremum)| (evaluator(text), *extremum, None));
        let last = i64::try_from(scene.steps()).unwrap_or(i64::MAX);
        Ok(RunFollower {
            run: scene.as_run(),
            described: &scene.system,
            keep,
            stops,
            is_long: scene.arithmetic.is_longer_than_double(),
            drift: None,
            watch,
            tangents: None,
            tests: tests.collect(),
            at_end: at_end.collect(),
            extremes: extremes.collect(),
            last,
            end: None,
            shown: scene.system.shown(context),
        })
    }

    /// Whether the last state has come.
    fn is_over(&self) -> bool {
        self.end.is_some()
    }

    /// Takes the state n.
    fn include(&mut self, n: i64, integrator: &mut VectorIntegrator<'_, N>) {
        if let Some(watch) = self.watch.as_mut().filter(|_| n > 0) {
            watch.include(n, integrator);
        }
        if let Some(tangents) = self.tangents.as_mut().filter(|_| n > 0) {
            tangents.step();
        }
        if self.tests.is_empty() && self.extremes.is_empty() && n != self.last {
            return;
        }
        let run = self.run;
        at_output(integrator, |integrator| {
            let system = integrator.system();
            for (test, met) in &mut self.tests {
                if met.is_none() && test.is_met(system, || run.time(n)) {
                    let physical = self.described.time_of(system.state().q());
                    *met = Some(physical.map_or_else(|| to_text(&run.time(n)), N::to_text));
                }
            }
            if self.keep.stop.iter().any(|&place| self.tests[place].1.is_some()) {
                self.last = n;
            }
            for (evaluator, extremum, found) in &mut self.extremes {
                let value = evaluator.value(system, || run.time(n));
                if extremum.is_beyond(value, found.as_ref()) {
                    *found = Some(value.clone());
                }
            }
            if n == self.last {
                let text = |number: &N| number.is_finite().then(|| number.to_text());
                let expressions = self.at_end.iter_mut().map(|end| text(end.value(system, || run.time(n)))).collect();
                let (q, p) = match &mut self.shown {
                    Some(shown) => shown.of_state(system.state().q(), system.state().p()),
                    None => (system.state().q(), system.state().p()),
                };
                let state = if self.keep.state { q.iter().chain(p).map(text).collect() } else { Vec::new() };
                self.end = Some(End { expressions, state, has_energy: system.energy().is_finite() });
            }
        });
    }

    /// The values of all columns.
    fn values(self, run: Run<'_>, ended: &Ended<N>) -> Result<Values, Error> {
        let RunFollower { keep, watch, mut tangents, tests, extremes, last, end, .. } = self;
        let end = end.expect("the last state was included");
        if !end.has_energy {
            return Err(run.not_finite(&format!("the energy at the end, n = {last},")));
        }
        let energy = watch.as_ref().map(Watch::energy);
        let summary = watch.and_then(|watch| watch.summary(run));
        let tangents = tangents.as_mut().map(FollowingVectors::end);
        let found = RunValues { energy: energy.as_ref(), summary: summary.as_ref(), tangents, ended, last };
        let values = keep.values.iter().map(|kept| found.value(*kept));
        let times = tests.into_iter().map(|(_, met)| met);
        let extremes = extremes.iter().map(|(_, _, found)| found.as_ref().map(N::to_text));
        Ok(values.chain(times).chain(end.expressions).chain(extremes).chain(end.state).collect())
    }
}

/// This number of steps in double precision is made at once, at most. Of longer numbers a step may take seconds, after
/// which a call must be able to stop.
const AT_ONCE: i64 = 64;

impl<N: RunNumber> Follower<N> for RunFollower<'_, N> {
    fn carried(&self) -> Carried {
        self.watch.as_ref().map_or(Carried::Nothing, Watch::carried)
    }

    fn next(&self, n: i64) -> i64 {
        if self.is_long || self.tangents.is_some() || !(self.tests.is_empty() && self.extremes.is_empty()) {
            return n + 1;
        }
        // what is watched but idle sees the states between
        let idle = self.watch.as_ref().map_or(u64::MAX, Watch::idle);
        n.saturating_add_unsigned(idle).saturating_add(1).min(n + AT_ONCE)
    }

    fn visitor(&mut self) -> Option<&mut dyn Visitor<N>> {
        self.watch.as_mut().map(|watch| -> &mut dyn Visitor<N> { watch })
    }

    fn state(&mut self, n: i64, integrator: &mut VectorIntegrator<'_, N>) {
        if 0 <= n && n <= self.last {
            self.include(n, integrator);
        }
    }

    fn output(
        &mut self,
        n: i64,
        estimate: Option<&Estimate<'_, N>>,
        _: &mut VectorIntegrator<'_, N>,
    ) -> Result<ControlFlow<()>, Error> {
        if let (Some(estimate), Some(drift)) = (estimate, &mut self.drift) {
            drift.include(n, estimate);
        }
        Ok(if n >= self.last || self.stops.load(Ordering::Relaxed) { Break(()) } else { Continue(()) })
    }

    /// Beyond the state at which a condition ends the run, states are made for estimates only.
    fn failed(&mut self, error: RunError) -> Result<(), Error> {
        match self.is_over() {
            true => Ok(()),
            false => Err(self.run.failed_naming(&error, &self.described.coordinates, &self.described.momenta)),
        }
    }
}

/// What the values are made of.
struct RunValues<'a, N> {
    energy: Option<&'a EnergySummary>,
    summary: Option<&'a Summary>,
    tangents: Option<&'a dyn TangentRun>,
    ended: &'a Ended<N>,
    last: i64,
}

impl<N: Real> RunValues<'_, N> {
    fn value(&self, kept: RunValue) -> Option<String> {
        let RunValues { energy, summary, tangents, ended, last } = self;
        let permanent = ended.drift.as_ref().and_then(|drift| drift.permanent.as_ref());
        match kept {
            RunValue::Verdict => summary.map(|summary| summary.verdict().to_owned()),
            RunValue::Reason => summary.map(|summary| summary.reason().to_owned()),
            RunValue::EnergyError => energy.map(|energy| energy.largest.clone()),
            RunValue::RelativeEnergyError => energy.and_then(|energy| energy.largest_relative.clone()),
            RunValue::LastEnergyError => energy.map(|energy| energy.last.clone()),
            RunValue::MethodError => summary.as_ref()?.modified_energy()?.method.clone(),
            RunValue::CloseEncounters => summary.map(|summary| summary.encounters().to_string()),
            RunValue::Drift => ended.drift.as_ref().map(|drift| drift.drift.to_text()),
            // of a change on one side of an encounter only, nothing is known
            RunValue::PermanentChange => {
                let known = permanent.filter(|permanent| permanent.finding != Finding::OneSided);
                known.map(|permanent| permanent.change.to_text())
            }
            RunValue::PermanentResolution => permanent.map(|permanent| permanent.resolution.to_text()),
            RunValue::PermanentFinding => permanent.map(|permanent| finding(permanent.finding).to_owned()),
            RunValue::Motion | RunValue::Lyapunov | RunValue::LyapunovError | RunValue::Megno => {
                tangents.and_then(|tangents| kept.of_growth(tangents.growths()[0]))
            }
            RunValue::Sali => tangents.and_then(TangentRun::sali).map(|sali| sali.to_text()),
            RunValue::Steps => Some(last.to_string()),
            RunValue::ForceEvaluations => Some(ended.evaluations.to_string()),
        }
    }
}

fn finding(finding: Finding) -> &'static str {
    match finding {
        Finding::Resolved => "resolved",
        Finding::BelowResolution => "below-resolution",
        Finding::OneSided => "one-sided",
    }
}
