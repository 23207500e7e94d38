//! A step begins with a kick or a drift.

use shadowstep::problems::Pendulum;
use shadowstep::{Motion, Scheme, UnitMasses, exact, splitting_scheme};

#[splitting_scheme("yoshida4.toml", first = "force")]
pub struct Mine;

// the struct is used: its users have no errors of their own
fn main() {
    let weights = Mine.weights::<f64>(&exact("1/10").unwrap(), &());
    let mut motion = Motion::new(Pendulum, UnitMasses, [0.0], [1.0]);
    Mine.step(&weights, &mut motion);
    Mine.step_augmented(&weights, &mut motion);
    Mine.step_back(&weights, &mut motion);
    Mine.step_back_augmented(&weights, &mut motion);
    println!("{} {:?}", Mine.summary().name, motion.energy());
}
