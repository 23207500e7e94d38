//! A parameter that is not in the formula.

shadowstep_macros::potential! { pub struct Spring { stiffness, width } U(x) = stiffness*x^2/2 }

fn main() {}
