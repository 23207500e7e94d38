//! A parameter with a type.

use shadowstep::potential;

potential! {
    pub struct Spring { stiffness: f64 }
    U(x) = stiffness*x^2/2
}

fn main() {}
