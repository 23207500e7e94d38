//! The argon crystal at steps from 10 to 120 femtoseconds.

use shadowstep_analysis::stability::Stability;

use crate::stability::long_run::{self, LongRun};
use crate::stability::prelude::*;

/// The case.
pub(super) struct Argon;

/// In nanoseconds.
const FEMTOSECOND: f64 = 1e-6;
/// Collisions raise the largest frequency of the crystal at its start by up to so much.
const COLLISIONS: f64 = 4.0;
/// An error of H that hard collisions may reach sooner or later.
const SMALL: f64 = 1e-4;
/// How much the error of H may differ between the first and the last fourth.
const BOUNDED: f64 = 3.0;
/// log₁₀ of the largest error that is drawn.
const LARGEST_DRAWN: f64 = 1.0;
const SMALL_BUT_REPORTED: &str =
    "A small error grows from collision to collision, and is reported; a longer run would show whether it stays small.";

impl Case for Argon {
    type Measured = LongRun;

    fn complete(scheme: &Examined, mut values: Values) -> Option<Values> {
        values.insert("h".to_owned(), format!("{}/1000000", values["aside"]["fs"]).into());
        long_run::complete(scheme, values)
    }

    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<LongRun, Error> {
        Ok(long_run::measure(trial, continues))
    }

    fn judge(all: &[&Done<'_, LongRun>]) -> Vec<Row> {
        let trial = &all[0].trial;
        let omega = shipped("argon-crystal", &[]).fastest_frequency().map_or(f64::NAN, |found| found.omega);
        let stability = Stability::of_scheme(trial.scheme().scheme.proved());
        let limit = stability.and_then(|stability| stability.limit.parse::<f64>().ok()).unwrap_or(f64::NAN);
        let h_omega = |trial: &Trial<'_>| trial.get::<f64>("fs") * FEMTOSECOND * trial.evaluations() as f64 * omega;
        let part = |one: &&Done<'_, LongRun>| format!("{:.2} {}", h_omega(&one.trial) / limit, state(&one.found));
        let found = format!("hω as a part of the limit {limit:.3}, ω = {omega:.0} per ns: {}", joined(all, ", ", part));
        let verdicts = all.iter().map(|one| verdict(&one.found, h_omega(&one.trial), limit));
        let points = all.iter().map(|one| (one.trial.get("fs"), one.found.energy_errors[3].log10()));
        let drawn = points.filter(|(_, error)| *error <= LARGEST_DRAWN);
        vec![Row::of(trial, found, Verdict::of_all(verdicts)).with(drawn)]
    }
}

fn is_stable(stayed: &LongRun) -> bool {
    let bounded = stayed.is_bounded(BOUNDED) || stayed.energy_errors[3] <= SMALL;
    stayed.watched.finite && bounded && stayed.farthest < 10.0
}

fn state(stayed: &LongRun) -> &'static str {
    match (is_stable(stayed), stayed.watched.fine) {
        (true, true) => "bounded",
        (true, false) => "bounded, reported",
        (false, false) => "lost, reported",
        (false, true) => "lost, not reported",
    }
}

fn verdict(stayed: &LongRun, h_omega: f64, limit: f64) -> Verdict {
    match (is_stable(stayed), stayed.watched.fine) {
        // a small error that grows from collision to collision is not conserved, and small all the same
        (true, false) if h_omega < limit / COLLISIONS => Verdict::NotDecided(SMALL_BUT_REPORTED),
        (stable, _) if h_omega < limit / COLLISIONS => stable.into(),
        (stable, fine) if h_omega > limit => Verdict::from(!stable && !fine),
        (stable, fine) => Verdict::from(stable || !fine),
    }
}
