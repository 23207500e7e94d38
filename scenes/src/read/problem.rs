//! [problem]: the system, given in one of three ways, each with its file.

use shadowstep::pairs::Separation;

use super::given::Given;
use super::pair::PairFormula;
use super::reader::Reader;
use super::{formula, pair, shipped};
use crate::scene::System;
use shadowstep_schemes::document::Section;

/// The keys of which exactly one gives the potential.
const WAYS: [&str; 3] = ["name", "potential", "pair"];

/// The system with its initial state.
pub(super) fn system(reader: &mut Reader<'_>, problem: &Section<'_, '_>, initial: &Section<'_, '_>) -> Option<System> {
    let ways: Vec<_> = WAYS.into_iter().filter(|way| problem.get(way).is_some()).collect();
    let [name, potential, pair] = WAYS.map(|way| problem.get(way).and_then(|value| reader.toml.text(value)));
    let pair = pair.and_then(|text| PairFormula::read(reader, text));
    // if none of the keys is given, only that is a fault
    let given = Given::read(reader, problem, initial, ways.is_empty() || ways.contains(&"pair"));
    match ways[..] {
        ["name"] => shipped::system(reader, &given, &name?),
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
