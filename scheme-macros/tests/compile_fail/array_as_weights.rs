//! The steps of a scheme take its weights, not an array of numbers nor the view that a stepper gives.

use shadowstep::problems::Kepler;
use shadowstep::{Motion, Scheme, Stepper, UnitMasses, splitting_scheme};

#[splitting_scheme("stormer-verlet.toml")]
struct StormerVerlet;

fn main() {
    let stepper = Stepper::<_, f64>::new(StormerVerlet, "1/10").unwrap();
    let mut motion = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]).unwrap();
    StormerVerlet.forward(&[0.05, 0.1], &mut motion);
    StormerVerlet.forward(stepper.weights(), &mut motion);
}
