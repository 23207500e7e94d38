//! A scheme with gradient kicks for three parts.

use shadowstep::splitting_scheme;

#[splitting_scheme("chin-4a.toml", parts = 3)]
pub struct Mine;

fn main() {
    let _ = Mine;
}
