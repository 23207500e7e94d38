//! The chain of Fermi, Pasta, Ulam and Tsingou to its recurrence.

use std::f64::consts::PI;

use crate::stability::prelude::*;
use crate::stability::watched::watched;

/// The case.
pub(super) struct Fput;

/// The energy of the first mode.
#[derive(Serialize, Deserialize)]
pub(super) struct Recurrence {
    watched: Watched,
    /// The time and the part of the initial energy of the first mode, at equal intervals.
    first_mode: Vec<(f64, f64)>,
}

const BODIES: usize = 32;
const SAMPLES: u64 = 400;
/// Fermi, Pasta, Ulam and Tsingou found the energy back in the first mode to 3 % after 29 000 steps of √(1/8), t = 10
/// 250.
const RECURS: (f64, f64) = (9_800.0, 10_700.0);
const BACK: f64 = 0.95;
const SPREAD: f64 = 0.3;

impl Case for Fput {
    type Measured = Recurrence;

    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<Recurrence, Error> {
        let (evaluations, steps_a_unit) = (trial.evaluations(), trial.get::<u64>("steps_a_unit"));
        let steps = trial.get::<u64>("until") * steps_a_unit / evaluations;
        let run = &mut *trial.start(&shipped("fput-alpha", &[]), &trial.step());
        let initial = energy_of_first_mode(run);
        let time = |n: u64| n as f64 * evaluations as f64 / steps_a_unit as f64;
        let mut first_mode = vec![(0.0, 1.0)];
        let watched = watched(run, (steps / 256).max(1), steps, continues, &mut |n, run| {
            if n % (steps / SAMPLES) == 0 {
                first_mode.push((time(n), energy_of_first_mode(run) / initial));
            }
            ControlFlow::Continue(())
        });
        Ok(Recurrence { watched, first_mode })
    }

    fn judge(all: &[&Done<'_, Recurrence>]) -> Vec<Row> {
        let Done { trial, found } = all[0];
        let least = found.first_mode.iter().map(|(_, part)| *part).fold(1.0, f64::min);
        let late = found.first_mode.iter().filter(|(t, _)| *t > RECURS.0 / 2.0);
        let (time, back) = late.copied().fold((0.0, 0.0), |best, point| if point.1 > best.1 { point } else { best });
        let what = format!(
            "the first mode has {:.1} % of its energy at least, and {:.1} % again at t = {time:.0}; the monitor: {}",
            100.0 * least,
            100.0 * back,
            found.watched.verdict
        );
        let recurs = (RECURS.0..RECURS.1).contains(&time) && back > BACK && least < SPREAD;
        let verdict = Verdict::of_all([Verdict::from(recurs), found.watched.is_fine()]);
        vec![Row::of(trial, what, verdict).with(found.first_mode.clone())]
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
