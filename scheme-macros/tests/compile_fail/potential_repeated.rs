//! A coordinate that is there twice.

use shadowstep::potential;

potential! {
    pub struct Spring;
    U(x, x) = x^2
}

fn main() {}
