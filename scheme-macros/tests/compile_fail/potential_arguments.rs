//! A function with one argument too many.

use shadowstep::potential;

potential! {
    pub struct Wave;
    U(x) = sin(x, 2)
}

fn main() {}
