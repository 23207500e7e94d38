//! A stepper with weights in `f64` for a motion in MPFR's numbers.

use shadowstep::number::{Float, Number, Precision};
use shadowstep::problems::Pendulum;
use shadowstep::{Motion, Stepper, UnitMasses, splitting_scheme};

#[splitting_scheme("stormer-verlet.toml")]
pub struct StormerVerlet;

fn main() {
    let zero = || vec![Float::zero(&Precision::digits(30).unwrap())];
    let mut motion = Motion::new(Pendulum, UnitMasses, zero(), zero()).unwrap();
    let stepper = Stepper::<_, f64>::new(StormerVerlet, "1/10").unwrap();
    stepper.step(&mut motion);
}
