//! Protects Hamiltonians that depend on time: orders that are those proved, β, and the integrals that the steps keep.
//!
//! Yardsticks: extrapolation with derivatives written here; Mathieu's exponent from its continued fraction; closed
//! forms of forced and of damped oscillators; the integral of a potential that turns.

use std::slice::from_mut;

use rug::Float;
use shadowstep::number::{Number, Real};
use shadowstep::shadow::Bilinear;
use shadowstep::shadow::run::energy_drift;
use shadowstep::systems::explicit_time::WithTime;
use shadowstep::systems::formula::FormulaPotential;
use shadowstep::systems::many_parts::{SystemOfParts, parts};
use shadowstep::tables::shipped;
use shadowstep::{DiagonalMasses, Motion, Stepper, System, UnitMasses};
use shadowstep_tests::orders::Measured;
use shadowstep_tests::reference::Separable;
use shadowstep_tests::{coordinates, log10_distance, number, numbers, precision, rational, stepper};

const DIGITS: u32 = 60;

type Driven<N> = Motion<N, Vec<N>, FormulaPotential<N>, WithTime<DiagonalMasses<N>>>;

/// A pendulum of mass 2 with a force sin(2t/3)/2, in x, t and p, p_t.
fn pendulum<N: Number>(context: &N::Context) -> Driven<N> {
    let potential = FormulaPotential::new("-cos(x) - x*sin(2*t/3)/2", &["x", "t"], &[]).unwrap();
    let kinetic = WithTime(DiagonalMasses::new(&[rational("2")], context).unwrap());
    Motion::new(potential, kinetic, numbers(&["1/2", "1/5"], context), numbers(&["1/3", "0"], context)).unwrap()
}

/// Its flow over a time h.
fn reference(start: &[Float], h: &Float) -> Vec<Float> {
    let velocity = |p: &[Float]| vec![p[0].clone() / 2, Float::with_val(p[0].prec(), 1)];
    let gradient = |q: &[Float]| {
        let [x, t] = [q[0].clone(), q[1].clone() * 2_u32];
        let (sine, cosine) = Float::sin_cos(t / 3_u32, Float::new(x.prec()));
        vec![Float::with_val(x.prec(), x.sin_ref()) - sine / 2_u32, -cosine * x / 3_u32]
    };
    Separable { velocity: &velocity, gradient: &gradient }.flow(start, h, 12)
}

/// Kicks that came at a wrong time would leave order 1 or 2.
#[test]
fn all_schemes_have_their_order() {
    let start = || pendulum::<Float>(&precision(DIGITS));
    let flow = |h: &Float| reference(&coordinates(&start()), h);
    Measured { start: &start, coordinates: |system| coordinates(system), flow: &flow, digits: DIGITS, halvings: 8 }
        .check_all(0.1);
}

/// β belongs to H + p_t: the modified energy of a chaotic orbit moves by what the estimator leaves, far less than H +
/// p_t, and H itself by more.
#[test]
fn the_modified_energy_is_that_of_the_extended_hamiltonian() {
    let context = precision(DIGITS);
    let stepper = stepper("yoshida4", "1/20", &context);
    let (start, mut motion) = (pendulum::<Float>(&context).energy(), pendulum::<Float>(&context));
    let found = energy_drift(stepper.with(motion.clone()), 2000, &Bilinear::new(12)).unwrap();
    stepper.steps(from_mut(&mut motion), 2000);
    let of_energy = log10_distance(&motion.energy(), &start);
    assert!(motion.p()[1].to_f64().abs() > 0.1, "the drive does work");
    assert!(of_energy > -8.0 && found.drift.log10_abs() < of_energy - 6.0, "{} {of_energy}", found.drift.log10_abs());
}

