//! What round-off makes of the modified energy in double precision: plain sums, compensated ones, and fixed point, over
//! many phases.
//!
//! `cargo bench -p shadowstep-tests --bench round_off` prints the tables of `docs/round-off.md`; `-- STEPS PHASES NAME`
//! sets the length of the runs, how many there are, and the cases whose names contain NAME, such as
//! `-- 1e8 8 yoshida4`.
//!
//! The modified energy is computed at the state in `f64` with its remainders, by steps of 50 digits around it, so that
//! no round-off of the estimate is in the results.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use rug::Float;
use shadowstep::number::Number;
use shadowstep::problems::{HenonHeiles, Kepler};
use shadowstep::shadow::Bilinear;
use shadowstep::shadow::run::ShadowRun;
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::{
    Kinetic, Motion, Potential, Rational, Scheme, Stepper, System, UnitMasses, ValidFor, splitting_scheme,
};
use shadowstep_tests::precision;

#[derive(Clone, Copy)]
#[splitting_scheme("stormer-verlet.toml")]
struct StormerVerlet;

#[derive(Clone, Copy)]
#[splitting_scheme("yoshida4.toml")]
struct Yoshida4;

#[derive(Clone, Copy)]
#[splitting_scheme("blanes-moan-srkn6b.toml")]
struct Srkn6b;

#[derive(Clone, Copy)]
#[splitting_scheme("kahan-li8.toml")]
struct KahanLi8;

/// The modified energy is taken so often.
const SAMPLES: u64 = 16;
const DIGITS: u32 = 50;
const ORDER: u32 = 24;

/// A start in the plane.
type Start = ([f64; 2], [f64; 2]);

/// Eccentricity 0.6, turned by an angle that is different for each phase.
fn comet(phase: usize) -> Start {
    let (sin, cos) = (0.1 + 0.61803398875 * phase as f64).sin_cos();
    ([0.4 * cos, 0.4 * sin], [-2.0 * sin, 2.0 * cos])
}

/// On regular orbits.
fn star(phase: usize) -> Start {
    let (sin, cos) = (0.1 + 0.61803398875 * phase as f64).sin_cos();
    ([0.1 * cos, 0.12 * sin], [0.11 * sin, 0.1 * cos])
}

/// Steps to the next apocentre, where the estimates of the modified energy are best: there qᵀp changes its sign from +
/// to −.
fn step_to_apocentre<S: Scheme + ValidFor<M::Class>, M: System<Number = f64>>(
    stepper: &Stepper<S, f64>,
    system: &mut M,
) {
    let radial = |system: &M| system.state().q().iter().zip(system.state().p()).map(|(q, p)| q * p).sum::<f64>();
    loop {
        let before = radial(system);
        stepper.step(system);
        if before > 0.0 && radial(system) <= 0.0 {
            return;
        }
    }
}

/// H̄ of a state with its remainders.
fn modified<S, P>(scheme: S, h: &str, potential: P, system: &impl System<Number = f64>) -> Float
where
    S: Scheme + Copy + ValidFor<Quadratic>,
    P: Potential<Float>,
    UnitMasses: Kinetic<Float, Class = Quadratic>,
{
    let context = precision(DIGITS);
    let number = |x: f64| Float::from_rational(&Rational::from_float(x).expect("states are finite"), &context);
    let rest = system.state().remainders();
    let with = |values: &[f64], rest: &[f64]| -> Vec<Float> {
        let rest = rest.iter().copied().chain(std::iter::repeat(0.0));
        values.iter().zip(rest).map(|(x, rest)| number(*x) + number(rest)).collect()
    };
    let motion =
        Motion::new(potential, UnitMasses, with(system.state().q(), &rest.q), with(system.state().p(), &rest.p));
    let stepper = Stepper::with_context(scheme, h, &context).expect("a step size");
    let motion = motion.expect("the dimensions agree");
    let mut run = ShadowRun::new(stepper.with(motion), 0, &Bilinear::new(ORDER)).expect("finite states");
    run.advance().expect("finite states").expect("an estimate").1.value.clone()
}

/// H̄ − H̄(0) after each part of a run.
#[inline(never)]
fn follow<S, P, M>(scheme: S, h: &str, potential: P, mut system: M, steps: u64, at_apocentres: bool) -> Vec<f64>
where
    S: Scheme + Copy + ValidFor<Quadratic>,
    P: Potential<Float> + Copy,
    M: System<Number = f64, Class = Quadratic>,
{
    let stepper = Stepper::<_, f64>::new(scheme, h).expect("a step size");
    let mut initial = None;
    let mut found = Vec::new();
    for sample in 0..=SAMPLES {
        for _ in 0..if sample == 0 { 0 } else { steps / SAMPLES } {
            stepper.step(&mut system);
        }
        if at_apocentres {
            step_to_apocentre(&stepper, &mut system);
        }
        let value = modified(scheme, h, potential, &system);
        let initial = initial.get_or_insert_with(|| value.clone());
        found.push((value - &*initial).to_f64());
    }
    found
}

/// How increments are added.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sums {
    Plain,
    Compensated,
    FixedPoint,
}

