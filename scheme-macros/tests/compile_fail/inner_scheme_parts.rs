//! A scheme with an inner scheme for two parts.

use shadowstep::splitting_scheme;

#[splitting_scheme("r-respa-4.toml")]
pub struct Mine;

fn main() {
    let _ = Mine;
}
