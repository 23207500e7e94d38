//! Protects the trait `System` for systems with flows of their own: all schemes that are valid for every T(p) advance
//! one, and runs and the monitor follow its modified energy.
//!
//! H = A + B with A = (q² + p²)²/4, which is not a T(p), and B = q³/10. The flow of A turns (q, p) by the angle r²t,
//! r² = q² + p². Along it β grows by qA_q + pA_p − 2A = 2A, as A is of degree 4; along the flow of B by qB_q − 2B = B.

use rug::Float;
use shadowstep::shadow::run::{ShadowRun, energy_drift};
use shadowstep::shadow::{Bilinear, Central, Criterion, ShadowEnergy, Verdict};
use shadowstep::systems::kinetic::General;
use shadowstep::systems::summation::{Half, Plain};
use shadowstep::{Carried, Integrator as _, Number, OwnedIncrements, Real, State, Stepper, System, splitting_scheme};
use shadowstep_tests::shipped::all_for_every_kinetic;
use shadowstep_tests::{Bits, precision, rational, variations};

#[derive(Clone, Copy)]
#[splitting_scheme("yoshida4.toml")]
struct Yoshida4;

#[derive(Clone, Copy)]
#[splitting_scheme("stormer-verlet.toml")]
struct StormerVerlet;

/// The system with its state.
#[derive(Clone)]
struct Rotor<N> {
    state: State<N, [N; 1]>,
    /// The degree of A, 4: along its flow β grows by (degree − 2) A.
    degree: i32,
    /// q(t) − q and p(t) − p along the flow of A.
    turn: [N; 2],
    /// Intermediate results.
    scratch: [N; 3],
}

impl<N: Number> Rotor<N> {
    fn new(start: [&str; 2], context: &N::Context) -> Self {
        let zero = || N::zero(context);
        let [q, p] = start.map(|text| [N::from_rational(&rational(text), context)]);
        Rotor { state: State::new(q, p, context), degree: 4, turn: [zero(), zero()], scratch: [zero(), zero(), zero()] }
    }

    fn energies(&mut self) -> [N; 2] {
        let zero = N::zero(&self.state.context());
        let [mut energy, mut kinetic] = [zero.clone(), zero];
        self.assign_energy(None, &mut energy);
        self.assign_kinetic_energy(None, &mut kinetic);
        [energy, kinetic]
    }

    /// q and p.
    fn point(&self) -> [N; 2] {
        [self.state.q()[0].clone(), self.state.p()[0].clone()]
    }

    /// turn ← (p sin θ − 2q sin²(θ/2), −q sin θ − 2p sin²(θ/2)) with θ = r² weight; the first scratch ← r²
    fn assign_turn(&mut self, weight: &N) {
        let Rotor { state, turn: [to_q, to_p], scratch: [square, sine, versine], .. } = self;
        let (q, p) = (&state.q()[0], &state.p()[0]);
        assign_squared_radius(square, q, p);
        versine.assign_product(square, weight);
        sine.assign_sin(versine);
        versine.divide_integer(2);
        to_q.assign_sin(versine);
        versine.assign_square(to_q);
        versine.multiply_integer(2);
        to_q.assign_product(p, sine);
        to_q.subtract_product(q, versine);
        to_p.assign_product(q, sine);
        to_p.negate();
        to_p.subtract_product(p, versine);
    }

    /// The first scratch ← 3q²/10
    fn assign_slope(&mut self) {
        let Rotor { state, scratch: [slope, ..], .. } = self;
        slope.assign_square(&state.q()[0]);
        slope.multiply_integer(3);
        slope.divide_integer(10);
        state.count_evaluation();
    }
}

fn assign_squared_radius<N: Number>(square: &mut N, q: &N, p: &N) {
    square.assign_square(q);
    square.add_product(p, p);
}

/// b ← q³/10
fn assign_b<N: Number>(b: &mut N, q: &N) {
    b.assign_square(q);
    b.multiply(q);
    b.divide_integer(10);
}

impl<N: Number> System for Rotor<N> {
    type Number = N;
    type Class = General;
    type Coordinates = [N; 1];
    type Summation = Plain;

    fn state(&self) -> &State<N, [N; 1]> {
        &self.state
    }

    fn state_mut(&mut self) -> &mut State<N, [N; 1]> {
        &mut self.state
    }

    fn clear_increments(&mut self) {
        self.state.clear_increments();
    }

    fn kick(&mut self, weight: &N, carried: Carried) {
        self.assign_slope();
        let Rotor { state, scratch: [slope, b, _], .. } = self;
        state.change(Half::Momenta, 0, carried, |p| p.subtract_product(weight, slope));
        assign_b(b, &state.q()[0]);
        state.add_to_beta(carried, weight, b);
    }