fn run<S, P>(scheme: S, h: &str, potential: P, (q, p): Start, steps: u64, sums: Sums, at_apocentres: bool) -> Vec<f64>
where
    S: Scheme + Copy + ValidFor<Quadratic>,
    P: Potential<f64> + Potential<Float> + Copy,
{
    let motion = Motion::new(potential, UnitMasses, q, p).expect("the dimensions agree");
    match sums {
        Sums::Plain => follow(scheme, h, potential, motion, steps, at_apocentres),
        Sums::Compensated => follow(scheme, h, potential, motion.compensated(), steps, at_apocentres),
        Sums::FixedPoint => {
            let motion = motion.fixed_point(&[2.0; 2], &[4.0; 2]).expect("within the ranges");
            follow(scheme, h, potential, motion, steps, at_apocentres)
        }
    }
}

/// A problem, a scheme and a step size, with the runs of all phases.
struct Case {
    name: String,
    of: Box<dyn Fn(usize, u64, Sums) -> Vec<f64> + Sync>,
}

fn kepler<S: Scheme + Copy + Sync + ValidFor<Quadratic> + 'static>(name: &str, scheme: S, h: &'static str) -> Case {
    let of = move |phase, steps, sums| run(scheme, h, Kepler, comet(phase), steps, sums, true);
    Case { name: format!("Kepler, {name}, h = {h}"), of: Box::new(of) }
}

fn henon_heiles<S: Scheme + Copy + Sync + ValidFor<Quadratic> + 'static>(
    name: &str,
    scheme: S,
    h: &'static str,
) -> Case {
    let of = move |phase, steps, sums| run(scheme, h, HenonHeiles, star(phase), steps, sums, false);
    Case { name: format!("Hénon–Heiles, {name}, h = {h}"), of: Box::new(of) }
}

/// The runs of all phases, on all cores.
fn all(case: &Case, phases: usize, steps: u64, sums: Sums) -> Vec<Vec<f64>> {
    let (next, found) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                loop {
                    let phase = next.fetch_add(1, Ordering::Relaxed);
                    if phase >= phases {
                        break;
                    }
                    let run = (case.of)(phase, steps, sums);
                    found.lock().expect("no thread panics").push(run);
                }
            });
        }
    });
    found.into_inner().expect("no thread panics")
}

fn root_mean_square(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let count = values.clone().count() as f64;
    (values.map(|x| x * x).sum::<f64>() / count).sqrt()
}

fn row(case: &Case, phases: usize, steps: u64, sums: Sums) {
    let runs = all(case, phases, steps, sums);
    let at = |sample: usize| root_mean_square(runs.iter().map(|run| run[sample]));
    let last = SAMPLES as usize;
    // from a quarter of the run to all of it
    let exponent = (at(last) / at(last / 4)).log2() / 2.0;
    let changes: Vec<f64> = runs.iter().map(|run| run[last]).collect();
    let mean = changes.iter().sum::<f64>() / phases as f64;
    let spread = root_mean_square(changes.iter().map(|change| change - mean)) / ((phases - 1) as f64).sqrt();
    let largest = runs.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    println!(
        "| {} | {sums:?} | {:.1e} | {largest:.1e} | {exponent:.2} | {mean:.1e} ± {spread:.1e} |",
        case.name,
        at(last)
    );
}

/// Steps in fixed point and back, to the bits of the start.
fn reversed(steps: u64) {
    let motion = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]).expect("the dimensions agree");
    let mut motion = motion.fixed_point(&[2.0; 2], &[4.0; 2]).expect("within the ranges");
    let stepper = Stepper::<_, f64>::new(Yoshida4, "1/20").expect("a step size");
    (0..steps).for_each(|_| stepper.step(&mut motion));
    let there = motion.q()[0];
    (0..steps).for_each(|_| stepper.step_back(&mut motion));
    let back = motion.q().iter().chain(motion.p()).map(|x| x.to_bits());
    let same = back.eq([0.4_f64, 0.0, 0.0, 2.0].map(f64::to_bits));
    println!(
        "\nKepler, yoshida4, h = 1/20, fixed point: {steps:e} steps to x = {there:.3} and back, the same bits: {same}"
    );
}

fn main() {
    let mut arguments = std::env::args().skip(1).filter(|argument| !argument.starts_with("--"));
    let mut number = |default: f64| arguments.next().map_or(default, |text| text.parse().expect("a number"));
    let (steps, phases) = (number(1e6) as u64, number(32.0) as usize);
    let part = arguments.next().unwrap_or_default();
    println!("{steps:e} steps, {phases} phases\n");
    println!(
        "| problem, scheme, step | sums | rms of H̄ − H̄(0) | largest | grows like n to the | mean over the phases |"
    );
    println!("| --- | --- | --- | --- | --- | --- |");
    for case in [
        kepler("stormer-verlet", StormerVerlet, "1/20"),
        kepler("stormer-verlet", StormerVerlet, "1/200"),
        kepler("yoshida4", Yoshida4, "1/20"),
        kepler("yoshida4", Yoshida4, "1/200"),
        kepler("blanes-moan-srkn6b", Srkn6b, "1/40"),
        kepler("kahan-li8", KahanLi8, "1/40"),
        henon_heiles("stormer-verlet", StormerVerlet, "1/20"),
        henon_heiles("yoshida4", Yoshida4, "1/20"),
    ]
    .into_iter()
    .filter(|case| case.name.contains(&part))
    {
        for sums in [Sums::Plain, Sums::Compensated, Sums::FixedPoint] {
            row(&case, phases, steps, sums);
        }
    }
    reversed(steps);
}
