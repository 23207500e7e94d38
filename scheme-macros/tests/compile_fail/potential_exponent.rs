//! An exponent that varies.

use shadowstep::potential;

potential! {
    pub struct Odd;
    U(x, y) = x^y
}

fn main() {}
