//! Protects kinetic energies that are not quadratic: the order measured is the one proved for every T(p), the modified
//! energy is conserved, and a scheme whose order holds for quadratic T only does not get them.
//!
//! (What the compiler refuses is in `scheme-macros/tests/compile_fail/`.)

use std::array;

use rug::Float;
use shadowstep::number::Precision;
use shadowstep::number::counting::{Counting, Operations, count};
use shadowstep::shadow::Central;
use shadowstep::shadow::run::{EnergyDrift, ShadowRun, energy_drift};
use shadowstep::systems::formula::FormulaKinetic;
use shadowstep::systems::kinetic::{General, Quadratic};
use shadowstep::tables::{QuadraticOnly, Source, TableScheme, read, shipped};
use shadowstep::{
    Carried, DiagonalMasses, Kinetic, Motion, Number, Potential, Rational, Scheme, Stepper, System, UnitMasses,
    ValidFor, kinetic, potential, splitting_scheme,
};
use shadowstep_analysis::best_for_every_kinetic;
use shadowstep_schemes::First;
use shadowstep_tests::general::{AnyMotion, Problem, Spring};
use shadowstep_tests::orders::{Measured, Order};
use shadowstep_tests::reference::Separable;
use shadowstep_tests::shipped::{Shipped, all, all_for_every_kinetic, twin};
use shadowstep_tests::steps::Steps;
use shadowstep_tests::{
    Bits, coordinates, log10_largest_distance, number, numbers, precision, rational, same_bits, variations,
};

const DIGITS: u32 = 80;

/// The orders measured of a system, beside the solution, which is off by about h^25, far less than steps.
fn orders<C: 'static, M: System<Number = Float, Class = C>>(
    problem: Problem,
    start: &dyn Fn() -> M,
    schemes: impl Fn(&Rational, &Precision) -> Vec<Shipped<Float, C>>,
) -> Vec<Order> {
    let separable = Separable { velocity: &|p| problem.velocity(p), gradient: &|q| problem.gradient(q) };
    let flow = |h: &Float| separable.flow(&coordinates(&start()), h, 12);
    let measured =
        Measured { start, coordinates: |system| coordinates(system), flow: &flow, digits: DIGITS, halvings: 10 };
    measured.orders(schemes, |scheme| scheme.summary.order)
}

/// Steps of 2^(1−k) and 2^−k show the order up to c 2^−k/ln 2, where c is the ratio of the errors' constants: some 14
/// at most.
fn tolerance(k: u32) -> f64 {
    20.0 / f64::from(1 << k)
}

/// McLachlan and Atela's scheme: order 4 for quadratic T, 3 for every T(p).
#[derive(Clone, Copy)]
#[splitting_scheme("../../scheme-macros/tests/compile_fail/nystrom.toml")]
struct Nystrom;

fn nystrom() -> TableScheme {
    let (path, text) =
        ("nystrom.toml".into(), include_str!("../../scheme-macros/tests/compile_fail/nystrom.toml").into());
    read(&Source { path, text }, &|_, _| None, None).unwrap()
}

fn for_every_kinetic(name: &str) -> TableScheme<General> {
    shipped(name).unwrap().for_every_kinetic().unwrap()
}

// ---------------------------------------------------------------------------------------------------------------
// Orders

#[test]
fn the_order_measured_is_the_order_proved_for_every_kinetic_energy() {
    for problem in Problem::ALL {
        let start = || problem.system::<Float>(&precision(DIGITS));
        for order in orders(problem, &start, all_for_every_kinetic) {
            assert!(order.off() < tolerance(order.k), "{problem:?}, {order:?}");
        }
    }
}

/// Takes the kinetic energy for a quadratic one, so that every scheme is valid for it; with the right or the wrong sign
/// of what its drifts add to β.
struct Pretended<K> {
    kinetic: K,
    wrong_sign: bool,
}

impl<N: Number, K: Kinetic<N>> Kinetic<N> for Pretended<K> {
    type Class = Quadratic;
    fn dimension(&self) -> Option<usize> {
        self.kinetic.dimension()
    }
    fn scratch(&self) -> usize {
        self.kinetic.scratch()
    }
    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        self.kinetic.prepare(scratch, context);
    }
    fn drift(&self, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
        self.kinetic.drift(weight, p, q, scratch);
    }
    fn drift_augmented(&self, weight: &N, p: &[N], q: &mut [N], beta: &mut N, scratch: &mut [N]) {
        let mut start = beta.clone();
        self.kinetic.drift_augmented(weight, p, q, beta, scratch);
        if self.wrong_sign {
            // the sum of both is twice the start
            start.multiply_integer(2);
            beta.negate();
            beta.add(&start);
        }
    }
    fn energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]) {
        self.kinetic.energy(p, energy, scratch);
    }
}

