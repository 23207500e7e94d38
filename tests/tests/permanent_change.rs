//! Protects the permanent change of the modified energy: nothing on the exact flow, the same by every estimator on
//! schemes.

use rug::Float;
use shadowstep::problems::{Setup, problem};
use shadowstep::shadow::exact_flow::ExactFlow;
use shadowstep::shadow::run::{EnergyDrift, Finding, PermanentChange, ShadowRun, energy_drift};
use shadowstep::shadow::{Bilinear, BuildEstimator, Central, SelectionRule, StoppingRule};
use shadowstep::{Number, Rational, Real};
use shadowstep_tests::{precision, step_size, stepper};

const DIGITS: u32 = 80;

fn setup(name: &str, set: &[(&str, &str)]) -> Setup {
    let set: Vec<_> = set.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
    problem(name).unwrap().setup(&set, 120).unwrap()
}

/// How many steps of size h fit into [0, 100].
fn steps(h: &Rational) -> u64 {
    (100.0 / f64::from_rational(h, &())) as u64
}

fn on_the_exact_flow(setup: &Setup, h: &str, settings: &impl BuildEstimator<Float>) -> EnergyDrift<Float> {
    let (h, context) = (step_size(h), precision(DIGITS));
    let steps = steps(h.exact());
    let mut run = ShadowRun::<ExactFlow<Float>, _>::of_exact_flow(setup, &h, steps, settings, &context).unwrap();
    run.drift().unwrap()
}

fn of(scheme: &str, setup: &Setup, h: &str, settings: &impl BuildEstimator<Float>) -> EnergyDrift<Float> {
    let context = precision(DIGITS);
    let (stepper, motion) = (stepper(scheme, h, &context), setup.motion(&context).unwrap());
    energy_drift(stepper.with(motion), steps(stepper.h()), settings).unwrap()
}

fn change(found: &EnergyDrift<Float>) -> (f64, f64) {
    let PermanentChange { change, resolution, .. } = found.permanent.as_ref().unwrap();
    (change.log10_abs(), resolution.log10_abs())
}

#[test]
fn the_exact_flow_has_none() {
    for (name, set, h) in [
        ("kepler", ("eccentricity", "3/10"), "1/10"),
        ("kepler", ("eccentricity", "6/10"), "1/10"),
        ("kepler", ("eccentricity", "6/10"), "1/20"),
        ("kepler", ("eccentricity", "9/10"), "1/20"),
        ("pendulum", ("p", "1"), "1/4"),
        ("harmonic-oscillator", ("omega", "2"), "1/10"),
    ] {
        let setup = setup(name, &[set]);
        for k in [8, 16, 50] {
            let found = on_the_exact_flow(&setup, h, &Bilinear::with_error(k));
            let (change, resolution) = change(&found);
            println!(
                "{name}, {set:?}, h = {h}, k = {k}: drift 1e{:.1}, change 1e{change:.1} of 1e{resolution:.1}",
                found.drift.log10_abs()
            );
            assert_ne!(
                found.permanent.unwrap().finding,
                Finding::Resolved,
                "{name}, h = {h}, k = {k}: 1e{change} of 1e{resolution}"
            );
        }
    }
}

/// The drift is the estimator's, the permanent change is the method's: it does not depend on the estimator.
#[test]
fn every_estimator_finds_the_same() {
    let kepler = setup("kepler", &[]);
    for scheme in ["stormer-verlet", "yoshida4", "blanes-moan-srkn6b"] {
        let mut found: Vec<f64> = Vec::new();
        for k in [16, 24, 50] {
            let drift = of(scheme, &kepler, "1/20", &Bilinear::with_error(k));
            println!("{scheme}, k = {k}: drift 1e{:.2}, change 1e{:.4}", drift.drift.log10_abs(), change(&drift).0);
            assert_eq!(drift.permanent.as_ref().unwrap().finding, Finding::Resolved);
            found.push(change(&drift).0);
        }
        let drift =
            of(scheme, &kepler, "1/20", &Central::best_with_error(100, StoppingRule::Full, SelectionRule::Least));
        println!("{scheme}, central: drift 1e{:.2}, change 1e{:.4}", drift.drift.log10_abs(), change(&drift).0);
        found.push(change(&drift).0);
        // three digits: the drifts themselves are nine decades apart
        assert!(found.iter().all(|one| (one - found[0]).abs() < 4e-4), "{scheme}: {found:?}");
    }
}

/// The page of the documentation has the numbers of this tree.
#[test]
fn the_page_says_what_is_found() {
    let page = include_str!("../../docs/the-modified-energy.md");
    let cells = |label: &str| -> Vec<&str> {
        let row = page.lines().find(|line| line.starts_with(&format!("| {label} |"))).expect(label);
        row.split('|').map(str::trim).skip(2).take(3).collect()
    };
    let kepler = setup("kepler", &[]);
    let (best, e50) = (Central::best(200, StoppingRule::Full), Bilinear::with_error(50));
    let shown = |value: &Float| format!("{:.2e}", value.to_f64());
    for (label, scheme) in [
        ("Störmer–Verlet", "stormer-verlet"),
        ("Yoshida 4", "yoshida4"),
        ("Blanes–Moan S6", "blanes-moan-s6"),
        ("Blanes–Moan SRKN6b", "blanes-moan-srkn6b"),
    ] {
        let (drift, bilinear) = (of(scheme, &kepler, "1/20", &best).drift, of(scheme, &kepler, "1/20", &e50));
        let found = [drift, bilinear.drift.clone(), bilinear.permanent.unwrap().change].map(|value| shown(&value));
        assert_eq!(cells(label), found, "{label}");
    }
    let bilinear = on_the_exact_flow(&kepler, "1/20", &e50);
    let found = [on_the_exact_flow(&kepler, "1/20", &best).drift, bilinear.drift].map(|value| shown(&value));
    assert_eq!(cells("the exact flow"), [&found[0], &found[1], "none"]);
}
