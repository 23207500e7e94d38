//! Long runs of shipped problems: whether the energy error stays bounded and the bodies stay where they are.

use serde::{Deserialize, Serialize};
use shadowstep::number::Rounded;
use shadowstep::{Number, Rational, Scheme};
use shadowstep_report::chart::{Axis, Chart, Curve};
use shadowstep_scenes::Error;
use shadowstep_symbolic::decimal::to_text;

use crate::case::Continues;
use crate::suite::Suite;
use crate::watched::{Next, Watched, setup, watched};

/// A run of a scheme on a shipped problem.
#[derive(Serialize)]
pub(crate) struct LongRun {
    pub(crate) scheme: String,
    pub(crate) problem: &'static str,
    /// The step size, exact.
    pub(crate) h: String,
    pub(crate) steps: u64,
}

/// What it has shown.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct Stayed {
    pub(crate) watched: Watched,
    /// The largest |H − H(0)| as a part of |H(0)|, in each fourth of the run, over some states.
    pub(crate) energy_errors: [f64; 4],
    /// The times of equal parts of the run, and the largest error in each.
    pub(crate) envelope: Vec<(f64, f64)>,
    /// The largest coordinate of all states, beside the largest one at the start.
    pub(crate) farthest: f64,
}

/// The monitor has about so many windows.
const WINDOWS: u64 = 256;
/// Charts have the largest error of H in so many parts of a run.
const PARTS: usize = 60;
/// H is computed at so many states.
const ENERGIES: u64 = 20_000;
/// A body is lost if a coordinate is this many times as large as at the start.
const LOST: f64 = 100.0;

impl LongRun {
    /// A run with steps of `h_per_evaluation` for each force evaluation of a step, to about `until`.
    pub(crate) fn at_equal_cost(
        (identity, evaluations): (&str, usize),
        problem: &'static str,
        h_per_evaluation: &Rational,
        until: f64,
    ) -> LongRun {
        let h = h_per_evaluation * Rational::from_integer(evaluations.into());
        let steps = (until / <f64 as Number>::from_rational(&h, &())).round() as u64;
        LongRun { scheme: identity.to_owned(), problem, h: to_text(&h), steps }
    }

    /// The approximate time with this many bodies.
    pub(crate) fn seconds(&self, suite: &Suite, evaluation: f64) -> f64 {
        self.steps as f64 * suite.scheme(&self.scheme).scheme.summary().evaluations as f64 * evaluation
    }

    pub(crate) fn make<N: Rounded + 'static>(
        &self,
        suite: &Suite,
        context: &N::Context,
        continues: Continues<'_>,
    ) -> Result<Stayed, Error> {
        let h = shadowstep::exact(&self.h).expect("it is exact");
        let mut motion = setup(self.problem, &[]).motion::<N>(context).expect("masses are positive");
        let initial = motion.energy().to_f64();
        let size = |q: &[N]| q.iter().map(|q| q.to_f64().abs()).fold(0.0, f64::max);
        let begin = size(motion.q());
        let (every, steps) = ((self.steps / ENERGIES).max(1), self.steps);
        let (mut farthest, mut energy_errors) = (1.0_f64, [0.0_f64; 4]);
        let duration = <f64 as Number>::from_rational(&h, &()) * steps as f64;
        let mut envelope: Vec<_> = (1..=PARTS).map(|i| (duration * i as f64 / PARTS as f64, 0.0_f64)).collect();
        let watched = watched(
            (suite.scheme(&self.scheme), &h),
            (steps / WINDOWS).max(1),
            motion,
            steps,
            continues,
            |n, motion| {
                if n % every == 0 {
                    let error = (motion.energy().to_f64() - initial).abs() / initial.abs();
                    let fourth = (4 * (n - 1) / steps) as usize;
                    // JSON has no infinity
                    energy_errors[fourth] = energy_errors[fourth].max(error).min(f64::MAX);
                    let part = &mut envelope[((PARTS as u64 * (n - 1)) / steps) as usize].1;
                    *part = part.max(error).min(f64::MAX);
                    farthest = farthest.max(size(motion.q()) / begin).min(f64::MAX);
                }
                Next::Continue
            },
        );
        envelope.retain(|(_, error)| *error > 0.0);
        Ok(Stayed { watched, energy_errors, envelope, farthest })
    }
}

/// The largest error of H in the parts of several runs.
pub(crate) fn envelopes<'a>(title: &str, unit: &str, runs: impl Iterator<Item = (String, &'a Stayed)>) -> Chart {
    let curve = |(i, (label, stayed)): (usize, (String, &Stayed))| {
        Curve::line(label, stayed.envelope.iter().map(|(t, error)| (*t, error.log10())).collect(), i)
    };
    let (x, y) = (Axis::linear(unit), Axis::log10("largest error of H, as a part of H(0)"));
    Chart::new(title, x, y, runs.enumerate().map(curve).collect())
}

impl Stayed {
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