/// This is why they are refused.
#[test]
fn schemes_for_quadratic_kinetic_energies_lose_their_order() {
    let context = precision(DIGITS);
    // with gradient kicks they have none to lose
    let losing = |h: &Rational, context: &Precision| {
        let loses = |scheme: &Shipped<Float>| (1..scheme.summary.order_quadratic).contains(&scheme.summary.order);
        all(h, context).into_iter().filter(loses).collect()
    };
    for problem in Problem::ALL {
        let pretended = || {
            let kinetic = Pretended { kinetic: problem.kinetic::<Float>(&context), wrong_sign: false };
            let [q, p] = problem.start().map(|texts| numbers(texts, &context));
            Motion::new(problem.potential::<Float>(), kinetic, q, p).unwrap()
        };
        for order in orders(problem, &pretended, losing) {
            assert!(order.off() < tolerance(order.k), "{problem:?}, {order:?}");
        }
    }
}

#[test]
fn a_table_with_an_order_for_quadratic_energies_only_is_refused() {
    let refused = nystrom().for_every_kinetic().unwrap_err();
    assert_eq!(refused.to_string(), "nystrom has order 4 for quadratic T only, for a general T(p) order 3");
    let QuadraticOnly { order, order_quadratic, .. } = refused;
    assert_eq!((order, order_quadratic), (3, 4));
    let better = &best_for_every_kinetic(4).unwrap().scheme.table.name.value;
    assert_eq!(for_every_kinetic(better).summary().order, 4);
}

// ---------------------------------------------------------------------------------------------------------------
// The modified energy

/// Over the time 20 with steps of 1/n; differences with this number of terms.
fn drift_of<K: Kinetic<Float>>(problem: Problem, kinetic: K, name: &str, n: u64, m: u32) -> EnergyDrift<Float>
where
    TableScheme<General>: ValidFor<K::Class>,
{
    let context = precision(40);
    let [q, p] = problem.start().map(|texts| numbers(texts, &context));
    let motion = Motion::new(problem.potential::<Float>(), kinetic, q, p).unwrap();
    let stepper = Stepper::with_context(for_every_kinetic(name), &*format!("1/{n}"), &context).unwrap();
    energy_drift(stepper.with(motion), 20 * n, &Central::fixed(m)).unwrap()
}

fn drift(problem: Problem, name: &str, n: u64, m: u32) -> f64 {
    drift_of(problem, problem.kinetic::<Float>(&precision(40)), name, n, m).drift.to_f64()
}

/// max − min of H itself over the same run.
fn energy_variation(problem: Problem, name: &str, n: u64) -> f64 {
    let stepper = Stepper::new(for_every_kinetic(name), &*format!("1/{n}")).unwrap();
    variations::of_energy(&stepper, problem.system::<f64>(&()), 20 * n)
}

#[test]
fn the_modified_energy_is_conserved() {
    for problem in Problem::ALL {
        for name in ["stormer-verlet", "yoshida4"] {
            let (energy, modified) = (energy_variation(problem, name, 40), drift(problem, name, 40, 12));
            println!("{problem:?} {name}: H varies by {energy:.2e}, the modified energy by {modified:.2e}");
            assert!(modified < 1e-10 * energy, "{problem:?}, {name}: {modified} and {energy}");
        }
    }
}

/// Differences of m terms are off by C h^{2m}, far above all else that changes the modified energy when m is small.
#[test]
fn the_error_of_the_modified_energy_shrinks_as_its_differences_do() {
    for problem in Problem::ALL {
        for m in [2, 3] {
            let [coarse, fine] = [80, 160].map(|n| drift(problem, "yoshida4", n, m));
            let rate = (coarse / fine).log2();
            println!("{problem:?}, m = {m}: {coarse:.2e}, {fine:.2e}, rate {rate:.4}");
            // the next term is C' h^{2m+2}: h² = 1/6400 times a ratio of some 100 at most
            assert!((rate - 2.0 * f64::from(m)).abs() < 0.05, "{problem:?}, m = {m}: {rate}");
        }
    }
}

