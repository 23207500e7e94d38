//! Protects force-gradient kicks: their sign and factor, the refusal of wrong ones, Hessian–vector products, β.

use rug::Float;
use shadowstep::problems::{Kepler, PROBLEMS};
use shadowstep::shadow::run::{RunError, energy_drift};
use shadowstep::shadow::{Bilinear, ShadowEnergy, Verdict};
use shadowstep::steps::MismatchError;
use shadowstep::systems::formula::{FormulaPair, FormulaPotential};
use shadowstep::systems::pairs::{Ends, Pairs, Separation};
use shadowstep::systems::potential::{HessianProduct, from_fn};
use shadowstep::tables::shipped;
use shadowstep::{Motion, Number, Potential, Real, Stepper, System, UnitMasses, potential};
use shadowstep_tests::refusals::judge;
use shadowstep_tests::{log10_largest_distance, numbers, precision, rational, same_bits, variations, watched};

const DIGITS: u32 = 90;

/// What is said of wrong tables is in refused_tables.md.
#[test]
fn gradient_kicks_are_for_quadratic_kinetic_energy() {
    assert_eq!(shipped("chin-4a").unwrap().for_every_kinetic().unwrap_err().order, 0);
}

/// Near-integrable orders of the leapfrog with [B,[A,B]] and a corrector: (8,4,3) for a weight of 1/24, where [A,[A,B]]
/// is taken out by the corrector. A weight of 1/12, which takes [B,[A,B]] out of the kernel alone, leaves it to the
/// processed scheme.
#[test]
fn near_integrable_orders_are_proved_with_gradient_kicks() {
    let table = shadowstep_schemes::shipped("wisdom-kernel-7").unwrap().text;
    let effective = judge(&table).unwrap().proof.effective.unwrap();
    let orders: Vec<_> = effective.near_integrable.iter().map(|order| order.order).collect();
    assert_eq!((orders, effective.quadratic.order), (vec![8, 4, 3], 4));
    let failing = "effective order 2 holds for the terms of ε^2: the condition of the word KKD fails";
    for (from, to, failing) in [
        ("\"1/24\"", "\"1/12\"", failing),
        ("\"1/24\"", "\"-1/24\"", failing),
        ("[8, 4, 3]", "[8, 6, 3]", "effective order 6 is claimed, effective order 4 holds for the terms of ε^2"),
    ] {
        let message = judge(&table.replace(from, to)).unwrap_err().to_string();
        assert!(message.contains(failing), "{from} → {to}: {message}");
    }
}

/// A composition scales gradient kicks with γ³: a triple jump of a scheme of order 4 has order 6.
#[test]
fn a_composition_of_gradient_kicks() {
    let table = r#"name = "mine"
order = 6
kinetic = "quadratic"
symmetric = true
reference = "none"

[constants]
g = "1/(2 - 2^(1/5))"

[composition]
base = "chin-4a"
gamma = ["g", "1 - 2*g", "g"]
"#;
    let proved = judge(table).unwrap();
    assert_eq!(proved.proof.quadratic.order, 6);
    assert_eq!((proved.plan.evaluations, proved.plan.hessian_products), (6, 3));
}

/// U_qq v and vᵀ∂(qᵀU_q − 2U)/∂q against central differences.
fn assert_second_derivatives(potential: &dyn Potential<Float>, q: &[Float], what: &str) {
    let context = precision(DIGITS);
    let zeros = |n: usize| vec![Float::new(context.in_bits()); n];
    let v: Vec<_> = (0..q.len()).map(|i| Float::with_val(context.in_bits(), 3 * i as i32 % 7 - 2) / 3).collect();
    let hessian = potential.hessian().unwrap_or_else(|| panic!("{what} has second derivatives"));
    let mut scratch = zeros(hessian.hessian_scratch());
    hessian.prepare_hessian(&mut scratch, &context);
    let (mut plain, mut product, mut rate) = (zeros(q.len()), zeros(q.len()), zeros(1).remove(0));
    hessian.hessian_product(q, &v, &mut plain, &mut scratch);
    hessian.hessian_product_and_rate(q, &v, &mut product, &mut rate, &mut scratch);
    assert!(same_bits(&plain, &product), "{what}");

    let mut space = zeros(potential.scratch());
    potential.prepare(&mut space, &context);
    let shift = Float::with_val(context.in_bits(), 1) >> 100;
    let mut at = |sign: i32| {
        let moved: Vec<_> = q.iter().zip(&v).map(|(q, v)| q.clone() + v.clone() * &shift * sign).collect();
        let (mut gradient, mut rate) = (zeros(q.len()), zeros(1).remove(0));
        potential.gradient_and_rate(&moved, &mut gradient, &mut rate, &mut space);
        gradient.push(rate);
        gradient
    };
    let (ahead, behind) = (at(1), at(-1));
    let expected: Vec<_> = ahead.into_iter().zip(behind).map(|(a, b)| (a - b) / &shift / 2).collect();
    product.push(rate);
    let size = expected.iter().map(Real::log10_abs).fold(f64::NEG_INFINITY, f64::max);
    let off = log10_largest_distance(&product, &expected);
    assert!(off < size - 50.0, "{what}: 10^{off} of 10^{size}");
}

