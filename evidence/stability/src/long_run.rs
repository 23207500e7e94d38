//! Long runs of shipped problems: whether the energy error stays bounded and the bodies stay where they are.

use serde::{Deserialize, Serialize};
use shadowstep::{Number, Rational, Scheme};
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::start::Begin;
use shadowstep_studies::Continues;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;
use shadowstep_symbolic::decimal::to_text;

use crate::case::Case;
use crate::integrator::{AnyIntegrator, start_in, step_size, steps_of};
use crate::suite::{Examined, Suite};
use crate::systems::shipped;
use crate::watched::{Next, Watched, watched};

/// A run of a scheme on a shipped problem.
#[derive(Serialize)]
pub(crate) struct LongRun {
    pub(crate) scheme: String,
    pub(crate) problem: &'static str,
    /// The step size, exact.
    pub(crate) h: String,
    pub(crate) steps: u64,
    /// How many of the first coordinates are those of the body from which positions are measured; 0 for the origin.
    pub(crate) about: usize,
}

/// What it has shown.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct LongRunResult {
    pub(crate) watched: Watched,
    /// The largest |H − H(0)| as a part of |H(0)|, in each fourth of the run, over some states.
    pub(crate) energy_errors: [f64; 4],
    /// The times of equal parts of the run, and the largest error in each.
    pub(crate) envelope: Vec<(f64, f64)>,
    /// The largest coordinate of all states, about that body, beside the largest one at the start.
    pub(crate) farthest: f64,
}

/// The monitor has about this number of windows.
const WINDOWS: u64 = 256;
/// Charts have the largest error of H in each of this number of parts of a run.
const PARTS: usize = 60;
/// H is computed at this number of states.
const ENERGIES: u64 = 20_000;
/// How much the error of H may differ between the first and the last fourth, if it is the same oscillation.
const SAME: f64 = 1.5;
/// A body is lost if a coordinate is this many times as large as at the start.
const LOST: f64 = 100.0;

impl LongRun {
    /// Runs of schemes to about `until`, with steps of so much for each force evaluation.
    pub(crate) fn at_equal_cost(
        schemes: &[&Examined],
        problem: &'static str,
        h_per_evaluation: &Rational,
        until: f64,
    ) -> Vec<LongRun> {
        let run = |scheme: &&Examined| {
            let h = h_per_evaluation * Rational::from_integer(scheme.scheme.scheme.summary().evaluations.into());
            let steps = (until / <f64 as Number>::from_rational(&h, &())).round() as u64;
            LongRun { scheme: scheme.identity.clone(), problem, h: to_text(&h), steps, about: 0 }
        };
        schemes.iter().map(run).collect()
    }

    fn make(&self, suite: &Suite, arithmetic: Arithmetic, continues: Continues<'_>) -> LongRunResult {
        let h = step_size(&*self.h);
        let run = &mut *start_in(
            arithmetic,
            &shipped(self.problem, &[]),
            steps_of(suite.scheme(&self.scheme), &h, Begin::Step),
        );
        let initial = run.energy();
        let size = |run: &dyn AnyIntegrator| {
            let origin = |i: usize| if self.about > 0 { run.q(i % self.about) } else { 0.0 };
            (0..run.dimension()).map(|i| (run.q(i) - origin(i)).abs()).fold(0.0, f64::max)
        };
        let begin = size(run);
        let (every, steps) = ((self.steps / ENERGIES).max(1), self.steps);
        let (mut farthest, mut energy_errors) = (1.0_f64, [0.0_f64; 4]);
        let duration = <f64 as Number>::from_rational(h.exact(), &()) * steps as f64;
        let mut envelope: Vec<_> = (1..=PARTS).map(|i| (duration * i as f64 / PARTS as f64, 0.0_f64)).collect();
        let watched = watched(run, (steps / WINDOWS).max(1), steps, continues, &mut |n, run| {
            if n % every == 0 {
                let error = (run.energy() - initial).abs() / initial.abs();
                let fourth = (4 * (n - 1) / steps) as usize;
                // JSON has no infinity
                energy_errors[fourth] = energy_errors[fourth].max(error).min(f64::MAX);
                let part = &mut envelope[((PARTS as u64 * (n - 1)) / steps) as usize].1;
                *part = part.max(error).min(f64::MAX);
                farthest = farthest.max(size(run) / begin).min(f64::MAX);
            }
            Next::Continue
        });
        envelope.retain(|(_, error)| *error > 0.0);
        LongRunResult { watched, energy_errors, envelope, farthest }
    }
}

