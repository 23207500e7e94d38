//! Stiff springs with steps up to their stability limit.

use shadowstep::exact;
use shadowstep_analysis::stability::Stability;
use shadowstep_schemes::symbolic::decimal::to_text;

use crate::stability::long_run::{self, LongRun};
use crate::stability::prelude::*;

/// The case.
pub(super) struct StiffSprings;

/// Of the stiff springs.
const OMEGA: i64 = 50;
/// How much the error of H may differ between the first and the last fourth; the stiff springs exchange energy slowly.
const BOUNDED: f64 = 4.0;
/// The springs leave a gap of instability that is narrower.
const NARROW: f64 = 0.05;
/// log₁₀ of the largest error that is drawn.
const LARGEST_DRAWN: f64 = 2.0;

impl Case for StiffSprings {
    type Measured = LongRun;

    fn complete(scheme: &Examined, mut values: Values) -> Option<Values> {
        let stability = Stability::of_scheme(scheme.scheme.scheme.proved());
        let part = exact(values["aside"]["part"].as_str()?).expect("it is exact");
        let limit = stability.and_then(|stability| exact(&stability.limit).ok()).unwrap_or_else(|| part.clone());
        values.insert("h".to_owned(), to_text(&(limit * part / Rational::from_integer(OMEGA.into()))).into());
        Some(values)
    }

    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<LongRun, Error> {
        Ok(long_run::measure(trial, continues))
    }

    fn judge(all: &[&Done<'_, LongRun>]) -> Vec<Row> {
        let trial = &all[0].trial;
        let stability = Stability::of_scheme(trial.scheme().scheme.proved());
        let gap = stability.and_then(|stability| Some(stability.gaps.first()?.width)).unwrap_or(f64::INFINITY);
        let part = |one: &Done<'_, LongRun>| one.trial.get::<String>("part");
        let described = |one: &&Done<'_, LongRun>| {
            let (part, said) = (part(one), if one.found.watched.fine { "fine" } else { "reported" });
            match one.found.is_bounded(BOUNDED) {
                true => format!("{part}: bounded, error of H {:.1e}, {said}", one.found.energy_errors[0]),
                false => format!("{part}: grows, {said}"),
            }
        };
        let found = format!("parts of the limit, before a gap of {gap:.1e}: {}", joined(all, "; ", described));
        let verdict = |one: &&Done<'_, LongRun>| {
            let bounded = one.found.is_bounded(BOUNDED);
            let as_predicted = match &*part(one) {
                "201/200" => !bounded || gap < NARROW,
                "199/200" => true,
                _ => bounded,
            };
            Verdict::from(as_predicted && (bounded || !one.found.watched.fine))
        };
        let of_limit = |part: &str| exact(part).map_or(f64::NAN, |part| <f64 as Number>::from_rational(&part, &()));
        let points = all.iter().map(|one| (of_limit(&part(one)), one.found.energy_errors[0].log10()));
        let drawn = points.filter(|(_, error)| *error <= LARGEST_DRAWN);
        vec![Row::of(trial, found, Verdict::of_all(all.iter().map(verdict))).with(drawn)]
    }
}