    fn drift(&mut self, weight: &N, carried: Carried) {
        self.assign_turn(weight);
        let Rotor { state, turn: [to_q, to_p], degree, scratch: [square, rate, _], .. } = self;
        state.change(Half::Positions, 0, carried, |q| q.add(to_q));
        state.change(Half::Momenta, 0, carried, |p| p.add(to_p));
        rate.assign_square(square);
        rate.multiply_integer(*degree - 2);
        rate.divide_integer(4);
        state.add_to_beta(carried, weight, rate);
    }

    fn assign_energy(&mut self, at: Option<(&[N], &[N])>, energy: &mut N) {
        let mut kinetic = N::zero(&energy.context());
        self.assign_kinetic_energy(at, &mut kinetic);
        let (q, _) = at.unwrap_or((self.state.q(), self.state.p()));
        assign_b(energy, &q[0]);
        energy.add(&kinetic);
    }

    /// A is taken for the kinetic energy.
    fn assign_kinetic_energy(&mut self, at: Option<(&[N], &[N])>, kinetic: &mut N) {
        let Rotor { state, scratch: [square, ..], .. } = self;
        let (q, p) = at.unwrap_or((state.q(), state.p()));
        assign_squared_radius(square, &q[0], &p[0]);
        kinetic.assign_square(square);
        kinetic.divide_integer(4);
    }
}

const START: [&str; 2] = ["0.9", "-0.3"];

/// A step with which nothing is special.
const STEP: &str = "1/53";

/// q' = H_p and p' = −H_q in plain formulas, by the classical Runge–Kutta scheme of order 4.
fn reference([mut q, mut p]: [f64; 2], until: f64, steps: u32, with_b: bool) -> [f64; 2] {
    let h = until / f64::from(steps);
    let slope = if with_b { 0.3 } else { 0.0 };
    let f = |q: f64, p: f64| [(q * q + p * p) * p, -(q * q + p * p) * q - slope * q * q];
    for _ in 0..steps {
        let a = f(q, p);
        let b = f(q + h / 2.0 * a[0], p + h / 2.0 * a[1]);
        let c = f(q + h / 2.0 * b[0], p + h / 2.0 * b[1]);
        let d = f(q + h * c[0], p + h * c[1]);
        q += h / 6.0 * (a[0] + 2.0 * b[0] + 2.0 * c[0] + d[0]);
        p += h / 6.0 * (a[1] + 2.0 * b[1] + 2.0 * c[1] + d[1]);
    }
    [q, p]
}

// ---------------------------------------------------------------------------------------------------------------
// Flows and steps

#[test]
fn the_drift_is_the_flow_of_a() {
    let mut rotor = Rotor::<f64>::new(START, &());
    let start = rotor.point();
    let [_, a] = rotor.energies();
    // (0.9² + 0.3²)²/4
    assert!((a - 0.2025).abs() < 1e-15);
    rotor.drift(&2.5, Carried::Increments);
    let exact = reference(start, 2.5, 2000, false);
    // the reference is off by some (2.5/2000)⁴ = 2e-12 and less
    assert!((rotor.point()[0] - exact[0]).hypot(rotor.point()[1] - exact[1]) < 1e-12, "{:?}, {exact:?}", rotor.point());
    let OwnedIncrements { q, p, beta } = rotor.state.increments().to_owned();
    assert!((beta - 2.0 * a * 2.5).abs() < 1e-15 && (rotor.energies()[1] - a).abs() < 1e-15);
    assert_eq!([start[0] + q[0], start[1] + p[0]], rotor.point());
}

#[test]
fn steps_are_steps_in_both_kinds_of_numbers() {
    fn check<N: Bits>(context: &N::Context) {
        for scheme in all_for_every_kinetic::<N>(&rational(STEP), context) {
            scheme.generated.check(&scheme.name, || Rotor::<N>::new(START, context), 3, 2.5);
        }
    }
    check::<f64>(&());
    check::<Float>(&precision(60));
}

#[test]
fn yoshida_has_order_4() {
    let start = Rotor::<f64>::new(START, &()).point();
    let [good, better] = [16_000, 32_000].map(|steps| reference(start, 8.0, steps, true));
    assert!((good[0] - better[0]).hypot(good[1] - better[1]) < 1e-12);
    let errors = [4, 8, 16, 32].map(|n: u32| {
        let stepper = Stepper::new(Yoshida4, 1.0 / f64::from(n)).unwrap();
        let mut rotor = Rotor::<f64>::new(START, &());
        (0..8 * n).for_each(|_| stepper.step(&mut rotor));
        (rotor.point()[0] - better[0]).hypot(rotor.point()[1] - better[1])
    });
    let orders: Vec<f64> = errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect();
    println!("{errors:?}, {orders:?}");
    assert!(errors[3] > 1e-9 && orders[1..].iter().all(|order| (order - 4.0).abs() < 0.1), "{errors:?}, {orders:?}");
}

