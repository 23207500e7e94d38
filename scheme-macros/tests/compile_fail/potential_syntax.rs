//! An operator is missing.

use shadowstep::potential;

potential! {
    pub struct Spring;
    U(x) = 3 x^2
}

fn main() {}
