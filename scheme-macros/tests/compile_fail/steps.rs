//! Steps that no system, numbers or weights of this kind can make.

use shadowstep::number::{AnyLimbs, DoubleDouble};
use shadowstep::problems::{Kepler, Pendulum};
use shadowstep::shadow::Central;
use shadowstep::shadow::run::energy_drift;
use shadowstep::steps::scheme::Weights;
use shadowstep::systems::many_parts::{SystemOfParts, parts};
use shadowstep::{Motion, Scheme, Stepper, UnitMasses, kinetic, potential, splitting_scheme, tables};

#[splitting_scheme("stormer-verlet.toml")]
struct StormerVerlet;

#[splitting_scheme("nystrom.toml")]
pub struct Nystrom;

#[splitting_scheme("yoshida4.toml")]
pub struct ForTwo;

#[splitting_scheme("yoshida4.toml", parts = 3)]
pub struct ForMany;

kinetic! {
    pub struct Relativistic;
    T(p) = sqrt(1 + p^2)
}

kinetic! {
    pub struct Masses;
    T(p) = p^2/2
}

potential! {
    pub struct Spring;
    U(q) = q^2/2
}

fn pendulum() -> Motion<f64, [f64; 1], Pendulum, UnitMasses> {
    Motion::new(Pendulum, UnitMasses, [0.0], [1.0]).unwrap()
}

/// The steps of a scheme take its weights, not an array of numbers nor the view that a stepper gives.
fn array_as_weights() {
    let stepper = Stepper::<_, f64>::new(StormerVerlet, "1/10").unwrap();
    StormerVerlet.forward(&[0.05, 0.1], &mut pendulum());
    StormerVerlet.forward(stepper.weights(), &mut pendulum());
}

/// Weights of one's own move no system: only a stepper has its flows.
fn self_made_weights() {
    let weights = Weights { kicks: [0.05], drifts: [0.1], middle_parts: [], gradient_kicks: [] };
    StormerVerlet.forward(&weights, &mut pendulum());
}

/// A scheme whose class is known at run time only makes no steps before it is checked.
fn class_at_run_time() {
    let scheme = tables::shipped("yoshida4").unwrap().for_many_parts().unwrap().at_run_time();
    Stepper::new(scheme, "1/20").unwrap().step(&mut pendulum());
}

/// A run by a table that was not checked for a T that is not quadratic.
fn unchecked_run() {
    let yoshida = tables::shipped("yoshida4").unwrap();
    let motion = || Motion::new(Spring, Relativistic, [1.0], [0.0]).unwrap();
    let checked = Stepper::new(yoshida.clone().for_every_kinetic().unwrap(), "1/20").unwrap();
    let unchecked = Stepper::new(yoshida, "1/20").unwrap();
    let _ = energy_drift(checked.with(motion()), 100, &Central::fixed(5));
    let _ = energy_drift(unchecked.with(motion()), 100, &Central::fixed(5));
}

/// A step of a scheme whose order holds for quadratic T only, for a T that is not.
fn nystrom_step() {
    let stepper = Stepper::new(Nystrom, "1/20").unwrap();
    let mut quadratic = Motion::new(Spring, Masses, [1.0], [0.0]).unwrap();
    stepper.step(&mut quadratic);
    let mut motion = Motion::new(Spring, Relativistic, [1.0], [0.0]).unwrap();
    stepper.step(&mut motion);
}

/// A scheme for two parts and a system of three.
fn two_parts_for_three() {
    let formulas = ["p^2/2", "q*p/10", "cos(q)"];
    let parts = parts::<f64>(&formulas, (&["q"], &["p"]), &[], &()).unwrap();
    let mut system = SystemOfParts::new(parts, &[0.3], &[0.1]).unwrap();
    Stepper::new(ForMany, "1/10").unwrap().step(&mut system);
    Stepper::new(ForTwo, "1/10").unwrap().step(&mut system);
}

/// A scheme whose steps are made for three parts and more does not advance a system of two.
fn three_parts_for_two() {
    Stepper::new(ForMany, "1/10").unwrap().step(&mut pendulum());
}

/// A stepper for numbers whose precision is chosen at run time, without that precision.
fn no_context() {
    let _ = Stepper::<_, AnyLimbs>::new(StormerVerlet, "1/10").unwrap();
}

/// A stepper with weights in `f64` for a motion in double-double numbers.
fn other_numbers() {
    let zero = || vec![DoubleDouble::from(0.0)];
    let mut motion = Motion::new(Pendulum, UnitMasses, zero(), zero()).unwrap();
    let stepper = Stepper::<_, f64>::new(StormerVerlet, "1/10").unwrap();
    stepper.step(&mut motion);
}

fn integers_as_state() {
    let _ = Motion::new(Kepler, UnitMasses, [1, 0], [0, 1]);
}

fn name_as_scheme() {
    let _ = Stepper::<_, f64>::new("yoshida4", "1/20");
}

fn main() {}
