//! A stepper for numbers whose precision is chosen at run time, without that precision.

use shadowstep::number::AnyLimbs;
use shadowstep::{Stepper, splitting_scheme};

#[splitting_scheme("stormer-verlet.toml")]
pub struct StormerVerlet;

fn main() {
    let _ = Stepper::<_, AnyLimbs>::new(StormerVerlet, "1/10").unwrap();
}
