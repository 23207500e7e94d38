//! A step takes neither a plain array of numbers as its weights nor the weights of a stepper, which are a slice.

use shadowstep::problems::Pendulum;
use shadowstep::{Motion, Scheme, Stepper, UnitMasses, splitting_scheme};

#[splitting_scheme("stormer-verlet.toml")]
pub struct StormerVerlet;

fn main() {
    let mut motion = Motion::new(Pendulum, UnitMasses, [0.0], [1.0]).unwrap();
    let stepper = Stepper::new(StormerVerlet, "1/10").unwrap();
    StormerVerlet.step(&[0.05, 0.1], &mut motion);
    StormerVerlet.step(stepper.weights(), &mut motion);
}
