//! Steps in `f64` as they are compiled in a crate of one's own, with Cargo's default release profile.
//!
//! `cargo run --release`, for any processor of the architecture;
//! `RUSTFLAGS="-C target-cpu=native" cargo run --release`, for this one.

#[path = "../../../../runtime/benches/timing/mod.rs"]
mod timing;

use std::hint::black_box;

use shadowstep::number::Number;
use shadowstep::problems::{CubicSpring, Gravity, HenonHeiles, Kepler, LennardJones, Pendulum, problem};
use shadowstep::shadow::{Bilinear, ShadowEnergy};
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::systems::pairs::{Ends, PairPotential, Pairs};
use shadowstep::tables::shipped;
use shadowstep::{
    Coordinates, DiagonalMasses, Kinetic, Motion, Potential, Scheme, Stepper, UnitMasses, ValidFor, potential,
    splitting_scheme,
};

use timing::{Contestant, compare, head, measure};

#[derive(Clone, Copy, Debug)]
#[splitting_scheme("stormer-verlet.toml")]
struct StormerVerlet;

#[derive(Clone, Copy, Debug)]
#[splitting_scheme("blanes-moan-srkn6b.toml")]
struct Srkn6b;

potential! {
    /// Gravity that is softened at the distance s.
    struct Plummer { s }
    pair U(r2; m_i, m_j) = -m_i*m_j/sqrt(r2 + s^2)
}

type Run<V, P, K = UnitMasses> = Motion<f64, V, P, K>;

/// A loop of steps, `steps` and `merged_steps`.
fn contestants<'a, S, V, P, K>(
    names: [&'static str; 3],
    scheme: impl Fn() -> S,
    h: &str,
    start: &Run<V, P, K>,
) -> Vec<Contestant<'a>>
where
    S: Scheme + ValidFor<Quadratic> + 'a,
    V: Coordinates<f64> + 'a,
    P: Potential<f64> + Clone + 'a,
    K: Kinetic<f64, Class = Quadratic> + Clone + 'a,
{
    let stepper = || Stepper::<S, f64>::new(scheme(), h).expect("h is not 0");
    let start = || std::slice::from_ref(start).to_vec();
    let (one, mut of_one, all, mut of_all, merged, mut of_merged) =
        (stepper(), start(), stepper(), start(), stepper(), start());
    vec![
        (names[0], Box::new(move |count| loop_of_steps(&one, &mut of_one[0], count))),
        (names[1], Box::new(move |count| all.steps(&mut of_all, count.into()))),
        (names[2], Box::new(move |count| merged.merged_steps(&mut of_merged, count.into()))),
    ]
}

/// A function of its own, as a user has it: inlined into the timing it would be compiled differently for each
/// contestant.
#[inline(never)]
fn loop_of_steps<S, V, P, K>(stepper: &Stepper<S, f64>, motion: &mut Run<V, P, K>, count: u32)
where
    S: Scheme + ValidFor<Quadratic>,
    V: Coordinates<f64>,
    P: Potential<f64>,
    K: Kinetic<f64, Class = Quadratic>,
{
    for _ in 0..count {
        stepper.step(motion);
    }
    black_box(motion.q());
}

fn watched<'a, V, P, K>(h: &str, mut motion: Run<V, P, K>) -> Contestant<'a>
where
    V: Coordinates<f64> + 'a,
    P: Potential<f64> + Clone + 'a,
    K: Kinetic<f64, Class = Quadratic> + Clone + 'a,
{
    let stepper = Stepper::new(StormerVerlet, h).expect("h is not 0");
    let mut monitor = ShadowEnergy::new(stepper, &mut motion, &Bilinear::new(8)).expect("a finite state").every(1);
    let run = move |count| {
        for _ in 0..count {
            monitor.step(&mut motion).expect("finite states");
        }
        black_box(motion.q());
    };
    ("E_8 at each step", Box::new(run))
}

/// Störmer–Verlet, with E_8 as well.
fn verlet<'a, V, P, K>(h: &str, start: &Run<V, P, K>) -> Vec<Contestant<'a>>
where
    V: Coordinates<f64> + 'a,
    P: Potential<f64> + Clone + 'a,
    K: Kinetic<f64, Class = Quadratic> + Clone + 'a,
{
    let mut all = contestants(["step", "steps", "merged_steps"], || StormerVerlet, h, start);
    all.push(watched(h, start.clone()));
    all
}

