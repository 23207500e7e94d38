//! A scheme for two parts and a system of three.

use shadowstep::systems::many_parts::{SystemOfParts, parts};
use shadowstep::{Stepper, splitting_scheme};

#[splitting_scheme("yoshida4.toml")]
pub struct ForTwo;

#[splitting_scheme("yoshida4.toml", parts = 3)]
pub struct ForMany;

fn main() {
    let formulas = ["p^2/2", "q*p/10", "cos(q)"];
    let parts = parts::<f64>(&formulas, (&["q"], &["p"]), &[], &()).unwrap();
    let mut system = SystemOfParts::new(parts, &[0.3], &[0.1]).unwrap();
    Stepper::new(ForMany, "1/10").unwrap().step(&mut system);
    Stepper::new(ForTwo, "1/10").unwrap().step(&mut system);
}
