//! `shadowstep run` of planets: what a run reports of their interactions and of its steps.

use std::f64::consts::TAU;

use crate::scenes::{folder, summarised};

/// Two planets of 1e-5 of the star on circles whose radii differ by this number of mutual Hill radii, with this number
/// of steps in a revolution of the inner one; what the summary of 60 revolutions says, in one line.
fn report(separation: f64, steps: f64) -> String {
    let radius = (2e-5_f64 / 3.0).cbrt() * separation / 2.0;
    let scene = format!(
        "[problem]\nparts = \"wisdom-holman\"\nparameters = {{ g = 1 }}\n[[body]]\nname = \"star\"\nmass = 1\n\
         [[body]]\nname = \"inner\"\nmass = 1e-5\na = 1\n[[body]]\nname = \"outer\"\nmass = 1e-5\na = {:.6}\nM = 180\n\
         [run]\nscheme = \"stormer-verlet\"\nstep = {:.6e}\nsteps = {}\ndigits = \"double\"\n\
         [output]\nenergy = {{ every = 1000 }}\n",
        (1.0 + radius) / (1.0 - radius),
        TAU / steps,
        60.0 * steps
    );
    let result = summarised(folder(&scene).path(), "");
    assert_eq!(result.code, 0, "{}", result.err);
    result.err.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Within a Hill radius the kicks are not the smaller part: neither the step size nor the forces are the cause.
#[test]
fn a_close_encounter_is_named_as_the_cause() {
    let said = report(2.0, 30.0);
    assert!(
        said.contains("verdict the splitting is not valid in a close encounter: inner and outer came within 0.26 Hill"),
        "{said}"
    );
    assert!(said.contains("at t = 58.0147,") && said.contains("smaller steps do not help"), "{said}");
    assert!(!said.contains("not smooth") && !said.contains("windows of 17 states"), "{said}");
    let apart = report(8.0, 30.0);
    assert!(apart.contains("verdict bounded") && !apart.contains("splitting"), "{apart}");
}

/// The largest interaction is that of the encounter, which takes a few of the states.
#[test]
fn interactions_are_those_of_all_states() {
    let said = report(2.0, 30.0);
    assert!(said.contains("planets interactions at most 4.1e-1 of the Kepler force"), "{said}");
}

#[test]
fn few_steps_in_a_revolution_are_noted() {
    let note = "note: inner has 1.5 steps of 1 kick in a revolution: with fewer than 10 kicks the step size may be in \
        resonance with the orbit";
    let said = report(8.0, 1.5);
    assert!(said.contains(note), "{said}");
    let said = report(8.0, 30.0);
    assert!(!said.contains("note:"), "{said}");
}
