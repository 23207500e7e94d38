//! What a kind of split does not have is refused at the key that asks for the split, with its own sentence.

use shadowstep::tables::{Faults, Source};
use shadowstep_scenes::ensemble::Ensemble;
use shadowstep_scenes::{Error, Scene};

const HENON_HEILES: &str = "name = \"henon-heiles\"\n";
const PLANETS: &str = "name = \"outer-solar-system\"\n";
const FORMULAS: &str = "parts = [\"p^2/2\", \"a*q^4\", \"cos(q)\"]\ncoordinates = [\"q\"]\nmomenta = \
    [\"p\"]\nparameters = { a = 1 }\n[initial]\nq = [1]\np = [0]\n";
const LOGARITHMIC: &str = "name = \"kepler\"\n[time]\ntransform = \"logarithmic\"\n";

fn source(problem: &str, digits: &str, more: &str) -> Source {
    let run = format!("[run]\nscheme = \"yoshida4\"\nstep = \"1/10\"\nsteps = 3\ndigits = \"{digits}\"");
    let text = format!("[problem]\n{problem}{run}\n[output]\nenergy = true\n{more}");
    Source { path: "test.toml".to_owned(), text }
}

fn shown(Faults(faults): &Faults) -> Vec<String> {
    faults.iter().map(|fault| format!("{}:{}: {}", fault.line, fault.column, fault.message)).collect()
}

#[test]
fn ensembles() {
    let columns = "[ensemble]\ncolumns = { u = [1, 2] }\n";
    let (all, [.., transformed]) = (splits(), splits());
    for problem in &all {
        let found = Ensemble::read(source(problem, "double", columns));
        match found {
            Err(Error::Faults(faults)) if *problem == transformed => assert_eq!(
                shown(&faults),
                ["4:13: an ensemble has no transformed time: its steps end at different times"]
            ),
            found => assert!(found.is_ok() && *problem != transformed, "{problem}: {:?}", found.err()),
        }
    }
}

#[test]
fn compensated_sums() {
    for problem in splits() {
        for digits in ["double", "compensated"] {
            assert!(Scene::read(source(&problem, digits, "")).is_ok(), "{problem}");
        }
    }
}

/// A problem with each kind of split, transformed time the last one.
fn splits() -> [String; 5] {
    let planets = |word: &str| format!("{PLANETS}parts = \"{word}\"\n");
    let linear = format!("{HENON_HEILES}parts = \"linear\"\n");
    let [jacobi, heliocentric] = ["wisdom-holman", "wisdom-holman-heliocentric"].map(planets);
    [linear, jacobi, heliocentric, FORMULAS.to_owned(), LOGARITHMIC.to_owned()]
}
