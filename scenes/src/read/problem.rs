//! [problem]: the system, given in one of four ways, each with its file.

use shadowstep::pairs::Separation;

use super::given::Given;
use super::pair::PairFormula;
use super::planets::{self, GivenBody, Settings};
use super::reader::Reader;
use super::{formula, pair, shipped};
use crate::scene::{Canonical, Parts, Planets, PotentialEnergy, System};
use shadowstep_schemes::document::Section;

/// The keys of which exactly one gives the potential.
const WAYS: [&str; 3] = ["name", "potential", "pair"];

/// The system with its initial state.
pub(super) fn system(
    reader: &mut Reader<'_>,
    problem: &Section<'_, '_>,
    initial: &Section<'_, '_>,
    bodies: &[GivenBody],
) -> Option<System> {
    let ways: Vec<_> = WAYS.into_iter().filter(|way| problem.get(way).is_some()).collect();
    let [name, potential, pair] = WAYS.map(|way| problem.get(way).and_then(|value| reader.toml.text(value)));
    let pair = pair.and_then(|text| PairFormula::read(reader, text));
    // if none of the keys is given, only that is a fault
    let given = Given::read(reader, problem, initial, ways.is_empty() || ways.contains(&"pair"));
    let settings = Settings::read(reader, problem);
    if !ways.is_empty() || bodies.is_empty() {
        refuse_keys_of_bodies(reader, &given, ways == ["name"] || ways.is_empty());
    }
    match ways[..] {
        [] if !bodies.is_empty() => planets::system(reader, &given, problem, (&settings, bodies)),
        [way, ..] if !bodies.is_empty() => {
            let message = format!("{way} and [[body]] are both given");
            reader.toml.wrong(given.place(way)?, message, "keep one of the two")
        }
        ["name"] => {
            let system = shipped::system(reader, &given, &name?)?;
            in_parts(reader, &given, system, settings.parts?)
        }
        ["potential"] => {
            given.needs(reader, problem, "coordinates");
            formula::system(reader, &given, &potential?)
        }
        ["pair"] => {
            given.needs(reader, problem, "bodies");
            // a formula in d has one dimension
            if pair.as_ref().is_some_and(|pair| pair.separation == Separation::SquaredDistance) {
                given.needs(reader, problem, "dimensions");
            }
            pair::system(reader, &given, pair)
        }
        [] => {
            reader.toml.missing(problem, &WAYS);
            None
        }
        [first, second] => {
            let message = format!("{first} and {second} are both given");
            reader.toml.wrong(given.place(second)?, message, "keep one of the two")
        }
        _ => reader.toml.wrong(given.place("pair")?, "name, potential and pair are all given", "keep one of the three"),
    }
}

/// A shipped problem in the parts that its steps have.
fn in_parts(reader: &mut Reader<'_>, given: &Given, system: System, parts: Option<Canonical>) -> Option<System> {
    let Some(coordinates) = parts else { return Some(system) };
    let bodies = match &system.potential {
        PotentialEnergy::Shipped(setup) => setup.bodies(),
        _ => None,
    };
    let Some((bodies, dimensions)) = bodies else {
        let help = "remove `parts`, or use a problem such as outer-solar-system";
        return reader.toml.wrong(given.place("parts")?, "only bodies that attract each other have these parts", help);
    };
    Some(System { parts: Parts::WisdomHolman(Planets { coordinates, bodies, dimensions }), ..system })
}

/// Refuses what only bodies can have.
fn refuse_keys_of_bodies(reader: &mut Reader<'_>, given: &Given, shipped: bool) {
    let keys: &[&str] =
        if shipped { &["units", "elements", "barycentric"] } else { &["parts", "units", "elements", "barycentric"] };
    given.refuse(reader, keys, |key| {
        (format!("{key} requires bodies"), format!("remove `{key}`, or give the bodies in sections [[body]]"))
    });
}