#[test]
fn second_derivatives_are_those_of_the_gradient() {
    let context = precision(DIGITS);
    for problem in PROBLEMS {
        let setup = problem.setup(&[], DIGITS).unwrap();
        let potential = setup.potential::<Float>(&context);
        // FPUT's chains begin at rest with some springs at 0
        let moved = |(i, q): (usize, Float)| q * (1.0 + 1e-3 * i as f64) + 0.01 * i as f64;
        let q: Vec<_> = setup.values.q::<Float>(&context).into_iter().enumerate().map(moved).collect();
        assert_second_derivatives(&*potential, &q, problem.name());
    }
}

potential! {
    /// Everything that a formula may have.
    pub struct Mixed { a, b }
    U(x, y) = a*exp(-x^2)*cos(y) + atan(b*x*y) + sqrt(1 + x^2 + y^4) - log(2 + tanh(x)) + cbrt(3 + x*y)
}

potential! {
    /// A spring in d.
    pub struct Spring { k }
    pair U(d) = k*d^2/2 + d^3/3 + exp(-d)
}

potential! {
    /// Masses that attract each other.
    pub struct Gravity { g }
    pair U(r2; m_i, m_j) = -g*m_i*m_j/sqrt(r2)
}

#[test]
fn formulas_have_the_second_derivatives_of_compiled_ones_bit_for_bit() {
    const TEXT: &str = "a*exp(-x^2)*cos(y) + atan(b*x*y) + sqrt(1 + x^2 + y^4) - log(2 + tanh(x)) + cbrt(3 + x*y)";
    let context = precision(DIGITS);
    let number = |text: &str| Float::from_rational(&rational(text), &context);
    let compiled = Mixed { a: number("0.7"), b: number("1.3") };
    let parameters = [("a", number("0.7")), ("b", number("1.3"))];
    let read = FormulaPotential::new(TEXT, &["x", "y"], &parameters).unwrap();
    let (q, v) = (numbers::<Float>(&["0.3", "-1.2"], &context), numbers::<Float>(&["0.9", "0.4"], &context));
    assert_second_derivatives(&compiled, &q, "compiled");
    assert_eq!(products(&compiled, &q, &v), products(&read, &q, &v));

    let masses = numbers::<Float>(&["1", "2", "0.5"], &context);
    let pair = Pairs::<_, 2>::all(3, Gravity { g: number("1.1"), m: masses.clone() }).unwrap();
    let formula =
        FormulaPair::new("-g*m_i*m_j/sqrt(r2)", Separation::SquaredDistance, &[("m", masses)], &[("g", number("1.1"))]);
    let read = Pairs::<_, 2>::all(3, formula.unwrap()).unwrap();
    let q = numbers::<Float>(&["0.1", "0.2", "1.3", "-0.4", "-0.8", "0.9"], &context);
    let v = numbers::<Float>(&["1", "-0.5", "0.3", "0.2", "0.7", "-0.1"], &context);
    assert_second_derivatives(&pair, &q, "pairs");
    assert_eq!(products(&pair, &q, &v), products(&read, &q, &v));
    for ends in [Ends::Free, Ends::Fixed, Ends::Periodic] {
        let chain = Pairs::<_, 1>::neighbours(6, Spring { k: number("1.7") }, ends).unwrap();
        assert_second_derivatives(&chain, &q, "a chain");
    }
}

/// U_qq v and its rate.
fn products(potential: &dyn Potential<Float>, q: &[Float], v: &[Float]) -> (Vec<Float>, Float) {
    let context = precision(DIGITS);
    let hessian: &dyn HessianProduct<Float> = potential.hessian().unwrap();
    let mut scratch = vec![Float::new(context.in_bits()); hessian.hessian_scratch()];
    hessian.prepare_hessian(&mut scratch, &context);
    let (mut product, mut rate) = (vec![Float::new(context.in_bits()); q.len()], Float::new(context.in_bits()));
    hessian.hessian_product_and_rate(q, v, &mut product, &mut rate, &mut scratch);
    (product, rate)
}