#[test]
fn with_the_wrong_sign_it_is_not_conserved() {
    for problem in Problem::ALL {
        let wrong = Pretended { kinetic: problem.kinetic::<Float>(&precision(40)), wrong_sign: true };
        let found = drift_of(problem, wrong, "yoshida4", 40, 12);
        let energy = energy_variation(problem, "yoshida4", 40);
        println!("{problem:?}: {:.2e}, and H itself {energy:.2e}", found.drift.to_f64());
        assert!(found.drift.to_f64() > 1e4 * energy, "{problem:?}: {}", found.drift);
    }
}

// ---------------------------------------------------------------------------------------------------------------
// Exchanged roles: Q = p, P = −q turn H = T(p) + U(q) into U(−P) + T(Q)

kinetic! {
    struct Cosine;
    T(p) = -cos(p)
}

potential! {
    struct Pendulum;
    U(q) = -cos(q)
}

kinetic! {
    struct Stiff { omega }
    T(p) = omega^2 * p^2/2
}

/// The modified energies of 50 steps.
fn modified_energies<P: Potential<Float>, K: Kinetic<Float>, S: Scheme + ValidFor<K::Class>>(
    scheme: S,
    potential: P,
    kinetic: K,
    [q, p]: [&str; 2],
) -> Vec<Float> {
    let [q, p] = [q, p].map(|text| vec![number(text, 60)]);
    let motion = Motion::new(potential, kinetic, q, p).unwrap();
    let stepper = Stepper::with_context(scheme, "1/20", &motion.context()).unwrap();
    let mut run = ShadowRun::new(stepper.with(motion), 50, &Central::fixed(8)).unwrap();
    let mut all = Vec::new();
    while let Some((_, estimate)) = run.advance().unwrap() {
        all.push(estimate.value.clone());
    }
    all
}

/// What a drift adds to β is in one system what a kick adds in the other.
#[test]
fn the_pendulum_with_exchanged_roles_has_the_same_modified_energy() {
    for name in ["stormer-verlet", "symplectic-euler", "yoshida4"] {
        let one = modified_energies(twin(name, None), Pendulum, UnitMasses, ["0.7", "1.1"]);
        let exchanged = twin(name, Some(First::Drift)).for_every_kinetic().unwrap();
        let other = modified_energies(exchanged, Spring, Cosine, ["1.1", "-0.7"]);
        assert_eq!((one.len(), other.len()), (51, 51));
        let off = log10_largest_distance(&one, &other);
        // 60 digits, less what the differences of order 8, divided by h, make of round-off
        assert!(off < -56.0, "{name}: 10^{off}");
    }
}

/// What β gets from it costs nothing either.
#[test]
fn a_drift_of_a_quadratic_formula_costs_the_same_with_beta() {
    let stiff = Stiff { omega: Counting(1.5) };
    let mut motion = Motion::new(Spring, stiff, [Counting(0.7)], [Counting(1.1)]).unwrap();
    let weight = Counting(0.1);
    let plain = count(|| motion.drift(&weight, Carried::Nothing)).1;
    assert_eq!(plain, Operations { additions: 1, multiplications: 2, ..Operations::default() });
    assert_eq!(count(|| motion.drift(&weight, Carried::Increments)).1, plain);
}

/// ω = 3/2 has an exact square, so that nothing is rounded differently.
#[test]
fn a_quadratic_formula_has_the_bits_of_masses() {
    let context = precision(60);
    let stiff = || Stiff { omega: number("3/2", 60) };
    let read = FormulaKinetic::new("omega^2 * p^2/2", &["p"], &[("omega", number("3/2", 60))]).unwrap();
    let read = read.into_quadratic().expect("it is quadratic");
    let masses = DiagonalMasses::<Float>::new(&[rational("4/9")], &context).unwrap();
    // for quadratic T only: these three do get it
    let start = ["0.7", "1.1"];
    let of_masses = modified_energies(Nystrom, Spring, masses, start);
    assert!(same_bits(&of_masses, &modified_energies(Nystrom, Spring, stiff(), start)));
    assert!(same_bits(&of_masses, &modified_energies(nystrom(), Spring, read, start)));
    let general = FormulaKinetic::new("p^4/4", &["p"], &[] as &[(&str, Float)]).unwrap();
    assert!(general.into_quadratic().is_err());
}

