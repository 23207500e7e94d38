//! A momentum that does not exist.

use shadowstep::kinetic;

kinetic! {
    pub struct Wrong;
    T(px, py) = px^2 + pz^2
}

fn main() {}
