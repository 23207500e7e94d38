//! A run by a table that was not checked for a T that is not quadratic.

use shadowstep::shadow::run::energy_drift;
use shadowstep::shadow::Central;
use shadowstep::{Motion, Stepper, kinetic, potential, tables};

kinetic! {
    pub struct Relativistic;
    T(p) = sqrt(1 + p^2)
}

potential! {
    pub struct Spring;
    U(q) = q^2/2
}

fn main() {
    let yoshida = tables::shipped("yoshida4").unwrap();
    let motion = || Motion::new(Spring, Relativistic, [1.0], [0.0]).unwrap();
    let checked = Stepper::new(yoshida.clone().for_every_kinetic().unwrap(), "1/20").unwrap();
    let unchecked = Stepper::new(yoshida, "1/20").unwrap();
    let _ = energy_drift(checked.with(motion()), 100, &Central::fixed(5));
    let _ = energy_drift(unchecked.with(motion()), 100, &Central::fixed(5));
}
