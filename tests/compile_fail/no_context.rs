//! A stepper for MPFR's numbers without their precision.

use shadowstep::number::Float;
use shadowstep::{Stepper, splitting_scheme};

#[splitting_scheme("stormer-verlet.toml")]
pub struct StormerVerlet;

fn main() {
    let _ = Stepper::<_, Float>::new(StormerVerlet, "1/10").unwrap();
}
