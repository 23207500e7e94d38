//! A division by zero.

use shadowstep::potential;

potential! {
    pub struct Spring;
    U(x) = x^2/(1 - 1)
}

fn main() {}
