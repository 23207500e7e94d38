//! A potential of another name.

use shadowstep::potential;

potential! {
    pub struct Spring;
    V(x) = x^2
}

fn main() {}
