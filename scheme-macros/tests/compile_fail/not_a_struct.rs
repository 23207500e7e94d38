//! The attribute stands above a function.

use shadowstep::splitting_scheme;

#[splitting_scheme("yoshida4.toml")]
fn mine() {}

fn main() {
    println!("nothing else is wrong");
}