/// The problems of few coordinates.
fn few<const D: usize, P: Potential<f64> + Copy>(title: &str, potential: P, (q, p): ([f64; D], [f64; D]), h: &str) {
    let start = Motion::new(potential, UnitMasses, q, p).expect("the dimensions agree");
    compare(&format!("{title}, Störmer–Verlet"), verlet(h, &start), 100_000);
    let mut many_stages = contestants(["step", "steps", "merged_steps"], || Srkn6b, h, &start);
    let table = || shipped("blanes-moan-srkn6b").expect("it is shipped");
    many_stages.extend(contestants(
        ["step, from the table", "steps, from the table", "merged_steps, from the table"],
        table,
        h,
        &start,
    ));
    compare(&format!("{title}, SRKN6b"), many_stages, 20_000);
}

fn planets() {
    let problem = problem("outer-solar-system").expect("it is shipped");
    let values = problem.setup(&[], 40).expect("the defaults are valid").values;
    let of_coordinates: Vec<_> = values.masses().expect("they differ").iter().map(|mass| mass.value.clone()).collect();
    let masses = DiagonalMasses::new(&of_coordinates, &()).expect("positive masses");
    let m = of_coordinates.iter().step_by(3).map(|mass| f64::from_rational(mass, &())).collect();
    let pairs =
        Pairs::<_, 3>::all(6, Gravity { g: f64::from_rational(values.value("g"), &()), m }).expect("the pairs fit");
    let [q, p] = [values.q(&()), values.p(&())].map(|x| <[f64; 18]>::try_from(x).expect("six bodies"));
    let start = Motion::new(pairs, masses, q, p).expect("the dimensions agree");
    compare("The Sun and five planets, Störmer–Verlet", verlet("100", &start), 20_000);
}

const BODIES: usize = 100;

/// At rest on a grid of 5 × 5 × 4 with some disorder.
fn bodies<P: PairPotential<f64>>(pair: P, distance: f64) -> Run<Vec<f64>, Pairs<P, 3>> {
    let place = |i: usize| [i % 5, i / 5 % 5, i / 25].map(|n| n as f64);
    let disorder = |c: usize| (c as f64).sin() / 20.0;
    let q = (0..BODIES).flat_map(place).enumerate().map(|(c, x)| distance * (x + disorder(c))).collect();
    let pairs = Pairs::all(BODIES, pair).expect("the pairs fit");
    Motion::new(pairs, UnitMasses, q, vec![0.0; 3 * BODIES]).expect("the dimensions agree")
}

const IN_CHAIN: usize = 1000;

fn chain() -> Run<Vec<f64>, Pairs<CubicSpring<f64>, 1>> {
    let q = (0..IN_CHAIN).map(|i| (i as f64).sin() / 10.0).collect();
    let springs = Pairs::neighbours(IN_CHAIN, CubicSpring { alpha: 0.25 }, Ends::Fixed).expect("the springs fit");
    Motion::new(springs, UnitMasses, q, vec![0.0; IN_CHAIN]).expect("the dimensions agree")
}

/// A step of Störmer–Verlet, divided by what it computes.
fn many<P: Potential<f64> + Clone>(title: &str, start: &Run<Vec<f64>, P>, (of_what, how_many): (&str, usize)) {
    let mut verlet = verlet("1/1000", start);
    let measured = measure(&mut verlet, 500);
    for ((name, _), measured) in verlet.iter().zip(measured) {
        println!(
            "| {title}: {of_what}, {name} | {:.2} | {:.3} |",
            measured.nanoseconds / how_many as f64,
            measured.ratio
        );
    }
}

fn main() {
    few("Kepler", Kepler, ([0.4, 0.0], [0.0, 2.0]), "1/100");
    few("Hénon–Heiles", HenonHeiles, ([0.1, 0.2], [0.1, 0.0]), "1/20");
    few("Pendulum", Pendulum, ([1.0], [0.0]), "1/20");
    planets();
    head("Many bodies, Störmer–Verlet");
    let pairs = ("a pair", BODIES * (BODIES - 1) / 2);
    many("100 bodies, softened gravity", &bodies(Plummer { s: 0.1, m: vec![0.01; BODIES] }, 1.0), pairs);
    many("100 bodies, Lennard-Jones", &bodies(LennardJones { epsilon: 1.0, sigma: 1.0 }, 1.12), pairs);
    many("a chain of 1000", &chain(), ("a body", IN_CHAIN));
}
