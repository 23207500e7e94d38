//! What the monitor of the modified energy adds to a loop: a hundred bodies, Störmer–Verlet, f64.
//!
//! `cargo bench -p shadowstep --bench monitor`

mod timing;

use std::hint::black_box;

use shadowstep::pairs::{PairPotential, Pairs};
use shadowstep::problems::LennardJones;
use shadowstep::shadow::{Bilinear, ShadowEnergy};
use shadowstep::{Motion, Scheme, UnitMasses, exact, potential, splitting_scheme};

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

fn plain<'a, P: PairPotential<f64> + 'a>(mut motion: Bodies<P>) -> Contestant<'a> {
    let h = StormerVerlet.weights::<f64>(&exact("1/1000").expect("exact"), &());
    let run = move |repetitions| {
        for _ in 0..repetitions {
            StormerVerlet.step(&h, &mut motion);
        }
        black_box(motion.q());
    };
    ("steps", Box::new(run))
}

fn augmented<'a, P: PairPotential<f64> + 'a>(mut motion: Bodies<P>) -> Contestant<'a> {
    let h = StormerVerlet.weights::<f64>(&exact("1/1000").expect("exact"), &());
    let run = move |repetitions| {
        for _ in 0..repetitions {
            StormerVerlet.step_augmented(&h, &mut motion);
        }
        black_box(motion.q());
    };
    ("steps that carry β", Box::new(run))
}

fn watched<'a, P: PairPotential<f64> + 'a>(
    name: &'static str,
    mut motion: Bodies<P>,
    method: Bilinear,
    every: u64,
) -> Contestant<'a> {
    let h = exact("1/1000").expect("exact");
    let mut monitor = ShadowEnergy::new(&mut motion, &h, &method).expect("a finite state").every(every);
    let h = StormerVerlet.weights::<f64>(&h, &());
    let run = move |repetitions| {
        for _ in 0..repetitions {
            monitor.step(&StormerVerlet, &h, &mut motion).expect("finite states");
        }
        black_box(motion.q());
    };
    (name, Box::new(run))
}

fn compare_for<P: PairPotential<f64> + Clone>(title: &str, pair: &P, distance: f64) {
    let motion = || bodies(pair.clone(), distance);
    let contestants = vec![
        plain(motion()),
        augmented(motion()),
        watched("with E_8, a window in 100 steps", motion(), Bilinear::new(8), 100),
        watched("with E_8 and its error, a window in 100 steps", motion(), Bilinear::with_error(8), 100),
        watched("with E_8 and its error, a window in 1000 steps", motion(), Bilinear::with_error(8), 1000),
        watched("with E_8 and its error at every step", motion(), Bilinear::with_error(8), 1),
    ];
    compare(title, contestants, 1000);
}

fn main() {
    compare_for("100 bodies, softened gravity", &Plummer { s: 0.1, m: vec![0.01; BODIES] }, 1.0);
    compare_for("100 bodies, Lennard-Jones", &LennardJones { epsilon: 1.0, sigma: 1.0 }, 1.12);
}
