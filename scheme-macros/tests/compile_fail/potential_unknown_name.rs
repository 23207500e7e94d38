//! A name that is neither a coordinate nor a parameter.

use shadowstep::potential;

potential! {
    pub struct Well { depth }
    U(x, y) = -depht * exp(-(x^2 + y^2))
}

fn main() {}