/// x″ = −2u cos(2t) x: the trace of the map of a period is 2 cos(πβ).
#[test]
fn an_ion_in_a_trap_has_mathieus_exponent() {
    let context = precision(DIGITS);
    let trace = |steps: u32| {
        let h = shadowstep::StepSize::try_from(format!("pi/{steps}").as_str()).unwrap();
        let column = |q: &str, p: &str| {
            let potential = FormulaPotential::<Float>::new("2*cos(2*t)*x^2/5", &["x", "t"], &[]).unwrap();
            let (q, p) = (numbers(&[q, "0"], &context), numbers(&[p, "0"], &context));
            let mut motion = Motion::new(potential, WithTime(UnitMasses), q, p).unwrap();
            let stepper = Stepper::with_context(shipped("blanes-moan-srkn11b").unwrap(), h.clone(), &context).unwrap();
            stepper.steps(from_mut(&mut motion), steps.into());
            coordinates(&motion)
        };
        column("1", "0")[0].clone() + &column("0", "1")[2]
    };
    // β² = q (R₊ + R₋), where R± = q/((β ± 2)² − q/((β ± 4)² − …)) without the first q
    let pi = Float::with_val(context.in_bits(), rug::float::Constant::Pi);
    let u = number("2/5", DIGITS);
    let fraction = |beta: &Float, sign: i32| {
        (1..25).rev().fold(Float::new(context.in_bits()), |below, n| {
            let square = (beta.clone() + 2 * sign * n).square();
            u.clone() / (square - u.clone() * below)
        })
    };
    let mut beta = number("29/100", DIGITS);
    for _ in 0..200 {
        beta = (u.clone() * (fraction(&beta, 1) + fraction(&beta, -1))).sqrt();
    }
    let exact = (pi * &beta).cos() * 2;
    let [coarse, fine] = [20, 40].map(|steps| log10_distance(&trace(steps), &exact));
    assert!(((coarse - fine) / 2_f64.log10() - 6.0).abs() < 0.05, "{coarse} {fine}");
    assert!(fine < -11.0, "{fine}");
}

/// H = e^{−kt} p²/2 + e^{kt} x²/2 is x″ + k x′ + x = 0: t is in T and U, and p_t a part of its own.
#[test]
fn a_damped_oscillator_has_its_closed_form() {
    let context = precision(DIGITS);
    let scheme = shipped("blanes-moan-s6").unwrap().for_many_parts().unwrap();
    let error = |steps: u32| {
        let formulas = ["exp(-t/5)*p^2/2", "exp(t/5)*x^2/2", "pt"];
        let parts = parts(&formulas, (&["x", "t"], &["p", "pt"]), &[], &context).unwrap();
        let (q, p) = (numbers::<Float>(&["1", "0"], &context), numbers(&["0", "0"], &context));
        let mut system = SystemOfParts::new(parts, &q, &p).unwrap();
        let stepper = Stepper::with_context(scheme.clone(), format!("2/{steps}").as_str(), &context).unwrap();
        stepper.steps(from_mut(&mut system), steps.into());
        // e^{−t/10} (cos wt + sin wt/(10 w)) with w² = 99/100
        let w = number("99/100", DIGITS).sqrt();
        let (sine, cosine) = Float::with_val(w.prec(), &w * 2_u32).sin_cos(Float::new(context.in_bits()));
        let exact = number("-1/5", DIGITS).exp() * (cosine + sine / (w * 10));
        log10_distance(&system.state().q()[0], &exact)
    };
    let slope = (error(20) - error(40)) / 2_f64.log10();
    assert!((slope - 4.0).abs() < 0.05, "{slope}");
}

/// A potential that turns with the rate w: p_t + w (x p_y − y p_x) is conserved by each kick and each drift, so to
/// round-off.
#[test]
fn steps_keep_jacobis_integral_of_a_bar() {
    let bar = "log(1/100 + (x*cos(t) + y*sin(t))^2 + (y*cos(t) - x*sin(t))^2*25/16)/2";
    for name in ["stormer-verlet", "blanes-moan-srkn6b", "chin-4a"] {
        let context = precision(DIGITS);
        let potential = FormulaPotential::<Float>::new(bar, &["x", "y", "t"], &[]).unwrap();
        let (q, p) = (numbers(&["1/2", "0", "0"], &context), numbers(&["0", "4/5", "0"], &context));
        let mut motion = Motion::new(potential, WithTime(UnitMasses), q, p).unwrap();
        let integral = |state: &[Float]| {
            let [x, y, _, px, py, pt] = state else { unreachable!("two coordinates and t") };
            x.clone() * py - y.clone() * px + pt
        };
        let start = integral(&coordinates(&motion));
        stepper(name, "1/10", &context).steps(from_mut(&mut motion), 1000);
        let moved = log10_distance(&integral(&coordinates(&motion)), &start);
        assert!(motion.p()[2].to_f64().abs() > 1e-3, "{name}: the bar does work");
        // a thousand steps of some 1e-60 each, which an unstable orbit does not increase
        assert!(moved < -54.0, "{name}: {moved}");
    }
}
