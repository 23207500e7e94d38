//! A scheme with an inner scheme for two parts, and for four.

use shadowstep::splitting_scheme;

#[splitting_scheme("r-respa-4.toml")]
pub struct ForTwo;

#[splitting_scheme("r-respa-4.toml", parts = 4)]
pub struct ForFour;

fn main() {
    let _ = (ForTwo, ForFour);
}
