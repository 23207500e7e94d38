//! The argon crystal at steps from 10 to 120 femtoseconds.

use shadowstep::{Rational, Scheme};
use shadowstep_analysis::stability::Stability;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;

use crate::long_run::{LongCase, LongRun, LongRunResult};
use crate::suite::{Examined, Suite};
use crate::systems::shipped;

/// The case.
pub(super) struct Argon;

/// Femtoseconds for each force evaluation of a step.
const STEPS: [i64; 7] = [10, 20, 40, 60, 80, 100, 120];
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
const SCHEMES: [&str; 3] = ["stormer-verlet", "yoshida4", "blanes-moan-srkn6b"];

impl LongCase for Argon {
    const NAME: &'static str = "argon";
    const TITLE: &'static str = "A crystal of seven argon atoms at steps from 10 to 120 fs";
    const THEORY: &'static str = "A step is stable while hω is below the stability limit of the scheme. The largest \
        frequency ω of the crystal at its start grows several times in collisions, which reach steeper parts of the \
        potential: up to a fourth of the limit the error of H is bounded, beyond the limit atoms leave, and between \
        these the monitor does not call a step fine with which the error grows.";
    const REVISION: u32 = 4;
    const EVALUATION: f64 = 200e-9;

    fn runs(suite: &Suite) -> Vec<LongRun> {
        let until = suite.full_or_quick(2.0, 0.2);
        let schemes = suite.schemes_or(&SCHEMES);
        let of = |scheme: &&Examined| {
            let steps = STEPS.map(|fs| Rational::new(fs.into(), 1_000_000.into()));
            let runs = steps.map(|h| LongRun::at_equal_cost(&[scheme], "argon-crystal", &h, until));
            runs.into_iter().flatten().collect::<Vec<_>>()
        };
        schemes.iter().flat_map(of).collect()
    }

    fn judge(suite: &Suite, measured: &[(LongRun, LongRunResult)]) -> Finding {
        let omega = shipped("argon-crystal", &[]).fastest_frequency().map_or(f64::NAN, |found| found.omega);
        let (mut finding, mut curves) = (Finding::default(), Vec::new());
        for all in measured.chunk_by(|(one, _), (other, _)| one.scheme == other.scheme) {
            let named = suite.scheme(&all[0].0.scheme);
            let stability = Stability::of_scheme(named.scheme.proved());
            let limit = stability.and_then(|stability| stability.limit.parse::<f64>().ok()).unwrap_or(f64::NAN);
            let evaluations = named.scheme.summary().evaluations as f64;
            let (mut parts, mut verdicts) = (Vec::new(), Vec::new());
            for ((_, stayed), fs) in all.iter().zip(STEPS) {
                let h_omega = fs as f64 * FEMTOSECOND * evaluations * omega;
                let bounded = stayed.is_bounded(BOUNDED) || stayed.energy_errors[3] <= SMALL;
                let stable = stayed.watched.finite && bounded && stayed.farthest < 10.0;
                let state = match (stable, stayed.watched.fine) {
                    (true, true) => "bounded",
                    (true, false) => "bounded, reported",
                    (false, false) => "lost, reported",
                    (false, true) => "lost, not reported",
                };
                parts.push(format!("{:.2} {state}", h_omega / limit));
                verdicts.push(match () {
                    () if h_omega < limit / COLLISIONS => match (stable, stayed.watched.fine) {
                        (true, true) => Verdict::Agrees,
                        // a small error that grows from collision to collision is not conserved, and small all the same
                        (true, false) => Verdict::NotDecided(SMALL_BUT_REPORTED),
                        (false, _) => Verdict::Differs,
                    },
                    () if h_omega > limit => Verdict::from(!stable && !stayed.watched.fine),
                    () => Verdict::from(stable || !stayed.watched.fine),
                });
            }
            let found = format!("hω as a part of the limit {limit:.3}, ω = {omega:.0} per ns: {}", parts.join(", "));
            finding.check(&named.name, found, Verdict::of_all(verdicts));
            let points = all.iter().zip(STEPS).map(|((_, stayed), fs)| (fs as f64, stayed.energy_errors[3].log10()));
            let points: Vec<_> = points.filter(|(_, error)| *error <= LARGEST_DRAWN).collect();
            curves.push(Curve::marked(named.name.clone(), points, curves.len()));
        }
        let (x, y) = (Axis::linear("femtoseconds an evaluation"), Axis::log10("largest error of H in the last fourth"));
        finding.chart(Chart::new("The error of H of the crystal", x, y, curves), "A curve ends where atoms leave.");
        finding
    }
}
