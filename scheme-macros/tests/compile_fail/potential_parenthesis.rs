//! A term is missing.

use shadowstep::potential;

potential! {
    pub struct Spring;
    U(x) = x^2 +
}

fn main() {}
