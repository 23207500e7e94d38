//! The pendulum at and around its separatrix.

use serde::{Deserialize, Serialize};
use shadowstep::{Rational, Scheme};
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::start::Begin;
use shadowstep_studies::Continues;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;

use crate::case::Case;
use crate::integrator::{start_in, step_size, steps_of};
use crate::suite::{Examined, OF_ORDERS_2_TO_8, Suite};
use crate::systems::shipped;
use crate::watched::{Next, Watched, watched};

/// The case.
pub(super) struct Pendulum;

/// A start at q = 0.
#[derive(Serialize)]
pub(super) struct Trial {
    scheme: String,
    momentum: &'static str,
    steps: u64,
}

/// How the pendulum moved.
#[derive(Serialize, Deserialize)]
pub(super) struct Moved {
    watched: Watched,
    /// Whether it swung back, and whether it turned over.
    back: bool,
    over: bool,
    /// The largest |H − H(0)|.
    energy_error: f64,
}

/// 2 + d and 2 − d are this far from the separatrix; H is off that by 2d.
const MOMENTA: [&str; 7] = ["1.9", "1.99", "1.999999", "2", "2.000001", "2.01", "2.1"];
/// Steps of 1/20 for each evaluation of the force.
const STEPS_A_UNIT: i64 = 20;

impl Case for Pendulum {
    const NAME: &'static str = "pendulum";
    const TITLE: &'static str = "The pendulum at its separatrix";
    const THEORY: &'static str = "Below p(0) = 2 the pendulum swings, above it turns over. A scheme follows a \
        modified pendulum whose separatrix is off by its energy error: what starts farther from it than that moves as \
        the exact one, what starts nearer may do either. Steps that are too large make a chaotic layer of the \
        separatrix, in which the pendulum does both; only there the monitor does not call the step fine.";
    const REVISION: u32 = 2;

    type Trial = Trial;
    type Measured = Moved;

    fn trials(suite: &Suite) -> Vec<Trial> {
        let steps = suite.full_or_quick(300_000, 20_000);
        let of =
            |scheme: &&Examined| MOMENTA.map(|momentum| Trial { scheme: scheme.identity.clone(), momentum, steps });
        suite.schemes_or(&OF_ORDERS_2_TO_8).iter().flat_map(of).collect()
    }

    fn seconds(suite: &Suite, trial: &Trial) -> f64 {
        trial.steps as f64 * suite.scheme(&trial.scheme).scheme.summary().evaluations as f64 * 60e-9
    }

    fn measure(suite: &Suite, trial: &Trial, arithmetic: Arithmetic, continues: Continues<'_>) -> Result<Moved, Error> {
        let scheme = suite.scheme(&trial.scheme);
        let evaluations = scheme.scheme.summary().evaluations;
        let h = Rational::new(evaluations.into(), STEPS_A_UNIT.into());
        let h = step_size(&h);
        let system = shipped("pendulum", &[("p", trial.momentum.to_owned())]);
        let run = &mut *start_in(arithmetic, &system, steps_of(scheme, &h, Begin::Step));
        let (mut back, mut over, mut energy_error) = (false, false, 0.0_f64);
        let watched = watched(run, (trial.steps / 256).max(1), trial.steps, continues, &mut |_, run| {
            back |= run.p(0) < 0.0;
            over |= run.q(0).abs() > std::f64::consts::PI;
            energy_error = energy_error.max(run.energy_change().abs());
            Next::Continue
        });
        Ok(Moved { watched, back, over, energy_error })
    }

    fn judge(suite: &Suite, measured: &[(Trial, Moved)]) -> Finding {
        let (mut finding, mut curves) = (Finding::default(), Vec::new());
        for all in measured.chunk_by(|(one, _), (other, _)| one.scheme == other.scheme) {
            let (mut parts, mut verdicts) = (Vec::new(), Vec::new());
            for (trial, moved) in all {
                let way = match (moved.back, moved.over) {
                    (true, true) => "both",
                    (true, false) => "swings",
                    (false, true) => "turns over",
                    (false, false) => "neither",
                };
                parts.push(format!("p(0) = {} {way}", trial.momentum));
                verdicts.push(moved.verdict(trial.momentum));
            }
            let largest = all.iter().map(|(_, moved)| moved.energy_error).fold(0.0, f64::max);
            let found = format!("{}; error of H {largest:.1e} at most", parts.join(", "));
            let name = &suite.scheme(&all[0].0.scheme).name;
            finding.check(name, found, Verdict::of_all(verdicts));
            let point = |(trial, moved): &(Trial, Moved)| (momentum(trial.momentum), moved.energy_error.log10());
            curves.push(Curve::marked(name.clone(), all.iter().map(point).collect(), curves.len()));
        }
        let (x, y) = (Axis::linear("p(0); the separatrix is at 2"), Axis::log10("largest error of H"));
        finding.chart(
            Chart::new("The error of H around the separatrix", x, y, curves),
            "Steps of 1/20 for each evaluation.",
        );
        finding
    }
}

fn momentum(text: &str) -> f64 {
    text.parse().expect("it is a number")
}

impl Moved {
    fn verdict(&self, start: &str) -> Verdict {
        let p = momentum(start);
        // H of the start beside that of the separatrix, 1
        let distance = p * p / 2.0 - 2.0;
        let as_exact = if distance < 0.0 { self.back && !self.over } else { self.over && !self.back };
        let decided = distance.abs() > self.energy_error;
        let both = self.back && self.over;
        let said = if both { Verdict::from(!self.watched.fine) } else { self.watched.is_fine() };
        Verdict::of_all([said, Verdict::from(as_exact || !decided)])
    }
}
