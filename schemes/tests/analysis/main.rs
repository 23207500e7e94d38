//! The analysis of schemes against closed forms, published values, and independent numerics.

mod nonlinear;
mod oscillator;
mod published;

use shadowstep_schemes::{Analysis, Proved, Source, read, shipped};

/// A shipped scheme.
fn scheme(name: &str) -> Proved {
    read(&shipped(name).unwrap(), &|name, _| shipped(name)).unwrap()
}

/// The scheme with these weights, written as in a table; `claims` are its lines before the stages.
fn with_weights(claims: &str, kick: &str, drift: &str) -> Proved {
    let text =
        format!("name = \"mine\"\nreference = \"a test\"\n{claims}\n[stages]\nkick = [{kick}]\ndrift = [{drift}]\n");
    read(&Source { path: "mine.toml".to_owned(), text }, &|name, _| shipped(name))
        .unwrap_or_else(|faults| panic!("{faults}"))
}

fn analysis(name: &str) -> Analysis {
    Analysis::of(&scheme(name))
}
