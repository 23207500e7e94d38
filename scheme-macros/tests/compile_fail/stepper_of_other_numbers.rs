//! A stepper with weights in `f64` for a motion in double-double numbers.

use shadowstep::number::DoubleDouble;
use shadowstep::problems::Pendulum;
use shadowstep::{Motion, Stepper, UnitMasses, splitting_scheme};

#[splitting_scheme("stormer-verlet.toml")]
pub struct StormerVerlet;

fn main() {
    let zero = || vec![DoubleDouble::from(0.0)];
    let mut motion = Motion::new(Pendulum, UnitMasses, zero(), zero()).unwrap();
    let stepper = Stepper::<_, f64>::new(StormerVerlet, "1/10").unwrap();
    stepper.step(&mut motion);
}
