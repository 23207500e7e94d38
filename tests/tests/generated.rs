//! Protects the code that the attribute writes: for every shipped table it does what the table states, bit for bit what
//! the same table does when it is read at run time, and costs what its documentation states.

use num_traits::{One, Signed};
use rug::Float;
use shadowstep::number::counting::{Counting, Operations, count};
use shadowstep::problems::{HenonHeiles, Kepler};
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::systems::potential::HessianProduct;
use shadowstep::{Motion, Number, Potential, Rational, Real, Scheme, Stepper, UnitMasses, ValidFor};
use shadowstep_schemes::scheme::Held;
use shadowstep_tests::shipped::{all, for_each_kind_of_step};
use shadowstep_tests::steps::Steps;
use shadowstep_tests::systems::{AnyMotion, systems};
use shadowstep_tests::{Bits, numbers, precision, rational, same_bits};

/// A step with which nothing is special: in no number type is it exact.
const STEP: &str = "1/53";

type Step<N> = fn(&Steps<N>, &mut AnyMotion<N>);

/// Every kind of step after every other one.
fn mixed_steps<N: Real + 'static>() -> [(&'static str, Step<N>); 12] {
    let kinds: [(_, Step<N>); 4] = [
        ("step", |s, m| s.step(m)),
        ("step_augmented", |s, m| s.step_augmented(m)),
        ("step_back", |s, m| s.step_back(m)),
        ("step_back_augmented", |s, m| s.step_back_augmented(m)),
    ];
    [0, 0, 1, 1, 3, 0, 3, 3, 2, 2, 1, 2].map(|kind| kinds[kind])
}

fn describe<N: Real + 'static>(system: &AnyMotion<N>) -> String {
    format!("{:?}, {} coordinates", system.potential(), system.q().len())
}

/// q, p and β of two systems have the same bits.
fn assert_same<N: Bits>(one: &AnyMotion<N>, other: &AnyMotion<N>, what: &str) {
    assert!(same_bits(one.q(), other.q()), "q differs: {what}\n{:?}\n{:?}", one.q(), other.q());
    assert!(same_bits(one.p(), other.p()), "p differs: {what}\n{:?}\n{:?}", one.p(), other.p());
    assert!(one.beta().same_bits(other.beta()), "β differs: {what}\n{:?}\n{:?}", one.beta(), other.beta());
}

fn unrolled_steps_have_the_bits_of_their_twins<N: Bits>(context: &N::Context) {
    let h = rational(STEP);
    for scheme in all::<N>(&h, context) {
        let twin = Steps::of(scheme.twin.clone(), &h, context);
        assert!(same_bits(&scheme.generated.forward, &twin.forward), "{}", scheme.name);
        assert!(same_bits(&scheme.generated.backward, &twin.backward), "{}", scheme.name);
        assert_eq!(scheme.summary, scheme.twin.summary());
        let (sequence, of_twin) = (scheme.sequence, scheme.twin.sequence());
        assert_eq!((sequence.maps, sequence.middle_parts), (of_twin.maps, of_twin.middle_parts), "{}", scheme.name);
        for system in systems::<N>(context) {
            let (mut one, mut other) = (system.clone(), system);
            for (i, (name, step)) in mixed_steps().into_iter().enumerate() {
                step(&scheme.generated, &mut one);
                step(&twin, &mut other);
                let what = format!("{}, {name} as step {i}, {}", scheme.name, describe(&one));
                assert_same(&one, &other, &what);
                assert_eq!(one.evaluations(), other.evaluations(), "{what}");
            }
        }
    }
}

#[test]
fn unrolled_steps_have_the_bits_of_their_twins_in_double() {
    unrolled_steps_have_the_bits_of_their_twins::<f64>(&());
}

#[test]
fn unrolled_steps_have_the_bits_of_their_twins_at_120_digits() {
    unrolled_steps_have_the_bits_of_their_twins::<Float>(&precision(120));
}