// ---------------------------------------------------------------------------------------------------------------
// Bits

/// A step with which nothing is special.
const STEP: &str = "1/53";

fn same_state<N: Bits, C>(one: &AnyMotion<N, C>, other: &AnyMotion<N, C>) -> bool {
    same_bits(one.q(), other.q()) && same_bits(one.p(), other.p()) && one.beta().same_bits(other.beta())
}

fn unrolled_steps_have_the_bits_of_their_twins<N: Bits>(context: &N::Context) {
    let h = rational(STEP);
    for scheme in all_for_every_kinetic::<N>(&h, context) {
        let twin = Steps::of(scheme.twin.clone(), &h, context);
        for problem in Problem::ALL {
            let [mut one, mut other, mut plain] = array::from_fn(|_| problem.system::<N>(context));
            for _ in 0..3 {
                scheme.generated.step_augmented(&mut one);
                twin.step_augmented(&mut other);
                scheme.generated.step(&mut plain);
                assert!(same_state(&one, &other), "{problem:?}, {}", scheme.name);
                assert!(same_bits(one.q(), plain.q()) && same_bits(one.p(), plain.p()), "{problem:?}, {}", scheme.name);
            }
            scheme.generated.step_back_augmented(&mut one);
            twin.step_back_augmented(&mut other);
            assert!(same_state(&one, &other), "back: {problem:?}, {}", scheme.name);
        }
    }
}

#[test]
fn unrolled_steps_have_the_bits_of_their_twins_in_both_kinds_of_numbers() {
    unrolled_steps_have_the_bits_of_their_twins::<f64>(&());
    unrolled_steps_have_the_bits_of_their_twins::<Float>(&precision(120));
}

fn steps_are_steps<N: Bits>(context: &N::Context) {
    for scheme in all_for_every_kinetic::<N>(&rational(STEP), context) {
        for problem in Problem::ALL {
            // some 60 numbers of size 1, rounded, and enlarged a few times (see `generated.rs`)
            scheme.generated.check(&format!("{problem:?}, {}", scheme.name), || problem.system::<N>(context), 1, 2.5);
        }
    }
}

#[test]
fn steps_are_steps_in_both_kinds_of_numbers() {
    steps_are_steps::<f64>(&());
    steps_are_steps::<Float>(&precision(120));
}

fn assert_twins<N: Bits>(
    problem: Problem,
    formula: &str,
    momenta: &[&str],
    parameters: &[(&str, N)],
    context: &N::Context,
) {
    let [q, p] = problem.start().map(|texts| numbers::<N>(texts, context));
    let read: Box<dyn Kinetic<N, Class = General>> =
        Box::new(FormulaKinetic::new(formula, momenta, parameters).unwrap());
    let mut one = problem.system::<N>(context);
    let mut other = Motion::new(problem.potential(), read, q, p).unwrap();
    let steps = Steps::of(for_every_kinetic("yoshida4"), &rational(STEP), context);
    for _ in 0..3 {
        assert!(one.energy().same_bits(&other.energy()), "{problem:?}");
        steps.step(&mut one);
        steps.step(&mut other);
        assert!(same_state(&one, &other), "{problem:?}");
        steps.step_augmented(&mut one);
        steps.step_augmented(&mut other);
        assert!(same_state(&one, &other) && one.beta().log10_abs() > -6.0, "{problem:?}");
    }
}

fn all_are_twins<N: Bits>(context: &N::Context) {
    let one = N::from_rational(&rational("1"), context);
    assert_twins::<N>(Problem::RelativisticOscillator, "sqrt(c^4 + c^2*p^2)", &["p"], &[("c", one)], context);
    assert_twins::<N>(Problem::LotkaVolterra, "p - exp(p)", &["p"], &[], context);
    assert_twins::<N>(Problem::Quartic, "p^4/4 + p^2/2", &["p"], &[], context);
    let plane = "sqrt(1 + px^2 + py^2) + px*py^2/3";
    assert_twins::<N>(Problem::Plane, plane, &["px", "py"], &[], context);
}

#[test]
fn compiled_and_read_have_the_same_bits_in_both_kinds_of_numbers() {
    all_are_twins::<f64>(&());
    all_are_twins::<Float>(&precision(120));
}
