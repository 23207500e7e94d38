//! A step of a scheme whose order holds for quadratic T only, for a T that is not.

use shadowstep::{Motion, Stepper, kinetic, potential, splitting_scheme};

#[splitting_scheme("nystrom.toml")]
pub struct Nystrom;

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

fn main() {
    let stepper = Stepper::new(Nystrom, "1/20").unwrap();
    let mut quadratic = Motion::new(Spring, Masses, [1.0], [0.0]).unwrap();
    stepper.step(&mut quadratic);
    let mut motion = Motion::new(Spring, Relativistic, [1.0], [0.0]).unwrap();
    stepper.step(&mut motion);
}