/// H̄ of E_k converges with k on a nonlinear problem, which it would not with a wrong rate of β.
#[test]
fn the_modified_energy_of_gradient_kicks_converges() {
    let context = precision(DIGITS);
    let motion = || {
        let [q, p] = [["0.1", "-0.1"], ["0.2", "0.15"]].map(|texts| numbers::<Float>(&texts, &context));
        Motion::new(shadowstep::problems::HenonHeiles, UnitMasses, q, p).unwrap()
    };
    for name in ["chin-4a", "chin-4b", "omelyan-4mn2f2gv"] {
        let stepper = Stepper::with_context(shipped(name).unwrap(), "1/4", &context).unwrap();
        let [energy, eight, sixteen] = variations::of_energies(&stepper, motion, 200, [8, 16]);
        println!("{name}: H varies by {energy:e}, E_8 by {eight:e}, E_16 by {sixteen:e}");
        assert!(energy > 1e-9 && eight < 1e-12 && sixteen < 1e-5 * eight, "{name}: {energy:e}, {eight:e}, {sixteen:e}");
    }
}

#[test]
fn hessian_products_are_counted_and_kept() {
    let mut motion = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]).unwrap();
    let stepper = Stepper::new(shipped("chin-4a").unwrap(), "1/20").unwrap();
    (0..10).for_each(|_| stepper.step(&mut motion));
    assert_eq!((motion.evaluations(), motion.hessian_products()), (21, 10));
    // several steps at once have the same bits
    let mut together = [Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]).unwrap()];
    stepper.steps(&mut together, 10);
    assert!(same_bits(together[0].q(), motion.q()) && same_bits(together[0].p(), motion.p()));
}

#[test]
fn a_potential_without_second_derivatives_says_so() {
    let spring = from_fn(1, |q, gradient| {
        gradient[0] = q[0];
        q[0] * q[0] / 2.0
    });
    let motion = Motion::new(spring, UnitMasses, [1.0], [0.0]).unwrap();
    assert!(!motion.has_gradient_kicks());
    let stepper = Stepper::new(shipped("chin-4a").unwrap(), "1/20").unwrap();
    // runs and the monitor refuse it, a step alone panics
    let expected = RunError::Mismatch(MismatchError::NoGradientKicks { scheme: "chin-4a".to_owned() });
    let drift = energy_drift(stepper.with(motion.clone()), 10, &Bilinear::new(2)).unwrap_err();
    let monitor = ShadowEnergy::new(stepper.clone(), &mut motion.clone(), &Bilinear::with_error(8)).unwrap_err();
    assert_eq!([&drift, &monitor], [&expected; 2]);
    assert!(drift.to_string().starts_with("chin-4a has gradient kicks, which this system has not"), "{drift}");
    let step = std::panic::AssertUnwindSafe(|| stepper.step(&mut motion.clone()));
    let panic = std::panic::catch_unwind(step).unwrap_err();
    let message = panic.downcast_ref::<&str>().copied().or(panic.downcast_ref::<String>().map(String::as_str));
    assert!(message.unwrap().contains("write it as a formula, or implement `Potential::hessian`"), "{message:?}");
}

/// The verdict on steps that resolve the pericentre and on some that do not.
#[test]
fn the_monitor_judges_gradient_kicks() {
    let watch = |scheme: &str, h: &str, steps: u64| {
        let mut motion = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]).unwrap();
        watched(Stepper::new(shipped(scheme).unwrap(), h).unwrap(), &mut motion, &Bilinear::with_error(8), 20, steps)
    };
    // with the coarse steps the orbit is lost, sooner or later
    for (scheme, coarse) in [("chin-4c", "2/3"), ("omelyan-4mn3f1gp", "1/2"), ("takahashi-imada", "1/3")] {
        let fine = watch(scheme, "1/40", 10_000);
        assert!(fine.verdict == Verdict::Bounded, "{scheme}: {fine}");
        assert!(fine.range < fine.energy_error / 20.0, "{scheme}: H̄ {:e}, H {:e}", fine.range, fine.energy_error);
        let coarse = watch(scheme, coarse, 3000);
        assert!(!coarse.verdict.is_bounded(), "{scheme}: {coarse}");
    }
}
