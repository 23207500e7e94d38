//! Protects processed schemes: the proof of the effective order apart from the kernel's, and a run that makes the steps
//! of the kernel and is read through the post-map.

use shadowstep::problems::Kepler;
use shadowstep::steps::integrator::at_output;
use shadowstep::tables::{TableScheme, shipped};
use shadowstep::{Carried, Integrator as _, Motion, Scheme, Stepper, UnitMasses, splitting_scheme};
use shadowstep_schemes::{Source, read, shipped as shipped_source, shipped_names, shipped_proved};

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
fn wrong_processors_are_refused() {
    for (name, from, to, expected) in [
        // of b6, two digits exchanged
        (
            "wisdom-corrector-17",
            "33737961615779",
            "33737961651779",
            "effective order 18 is claimed, effective order 2 holds for the terms of ε: the condition of the word KDD fails",
        ),
        (
            "wisdom-corrector-7",
            "near_integrable = [8, 2]",
            "near_integrable = [10, 2]",
            "effective order 10 is claimed, effective order 8 holds for the terms of ε",
        ),
        // the kernel's own claims concern the kernel
        ("wisdom-corrector-7", "order = 2", "order = 4", "order 4 is claimed, order 2 holds for every T(p)"),
        ("wisdom-corrector-3", "near_integrable = [4, 2]", "near_integrable = [21, 2]", "21 is out of range"),
        ("wisdom-corrector-3", "[processor]\norder = 2\n", "[processor]\n", "order"),
        ("wisdom-corrector-3", "[processor]", "[processor]\ngamma = [1]", "`gamma` is not for this processor"),
        (
            "wisdom-corrector-3",
            "[processor]",
            "[processor]\ngradient_kick = [1]",
            "`gradient_kick` is a key of [stages]: only kernels have gradient kicks",
        ),
        (
            "wisdom-corrector-3",
            "[processor]",
            "[processor]\nscheme = 1",
            "the keys of [processor] are order, near_integrable, dominant, kick, drift, gamma",
        ),
    ] {
        let faults = refused(name, from, to);
        assert!(faults.contains(expected), "{name}, {to}: {faults}");
    }
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
