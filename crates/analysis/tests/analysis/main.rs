//! The analysis of schemes against closed forms, published values, and independent numerics.

mod nonlinear;
mod oscillator;
mod published;
mod resonance;

use std::sync::LazyLock;

use shadowstep_analysis::Analysis;
use shadowstep_schemes::{Proved, Source, read, shipped, shipped_names};

/// All shipped schemes, each proved and analysed once for all tests.
static SHIPPED: LazyLock<Vec<(&str, Proved, Analysis)>> = LazyLock::new(|| {
    let analysed = |name| {
        let proved = read(&shipped(name).unwrap(), &|name, _| shipped(name)).unwrap();
        let analysis = Analysis::of(&proved);
        (name, proved, analysis)
    };
    shipped_names().into_iter().map(analysed).collect()
});

/// A shipped scheme.
fn scheme(name: &str) -> &'static Proved {
    &SHIPPED.iter().find(|(known, ..)| *known == name).unwrap().1
}

/// The scheme with these weights, written as in a table; `claims` are its lines before the stages.
fn with_weights(claims: &str, kick: &str, drift: &str) -> Proved {
    let text =
        format!("name = \"mine\"\nreference = \"a test\"\n{claims}\n[stages]\nkick = [{kick}]\ndrift = [{drift}]\n");
    read(&Source { path: "mine.toml".to_owned(), text }, &|name, _| shipped(name))
        .unwrap_or_else(|faults| panic!("{faults}"))
}

fn analysis(name: &str) -> &'static Analysis {
    &SHIPPED.iter().find(|(known, ..)| *known == name).unwrap().2
}