/// Two storages of the same system, advanced by the generated steps without any indirection.
#[test]
fn arrays_and_vectors_have_the_same_bits() {
    struct Storages;
    impl shadowstep_tests::shipped::Visitor for Storages {
        fn visit<S: Scheme + ValidFor<Quadratic> + Copy>(
            &mut self,
            name: &str,
            _: Option<shadowstep_schemes::First>,
            scheme: &'static S,
        ) {
            compare::<S, f64, _>(name, *scheme, Kepler, &());
            compare::<S, Float, _>(name, *scheme, HenonHeiles, &precision(120));
        }
    }
    fn compare<S: Scheme + ValidFor<Quadratic>, N: Bits, P: Potential<N> + Clone>(
        name: &str,
        scheme: S,
        potential: P,
        context: &N::Context,
    ) {
        let stepper = Stepper::with_context(scheme, STEP, context).unwrap();
        let [q, p] = [["0.4", "0.1"], ["0.2", "-1.3"]].map(|texts| numbers::<N>(&texts, context));
        let array = |v: &[N]| [v[0].clone(), v[1].clone()];
        let mut arrays = Motion::new(potential.clone(), UnitMasses, array(&q), array(&p)).unwrap();
        let mut vectors = Motion::new(potential, UnitMasses, q, p).unwrap();
        for _ in 0..3 {
            stepper.step(&mut arrays);
            stepper.step(&mut vectors);
            stepper.step_augmented(&mut arrays);
            stepper.step_augmented(&mut vectors);
            assert!(same_bits(arrays.q(), vectors.q()) && same_bits(arrays.p(), vectors.p()), "{name}");
            assert!(arrays.beta().same_bits(vectors.beta()), "{name}");
        }
    }
    for_each_kind_of_step(&mut Storages);
}

fn steps_are_steps<N: Bits>(context: &N::Context) {
    for scheme in all::<N>(&rational(STEP), context) {
        for start in systems::<N>(context) {
            // A step and its inverse round some 60 numbers of size 1 by half a last place each, and later maps
            // enlarge each error a few times; the truncation error, at least (1/53)⁷ = 1e-12 of the state, would be
            // far above this in 120 digits, and a wrong map (order 1/53) in both.
            scheme.generated.check(&format!("{}, {}", scheme.name, describe(&start)), || start.clone(), 2, 2.5);
        }
    }
}

#[test]
fn steps_are_steps_in_double() {
    steps_are_steps::<f64>(&());
}

#[test]
fn steps_are_steps_at_120_digits() {
    steps_are_steps::<Float>(&precision(120));
}

fn a_kept_gradient_changes_no_bit<N: Bits>(context: &N::Context) {
    for scheme in all::<N>(&rational(STEP), context) {
        for system in systems::<N>(context) {
            let (mut keeps, mut forgets) = (system.clone(), system);
            for (name, step) in mixed_steps() {
                let _ = forgets.q_mut(); // drops the kept gradient
                step(&scheme.generated, &mut keeps);
                step(&scheme.generated, &mut forgets);
                assert_same(&keeps, &forgets, &format!("{}, {name}, {}", scheme.name, describe(&keeps)));
            }
            if scheme.twin.plan().keeps_gradient() {
                assert!(keeps.evaluations() < forgets.evaluations(), "nothing was kept: {}", scheme.name);
            }
        }
    }
}

#[test]
fn a_kept_gradient_changes_no_bit_in_double() {
    a_kept_gradient_changes_no_bit::<f64>(&());
}

#[test]
fn a_kept_gradient_changes_no_bit_at_120_digits() {
    a_kept_gradient_changes_no_bit::<Float>(&precision(120));
}

/// The first step of a run may cost one evaluation more: there is no gradient kept from a step before.
#[test]
fn a_step_evaluates_as_often_as_its_summary_says() {
    for scheme in all::<f64>(&rational(STEP), &()) {
        let said = scheme.summary.evaluations as u64;
        assert!(said > 0);
        for (name, step) in mixed_steps::<f64>() {
            let mut system = systems::<f64>(&()).swap_remove(0);
            step(&scheme.generated, &mut system);
            let first = system.evaluations();
            assert_eq!(first, said + u64::from(scheme.twin.plan().keeps_gradient()), "{}, {name}", scheme.name);
            for n in 1..=5 {
                step(&scheme.generated, &mut system);
                assert_eq!(system.evaluations(), first + n * said, "{}, {name}", scheme.name);
            }
        }
    }
}

/// U = 0 in d dimensions, without one operation.
#[derive(Clone, Copy)]
struct Free(usize);

impl<N: Number> Potential<N> for Free {
    fn dimension(&self) -> usize {
        self.0
    }
    fn energy(&self, _: &[N], energy: &mut N, _: &mut [N]) {
        energy.assign_zero();
    }
    fn gradient(&self, _: &[N], gradient: &mut [N], _: &mut [N]) {
        gradient.iter_mut().for_each(Number::assign_zero);
    }
    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        self.gradient(q, gradient, scratch);
        rate.assign_zero();
    }
    fn hessian(&self) -> Option<&dyn HessianProduct<N>> {
        Some(self)
    }
}

