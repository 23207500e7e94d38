//! Protects systems whose oscillations are solved exactly: the flow, the orders, the modified energy, and steps above
//! the limit of T(p) and U(q).
//!
//! Yardsticks: cos and sin of one oscillator; the same system with T(p) and U(q), extrapolated from leapfrog steps.

use rug::Float;
use shadowstep::number::{CorrectlyRounded, Limbs, Number};
use shadowstep::problems::{HarmonicOscillator, HenonHeiles, StiffFput};
use shadowstep::shadow::{Bilinear, Criterion, ShadowEnergy, Verdict};
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::systems::linear_part::LinearPart;
use shadowstep::{Motion, Rational, System, UnitMasses};
use shadowstep_tests::orders::Measured;
use shadowstep_tests::reference::Separable;
use shadowstep_tests::shipped::{all, twin};
use shadowstep_tests::steps::Steps;
use shadowstep_tests::{Bits, coordinates, log10_largest_distance, numbers, precision, rational, stepper, variations};

const DIGITS: u32 = 60;

fn diagonal(values: &[&str]) -> Vec<Vec<Rational>> {
    let zero = || rational("0");
    let row = |i: usize| (0..values.len()).map(|j| if i == j { rational(values[i]) } else { zero() }).collect();
    (0..values.len()).map(row).collect()
}

fn ones(count: usize) -> Vec<Rational> {
    vec![rational("1"); count]
}

/// Hénon–Heiles with both oscillators, ω = 1, as the linear part.
fn henon_heiles<N: CorrectlyRounded>(context: &N::Context) -> LinearPart<N, HenonHeiles> {
    let (q, p) = (numbers(&["0.1", "0.2"], context), numbers(&["0.3", "-0.1"], context));
    LinearPart::new(HenonHeiles, &ones(2), &diagonal(&["1", "1"]), &q, &p).expect("the dimensions agree")
}

#[test]
fn the_flow_of_an_oscillator_is_exact() {
    for (omega, time) in [("1/10", "1"), ("3", "1"), ("50", "1/3"), ("1000", "7")] {
        let k = rational(omega) * rational(omega);
        let number = |text: &str| Float::from_rational(&rational(text), &precision(DIGITS));
        let potential = HarmonicOscillator { omega: number(omega) };
        let (q, p) = (vec![number("0.6")], vec![number("0.8")]);
        let stiffness = [vec![k]];
        let mut system = LinearPart::new(potential, &ones(1), &stiffness, &q, &p).expect("one dimension");
        stepper::<Float>("stormer-verlet", time, &precision(DIGITS)).step(&mut system);
        let angle = number(omega) * number(time);
        let (sin, cos) = (angle.clone().sin(), angle.cos());
        let exact_q = q[0].clone() * &cos + p[0].clone() * &sin / number(omega);
        let exact_p = p[0].clone() * &cos - q[0].clone() * &sin * number(omega);
        let off = log10_largest_distance(&[system.state().q(), system.state().p()].concat(), &[exact_q, exact_p]);
        // the rounding of kicks by U_q − Kq, which is round-off of ω² q, and of the sines of the yardstick
        let size = 2.0 * f64::from_rational(&rational(omega), &()).log10().max(0.0);
        assert!(off < size + 2.0 - f64::from(DIGITS), "ω = {omega}: 10^{off}");
    }
}

#[test]
fn the_orders_are_those_proved() {
    let context = precision(DIGITS);
    let gradient = |q: &[Float]| {
        let [x, y] = [q[0].clone(), q[1].clone()];
        vec![x.clone() + x.clone() * &y * 2, y.clone() + x.square() - y.square()]
    };
    let start = || henon_heiles::<Float>(&context);
    let separable = Separable { velocity: &|p| p.to_vec(), gradient: &gradient };
    let flow = |h: &Float| separable.flow(&coordinates(&start()), h, 12);
    let measured =
        Measured { start: &start, coordinates: |system| coordinates(system), flow: &flow, digits: DIGITS, halvings: 7 };
    for order in measured.orders(all, |scheme| scheme.summary.order_quadratic) {
        // c h/ln 2 with c of size 1 to 10; near-integrable schemes may show a higher power of h with a small constant
        // first
        let off = if order.near_integrable { order.proved - order.measured } else { order.off() };
        assert!(off < 0.15, "{order:?}");
    }
}

#[test]
fn the_modified_energy_is_conserved() {
    let stepper = stepper::<Limbs<4>>("stormer-verlet", "1/10", &());
    let [energy, modified, _] = variations::of_energies(&stepper, || henon_heiles::<Limbs<4>>(&()), 400, [12, 8]);
    assert!(energy > 1e-6 && modified < 1e-16, "H varies by {energy:e}, E_12 by {modified:e}");
}

