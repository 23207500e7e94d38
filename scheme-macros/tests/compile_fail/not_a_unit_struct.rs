//! The attribute stands above a struct with a field.

use shadowstep::{Scheme, splitting_scheme};

#[splitting_scheme("yoshida4.toml")]
pub struct Mine {
    pub steps: u64,
}

fn main() {
    println!("{}", Mine { steps: 1 }.summary().name);
}