/// A case of such runs.
pub(crate) trait LongCase {
    /// As those of a [`Case`].
    const NAME: &'static str;
    const TITLE: &'static str;
    const THEORY: &'static str;
    const REVISION: u32;
    /// The approximate time of a force evaluation in double precision, in seconds.
    const EVALUATION: f64;

    /// All runs.
    fn runs(suite: &Suite) -> Vec<LongRun>;

    /// The number type of the runs.
    fn arithmetic(suite: &Suite) -> Arithmetic {
        suite.arithmetic
    }

    /// What the runs show.
    fn judge(suite: &Suite, measured: &[(LongRun, LongRunResult)]) -> Finding;
}

impl<C: LongCase> Case for C {
    const NAME: &'static str = C::NAME;
    const TITLE: &'static str = C::TITLE;
    const THEORY: &'static str = C::THEORY;
    const REVISION: u32 = C::REVISION;

    type Trial = LongRun;
    type Measured = LongRunResult;

    fn trials(suite: &Suite) -> Vec<LongRun> {
        C::runs(suite)
    }

    fn arithmetic(suite: &Suite) -> Arithmetic {
        C::arithmetic(suite)
    }

    fn seconds(suite: &Suite, run: &LongRun) -> f64 {
        run.steps as f64 * suite.scheme(&run.scheme).scheme.summary().evaluations as f64 * C::EVALUATION
    }

    fn measure(
        suite: &Suite,
        run: &LongRun,
        arithmetic: Arithmetic,
        continues: Continues<'_>,
    ) -> Result<LongRunResult, Error> {
        Ok(run.make(suite, arithmetic, continues))
    }

    fn judge(suite: &Suite, measured: &[(LongRun, LongRunResult)]) -> Finding {
        C::judge(suite, measured)
    }
}

/// Orbits that stay where they are: no coordinate is larger than `stays` times the largest one at the start, the error
/// of H is at most 1.5 times as large in the last fourth of the run as in the first, and the monitor calls the step
/// fine.
pub(crate) fn staying(
    (suite, measured): (&Suite, &[(LongRun, LongRunResult)]),
    stays: f64,
    title: &str,
    unit: &str,
) -> Finding {
    let mut finding = Finding::default();
    for (run, stayed) in measured {
        let found = format!(
            "{} steps of {} {unit}: no coordinate beyond {:.3} of the largest initial one; {}; the monitor: {}",
            run.steps,
            run.h,
            stayed.farthest,
            stayed.errors(),
            stayed.watched.verdict
        );
        let bounded = Verdict::from(stayed.is_bounded(SAME) && stayed.farthest <= stays);
        let verdict = Verdict::of_all([bounded, stayed.watched.is_fine()]);
        finding.check(&suite.scheme(&run.scheme).name, found, verdict);
    }
    let runs = measured.iter().map(|(run, stayed)| (suite.scheme(&run.scheme).name.clone(), stayed));
    finding.chart(envelopes(title, unit, runs), "Each point is the largest error in a 60th of the run.");
    finding
}

/// The largest error of H in the parts of several runs.
fn envelopes<'a>(title: &str, unit: &str, runs: impl Iterator<Item = (String, &'a LongRunResult)>) -> Chart {
    let curve = |(i, (label, stayed)): (usize, (String, &LongRunResult))| {
        Curve::line(label, stayed.envelope.iter().map(|(t, error)| (*t, error.log10())).collect(), i)
    };
    let (x, y) = (Axis::linear(unit), Axis::log10("largest error of H, as a part of H(0)"));
    Chart::new(title, x, y, runs.enumerate().map(curve).collect())
}

impl LongRunResult {
    /// Whether the energy error of the last fourth is at most `factor` times that of the first one.
    pub(crate) fn is_bounded(&self, factor: f64) -> bool {
        self.watched.finite && self.farthest <= LOST && self.energy_errors[3] <= factor * self.energy_errors[0]
    }

    /// The energy errors in words.
    pub(crate) fn errors(&self) -> String {
        let [first, .., last] = self.energy_errors;
        format!("error of H {first:.1e} in the first fourth, {last:.1e} in the last")
    }
}