#[test]
fn steps_are_steps_in_both_kinds_of_numbers() {
    fn check<N: Bits + CorrectlyRounded>(context: &N::Context) {
        // some hundred roundings of numbers below 1
        let steps = Steps::of(twin("yoshida4", None), &rational("1/3"), context);
        steps.check("yoshida4", || henon_heiles::<N>(context), 10, 1.5);
    }
    check::<f64>(&());
    check::<Float>(&precision(DIGITS));
}

/// Three stiff springs, ω = 50, and the rest of the chain.
fn stiff() -> (StiffFput<f64>, Vec<f64>, Vec<f64>) {
    let q = vec![1.0, 0.0, 0.0, 1.0 / 50.0, 0.0, 0.0];
    (StiffFput { omega: 50.0 }, q, vec![1.0, 0.0, 0.0, 1.0, 0.0, 0.0])
}

/// Above hω = 2 Störmer–Verlet with T(p) and U(q) is unstable, and the monitor reports it; with the oscillations solved
/// exactly it is not.
#[test]
fn a_step_above_the_limit_of_the_stiff_springs_is_bounded() {
    let stepper = stepper::<f64>("stormer-verlet", "1/20", &());
    let settings = Bilinear::with_error(8);
    let (potential, q, p) = stiff();
    let mut motion = Motion::new(potential.clone(), UnitMasses, q.clone(), p.clone()).expect("six dimensions");
    let mut monitor = ShadowEnergy::new(stepper.clone(), &mut motion, &settings).expect("it is finite");
    let stable = (0..2000).all(|_| monitor.step(&mut motion).is_ok());
    assert!(!stable || !monitor.report().verdict.is_bounded());

    // the soft springs are of degree 4
    let stiffness = diagonal(&["0", "0", "0", "2500", "2500", "2500"]);
    let mut system = LinearPart::new(potential, &ones(6), &stiffness, &q, &p).expect("six dimensions");
    let before = System::energy(&mut system);
    let mut monitor = ShadowEnergy::new(stepper, &mut system, &settings).expect("it is finite");
    let mut largest = 0.0_f64;
    for _ in 0..20_000 {
        monitor.step(&mut system).expect("it is finite");
        largest = largest.max((System::energy(&mut system) - before).abs());
    }
    println!("{}; the largest error of H is {largest:e} of {before}", monitor.report());
    assert!(largest < 0.1 * before);
}

/// The verdict on 6000 steps with hω = `part` π.
fn verdict<M: System<Number = f64, Class = Quadratic>>(scheme: &str, part: &str, mut system: M) -> Verdict {
    let stepper = stepper::<f64>(scheme, &format!("{part}*pi/50"), &());
    let mut monitor = ShadowEnergy::new(stepper, &mut system, &Bilinear::with_error(8)).expect("it is finite");
    for _ in 0..6000 {
        if monitor.step(&mut system).is_err() {
            return Verdict::TooLarge(Criterion::NotFinite);
        }
    }
    monitor.report().verdict
}

/// With T(p) and U(q) Störmer–Verlet ends at hω = 2, and PEFRL has a gap around π. With the oscillations solved exactly
/// there is a narrow resonance at π, where 2ω is 2π/h, and both sides of it are fine.
#[test]
fn the_resonances_move() {
    let (potential, q, p) = stiff();
    let stiffness = diagonal(&["0", "0", "0", "2500", "2500", "2500"]);
    let linear = |part: &str| {
        let system = LinearPart::new(potential.clone(), &ones(6), &stiffness, &q, &p).expect("six dimensions");
        verdict("stormer-verlet", part, system)
    };
    let plain = |scheme: &str, part: &str| {
        verdict(scheme, part, Motion::new(potential.clone(), UnitMasses, q.clone(), p.clone()).expect("six dimensions"))
    };
    for part in ["0.7", "0.9", "1.1", "1.3"] {
        assert!(linear(part).is_bounded(), "{part}: {:?}", linear(part));
        assert!(matches!(plain("stormer-verlet", part), Verdict::TooLarge(_)), "{part}");
    }
    assert!(matches!(linear("1"), Verdict::TooLarge(_)), "{:?}", linear("1"));
    assert!(plain("pefrl", "0.7").is_bounded());
    for part in ["0.9", "1", "1.1", "1.3"] {
        assert!(matches!(plain("pefrl", part), Verdict::TooLarge(_)), "{part}");
    }
}
