//! A momentum that there is none of.

use shadowstep::kinetic;

kinetic! {
    pub struct Wrong;
    T(px, py) = px^2 + pz^2
}

fn main() {}
