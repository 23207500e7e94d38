//! Protects processed schemes: the proof of the effective order apart from the kernel's, and a run that makes the steps
//! of the kernel and is read through the post-map.

use rug::Float;
use shadowstep::number::Real;
use shadowstep::problems::Kepler;
use shadowstep::steps::integrator::at_output;
use shadowstep::tables::{TableScheme, shipped};
use shadowstep::{Carried, Integrator as _, Motion, Scheme, Stepper, UnitMasses, splitting_scheme};
use shadowstep_schemes::{MapKind, Source, read, shipped as shipped_source, shipped_names, shipped_proved};
use shadowstep_tests::precision;
use shadowstep_tests::reference::{Separable, State};

#[splitting_scheme("wisdom-corrector-5.toml")]
struct Corrected;

fn processed() -> impl Iterator<Item = &'static str> {
    shipped_names().into_iter().filter(|name| shipped_proved(name).unwrap().scheme.processor.is_some())
}

/// The faults of a shipped table in which a text is replaced.
fn refused(name: &str, from: &str, to: &str) -> String {
    let Source { path, text } = shipped_source(name).unwrap();
    assert!(text.contains(from), "{text}");
    let source = Source { path, text: text.replacen(from, to, 1) };
    read(&source, &|base, _| shipped_source(base)).unwrap_err().to_string()
}

#[test]
fn the_effective_order_is_proved_apart_from_that_of_the_kernel() {
    for (corrector, order) in [(3, 4), (5, 6), (7, 8), (11, 12), (17, 18)] {
        let proof = &shipped_proved(&format!("wisdom-corrector-{corrector}")).unwrap().proof;
        let effective = proof.effective.as_ref().unwrap();
        let orders: Vec<_> = effective.near_integrable.iter().map(|order| order.order).collect();
        assert_eq!((proof.general.order, effective.general.order, orders), (2, 2, vec![order, 2]));
        let (failed, _) = effective.near_integrable[0].failed.as_ref().expect("a higher order does not hold");
        assert_eq!(failed.order, order + 1);
    }
}

#[test]
fn a_changed_digit_of_the_processor_is_refused_by_a_named_condition() {
    // 33737961615779 of b6, two digits exchanged
    let faults = refused("wisdom-corrector-17", "33737961615779", "33737961651779");
    assert!(
        faults.contains(
            "effective order 18 is claimed, effective order 2 holds for the terms of ε: the condition \
        of the word KDD fails"
        ),
        "{faults}"
    );
    let faults = refused("wisdom-corrector-7", "near_integrable = [8, 2]", "near_integrable = [10, 2]");
    assert!(faults.contains("effective order 10 is claimed, effective order 8 holds for the terms of ε"), "{faults}");
    // the kernel's own claims concern the kernel
    let faults = refused("wisdom-corrector-7", "order = 2", "order = 4");
    assert!(faults.contains("order 4 is claimed, order 2 holds for every T(p)"), "{faults}");
}

#[test]
fn claims_of_the_processor_that_cannot_be_read_are_faults_at_their_places() {
    let faults = refused("wisdom-corrector-3", "near_integrable = [4, 2]", "near_integrable = [21, 2]");
    assert!(faults.contains("21 is out of range") && faults.contains("1 to 20"), "{faults}");
    let faults = refused("wisdom-corrector-3", "[processor]\norder = 2\n", "[processor]\n");
    assert!(faults.contains("order"), "{faults}");
    let faults = refused("wisdom-corrector-3", "[processor]", "[processor]\ngamma = [1]");
    assert!(faults.contains("`gamma` is not for this processor"), "{faults}");
    let faults = refused("wisdom-corrector-3", "[processor]", "[processor]\ngradient_kick = [1]");
    assert!(faults.contains("unknown key `gradient_kick`"), "{faults}");
    assert!(faults.contains("`gradient_kick` is a key of [stages]: only kernels have gradient kicks"), "{faults}");
    let faults = refused("wisdom-corrector-3", "[processor]", "[processor]\nscheme = 1");
    assert!(
        faults.contains("the keys of [processor] are order, near_integrable, dominant, kick, drift, gamma"),
        "{faults}"
    );
}

type Comet = Motion<f64, [f64; 2], Kepler, UnitMasses>;

fn comet() -> Comet {
    Motion::new(Kepler, UnitMasses, [0.4, 0.1], [0.1, 2.0]).unwrap()
}

#[test]
fn the_pre_map_undoes_the_post_map() {
    for name in processed() {
        let stepper: Stepper<TableScheme, f64> = Stepper::new(shipped(name).unwrap(), "1/20").unwrap();
        let mut motion = comet();
        stepper.preprocess(&mut motion);
        let between = motion.q().to_vec();
        stepper.postprocess(&mut motion);
        let start = comet();
        let distance = |q: &[f64]| (q[0] - start.q()[0]).abs().max((q[1] - start.q()[1]).abs());
        assert!(distance(&between) > 1e-9, "{name}: {}", distance(&between));
        assert!(distance(motion.q()) < 1e-13, "{name}: {}", distance(motion.q()));
    }
}

