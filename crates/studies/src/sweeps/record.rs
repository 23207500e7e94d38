//! One run: what is kept of it, or why it failed.

use std::sync::atomic::{AtomicBool, Ordering};

use serde::{Deserialize, Serialize};
use shadowstep::Real;
use shadowstep::shadow::run::{DriftRecorder, EnergyDrift, Finding};
use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep_scenes::at::At;
use shadowstep_scenes::column::Column;
use shadowstep_scenes::computation::{Computation, RunNumber};
use shadowstep_scenes::evaluator::{Evaluator, Test};
use shadowstep_scenes::posed::{Followed, Posed};
use shadowstep_scenes::run::Run;
use shadowstep_scenes::tangent::{FollowingVectors, TangentRun, Vectors};
use shadowstep_scenes::watch::Energies;
use shadowstep_scenes::{Error, Observer, Scene, System};
use shadowstep_schemes::symbolic::decimal::to_text;

use crate::sweeps::keep::{Keep, Kept};
use crate::sweeps::values::{Ended, Need, finite};

/// What a run has given.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Record {
    /// Its number.
    pub run: u64,
    /// The value of each column; `None` where there is none, as the time of a condition that no state meets. Empty if
    /// it failed.
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
    let found = scene.arithmetic.compute(Measuring { scene, keep, stops });
    let record = found.and_then(|values| match values {
        Some(values) if keep.rows => {
            Ok(rows(scene, stops)?.map(|rows| Record { rows: Some(rows), ..Record::of(run, values) }))
        }
        values => Ok(values.map(|values| Record::of(run, values))),
    });
    record.unwrap_or_else(|error| Some(Record::failed(run, sentence(error))))
}

/// The message of an error without its hint.
fn sentence(error: Error) -> String {
    match error {
        Error::Usage { message, .. } | Error::Run { message, .. } => message,
        other => other.to_string(),
    }
}

/// Stops a run where another thread wants it.
struct Stops<'a>(&'a AtomicBool);

impl Observer for Stops<'_> {
    fn stops(&mut self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// The rows of a scene's \[output\] as CSV without their head; `None` if it was stopped.
fn rows(scene: &Scene, stops: &AtomicBool) -> Result<Option<String>, Error> {
    let mut bytes = Vec::new();
    scene.run_into_csv(&mut bytes, &mut Stops(stops))?;
    if stops.load(Ordering::Relaxed) {
        return Ok(None);
    }
    let text = String::from_utf8(bytes).expect("rows are UTF-8");
    Ok(Some(text.lines().filter(|line| !line.starts_with('#')).flat_map(|line| [line, "\n"]).collect()))
}

/// A run in any number type: what is kept of it; `None` if it was stopped.
struct Measuring<'a> {
    scene: &'a Scene,
    keep: &'a Keep,
    stops: &'a AtomicBool,
}

impl Computation for Measuring<'_> {
    type Output = Result<Option<Values>, Error>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output {
        let Measuring { scene, keep, stops } = self;
        let vectors = keep.vectors();
        let settings = scene.output.modified_energy.as_ref().filter(|_| keep.needs(Need::Estimates));
        let energies = keep.needs(Need::Energies).then_some(Energies::All);
        let posed = Posed {
            estimator: settings.map(|(settings, _)| settings),
            vectors: (vectors > 0).then_some((Vectors::Free(vectors), 1)),
            energies,
            summarised: keep.needs(Need::Summary),
            ..scene.posed()
        };
        let system = &scene.system;
        let drift = || DriftRecorder::new(scene.h.clone()).compensated_if(scene.arithmetic.is_compensated());
        let mut kept = KeptOfRun {
            keep,
            system,
            drift: settings.map(|_| drift()),
            formulas: keep.begin(
                |condition| Test::new(condition, system, context),
                |expression| Evaluator::of_run(expression, system, context),
            ),
            state: Vec::new(),
        };
        let followed = N::follow(&posed, context, &mut [&mut kept], &mut Stops(stops))?;
        Ok((!followed.is_stopped).then(|| kept.values(followed)))
    }
}

/// What is kept, as far as the states have come.
struct KeptOfRun<'a, N: RunNumber> {
    keep: &'a Keep,
    system: &'a System,
    /// Of the modified energy, where it is estimated.
    drift: Option<DriftRecorder<N>>,
    formulas: Vec<Kept<N, Option<String>, Option<N>>>,
    /// q and p at the last state.
    state: Values,
}

