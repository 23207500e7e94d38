//! Stiff springs with steps up to their stability limit.

use shadowstep::{Number, Rational, exact};
use shadowstep_analysis::stability::Stability;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;
use shadowstep_symbolic::decimal::to_text;

use crate::long_run::{LongCase, LongRun, LongRunResult};
use crate::suite::{Examined, Suite};

/// The case.
pub(super) struct StiffSprings;

/// hω as parts of the stability limit: for Störmer–Verlet hω = 1.5, 1.9, 1.99, 2.01, with ω = 50.
const PARTS: [&str; 4] = ["3/4", "19/20", "199/200", "201/200"];
const OMEGA: i64 = 50;
/// How much the error of H may differ between the first and the last fourth; the stiff springs exchange energy slowly.
const BOUNDED: f64 = 4.0;
/// The springs leave a gap of instability that is narrower.
const NARROW: f64 = 0.05;
/// log₁₀ of the largest error that is drawn.
const LARGEST_DRAWN: f64 = 2.0;
const SCHEMES: [&str; 4] = ["stormer-verlet", "mclachlan-sb3a4", "blanes-moan-s6", "blanes-moan-srkn6b"];

impl LongCase for StiffSprings {
    const NAME: &'static str = "stiff-springs";
    const TITLE: &'static str = "Stiff springs up to the stability limit";
    const THEORY: &'static str = "Three stiff springs of ω = 50 in a chain with soft ones, which raise the stiff \
        frequencies by a part of 1e-3 and more as amplitudes grow. With hω at 0.75 and 0.95 of the stability limit \
        all stays bounded; at 0.995 a step that enlarges amplitudes may be carried beyond the limit. At 1.005 \
        amplitudes grow, unless the unstable gap is so narrow that they leave it as the frequency shifts. What grows \
        is not called fine.";
    const REVISION: u32 = 3;
    const EVALUATION: f64 = 60e-9;

    fn runs(suite: &Suite) -> Vec<LongRun> {
        let steps = suite.full_or_quick(200_000, 10_000);
        let of = |scheme: &&Examined| {
            let limit = Stability::of_scheme(scheme.scheme.scheme.proved()).map(|stability| stability.limit);
            let limit = limit.and_then(|limit| exact(&limit).ok());
            PARTS.map(|part| {
                let part = exact(part).expect("it is exact");
                let h = limit.clone().unwrap_or(part.clone()) * part / Rational::from_integer(OMEGA.into());
                LongRun { scheme: scheme.identity.clone(), problem: "fput-stiff", h: to_text(&h), steps, about: 0 }
            })
        };
        suite.schemes_or(&SCHEMES).iter().flat_map(of).collect()
    }

    fn judge(suite: &Suite, measured: &[(LongRun, LongRunResult)]) -> Finding {
        let (mut finding, mut curves) = (Finding::default(), Vec::new());
        for all in measured.chunk_by(|(one, _), (other, _)| one.scheme == other.scheme) {
            let named = suite.scheme(&all[0].0.scheme);
            let stability = Stability::of_scheme(named.scheme.proved());
            let first_gap =
                stability.and_then(|stability| Some(stability.gaps.first()?.width)).unwrap_or(f64::INFINITY);
            let (mut parts, mut verdicts) = (Vec::new(), Vec::new());
            for ((_, stayed), part) in all.iter().zip(PARTS) {
                let bounded = stayed.is_bounded(BOUNDED);
                let said = if stayed.watched.fine { "fine" } else { "reported" };
                parts.push(match bounded {
                    true => format!("{part}: bounded, error of H {:.1e}, {said}", stayed.energy_errors[0]),
                    false => format!("{part}: grows, {said}"),
                });
                let as_predicted = match part {
                    "201/200" => !bounded || first_gap < NARROW,
                    "199/200" => true,
                    _ => bounded,
                };
                verdicts.push(Verdict::from(as_predicted && (bounded || !stayed.watched.fine)));
            }
            let found = format!("parts of the limit, before a gap of {first_gap:.1e}: {}", parts.join("; "));
            finding.check(&named.name, found, Verdict::of_all(verdicts));
            let of_limit = |part: &str| exact(part).map_or(f64::NAN, |part| <f64 as Number>::from_rational(&part, &()));
            let points =
                all.iter().zip(PARTS).map(|((_, stayed), part)| (of_limit(part), stayed.energy_errors[0].log10()));
            let points: Vec<_> = points.filter(|(_, error)| *error <= LARGEST_DRAWN).collect();
            curves.push(Curve::marked(named.name.clone(), points, curves.len()));
        }
        let (x, y) = (
            Axis::linear("hω as a part of the stability limit"),
            Axis::log10("largest error of H in the first fourth"),
        );
        finding.chart(
            Chart::new("The error of H near the stability limit", x, y, curves),
            "A curve ends where the springs run away.",
        );
        finding
    }
}
