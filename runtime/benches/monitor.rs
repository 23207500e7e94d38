//! What the monitor of the modified energy adds to a loop: a hundred bodies, Störmer–Verlet, f64.
//!
//! `cargo bench -p shadowstep --bench monitor`

mod timing;

use std::hint::black_box;

use shadowstep::pairs::{PairPotential, Pairs};
use shadowstep::problems::LennardJones;
use shadowstep::shadow::{Bilinear, BilinearEstimator, ShadowEnergy};
use shadowstep::{Motion, Rational, Scheme, UnitMasses, Weights, exact, potential, splitting_scheme};

use timing::{Contestant, compare};

#[splitting_scheme("stormer-verlet.toml")]
struct StormerVerlet;

potential! {
    /// Gravity that is softened at the distance s.
    struct Plummer { s }
    pair U(r2; m_i, m_j) = -m_i*m_j/sqrt(r2 + s^2)
}

const BODIES: usize = 100;

type Bodies<P> = Motion<f64, Vec<f64>, Pairs<P, 3>, UnitMasses>;

/// At rest on a grid of 5 × 5 × 4 with some disorder.
fn bodies<P: PairPotential<f64>>(pair: P, distance: f64) -> Bodies<P> {
    let place = |i: usize| [i % 5, i / 5 % 5, i / 25].map(|n| n as f64);
    let disorder = |c: usize| (c as f64).sin() / 20.0;
    let q = (0..BODIES).flat_map(place).enumerate().map(|(c, x)| distance * (x + disorder(c))).collect();
    Motion::new(Pairs::all(BODIES, pair), UnitMasses, q, vec![0.0; 3 * BODIES])
}

/// Each run begins at the same state, in vectors of its own: so all make the same steps, and find them at like places.
fn contestant<'a, P: PairPotential<f64> + Clone + 'a>(
    name: &'static str,
    start: Bodies<P>,
    steps: impl Fn(&mut Bodies<P>, &Weights<[f64; 2]>, u32) + 'a,
) -> Contestant<'a> {
    let h = StormerVerlet.weights::<f64>(&step(), &());
    let run = move |repetitions| {
        let mut motion = start.clone();
        steps(&mut motion, &h, repetitions);
        black_box(motion.q());
    };
    (name, Box::new(run))
}

fn step() -> Rational {
    exact("1/1000").expect("exact")
}

#[inline(never)]
fn plain<P: PairPotential<f64>>(motion: &mut Bodies<P>, h: &Weights<[f64; 2]>, repetitions: u32) {
    for _ in 0..repetitions {
        StormerVerlet.step(h, motion);
    }
}

#[inline(never)]
fn augmented<P: PairPotential<f64>>(motion: &mut Bodies<P>, h: &Weights<[f64; 2]>, repetitions: u32) {
    for _ in 0..repetitions {
        StormerVerlet.step_augmented(h, motion);
    }
}

/// With a monitor that is made before.
fn watched<P: PairPotential<f64> + Clone>(
    start: &Bodies<P>,
    method: Bilinear,
    every: u64,
) -> impl Fn(&mut Bodies<P>, &Weights<[f64; 2]>, u32) {
    let monitor = ShadowEnergy::new(&mut start.clone(), &step(), &method).expect("a finite state").every(every);
    move |motion, h, repetitions| watched_steps(motion, h, monitor.clone(), repetitions)
}

#[inline(never)]
fn watched_steps<P: PairPotential<f64>>(
    motion: &mut Bodies<P>,
    h: &Weights<[f64; 2]>,
    mut monitor: ShadowEnergy<f64, BilinearEstimator<f64>>,
    repetitions: u32,
) {
    for _ in 0..repetitions {
        monitor.step(&StormerVerlet, h, motion).expect("finite states");
    }
}

fn compare_for<P: PairPotential<f64> + Clone>(title: &str, pair: &P, distance: f64) {
    let start = bodies(pair.clone(), distance);
    let with = |name, method, every| contestant(name, start.clone(), watched(&start, method, every));
    let (value, with_error) = (Bilinear::new(8), Bilinear::with_error(8));
    let contestants = vec![
        contestant("steps", start.clone(), plain),
        contestant("steps that carry β", start.clone(), augmented),
        with("with E_6, a window in 100 steps", Bilinear::new(6), 100),
        with("with E_8, a window in 100 steps", value, 100),
        with("with E_8, a window in 200 steps", value, 200),
        with("with E_8 and its error, a window in 100 steps", with_error, 100),
        with("with E_8 and its error, a window in 1000 steps", with_error, 1000),
        with("with E_8 and its error at every step", with_error, 1),
    ];
    compare(title, contestants, 2000);
}

fn main() {
    compare_for("100 bodies, softened gravity", &Plummer { s: 0.1, m: vec![0.01; BODIES] }, 1.0);
    compare_for("100 bodies, Lennard-Jones", &LennardJones { epsilon: 1.0, sigma: 1.0 }, 1.12);
}
