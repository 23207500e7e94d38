//! No coordinates.

use shadowstep::potential;

potential! {
    pub struct Nothing;
    U() = 1
}

fn main() {}
