//! Shadowstep as a contestant, and what all contestants share: initial states, weights of schemes, reference solutions.
//!
//! `ours` answers requests; `ours initial PROBLEM` prints parameters, masses, q and p, a line each;
//! `ours weights SCHEME` the maps of a step; `ours reference PROBLEM UNTIL STEPS` the final q at 40 digits.

mod argon;
mod initial;
mod integrate;
mod problems;
#[path = "../protocol.rs"]
mod protocol;
mod reference;
mod schemes;

use num_traits::ToPrimitive as _;
use shadowstep_schemes::MapKind;

use initial::Initial;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        [] => protocol::serve(integrate::answer),
        ["initial", problem] => print_initial(&Initial::of(problem)),
        ["weights", scheme] => print_weights(scheme),
        ["reference", problem, until, steps] => reference::print(problem, until, steps),
        _ => panic!("usage: ours [initial PROBLEM | weights SCHEME | reference PROBLEM UNTIL STEPS]"),
    }
}

fn print_initial(Initial { parameters, masses, q, p }: &Initial) {
    for numbers in [parameters, masses, q, p] {
        let texts: Vec<_> = numbers.iter().map(|number| format!("{number:e}")).collect();
        println!("{} {}", numbers.len(), texts.join(" "));
    }
}

fn print_weights(scheme: &str) {
    let table = shadowstep::tables::shipped(scheme).expect("a shipped scheme");
    for map in table.proved().scheme.maps() {
        let kind = if map.kind == MapKind::Kick { "kick" } else { "drift" };
        println!("{kind} {:e}", map.weight.to_f64().expect("a finite weight"));
    }
}
