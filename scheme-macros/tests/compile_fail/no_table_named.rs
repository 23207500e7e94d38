//! No table is named.

use shadowstep::problems::Pendulum;
use shadowstep::{Motion, Scheme, Stepper, UnitMasses, splitting_scheme};

#[splitting_scheme()]
pub struct Mine;

// the struct is used: its users have no errors of their own
fn main() {
    let stepper = Stepper::new(Mine, "1/10").unwrap();
    let mut motion = Motion::new(Pendulum, UnitMasses, [0.0], [1.0]).unwrap();
    stepper.step(&mut motion);
    stepper.step_augmented(&mut motion);
    stepper.step_back(&mut motion);
    stepper.step_back_augmented(&mut motion);
    println!("{} {:?}", stepper.scheme().summary().name, motion.energy());
}
