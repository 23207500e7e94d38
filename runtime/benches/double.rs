//! What β, the monitor, pairs and chains cost in f64: ratios to the plain steps, and times of a pair and of a body.
//!
//! `cargo bench -p shadowstep --bench double`

mod timing;

use std::hint::black_box;

use shadowstep::number::instructions::Instructions;
use shadowstep::problems::{CubicSpring, HenonHeiles, Kepler, LennardJones};
use shadowstep::shadow::{Bilinear, ShadowEnergy};
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::systems::pairs::{Ends, PairPotential, Pairs};
use shadowstep::{
    Coordinates, Kinetic, Motion, Potential, Scheme, Stepper, UnitMasses, ValidFor, potential, splitting_scheme,
};

use timing::{Contestant, compare, head, measure};

#[derive(Clone, Copy, Debug)]
#[splitting_scheme("stormer-verlet.toml")]
struct StormerVerlet;

#[derive(Clone, Copy, Debug)]
#[splitting_scheme("yoshida4.toml")]
struct Yoshida4;

potential! {
    /// Gravity that is softened at the distance s.
    struct Plummer { s }
    pair U(r2; m_i, m_j) = -m_i*m_j/sqrt(r2 + s^2)
}

/// The potentials of a system whose kinetic energy is quadratic.
trait System<V>: Potential<f64> + Clone {}

impl<V, P: Potential<f64> + Clone> System<V> for P {}

type Run<V, P> = Motion<f64, V, P, UnitMasses>;

fn steps<'a, A, V, P>(name: &'static str, (scheme, h): (A, &str), mut motion: Run<V, P>) -> Contestant<'a>
where
    A: Scheme + ValidFor<Quadratic> + 'a,
    V: Coordinates<f64> + 'a,
    P: System<V> + 'a,
    UnitMasses: Kinetic<f64, Class = Quadratic>,
{
    let stepper = Stepper::new(scheme, h).expect("h is not 0");
    let run = move |repetitions| {
        for _ in 0..repetitions {
            stepper.step(&mut motion);
        }
        black_box(motion.q());
    };
    (name, Box::new(run))
}

/// What each step adds is stored, as an estimator would: the compiler would leave out what is never read.
fn augmented<'a, A, V, P>(name: &'static str, (scheme, h): (A, &str), mut motion: Run<V, P>) -> Contestant<'a>
where
    A: Scheme + ValidFor<Quadratic> + 'a,
    V: Coordinates<f64> + 'a,
    P: System<V> + 'a,
{
    let stepper = Stepper::new(scheme, h).expect("h is not 0");
    let mut newest = [[0.0; 5]; 16];
    let run = move |repetitions| {
        for n in 0..repetitions as usize {
            stepper.step_augmented(&mut motion);
            let added = motion.increments();
            newest[n % 16] = [*added.beta, added.q[0], added.q[1], added.p[0], added.p[1]];
        }
        black_box((motion.q(), &newest));
    };
    (name, Box::new(run))
}

fn watched<'a, A, V, P>(
    name: &'static str,
    (scheme, h): (A, &str),
    mut motion: Run<V, P>,
    (settings, every, between_at_once): (&Bilinear, u64, bool),
) -> Contestant<'a>
where
    A: Scheme + ValidFor<Quadratic> + 'a,
    V: Coordinates<f64> + 'a,
    P: System<V> + 'a,
{
    let stepper = Stepper::new(scheme, h).expect("h is not 0");
    let mut monitor = ShadowEnergy::new(stepper, &mut motion, settings).expect("a finite state").every(every);
    if between_at_once {
        let run = move |repetitions: u32| {
            monitor.steps(&mut motion, repetitions.into()).expect("finite states");
            black_box(motion.q());
        };
        return (name, Box::new(run));
    }
    let run = move |repetitions| {
        for _ in 0..repetitions {
            monitor.step(&mut motion).expect("finite states");
        }
        black_box(motion.q());
    };
    (name, Box::new(run))
}

