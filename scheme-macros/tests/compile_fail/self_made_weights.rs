//! Weights of one's own move no system: only a stepper has its flows.

use shadowstep::problems::Pendulum;
use shadowstep::steps::scheme::Weights;
use shadowstep::{Motion, Scheme, UnitMasses, splitting_scheme};

#[splitting_scheme("stormer-verlet.toml")]
pub struct StormerVerlet;

fn main() {
    let mut motion = Motion::new(Pendulum, UnitMasses, [0.0], [1.0]).unwrap();
    let weights = Weights { kicks: [0.05], drifts: [0.1], middle_parts: [], gradient_kicks: [] };
    StormerVerlet.forward(&weights, &mut motion);
}
