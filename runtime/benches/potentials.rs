//! What potentials from formulas cost against those that a careful person writes by hand for one type of numbers, in
//! the same step of Störmer–Verlet.
//!
//! `cargo bench -p shadowstep --bench potentials`

mod by_hand;
mod timing;

use std::hint::black_box;

use rug::Float;
use shadowstep::number::Precision;
use shadowstep::problems::{Gravity, HenonHeiles, Kepler, Pendulum, problem};
use shadowstep::systems::formula::FormulaPair;
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::systems::pairs::{Pairs, Separation};
use shadowstep::{DiagonalMasses, Kinetic, Motion, Potential, Real, Stepper, UnitMasses, exact, splitting_scheme};

use by_hand::{ByHand, HenonHeilesStar, KeplerOrbit, PendulumBob, Planets};
use timing::{Contestant, compare};

#[splitting_scheme("stormer-verlet.toml")]
struct StormerVerlet;

fn digits() -> Precision {
    Precision::digits(120).expect("120 digits are allowed")
}

fn numbers<N: Real, const D: usize>(texts: [&str; D], context: &N::Context) -> [N; D] {
    texts.map(|text| N::from_rational(&exact(text).expect("an exact number"), context))
}

fn contestant<'a, N, V, P, K>(name: &'static str, mut motion: Motion<N, V, P, K>, h: &str) -> Contestant<'a>
where
    N: Real + 'a,
    V: shadowstep::Coordinates<N> + 'a,
    P: Potential<N> + 'a,
    K: Kinetic<N, Class = Quadratic> + 'a,
{
    let stepper = Stepper::with_context(StormerVerlet, h, &motion.context()).expect("h is not 0");
    (name, Box::new(move |repetitions| steps(&mut motion, &stepper, repetitions)))
}

/// A loop of its own, as a user has it; inlined into the timing it would be compiled differently for each contestant.
#[inline(never)]
fn steps<N, V, P, K>(motion: &mut Motion<N, V, P, K>, stepper: &Stepper<StormerVerlet, N>, repetitions: u32)
where
    N: Real,
    V: shadowstep::Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N, Class = Quadratic>,
{
    for _ in 0..repetitions {
        stepper.step(motion);
    }
    black_box(motion.q());
}

fn orbit<'a, N: Real + 'a, P: Potential<N> + 'a, const D: usize>(
    name: &'static str,
    potential: P,
    [q, p]: [[&str; D]; 2],
    context: &N::Context,
) -> Contestant<'a> {
    let (q, p) = (numbers::<N, D>(q, context), numbers::<N, D>(p, context));
    contestant(name, Motion::new(potential, UnitMasses, q, p).expect("the dimensions agree"), "1/100")
}

/// The outer solar system, steps of 100 days.
fn planets<'a, N: Real + 'a, P: Potential<N> + 'a>(
    name: &'static str,
    potential: impl FnOnce(N, Vec<N>) -> P,
    context: &N::Context,
) -> Contestant<'a> {
    let setup = problem("outer-solar-system").and_then(|problem| problem.setup(&[], 150)).expect("a problem");
    let masses = setup.values.masses().expect("planets have masses");
    let masses: Vec<_> = masses.iter().map(|mass| mass.value.clone()).collect();
    let m = masses.iter().step_by(3).map(|m| N::from_rational(m, context)).collect();
    let kinetic = DiagonalMasses::new(&masses, context).expect("positive");
    let potential = potential(N::from_rational(setup.values.value("g"), context), m);
    contestant(
        name,
        Motion::new(potential, kinetic, setup.values.q(context), setup.values.p(context))
            .expect("the dimensions agree"),
        "100",
    )
}

const BY_HAND: &str = "potential by hand";
const BY_FORMULA: &str = "potential from its formula";
const AT_RUN_TIME: &str = "potential from a formula at run time";

fn gravity<N: Real>(g: N, m: Vec<N>) -> Pairs<Gravity<N>, 3> {
    Pairs::all(m.len(), Gravity { g, m }).expect("the pairs fit")
}

fn gravity_at_run_time<N: Real>(g: N, m: Vec<N>) -> Pairs<FormulaPair<N>, 3> {
    let (bodies, squared) = (m.len(), Separation::SquaredDistance);
    let pair = FormulaPair::new("-g*m_i*m_j/sqrt(r2)", squared, &[("m", m)], &[("g", g)]).expect("a formula");
    Pairs::all(bodies, pair).expect("the pairs fit")
}

/// A hundred bodies at rest in places without an order.
fn hundred<'a, P: Potential<f64> + 'a>(
    name: &'static str,
    potential: impl FnOnce(f64, Vec<f64>) -> P,
) -> Contestant<'a> {
    let q: Vec<f64> = (0..300_u32).map(|i| f64::from((i * i * 31 + 7 * i) % 1009) / 50.0).collect();
    let motion = Motion::new(potential(1e-6, vec![1.0; 100]), UnitMasses, q, vec![0.0; 300]);
    contestant(name, motion.expect("the dimensions agree"), "1/100")
}

fn in_numbers<N: Real>(numbers: &str, context: &N::Context, repetitions: u32)
where
    ByHand<KeplerOrbit>: Potential<N>,
    ByHand<HenonHeilesStar>: Potential<N>,
    ByHand<PendulumBob>: Potential<N>,
    ByHand<Planets<N>>: Potential<N>,
{
    let start = [["0.4", "0"], ["0", "2"]];
    let contestants = vec![
        orbit::<N, _, 2>(BY_HAND, ByHand(KeplerOrbit), start, context),
        orbit::<N, _, 2>(BY_FORMULA, Kepler, start, context),
    ];
    compare(&format!("Kepler, {numbers}"), contestants, repetitions);
    let start = [["0.1", "0.2"], ["0.1", "0"]];
    let contestants = vec![
        orbit::<N, _, 2>(BY_HAND, ByHand(HenonHeilesStar), start, context),
        orbit::<N, _, 2>(BY_FORMULA, HenonHeiles, start, context),
    ];
    compare(&format!("Hénon–Heiles, {numbers}"), contestants, repetitions);
    let start = [["0"], ["1"]];
    let contestants = vec![
        orbit::<N, _, 1>(BY_HAND, ByHand(PendulumBob), start, context),
        orbit::<N, _, 1>(BY_FORMULA, Pendulum, start, context),
    ];
    compare(&format!("Pendulum, {numbers}"), contestants, repetitions);
    let contestants = vec![
        planets::<N, _>(BY_HAND, |g, m| ByHand(Planets { g, m }), context),
        planets::<N, _>(BY_FORMULA, gravity, context),
        planets::<N, _>(AT_RUN_TIME, gravity_at_run_time, context),
    ];
    compare(&format!("The Sun and five planets, {numbers}"), contestants, repetitions / 20);
}

fn main() {
    in_numbers::<f64>("f64", &(), 1_000_000);
    let contestants = vec![hundred(BY_FORMULA, gravity), hundred(AT_RUN_TIME, gravity_at_run_time)];
    compare("100 bodies, f64", contestants, 2_000);
    in_numbers::<Float>("120 digits", &digits(), 2_000);
}
