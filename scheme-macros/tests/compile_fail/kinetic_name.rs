//! A kinetic energy of another name.

use shadowstep::kinetic;

kinetic! {
    pub struct Wrong;
    V(p) = p^2
}

fn main() {}
