//! Weights of a step are made by a stepper only.

use shadowstep::problems::Pendulum;
use shadowstep::{Motion, Scheme, StepWeights, UnitMasses, splitting_scheme};

#[splitting_scheme("stormer-verlet.toml")]
pub struct StormerVerlet;

fn main() {
    let mut motion = Motion::new(Pendulum, UnitMasses, [0.0], [1.0]).unwrap();
    let weights = StepWeights { forward: [0.05, 0.1], back: [-0.05, -0.1] };
    StormerVerlet.step(&weights, &mut motion);
}
