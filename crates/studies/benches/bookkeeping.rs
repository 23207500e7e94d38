//! What a sweep costs besides its steps: reading scenes, keeping records, writing and collecting chunks.
//!
//! `cargo bench -p shadowstep-studies --bench bookkeeping`; with RUNS=100000 for 10⁵ runs, with ROUNDS=1 for one round in place of five.
//! Both contestants make equally many steps on all cores, in turns.

use std::env;
use std::fs;
use std::hint::black_box;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use shadowstep::shadow::run::Trajectory;
use shadowstep::tables::Source;
use shadowstep_scenes::Scene;
use shadowstep_studies::sweeps::{Collected, Manifest, SweepPlan, TableFormat, collect, compute};

/// A run of about 1 ms.
const STEPS: u64 = 32_000;

/// The steps of this number of scenes are made alone, again and again.
const SCENES: u64 = 500;

fn main() {
    let given = |name, default| env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default);
    let (runs, rounds): (u64, u64) = (given("RUNS", 10_000), given("ROUNDS", 5));
    let plan = SweepPlan::of(&Source { path: "sweep.toml".to_owned(), text: text(runs) }).expect("the sweep is valid");
    let scenes = scenes(&plan);
    let folder = tempfile::tempdir().expect("there is a temporary folder");
    let (mut swept, mut bare, mut collected) = (Vec::new(), Vec::new(), Vec::new());
    for round in 0..rounds {
        let out = folder.path().join(round.to_string());
        let begin = Instant::now();
        let manifest = Manifest::begin(&out, &plan, None).expect("the folder can be written");
        compute(&plan, &manifest, &out, manifest.all_chunks(), &mut ()).expect("the runs are made");
        swept.push(begin.elapsed().as_secs_f64());
        let begin = Instant::now();
        let all = collect(&out, TableFormat::Csv, &mut ()).expect("the folder can be written");
        assert!(matches!(all, Collected::Complete { failed: 0, .. }));
        collected.push(begin.elapsed().as_secs_f64());
        let begin = Instant::now();
        steps_alone(&scenes, runs);
        bare.push(begin.elapsed().as_secs_f64());
        if round == 0 {
            let size: u64 =
                fs::read_dir(out.join("chunks")).unwrap().map(|file| file.unwrap().metadata().unwrap().len()).sum();
            println!("{runs} runs of {STEPS} steps; {:.0} bytes a run in the chunks", size as f64 / runs as f64);
        }
        fs::remove_dir_all(&out).expect("the folder can be removed");
    }
    let ratios: Vec<f64> = swept.iter().zip(&bare).map(|(swept, bare)| 1.0 - bare / swept).collect();
    let threads = rayon::current_num_threads() as f64;
    let of_run = |seconds: f64, threads: f64| 1e6 * seconds * threads / runs as f64;
    println!("the sweep             {:8.2} µs a run on each of {threads} threads", of_run(median(&swept), threads));
    println!("its steps alone       {:8.2} µs a run", of_run(median(&bare), threads));
    println!("lost to bookkeeping   {:8.2} % of the sweep", 100.0 * median(&ratios));
    println!("collecting            {:8.2} µs a run on one thread", of_run(median(&collected), 1.0));
}

fn text(runs: u64) -> String {
    let eccentricities = runs.div_ceil(1000);
    format!(
        "problem = {{ name = \"kepler\", parameters.eccentricity = \"e\" }}\n\
         run = {{ scheme = \"stormer-verlet\", step = \"h\", steps = {STEPS}, digits = \"double\" }}\n\
         [axes]\ne = \"0 … 8/10 in {} values\"\nh = \"1/20 … 1/100 in 1000 values of 1/h\"\n\
         [keep]\nstate = true\nat_end = {{ r = \"sqrt(x^2 + y^2)\", L = \"x*py - y*px\" }}\n",
        eccentricities.max(2)
    )
}

/// Scenes that are read before the clock starts, evenly spread over all runs.
fn scenes(plan: &SweepPlan) -> Vec<Scene> {
    let runs = plan.axes().runs();
    (0..SCENES).map(|k| plan.scene(k * runs / SCENES).expect("the scene is valid")).collect()
}

/// The steps of a number of runs on all cores, without anything else.
fn steps_alone(scenes: &[Scene], runs: u64) {
    let next = AtomicU64::new(0);
    rayon::broadcast(|_| {
        loop {
            let run = next.fetch_add(1, Ordering::Relaxed);
            if run >= runs {
                break;
            }
            follow(&scenes[(run % SCENES) as usize]);
        }
    });
}

fn follow(scene: &Scene) {
    let mut integrator = scene.integrator::<f64>(&()).expect("the dimensions agree");
    let mut trajectory = Trajectory::plain(&mut *integrator, 0, STEPS).expect("the state is finite");
    trajectory.reach(STEPS as i64).expect("the states are finite");
    black_box(trajectory.integrator().state().q());
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[sorted.len() / 2]
}
