//! Long runs of shipped problems: whether the energy error stays bounded and the bodies stay where they are.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};
use shadowstep::{Number, Rational, exact};
use shadowstep_schemes::symbolic::decimal::to_text;

use crate::stability::case::{Case, Done, Row};
use crate::stability::integrator::{AnyIntegrator, step_size};
use crate::stability::suite::Examined;
use crate::stability::systems::shipped;
use crate::stability::table::Values;
use crate::stability::trial::Trial;
use crate::stability::watched::Watched;
use crate::verdict::Verdict;
use crate::{Continues, Error};

/// What a long run has shown.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct LongRun {
    pub(crate) watched: Watched,
    /// The largest |H − H(0)| as a part of |H(0)|, in each fourth of the run, over some states.
    pub(crate) energy_errors: [f64; 4],
    /// The times of equal parts of the run, and the largest error in each.
    pub(crate) envelope: Vec<(f64, f64)>,
    /// The largest coordinate of all states, about that body, beside the largest one at the start.
    pub(crate) farthest: f64,
}

/// Charts have the largest error of H in each of this number of parts of a run.
const PARTS: usize = 60;
/// H is computed at this number of states.
const ENERGIES: u64 = 20_000;
/// How much the error of H may differ between the first and the last fourth, if it is the same oscillation.
const SAME: f64 = 1.5;
/// A body is lost if a coordinate is this many times as large as at the start.
const LOST: f64 = 100.0;

/// The values `h`, exact for each force evaluation, and `until` become a step size and a number of steps.
pub(crate) fn complete(scheme: &Examined, mut values: Values) -> Option<Values> {
    let h = exact(values["h"].as_str()?).ok()? * Rational::from_integer(scheme.evaluations().into());
    let steps = (values.remove("until")?.as_f64()? / <f64 as Number>::from_rational(&h, &())).round();
    values.insert("h".to_owned(), to_text(&h).into());
    values.insert("steps".to_owned(), (steps as u64).into());
    Some(values)
}

/// A run of a shipped problem by its values `problem`, `h`, `steps`, and `about`: how many of the first coordinates are
/// those of the body from which positions are measured; 0 for the origin.
pub(crate) fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> LongRun {
    let (h, about, steps) = (step_size(&*trial.get::<String>("h")), trial.get::<usize>("about"), trial.steps());
    let run = &mut *trial.start(&shipped(&trial.get::<String>("problem"), &[]), &h);
    let initial = run.energy();
    let size = |run: &dyn AnyIntegrator| {
        let origin = |i: usize| if about > 0 { run.q(i % about) } else { 0.0 };
        (0..run.dimension()).map(|i| (run.q(i) - origin(i)).abs()).fold(0.0, f64::max)
    };
    let begin = size(run);
    let every = (steps / ENERGIES).max(1);
    let (mut farthest, mut energy_errors) = (1.0_f64, [0.0_f64; 4]);
    let duration = <f64 as Number>::from_rational(h.exact(), &()) * steps as f64;
    let mut envelope: Vec<_> = (1..=PARTS).map(|i| (duration * i as f64 / PARTS as f64, 0.0_f64)).collect();
    let watched = trial.watched(run, continues, &mut |n, run| {
        if n % every == 0 {
            let error = (run.energy() - initial).abs() / initial.abs();
            let fourth = (4 * (n - 1) / steps) as usize;
            // JSON has no infinity
            energy_errors[fourth] = energy_errors[fourth].max(error).min(f64::MAX);
            let part = &mut envelope[((PARTS as u64 * (n - 1)) / steps) as usize].1;
            *part = part.max(error).min(f64::MAX);
            farthest = farthest.max(size(run) / begin).min(f64::MAX);
        }
        ControlFlow::Continue(())
    });
    envelope.retain(|(_, error)| *error > 0.0);
    LongRun { watched, energy_errors, envelope, farthest }
}

impl LongRun {
    /// Whether the energy error of the last fourth is at most `factor` times that of the first one.
    pub(crate) fn is_bounded(&self, factor: f64) -> bool {
        self.watched.finite && self.farthest <= LOST && self.energy_errors[3] <= factor * self.energy_errors[0]
    }
}

/// Orbits that stay where they are: no coordinate is larger than `stays` times the largest one at the start, the error
/// of H is at most 1.5 times as large in the last fourth of the run as in the first, and the monitor calls the step
/// fine.
pub(crate) struct Staying;

impl Case for Staying {
    type Measured = LongRun;

    fn complete(scheme: &Examined, values: Values) -> Option<Values> {
        complete(scheme, values)
    }

    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<LongRun, Error> {
        Ok(measure(trial, continues))
    }

    fn judge(all: &[&Done<'_, LongRun>]) -> Vec<Row> {
        let Done { trial, found: stayed } = all[0];
        let [first, .., last] = stayed.energy_errors;
        let found = format!(
            "{} steps of {} {}: no coordinate beyond {:.3} of the largest initial one; error of H {first:.1e} in the \
             first fourth, {last:.1e} in the last; the monitor: {}",
            trial.steps(),
            trial.get::<String>("h"),
            trial.get::<String>("unit"),
            stayed.farthest,
            stayed.watched.verdict
        );
        let bounded = Verdict::from(stayed.is_bounded(SAME) && stayed.farthest <= trial.get::<f64>("stays"));
        let verdict = Verdict::of_all([bounded, stayed.watched.is_fine()]);
        vec![Row::of(trial, found, verdict).with(stayed.envelope.iter().map(|(t, error)| (*t, error.log10())))]
    }
}