/// Plain steps, steps with β, and a monitor with E_8.
fn compare_all<A: Scheme + ValidFor<Quadratic> + Copy, V: Coordinates<f64>, P: System<V>>(
    title: &str,
    scheme: (A, &str),
    start: &Run<V, P>,
    repetitions: u32,
) {
    let (value, with_error) = (&Bilinear::new(8), &Bilinear::with_error(8));
    let start = || start.clone();
    let contestants = vec![
        steps("steps", scheme, start()),
        augmented("steps with β", scheme, start()),
        watched("with E_8 at each step", scheme, start(), (value, 1, false)),
        watched("with E_8 and its error at each step", scheme, start(), (with_error, 1, false)),
        watched("with E_8, a window in 100 steps", scheme, start(), (value, 100, false)),
        watched("the same, those between by `steps`", scheme, start(), (value, 100, true)),
    ];
    compare(title, contestants, repetitions);
}

const BODIES: usize = 100;

/// At rest on a grid of 5 × 5 × 4 with some disorder.
fn bodies<P: PairPotential<f64>>(pair: P, distance: f64) -> Run<Vec<f64>, Pairs<P, 3>> {
    let place = |i: usize| [i % 5, i / 5 % 5, i / 25].map(|n| n as f64);
    let disorder = |c: usize| (c as f64).sin() / 20.0;
    let q = (0..BODIES).flat_map(place).enumerate().map(|(c, x)| distance * (x + disorder(c))).collect();
    Motion::new(Pairs::all(BODIES, pair).expect("the pairs fit"), UnitMasses, q, vec![0.0; 3 * BODIES])
        .expect("the dimensions agree")
}

const CHAIN: usize = 1000;

fn chain() -> Run<Vec<f64>, Pairs<CubicSpring<f64>, 1>> {
    let q = (0..CHAIN).map(|i| (i as f64 * 0.37).sin() / 10.0).collect();
    let springs = Pairs::neighbours(CHAIN, CubicSpring { alpha: 0.25 }, Ends::Fixed).expect("the pairs fit");
    Motion::new(springs, UnitMasses, q, vec![0.0; CHAIN]).expect("the dimensions agree")
}

/// A step in each of the instructions of this processor, as a part of `parts`.
fn in_all_instructions<P: PairPotential<f64> + Clone, const D: usize>(
    title: &str,
    start: &Run<Vec<f64>, Pairs<P, D>>,
    (h, parts): (&str, f64),
    repetitions: u32,
) {
    let contestant = |instructions: Instructions| -> Contestant<'_> {
        let name: &'static str = match instructions {
            Instructions::Plain => "as the program is built",
            Instructions::Avx2 => "AVX2",
            Instructions::Avx512 => "AVX-512",
        };
        let (_, mut run) = steps(name, (StormerVerlet, h), start.clone());
        (name, Box::new(move |repetitions| instructions.only(|| run(repetitions))))
    };
    let mut contestants: Vec<_> = Instructions::available().map(contestant).collect();
    let measured = measure(&mut contestants, repetitions);
    head(title);
    for ((name, _), measured) in contestants.iter().zip(&measured) {
        println!("| {name} | {:.2} | {:.3} |", measured.nanoseconds / parts, measured.ratio);
    }
}

fn main() {
    let kepler = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]).expect("the dimensions agree");
    let star = Motion::new(HenonHeiles, UnitMasses, [0.1, 0.2], [0.1, 0.0]).expect("the dimensions agree");
    let plummer = bodies(Plummer { s: 0.1, m: vec![0.01; BODIES] }, 1.0);
    compare_all("Kepler, Störmer–Verlet", (StormerVerlet, "1/20"), &kepler, 100_000);
    compare_all("Hénon–Heiles, Störmer–Verlet", (StormerVerlet, "1/20"), &star, 100_000);
    compare_all("Hénon–Heiles, Yoshida 4", (Yoshida4, "1/20"), &star, 100_000);
    compare_all("100 bodies, softened gravity, Störmer–Verlet", (StormerVerlet, "1/1000"), &plummer, 1000);
    let pairs = (BODIES * (BODIES - 1) / 2) as f64;
    in_all_instructions("A pair of 100 bodies, softened gravity", &plummer, ("1/1000", pairs), 1000);
    let fluid = bodies(LennardJones { epsilon: 1.0, sigma: 1.0 }, 1.12);
    in_all_instructions("A pair of 100 bodies, Lennard-Jones", &fluid, ("1/1000", pairs), 1000);
    in_all_instructions("A body of a chain of 1000, FPUT α", &chain(), ("1/10", CHAIN as f64), 2000);
}
