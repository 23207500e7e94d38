//! A scheme whose steps are made for three parts and more does not advance a system of two.

use shadowstep::problems::Pendulum;
use shadowstep::{Motion, Stepper, UnitMasses, splitting_scheme};

#[splitting_scheme("yoshida4.toml", parts = 3)]
pub struct InParts;

fn main() {
    let mut motion = Motion::new(Pendulum, UnitMasses, [0.0], [1.0]).unwrap();
    Stepper::new(InParts, "1/10").unwrap().step(&mut motion);
}
