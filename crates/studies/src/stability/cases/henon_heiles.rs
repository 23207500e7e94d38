//! Hénon–Heiles: regular, chaotic, escaping.

use std::collections::HashMap;

use crate::stability::prelude::*;

/// The case.
pub(super) struct HenonHeiles;

/// What a run has shown.
#[derive(Serialize, Deserialize)]
pub(super) struct Measured {
    watched: Watched,
    /// The largest |H − H(0)|/|H(0)| in each half of the run.
    energy_errors: [f64; 2],
    /// log₁₀ of the growth of a distance at the start, at most 12.
    growth: f64,
    /// The same at some times.
    growing: Vec<(f64, f64)>,
    /// When |q| is first above 2, beyond which nothing returns.
    escaped: Option<u64>,
}

/// Beyond this distance the orbit has left the triangle of the equipotential 1/6, whose corners are at 1.
const OUTSIDE: f64 = 2.0;
/// Regular orbits separate like t, chaotic ones by factors: 1e4 is between the two for t = 1000 and more.
const CHAOTIC: f64 = 5.0;
const BOUNDED: f64 = 1.5;
const NEAR: f64 = 1e-10;
/// The growth is kept at this number of times.
const SAMPLES: u64 = 200;
const STAYS: &str = "It may escape later; a longer run would decide.";

impl Case for HenonHeiles {
    type Measured = Measured;

    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<Measured, Error> {
        let (h, steps) = (trial.step(), trial.steps());
        let length = <f64 as Number>::from_rational(h.exact(), &());
        let starts = trial.get::<HashMap<String, [String; 4]>>("starts");
        let [x, y, px, py] = starts[&trial.get::<String>("kind")].clone();
        let set = [("x", x), ("y", y), ("px", px), ("py", py)];
        let [system, mut beside] = [(); 2].map(|()| shipped("henon-heiles", &set));
        beside.problem.q[0].value += rational(NEAR);
        let [mut run, mut near] = [&system, &beside].map(|system| trial.start(system, &h));
        let initial = run.energy();
        let (mut energy_errors, mut growth, mut growing, mut escaped) = ([0.0_f64; 2], 0.0_f64, Vec::new(), None);
        let watched = trial.watched(&mut *run, continues, &mut |n, run| {
            let [x, y] = [run.q(0), run.q(1)];
            if x.hypot(y) > OUTSIDE {
                escaped = Some(n);
                return ControlFlow::Break(());
            }
            let error = ((run.energy() - initial) / initial).abs();
            let half = usize::from(2 * n > steps);
            energy_errors[half] = energy_errors[half].max(error);
            near.step();
            let distance = (near.q(0) - x).hypot(near.q(1) - y);
            growth = growth.max((distance / NEAR).max(1.0).log10().min(12.0));
            if n * SAMPLES % steps < SAMPLES {
                growing.push((n as f64 * length, growth));
            }
            ControlFlow::Continue(())
        });
        Ok(Measured { watched, energy_errors, growth, growing, escaped })
    }

    fn judge(all: &[&Done<'_, Measured>]) -> Vec<Row> {
        let Done { trial, found: one } = all[0];
        let kind = trial.get::<String>("kind");
        let [first, second] = one.energy_errors;
        let (found, verdict) = match (&*kind, one.escaped) {
            ("Escaping", None) => ("does not escape".to_owned(), Verdict::NotDecided(STAYS)),
            (kind, Some(n)) => (format!("escapes at step {n}"), Verdict::from(kind == "Escaping")),
            (kind, None) => {
                let found = format!(
                    "a distance grows to 1e{:.1} of its size; error of H {first:.1e} and {second:.1e} in the halves; \
                     the monitor: {}",
                    one.growth, one.watched.verdict
                );
                let as_exact = second <= BOUNDED * first && (one.growth > CHAOTIC) == (kind == "Chaotic");
                (found, Verdict::of_all([as_exact.into(), one.watched.is_fine()]))
            }
        };
        let shown = kind.to_lowercase();
        let row = Row::of(trial, format!("{shown}: {found}"), verdict);
        let label = format!("{}, {shown}", trial.name());
        vec![if kind == "Escaping" { row } else { row.with_curve(label, one.growing.clone()) }]
    }
}
