//! What the monitor of the modified energy adds to a loop: a hundred bodies, Störmer–Verlet, f64.
//!
//! `cargo bench -p shadowstep --bench monitor`

mod timing;

use std::hint::black_box;

use shadowstep::problems::LennardJones;
use shadowstep::shadow::{Bilinear, BilinearEstimator, ShadowEnergy};
use shadowstep::systems::pairs::{PairPotential, Pairs};
use shadowstep::{Motion, Stepper, UnitMasses, potential, splitting_scheme};

use timing::{Contestant, compare};

#[splitting_scheme("stormer-verlet.toml")]
#[derive(Clone, Debug)]
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
    Motion::new(Pairs::all(BODIES, pair).expect("the pairs fit"), UnitMasses, q, vec![0.0; 3 * BODIES])
        .expect("the dimensions agree")
}

/// Each run begins at the same state, in vectors of its own: so all make the same steps, and find them at like places.
fn contestant<'a, P: PairPotential<f64> + Clone + 'a>(
    name: &'static str,
    start: Bodies<P>,
    steps: impl Fn(&mut Bodies<P>, &Verlet, u32) + 'a,
) -> Contestant<'a> {
    let stepper = stepper();
    let run = move |repetitions| {
        let mut motion = start.clone();
        steps(&mut motion, &stepper, repetitions);
        black_box(motion.q());
    };
    (name, Box::new(run))
}

type Verlet = Stepper<StormerVerlet, f64>;

fn stepper() -> Verlet {
    Stepper::new(StormerVerlet, "1/1000").expect("h is not 0")
}

#[inline(never)]
fn plain<P: PairPotential<f64>>(motion: &mut Bodies<P>, stepper: &Verlet, repetitions: u32) {
    for _ in 0..repetitions {
        stepper.step(motion);
    }
}

#[inline(never)]
fn augmented<P: PairPotential<f64>>(motion: &mut Bodies<P>, stepper: &Verlet, repetitions: u32) {
    for _ in 0..repetitions {
        stepper.step_augmented(motion);
    }
}

/// With a monitor that is made before.
fn watched<P: PairPotential<f64> + Clone>(
    start: &Bodies<P>,
    settings: &Bilinear,
    every: u64,
) -> impl Fn(&mut Bodies<P>, &Verlet, u32) {
    let monitor = ShadowEnergy::new(stepper(), &mut start.clone(), settings).expect("a finite state").every(every);
    move |motion, _, repetitions| watched_steps(motion, monitor.clone(), repetitions)
}

#[inline(never)]
fn watched_steps<P: PairPotential<f64>>(
    motion: &mut Bodies<P>,
    mut monitor: ShadowEnergy<StormerVerlet, f64, BilinearEstimator<f64>>,
    repetitions: u32,
) {
    for _ in 0..repetitions {
        monitor.step(motion).expect("finite states");
    }
}

fn compare_for<P: PairPotential<f64> + Clone>(title: &str, pair: &P, distance: f64) {
    let start = bodies(pair.clone(), distance);
    let with = |name, settings, every| contestant(name, start.clone(), watched(&start, settings, every));
    let (fewer, value, with_error) = (&Bilinear::new(6), &Bilinear::new(8), &Bilinear::with_error(8));
    let contestants = vec![
        contestant("steps", start.clone(), plain),
        contestant("steps that carry β", start.clone(), augmented),
        with("with E_6, a window in 100 steps", fewer, 100),
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
