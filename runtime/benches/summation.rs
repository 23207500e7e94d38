//! What compensated sums and fixed point add to a step in f64: Störmer–Verlet on four systems, Yoshida 4 on two.
//!
//! `cargo bench -p shadowstep --bench summation`

mod timing;

use std::hint::black_box;

use shadowstep::problems::{Gravity, HenonHeiles, Kepler, LennardJones, problem};
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::systems::pairs::Pairs;
use shadowstep::systems::summation::Summation;
use shadowstep::{
    Coordinates, DiagonalMasses, Kinetic, Motion, Potential, Scheme, Stepper, UnitMasses, ValidFor, splitting_scheme,
};

use timing::{Contestant, compare};

#[derive(Clone, Copy)]
#[splitting_scheme("stormer-verlet.toml")]
struct StormerVerlet;

#[derive(Clone, Copy)]
#[splitting_scheme("yoshida4.toml")]
struct Yoshida4;

fn contestant<'a, A, V, P, K, S>(
    name: &'static str,
    mut motion: Motion<f64, V, P, K, S>,
    (scheme, h): (A, &str),
) -> Contestant<'a>
where
    A: Scheme + ValidFor<Quadratic> + 'a,
    V: Coordinates<f64> + 'a,
    P: Potential<f64> + 'a,
    K: Kinetic<f64, Class = Quadratic> + 'a,
    S: Summation<f64> + 'a,
{
    let stepper = Stepper::new(scheme, h).expect("h is not 0");
    (name, Box::new(move |repetitions| steps(&mut motion, &stepper, repetitions)))
}

#[inline(never)]
fn steps<A, V, P, K, S>(motion: &mut Motion<f64, V, P, K, S>, stepper: &Stepper<A, f64>, repetitions: u32)
where
    A: Scheme + ValidFor<Quadratic>,
    V: Coordinates<f64>,
    P: Potential<f64>,
    K: Kinetic<f64, Class = Quadratic>,
    S: Summation<f64>,
{
    for _ in 0..repetitions {
        stepper.step(motion);
    }
    black_box(motion.q());
}

/// The same system with each kind of sums; the ranges are 16 times the largest coordinate and momentum at the start.
fn compared<A, V, P, K>(title: &str, (potential, kinetic): (P, K), (q, p): (V, V), scheme: (A, &str), repetitions: u32)
where
    A: Scheme + ValidFor<Quadratic> + Copy,
    V: Coordinates<f64>,
    P: Potential<f64> + Clone,
    K: Kinetic<f64, Class = Quadratic> + Clone,
{
    let [q_ranges, p_ranges] = [&q, &p].map(|values| {
        let mut ranges = values.clone();
        let largest = ranges.as_ref().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        ranges.as_mut().fill(16.0 * largest);
        ranges
    });
    let start = Motion::new(potential, kinetic, q, p).expect("the dimensions agree");
    let contestants = vec![
        contestant("plain sums", start.clone(), scheme),
        contestant("compensated sums", start.clone().compensated(), scheme),
        contestant(
            "fixed point",
            start.fixed_point(q_ranges.as_ref(), p_ranges.as_ref()).expect("within the ranges"),
            scheme,
        ),
    ];
    compare(title, contestants, repetitions);
}

/// The masses and the state of a shipped problem, and one of its parameters after another.
struct Bodies {
    masses: DiagonalMasses<f64>,
    m: Vec<f64>,
    state: (Vec<f64>, Vec<f64>),
    parameters: Vec<f64>,
}

fn bodies(name: &str, dimensions: usize, parameters: &[&str]) -> Bodies {
    let setup = problem(name).and_then(|problem| problem.setup(&[], 30)).expect("a problem");
    let exact: Vec<_> = setup.values.masses().expect("bodies have masses").iter().map(|m| m.value.clone()).collect();
    let m = exact.iter().step_by(dimensions).map(|m| <f64 as shadowstep::Number>::from_rational(m, &())).collect();
    let number = |name: &&str| <f64 as shadowstep::Number>::from_rational(setup.values.value(name), &());
    Bodies {
        masses: DiagonalMasses::new(&exact, &()).expect("positive"),
        m,
        state: (setup.values.q(&()), setup.values.p(&())),
        parameters: parameters.iter().map(number).collect(),
    }
}

fn main() {
    let verlet = (StormerVerlet, "1/100");
    let yoshida = (Yoshida4, "1/100");
    compared("Kepler", (Kepler, UnitMasses), ([0.4, 0.0], [0.0, 2.0]), verlet, 1_000_000);
    compared("Kepler, Yoshida 4", (Kepler, UnitMasses), ([0.4, 0.0], [0.0, 2.0]), yoshida, 300_000);
    let star = ([0.1, 0.2], [0.1, 0.0]);
    compared("Hénon–Heiles", (HenonHeiles, UnitMasses), star, verlet, 1_000_000);
    compared("Hénon–Heiles, Yoshida 4", (HenonHeiles, UnitMasses), star, yoshida, 300_000);
    let Bodies { masses, m, state, parameters } = bodies("outer-solar-system", 3, &["g"]);
    let gravity = Pairs::<_, 3>::all(m.len(), Gravity { g: parameters[0], m }).expect("the pairs fit");
    compared("The Sun and five planets", (gravity, masses), state, (StormerVerlet, "100"), 100_000);
    let Bodies { masses, m, state, parameters } = bodies("argon-crystal", 2, &["epsilon", "sigma"]);
    let pair = LennardJones { epsilon: parameters[0], sigma: parameters[1] };
    let argon = Pairs::<_, 2>::all(m.len(), pair).expect("the pairs fit");
    compared("Seven argon atoms", (argon, masses), state, (StormerVerlet, "4e-5"), 100_000);
}