#[test]
fn generated_code_has_the_processor_of_the_table() {
    let table = shipped("wisdom-corrector-5").unwrap();
    assert_eq!(Corrected.processor(), table.processor());
    let (unrolled, read) = (Stepper::new(Corrected, "1/50").unwrap(), Stepper::new(table, "1/50").unwrap());
    let [mut a, mut b] = [comet(), comet()];
    unrolled.preprocess(&mut a);
    read.preprocess(&mut b);
    for _ in 0..100 {
        unrolled.step(&mut a);
        read.step(&mut b);
    }
    unrolled.postprocess(&mut a);
    read.postprocess(&mut b);
    assert_eq!((a.q(), a.p()), (b.q(), b.p()));
}

#[test]
fn an_output_changes_nothing_of_the_steps() {
    let stepper: Stepper<TableScheme, f64> = Stepper::new(shipped("wisdom-corrector-7").unwrap(), "1/50").unwrap();
    let [mut alone, mut read] = [comet().compensated(), comet().compensated()];
    stepper.preprocess(&mut alone);
    stepper.preprocess(&mut read);
    let mut read = stepper.with(read);
    for _ in 0..50 {
        stepper.step_augmented(&mut alone);
        read.step(Carried::Increments);
        let output = at_output(&mut read, |read| read.state().q().to_vec());
        let (mut q, mut p) = (read.state().q().to_vec(), read.state().p().to_vec());
        assert_ne!(output, q);
        read.postprocess_state(&mut q, &mut p);
        // but for the remainders of the sums
        assert!((output[0] - q[0]).abs() < 1e-14, "{} {}", output[0], q[0]);
    }
    let read = read.state();
    assert_eq!((alone.q(), alone.p(), alone.state().remainders()), (read.q(), read.p(), read.remainders()));
    assert_eq!(alone.beta(), read.increments().beta);
}

// ---------------------------------------------------------------------------------------------------------------
// H = p²/2 + εU(q), U = −cos q, with the drift the dominant part

/// The error of a processed step of size 2^−k for ε = `epsilon` times `times`.
fn error(name: &str, k: u32, epsilon: &str, times: i32) -> State {
    const DIGITS: u32 = 220;
    let context = precision(DIGITS);
    let bits = context.in_bits();
    let epsilon = Float::with_val(bits, Float::parse(epsilon).unwrap()) * times;
    let h = Float::with_val(bits, 1) >> k;
    let start = vec![Float::with_val(bits, 0.7), Float::with_val(bits, 1.1)];
    let [mut q, mut p] = [start[0].clone(), start[1].clone()];
    for map in shipped_proved(name).unwrap().scheme.processed_maps().unwrap() {
        let weight = shadowstep::Number::from_rational(&map.weight, &context);
        let weight: Float = weight;
        match map.kind {
            MapKind::Kick => p -= q.clone().sin() * (weight * &h) * &epsilon,
            MapKind::Drift => q += weight * &h * &p,
            // 2h³ w εU'εU''
            MapKind::GradientKick => {
                let (sin, cos) = q.clone().sin_cos(Float::new(bits));
                p += sin * cos * epsilon.clone().square() * h.clone().square() * &h * weight * 2;
            }
        }
    }
    let system = Separable { velocity: &|p| p.to_vec(), gradient: &|q| vec![q[0].clone().sin() * &epsilon] };
    let exact = system.flow(&start, &h, 20);
    vec![q - &exact[0], p - &exact[1]]
}

fn largest(state: &[Float]) -> f64 {
    state.iter().map(Real::log10_abs).fold(f64::NEG_INFINITY, f64::max)
}

/// log₂ of the terms of ε and of ε² of the error: what is left of higher powers is 1e-40 of them.
fn near_terms(name: &str, k: u32) -> [f64; 2] {
    let [plus, minus] = [1, -1].map(|times| error(name, k, "1e-40", times));
    let of = |terms: &dyn Fn(&Float, &Float) -> Float| -> Vec<_> {
        plus.iter().zip(&minus).map(|(a, b)| terms(a, b)).collect()
    };
    let odd = of(&|plus, minus| Float::with_val(plus.prec(), plus - minus));
    let even = of(&|plus, minus| Float::with_val(plus.prec(), plus + minus));
    [odd, even].map(|terms| largest(&terms) / std::f64::consts::LOG10_2)
}

#[test]
fn the_effective_orders_measured_are_those_proved() {
    for name in processed() {
        let effective = shipped_proved(name).unwrap().proof.effective.as_ref().unwrap();
        if effective.near_integrable.is_empty() {
            continue;
        }
        let [coarse, fine] = [7, 8].map(|k| near_terms(name, k));
        for ((coarse, fine), proved) in coarse.iter().zip(&fine).zip(&effective.near_integrable) {
            let order = coarse - fine - 1.0;
            println!("{name}: {order:.3} measured, {} proved, error 2^{fine:.1}", proved.order);
            assert!((order - f64::from(proved.order)).abs() < 0.2, "{name}: {order} measured, {} proved", proved.order);
        }
    }
}

#[test]
fn the_effective_orders_for_quadratic_kinetic_energies_are_measured_on_the_pendulum() {
    for name in processed() {
        let proved = shipped_proved(name).unwrap().proof.effective.as_ref().unwrap().quadratic.order;
        let [coarse, fine] = [8, 9].map(|k| largest(&error(name, k, "1", 1)) / std::f64::consts::LOG10_2);
        let order = coarse - fine - 1.0;
        println!("{name}: {order:.3} measured, {proved} proved, error 2^{fine:.1}");
        assert!((order - f64::from(proved)).abs() < 0.2, "{name}: {order} measured, {proved} proved");
    }
}
