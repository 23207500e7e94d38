//! A run by a table that was not asked whether it moves a T that is not quadratic.

use shadowstep::run::energy_drift;
use shadowstep::shadow::Central;
use shadowstep::{Motion, exact, kinetic, potential, tables};

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
    let motion = || Motion::new(Spring, Relativistic, [1.0], [0.0]);
    let h = exact("1/20").unwrap();
    let asked = yoshida.clone().for_every_kinetic().unwrap();
    let _ = energy_drift(&asked, motion(), &h, 100, &Central::fixed(5), |_| {});
    let _ = energy_drift(&yoshida, motion(), &h, 100, &Central::fixed(5), |_| {});
}
