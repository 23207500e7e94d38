//! What a kind of split does not have is refused at the key that asks for the split, with its own sentence.

use shadowstep::tables::{Faults, Source};
use shadowstep_scenes::ensemble::Ensemble;
use shadowstep_scenes::{Error, Scene};

const HENON_HEILES: &str = "name = \"henon-heiles\"\n";
const PLANETS: &str = "name = \"outer-solar-system\"\n";
const FORMULAS: &str = "parts = [\"p^2/2\", \"a*q^4\", \"cos(q)\"]\ncoordinates = [\"q\"]\nmomenta = [\"p\"]\nparameters = { a = 1 }\n[initial]\nq = [1]\np = [0]\n";
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
    let columns = "[ensemble]\ncolumns = { a = [1, 2] }\n";
    let linear = format!("{HENON_HEILES}parts = \"linear\"\n");
    let planets = |word: &str| format!("{PLANETS}parts = \"{word}\"\n");
    for (problem, fault) in [
        (linear.as_str(), "3:9: an ensemble has no linear part"),
        (&planets("wisdom-holman"), "3:9: an ensemble has no orbits of planets as parts"),
        (&planets("wisdom-holman-heliocentric"), "3:9: an ensemble has no orbits of planets as parts"),
        (LOGARITHMIC, "4:13: an ensemble has no transformed time: its steps end at different times"),
        (FORMULAS, "2:9: an ensemble has no formulas of parts"),
    ] {
        match Ensemble::read(source(problem, "double", columns)) {
            Err(Error::Faults(faults)) => assert_eq!(shown(&faults), [fault]),
            other => panic!("{fault}: {other:?}"),
        }
    }
    let plain = source(&planets("kinetic-potential"), "double", columns);
    assert!(Ensemble::read(plain).is_ok());
}

#[test]
fn compensated_sums() {
    let linear = format!("{HENON_HEILES}parts = \"linear\"\n");
    for (problem, fault) in [
        (linear.as_str(), Some("3:9: a linear part has no compensated sums")),
        (FORMULAS, Some("2:9: formulas of parts have no compensated sums")),
        (&format!("{PLANETS}parts = \"wisdom-holman\"\n"), None),
        (LOGARITHMIC, None),
    ] {
        assert!(Scene::read(source(problem, "double", "")).is_ok(), "{problem}");
        let found = Scene::read(source(problem, "compensated", ""));
        let faults = found.as_ref().err().map(shown).unwrap_or_default();
        assert_eq!(faults, fault.map(str::to_owned).into_iter().collect::<Vec<_>>());
    }
}