impl<N: RunNumber> KeptOfRun<'_, N> {
    /// The values of all columns.
    fn values(self, mut followed: Followed) -> Values {
        let KeptOfRun { keep, drift, formulas, state, .. } = self;
        let drift = drift.and_then(DriftRecorder::drift);
        let vectors = followed.vectors.as_mut().map(FollowingVectors::end);
        let ended = Ended {
            steps: followed.n.unsigned_abs(),
            evaluations: followed.evaluations,
            energy: followed.energy.map_or_else(Default::default, |energy| {
                [Some(energy.largest), energy.largest_relative, Some(energy.last)]
            }),
            summary: followed.summary.as_ref(),
            drift: drift.as_ref().map(texts_of).unwrap_or_default(),
            growth: vectors.map(|vectors| vectors.growths()[0]),
            sali: vectors.and_then(TangentRun::sali),
        };
        let values = keep.values.iter().map(|value| (value.of)(&ended));
        let formulas = formulas.into_iter().map(|kept| match kept {
            Kept::FirstTime(.., time) => time,
            Kept::Value(.., value) => value.as_ref().and_then(finite),
        });
        values.chain(formulas).chain(state).collect()
    }
}

impl<N: RunNumber> Column<N> for KeptOfRun<'_, N> {
    fn next(&self, n: i64) -> i64 {
        if self.drift.is_some() { n + 1 } else { i64::MAX }
    }

    fn take(&mut self, at: &mut At<'_, '_, N>) -> Result<(), Error> {
        if let (Some(estimate), Some(drift)) = (at.estimate, &mut self.drift) {
            drift.include(at.n, estimate);
        }
        Ok(())
    }

    fn sees_each(&self) -> bool {
        self.keep.follows_all()
    }

    fn see(&mut self, n: i64, run: Run<'_>, integrator: &mut VectorIntegrator<'_, N>) -> bool {
        let KeptOfRun { formulas, system: described, .. } = self;
        at_output(integrator, |integrator| {
            let system = integrator.system();
            for kept in formulas.iter_mut() {
                match kept {
                    Kept::FirstTime(test, _, met) if met.is_none() => {
                        *met = test.is_met(system, || run.time(n)).then(|| {
                            let physical = described.time_of(system.state().q());
                            physical.map_or_else(|| to_text(&run.time(n)), N::to_text)
                        });
                    }
                    Kept::Value(evaluator, Some(extremum), found) => {
                        let value = evaluator.value(system, || run.time(n));
                        if extremum.is_beyond(value, found.as_ref()) {
                            *found = Some(value.clone());
                        }
                    }
                    _ => {}
                }
            }
        });
        formulas.iter().any(|kept| matches!(kept, Kept::FirstTime(_, true, Some(_))))
    }

    fn end(&mut self, at: &mut At<'_, '_, N>) -> Result<(), Error> {
        let (time, energy) = (at.time(), at.energy()?.clone());
        for kept in &mut self.formulas {
            if let Kept::Value(evaluator, None, found) = kept {
                *found = Some(evaluator.value_at(at.state(), &time, || energy.clone()).clone());
            }
        }
        if self.keep.state {
            let (q, p) = at.shown_state();
            self.state = q.iter().chain(p).map(finite).collect();
        }
        Ok(())
    }
}

/// What is known of the modified energy: max − min; its permanent change, what that must exceed, and the finding.
fn texts_of<N: Real>(drift: &EnergyDrift<N>) -> [Option<String>; 4] {
    let permanent = drift.permanent.as_ref();
    // of a change on one side of an encounter only, nothing is known
    let known = permanent.filter(|permanent| permanent.finding != Finding::OneSided);
    let finding = permanent.map(|permanent| match permanent.finding {
        Finding::Resolved => "resolved",
        Finding::BelowResolution => "below-resolution",
        Finding::OneSided => "one-sided",
    });
    let [change, resolution] = [known.map(|known| &known.change), permanent.map(|permanent| &permanent.resolution)]
        .map(|x| x.and_then(finite));
    [finite(&drift.drift), change, resolution, finding.map(str::to_owned)]
}
