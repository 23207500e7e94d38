//! What compensated sums and fixed point add to a step: Störmer–Verlet in f64 on four systems.
//!
//! `cargo bench -p shadowstep --bench summation`

mod timing;

use std::hint::black_box;

use shadowstep::kinetic::Quadratic;
use shadowstep::pairs::Pairs;
use shadowstep::problems::{Gravity, HenonHeiles, Kepler, LennardJones, problem};
use shadowstep::summation::Summation;
use shadowstep::{Coordinates, DiagonalMasses, Kinetic, Motion, Potential, Stepper, UnitMasses, splitting_scheme};

use timing::{Contestant, compare};

#[splitting_scheme("stormer-verlet.toml")]
struct StormerVerlet;

fn contestant<'a, V, P, K, S>(name: &'static str, mut motion: Motion<f64, V, P, K, S>, h: &str) -> Contestant<'a>
where
    V: Coordinates<f64> + 'a,
    P: Potential<f64> + 'a,
    K: Kinetic<f64, Class = Quadratic> + 'a,
    S: Summation<f64> + 'a,
{
    let stepper = Stepper::new(StormerVerlet, h).expect("h is not 0");
    (name, Box::new(move |repetitions| steps(&mut motion, &stepper, repetitions)))
}

#[inline(never)]
fn steps<V, P, K, S>(motion: &mut Motion<f64, V, P, K, S>, stepper: &Stepper<StormerVerlet, f64>, repetitions: u32)
where
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
fn compared<V, P, K>(title: &str, (potential, kinetic): (P, K), (q, p): (V, V), h: &str, repetitions: u32)
where
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
        contestant("plain sums", start.clone(), h),
        contestant("compensated sums", start.clone().compensated(), h),
        contestant(
            "fixed point",
            start.fixed_point(q_ranges.as_ref(), p_ranges.as_ref()).expect("within the ranges"),
            h,
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
    compared("Kepler", (Kepler, UnitMasses), ([0.4, 0.0], [0.0, 2.0]), "1/100", 1_000_000);
    compared("Hénon–Heiles", (HenonHeiles, UnitMasses), ([0.1, 0.2], [0.1, 0.0]), "1/100", 1_000_000);
    let Bodies { masses, m, state, parameters } = bodies("outer-solar-system", 3, &["g"]);
    let gravity = Pairs::<_, 3>::all(m.len(), Gravity { g: parameters[0], m }).expect("the pairs fit");
    compared("The Sun and five planets", (gravity, masses), state, "100", 100_000);
    let Bodies { masses, m, state, parameters } = bodies("argon-crystal", 2, &["epsilon", "sigma"]);
    let pair = LennardJones { epsilon: parameters[0], sigma: parameters[1] };
    let argon = Pairs::<_, 2>::all(m.len(), pair).expect("the pairs fit");
    compared("Seven argon atoms", (argon, masses), state, "4e-5", 100_000);
}
