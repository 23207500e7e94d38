//! No momenta.

use shadowstep::kinetic;

kinetic! {
    pub struct Wrong;
    T() = 1
}

fn main() {}
