//! What a run of a sweep costs one by one and together with others: CPU time of the process, which computes in one
//! thread, in turns.
//!
//! `cargo bench -p shadowstep-studies --bench together`; with ROUNDS=1 for one round in place of five.

use std::env;
use std::hint::black_box;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use rustix::time::{ClockId, clock_gettime};
use shadowstep::tables::Source;
use shadowstep_scenes::ensemble::Ensemble;
use shadowstep_studies::sweeps::{Manifest, SweepPlan, compute};

/// The sweep of the documentation with fewer places.
const ESCAPE: &str = include_str!("../../../docs/sweeps/henon-heiles-escape.toml");

/// States at the end of long and short runs of Kepler's problem.
const KEPLER: &str = r#"
problem = { name = "kepler", parameters.eccentricity = "e" }
run = { scheme = "yoshida4", step = "h", steps = 2000, digits = "double" }
[axes]
h = "1/20 … 1/100 in 8 values of 1/h"
e = "0 … 8/10 in 250 values"
[keep]
state = true
at_end = { L = "x*py - y*px" }
"#;

fn main() {
    let rounds: usize = env::var("ROUNDS").ok().and_then(|text| text.parse().ok()).unwrap_or(5);
    let escape = ESCAPE.replace("in 250 values", "in 50 values");
    for (name, text) in [
        ("Hénon–Heiles: the time of escape, two of five places have no orbit", escape.clone()),
        ("Hénon–Heiles: H at each of 3000 states", all_energies(&escape)),
        ("Hénon–Heiles: the state after 3000 steps", at_the_end(&escape)),
        ("Kepler: the state after 2000 steps", KEPLER.to_owned()),
        ("Kepler: the state after 100 steps", KEPLER.replace("2000", "100")),
    ] {
        let plan = SweepPlan::of(&Source { path: "sweep.toml".to_owned(), text }).expect("the sweep is valid");
        measure(name, &plan, rounds);
    }
    ensemble(10_000, 1);
    ensemble(10_000, 1000);
    ensemble(10_000, 10_000);
}

fn all_energies(escape: &str) -> String {
    escape.replace("stop = [\"escape\"]", "values = [\"energy_error\"]").replace("energy_error = \"E", "last = \"E")
}

fn at_the_end(escape: &str) -> String {
    let kept = ["first_time = { escape = \"x^2 + y^2 > 9\" }", "stop = [\"escape\"]", "value = \"escape\""];
    kept.iter().fold(escape.to_owned(), |text, line| text.replace(line, ""))
}

fn measure(name: &str, plan: &SweepPlan, rounds: usize) {
    let folder = tempfile::tempdir().expect("there is a temporary folder");
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let runs = plan.axes().runs();
    let (mut alone, mut together, mut reading) = (Vec::new(), Vec::new(), Vec::new());
    for round in 0..rounds {
        let begin = cpu_seconds();
        (0..runs).for_each(|run| _ = black_box(plan.scene(run)));
        reading.push(cpu_seconds() - begin);
        let begin = cpu_seconds();
        (0..runs).for_each(|run| _ = black_box(plan.run(run, &AtomicBool::new(false))));
        alone.push(cpu_seconds() - begin);
        let out = folder.path().join(round.to_string());
        let begin = cpu_seconds();
        let manifest = Manifest::begin(&out, plan, None).expect("the folder can be written");
        let computed = one.install(|| compute(plan, &manifest, &out, manifest.all_chunks(), &mut ()));
        together.push(cpu_seconds() - begin);
        assert_eq!(computed.expect("the runs are made").runs, runs);
    }
    let of_run = |seconds: f64| 1e6 * seconds / runs as f64;
    let (alone, together, reading) = (of_run(median(alone)), of_run(median(together)), of_run(median(reading)));
    println!("{name}: {runs} runs");
    println!("  reading its scene         {reading:8.1} µs a run");
    println!("  one by one, without files {alone:8.1} µs a run");
    println!("  the sweep with its files  {together:8.1} µs a run, {:5.1} times as fast", alone / together);
}

/// An ensemble: columns in a scene, all cores.
fn ensemble(trajectories: u32, steps: u32) {
    let column =
        |f: fn(f64) -> f64| (0..trajectories).map(|t| format!("{:.6}", f(f64::from(t)))).collect::<Vec<_>>().join(", ");
    let text = format!(
        "problem = {{ potential = \"(x^2 + y^2)/2 + x^2*y - y^3/3\", coordinates = [\"x\", \"y\"] }}\n\
         initial = {{ q = [0, \"y0\"], p = [\"0.1 + u\", 0] }}\n\
         run = {{ scheme = \"yoshida4\", step = \"1/10\", steps = {steps}, digits = \"double\" }}\noutput.energy = {{ \
         every = 100 }}\n\
         ensemble.columns = {{ y0 = [{}], u = [{}] }}\n",
        column(|t| 0.1 * (0.7 * t).sin()),
        column(|t| 0.1 * (1.3 * t).cos())
    );
    let begin = cpu_seconds();
    let ensemble = Ensemble::read(Source { path: "scene.toml".to_owned(), text }).expect("the scene is valid");
    let read = cpu_seconds();
    ensemble.run_into(&mut std::io::sink(), || true).expect("the rows are written");
    let of_one = |seconds: f64| 1e6 * seconds / f64::from(trajectories);
    let (read, run) = (of_one(read - begin), of_one(cpu_seconds() - read));
    println!(
        "An ensemble of {trajectories} trajectories of {steps} steps: read {read:.1} µs, computed and written \
            {run:.1} µs a trajectory"
    );
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// CPU time of this process: on a machine with other load, the time on the clock means nothing.
fn cpu_seconds() -> f64 {
    Duration::try_from(clock_gettime(ClockId::ProcessCPUTime)).expect("it is positive").as_secs_f64()
}
