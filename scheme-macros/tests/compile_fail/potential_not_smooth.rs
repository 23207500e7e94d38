//! A function without a derivative.

use shadowstep::potential;

potential! {
    pub struct Cone;
    U(x) = abs(x)
}

fn main() {}
