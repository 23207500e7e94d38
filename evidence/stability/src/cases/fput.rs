//! The chain of Fermi, Pasta, Ulam and Tsingou to its recurrence.

use std::f64::consts::PI;

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
use crate::integrator::{AnyIntegrator, start_in, step_size, steps_of};
use crate::suite::{Examined, OF_ORDERS_2_TO_8, Suite};
use crate::systems::shipped;
use crate::watched::{Next, Watched, watched};

/// The case.
pub(super) struct Fput;

/// A run of the chain of 32 bodies from its first mode.
#[derive(Serialize)]
pub(super) struct Trial {
    scheme: String,
    until: u32,
}

/// The energy of the first mode.
#[derive(Serialize, Deserialize)]
pub(super) struct Recurrence {
    watched: Watched,
    /// The time and the part of the initial energy of the first mode, at equal intervals.
    first_mode: Vec<(f64, f64)>,
}

const BODIES: usize = 32;
const SAMPLES: u64 = 400;
/// Steps of 1/10 for each evaluation: the fastest mode has ω = 2.
const STEPS_A_UNIT: i64 = 10;
/// Fermi, Pasta, Ulam and Tsingou found the energy back in the first mode to 3 % after 29 000 steps of √(1/8), t = 10
/// 250.
const RECURS: (f64, f64) = (9_800.0, 10_700.0);
const BACK: f64 = 0.95;
const SPREAD: f64 = 0.3;

impl Case for Fput {
    const NAME: &'static str = "fput";
    const TITLE: &'static str = "The chain of Fermi, Pasta, Ulam and Tsingou to its recurrence";
    const THEORY: &'static str = "The energy leaves the first mode, for all but a few per cent of it, and comes back \
        to 97 % at t = 10 250 (the report of 1955: 29 000 steps of √(1/8)): the chain is nearly integrable. A \
        symplectic scheme that resolves the fastest mode shows it, and the monitor calls the step fine.";
    const REVISION: u32 = 2;

    type Trial = Trial;
    type Measured = Recurrence;

    fn trials(suite: &Suite) -> Vec<Trial> {
        let schemes = suite.schemes_or(&OF_ORDERS_2_TO_8);
        schemes.iter().map(|scheme: &&Examined| Trial { scheme: scheme.identity.clone(), until: 12_000 }).collect()
    }

    fn seconds(_: &Suite, trial: &Trial) -> f64 {
        f64::from(trial.until) * STEPS_A_UNIT as f64 * 500e-9
    }

    fn measure(
        suite: &Suite,
        trial: &Trial,
        arithmetic: Arithmetic,
        continues: Continues<'_>,
    ) -> Result<Recurrence, Error> {
        let scheme = suite.scheme(&trial.scheme);
        let evaluations = scheme.scheme.summary().evaluations;
        let h = Rational::new(evaluations.into(), STEPS_A_UNIT.into());
        let steps = u64::from(trial.until) * STEPS_A_UNIT as u64 / evaluations as u64;
        let h = step_size(&h);
        let run = &mut *start_in(arithmetic, &shipped("fput-alpha", &[]), steps_of(scheme, &h, Begin::Step));
        let initial = energy_of_first_mode(run);
        let time = |n: u64| n as f64 * evaluations as f64 / STEPS_A_UNIT as f64;
        let mut first_mode = vec![(0.0, 1.0)];
        let watched = watched(run, (steps / 256).max(1), steps, continues, &mut |n, run| {
            if n % (steps / SAMPLES) == 0 {
                first_mode.push((time(n), energy_of_first_mode(run) / initial));
            }
            Next::Continue
        });
        Ok(Recurrence { watched, first_mode })
    }

    fn judge(suite: &Suite, measured: &[(Trial, Recurrence)]) -> Finding {
        let mut finding = Finding::default();
        let mut curves = Vec::new();
        for (i, (trial, found)) in measured.iter().enumerate() {
            let name = &suite.scheme(&trial.scheme).name;
            let least = found.first_mode.iter().map(|(_, part)| *part).fold(1.0, f64::min);
            let late = found.first_mode.iter().filter(|(t, _)| *t > RECURS.0 / 2.0);
            let (time, back) =
                late.copied().fold((0.0, 0.0), |best, point| if point.1 > best.1 { point } else { best });
            let what = format!(
                "the first mode has {:.1} % of its energy at least, and {:.1} % again at t = {time:.0}; the monitor: {}",
                100.0 * least,
                100.0 * back,
                found.watched.verdict
            );
            let recurs = (RECURS.0..RECURS.1).contains(&time) && back > BACK && least < SPREAD;
            finding.check(name, what, Verdict::of_all([Verdict::from(recurs), found.watched.is_fine()]));
            curves.push(Curve::line(name.clone(), found.first_mode.clone(), i));
        }
        let (x, y) = (Axis::linear("t"), Axis::linear("part of its initial energy").over(0.0, 1.05));
        finding.chart(
            Chart::new("The energy of the first mode", x, y, curves),
            "32 bodies, α = 1/4, from the first mode at rest with the largest displacement 1.",
        );
        finding
    }
}

/// ½(P² + ω²Q²) of the first mode, with Q = √(2/33) Σ q_i sin(πi/33) and ω = 2 sin(π/66).
fn energy_of_first_mode(run: &dyn AnyIntegrator) -> f64 {
    let walls = (BODIES + 1) as f64;
    let along = |value: &dyn Fn(usize) -> f64| -> f64 {
        let products = (0..run.dimension()).map(|i| value(i) * (PI * (i + 1) as f64 / walls).sin());
        (2.0 / walls).sqrt() * products.sum::<f64>()
    };
    let omega = 2.0 * (PI / (2.0 * walls)).sin();
    (along(&|i| run.p(i)).powi(2) + (omega * along(&|i| run.q(i))).powi(2)) / 2.0
}