// ---------------------------------------------------------------------------------------------------------------
// The modified energy

/// By Störmer–Verlet steps of 1/20: H varies, by some 1e-5 and more.
fn the_modified_energy_is_conserved<N: Real>(context: &N::Context, most: f64) {
    let stepper = Stepper::<_, N>::with_context(StormerVerlet, "1/20", context).unwrap();
    let rotor = || Rotor::<N>::new(START, context);
    let energy = variations::of_energy(&stepper, rotor(), 1000);
    for found in [
        energy_drift(stepper.with(rotor()), 1000, &Bilinear::new(12)).unwrap(),
        energy_drift(stepper.with(rotor()), 1000, &Central::fixed(20)).unwrap(),
    ] {
        assert!(energy > 1e-5 && found.drift.to_f64() < most, "{energy:e}, {:e}", found.drift.to_f64());
        assert!((found.first.to_f64() - Rotor::<f64>::new(START, &()).energies()[0]).abs() < energy);
    }
}

#[test]
fn the_modified_energy_is_conserved_in_both_kinds_of_numbers() {
    the_modified_energy_is_conserved::<f64>(&(), 1e-14);
    the_modified_energy_is_conserved::<Float>(&precision(60), 1e-20);
}

/// With the β of a quadratic A it is not.
#[test]
fn with_the_wrong_beta_it_is_not_conserved() {
    let stepper = Stepper::new(StormerVerlet, "1/20").unwrap();
    let energy = variations::of_energy(&stepper, Rotor::<f64>::new(START, &()), 1000);
    for degree in [2, 3, 5] {
        let wrong = Rotor { degree, ..Rotor::<f64>::new(START, &()) };
        let found = energy_drift(stepper.with(wrong), 1000, &Bilinear::new(12)).unwrap();
        assert!(found.drift > 10.0 * energy, "degree {degree}: {:e}, and H itself {energy:e}", found.drift);
    }
}

/// One estimate for each state, with the states of the steps.
#[test]
fn a_run_has_the_states_of_its_steps() {
    let stepper = Stepper::new(Yoshida4, STEP).unwrap();
    let mut run = ShadowRun::new(stepper.with(Rotor::<f64>::new(START, &())), 200, &Bilinear::new(8)).unwrap();
    let mut rotor = Rotor::<f64>::new(START, &());
    let mut n = 0;
    while let Some((found, estimate)) = run.advance().unwrap() {
        assert_eq!((found, estimate.q, estimate.p), (n, rotor.state().q(), rotor.state().p()));
        stepper.step(&mut rotor);
        n += 1;
    }
    assert_eq!(n, 201);
    // 4 kicks a step, and 4 + 200 + 4 steps; the initial state is returned to without one
    assert_eq!(run.integrator().state().evaluations(), 208 * 4);
}

// ---------------------------------------------------------------------------------------------------------------
// The monitor

fn watch<N: Real>(h: &str, steps: u64, context: &N::Context) -> shadowstep::shadow::Report<N> {
    let mut rotor = Rotor::<N>::new(START, context);
    let stepper = Stepper::with_context(StormerVerlet, h, context).unwrap();
    let mut monitor = ShadowEnergy::new(stepper, &mut rotor, &Bilinear::with_error(8)).unwrap().every(20);
    for _ in 0..steps {
        // a state that is not finite is reported as well
        if monitor.step(&mut rotor).is_err() {
            break;
        }
    }
    monitor.report()
}

#[test]
fn the_monitor_follows_it() {
    let fine = watch::<f64>("1/20", 20_000, &());
    println!("{fine}");
    assert_eq!((fine.verdict, fine.mismatches), (Verdict::Bounded, 0), "{fine}");
    assert!(fine.energy_error > 1e-5 && fine.moved < 1e-8 * fine.energy_error, "{fine}");
    // r² = 0.9 turns once in 2π/0.9 = 7.0, or 140 steps; B makes it slower or faster by less than a third
    assert!((100.0..200.0).contains(&fine.steps_per_turn.unwrap()), "{fine}");
    let precise = watch::<Float>("1/20", 2000, &precision(40));
    assert_eq!(precise.verdict, Verdict::Bounded, "{precise}");
}

#[test]
fn the_monitor_refuses_hopeless_steps() {
    for (h, criterion) in [("1", Criterion::EnergyError), ("3/2", Criterion::NotFinite)] {
        let report = watch::<f64>(h, 20_000, &());
        assert_eq!(report.verdict, Verdict::TooLarge(criterion), "h = {h}: {report}");
    }
}