impl<N: Number> HessianProduct<N> for Free {
    fn hessian_product(&self, _: &[N], _: &[N], product: &mut [N], _: &mut [N]) {
        product.iter_mut().for_each(N::assign_zero);
    }
    fn hessian_product_and_rate(&self, _: &[N], _: &[N], product: &mut [N], rate: &mut N, _: &mut [N]) {
        product.iter_mut().for_each(N::assign_zero);
        rate.assign_zero();
    }
}

/// What the documentation of the generated struct states, counted by numbers that count.
#[test]
fn a_step_costs_what_its_documentation_says() {
    type Counted = Counting<f64>;
    type FreeMotion = Motion<Counted, Vec<Counted>, Free, UnitMasses>;
    type OneStep = fn(&Steps<Counted>, &mut FreeMotion);
    for scheme in all::<Counted>(&rational(STEP), &()) {
        let cost = scheme.twin.plan().cost();
        for dimension in 1..=3 {
            let state = || vec![Counting(0.5); dimension];
            let mut motion = Motion::new(Free(dimension), UnitMasses, state(), state()).unwrap();
            let products =
                |n: usize| Operations { additions: n as u64, multiplications: n as u64, ..Operations::default() };
            let plain = cost.products_per_dimension * dimension;
            let augmented = plain + cost.products_for_beta;
            let steps: [(usize, OneStep); 4] = [
                (plain, |s, m| s.step(m)),
                (augmented, |s, m| s.step_augmented(m)),
                (plain, |s, m| s.step_back(m)),
                (augmented, |s, m| s.step_back_augmented(m)),
            ];
            for (expected, step) in steps.into_iter().cycle().take(8) {
                let before = motion.hessian_products();
                let counted = count(|| step(&scheme.generated, &mut motion)).1;
                // each Hessian–vector product has M⁻¹U_q
                let velocities = (motion.hessian_products() - before) as usize * dimension;
                assert_eq!(counted, products(expected + velocities), "{}", scheme.name);
            }
        }
    }
}

fn weights_back_are_the_negatives<N: Bits>(context: &N::Context) {
    for scheme in all::<N>(&rational(STEP), context) {
        let Steps { forward, backward, .. } = &scheme.generated;
        assert_eq!(forward.len(), backward.len());
        for (forth, back) in forward.iter().zip(backward) {
            let mut negative = back.clone();
            negative.negate();
            assert!(forth.same_bits(&negative), "{}: {forth} forth, {back} back", scheme.name);
        }
    }
}

#[test]
fn weights_back_are_the_negatives_in_both_kinds_of_numbers() {
    weights_back_are_the_negatives::<f64>(&());
    weights_back_are_the_negatives::<Float>(&precision(120));
}

/// Kicks and drifts each move by the whole step: to the table's own digits, exactly where the table is exact.
#[test]
fn weights_sum_to_one() {
    for scheme in all::<f64>(&rational(STEP), &()) {
        let tolerance = match scheme.twin.proved().scheme.held {
            Held::Exactly => Rational::from_integer(0.into()),
            // some ten weights of size 1, each rounded by at most a unit of the last digit
            Held::Digits(digits) => rational(&format!("1e{}", 2 - i64::from(digits))),
        };
        let table = &scheme.twin.proved().scheme.stages;
        for weights in [&table.kick, &table.drift] {
            let sum: Rational = weights.iter().sum();
            assert!((&sum - Rational::one()).abs() <= tolerance, "{}: {sum}", scheme.name);
        }
    }
}

/// A table that is not compiled would not be tested here; those of multiple time steps are tested with three parts.
#[test]
fn every_shipped_table_is_among_them() {
    let compiled = all::<f64>(&rational(STEP), &());
    let has_two_parts = |name: &&str| shadowstep_schemes::shipped_proved(name).unwrap().scheme.inner.is_none();
    for name in shadowstep_schemes::shipped_names().into_iter().filter(has_two_parts) {
        assert!(compiled.iter().any(|scheme| scheme.summary.name == name), "{name}");
    }
    let exchanged = compiled.iter().filter(|scheme| scheme.name.contains("Drift"));
    assert!(exchanged.count() > 0, "no scheme with `first = \"drift\"` is tested");
}
