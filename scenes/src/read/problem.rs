//! [problem]: the system, given in one of several ways, each with its file.

use shadowstep::systems::pairs::Separation;

use super::encounters::GivenEncounters;
use super::given::Given;
use super::pair::PairFormula;
use super::parts;
use super::planets::{self, GivenBody, Settings};
use super::reader::Reader;
use super::{doubled, explicit_time, formula, magnetic, many_parts, pair, shipped, slow};
use crate::scene::System;
use crate::scene::split::SLOW;
use shadowstep_schemes::document::{Placed, Section, Text};

/// The keys of which exactly one gives the potential.
const WAYS: [&str; 4] = ["name", "potential", "pair", doubled::HAMILTONIAN];

/// The system with its initial state.
pub(super) fn system(
    reader: &mut Reader<'_>,
    problem: &Section<'_, '_>,
    initial: &Section<'_, '_>,
    bodies: &[GivenBody],
) -> Option<System> {
    let encounters = problem.get("encounters").map(|value| GivenEncounters::read(reader, value));
    let mut system = of_any_way(reader, problem, initial, bodies)?;
    encounters.map_or(Some(()), |encounters| encounters.set(reader, &mut system))?;
    refuse_coordinates(reader, problem, &system);
    Some(system)
}

/// Refuses names of a family that are those of coordinates or momenta.
fn refuse_coordinates(reader: &mut Reader<'_>, problem: &Section<'_, '_>, system: &System) {
    let mut names = reader.names.iter().map(|(name, _)| name);
    let Some(name) = names.find(|name| system.coordinates.contains(name) || system.momenta.contains(name)) else {
        return;
    };
    let message = format!("a coordinate or momentum has the name `{name}` of an axis or a column");
    reader.toml.fault(&problem.at, message, "give the axis or the column another name");
}

fn of_any_way(
    reader: &mut Reader<'_>,
    problem: &Section<'_, '_>,
    initial: &Section<'_, '_>,
    bodies: &[GivenBody],
) -> Option<System> {
    let ways: Vec<_> = WAYS.into_iter().filter(|way| problem.get(way).is_some()).collect();
    let [name, potential, pair, hamiltonian] =
        WAYS.map(|way| problem.get(way).and_then(|value| reader.toml.text(value)));
    let pair = pair.and_then(|text| PairFormula::read(reader, text));
    // if none of the keys is given, only that is a fault
    let is_of_parts = problem.get("parts").is_some_and(parts::is_list);
    let given = Given::read(reader, problem, initial, ways.contains(&"pair") || ways.is_empty() && !is_of_parts);
    let settings = Settings::read(reader, problem);
    let field = reader.names(problem, magnetic::KEY, "a list of formulas: [\"-b*y/2\", \"b*x/2\"]");
    let slow = problem.get(SLOW).and_then(|value| reader.toml.text(value));
    let coupling = problem.get(doubled::COUPLING).and_then(|value| reader.number(value));
    refuse_keys_of_others(reader, &given, &ways, bodies);
    if let Some(value) = problem.get("parts").filter(|value| parts::is_list(value)) {
        let other = ways.first().copied().or((!bodies.is_empty()).then_some("[[body]]"));
        if let Some(other) = other {
            let help = "keep one of the two: the formulas of the parts are all of H";
            return reader.toml.wrong(&value.span(), format!("{other} and formulas of parts are both given"), help);
        }
        given.needs(reader, problem, "coordinates");
        return many_parts::system(reader, &given, value);
    }
    match ways[..] {
        [] if !bodies.is_empty() => planets::system(reader, &given, problem, (&settings, bodies)),
        [way, ..] if !bodies.is_empty() => {
            let message = format!("{way} and [[body]] are both given");
            reader.toml.wrong(given.place(way)?, message, "keep one of the two")
        }
        ["name"] => {
            let (problem, bodies) = shipped::problem(reader, &given, &name?)?;
            parts::split(reader, &given, problem, settings.split?, bodies)
        }
        ["potential"] => {
            given.needs(reader, problem, "coordinates");
            of_potential(reader, &given, (potential?, slow), field.as_ref(), settings.split)
        }
        ["pair"] => {
            given.needs(reader, problem, "bodies");
            // a formula in d has one dimension
            if pair.as_ref().is_some_and(|pair| pair.separation == Separation::SquaredDistance) {
                given.needs(reader, problem, "dimensions");
            }
            let slow = slow.and_then(|text| PairFormula::read_if(reader, text));
            let problem = pair::problem(reader, &given, pair, slow)?;
            slow::system(reader, &given, problem, settings.split)
        }
        [doubled::HAMILTONIAN] => {
            given.needs(reader, problem, "coordinates");
            doubled::system(reader, &given, &hamiltonian?, coupling)
        }
        [] => {
            reader.toml.missing(problem, &WAYS);
            None
        }
        [first, second, ..] => {
            let message = format!("{first} and {second} are both given");
            reader.toml.wrong(given.place(second)?, message, "keep one of the two")
        }
        [_] => unreachable!("it is one of the ways"),
    }
}

/// The system of U: with a magnetic field, with t in T, or of T(p) and U.
fn of_potential(
    reader: &mut Reader<'_>,
    given: &Given,
    (potential, slow): (Text, Option<Text>),
    field: Option<&Placed<Vec<Text>>>,
    split: Option<parts::Split>,
) -> Option<System> {
    if slow.is_some() && (field.is_some() || explicit_time::is_in_kinetic(reader, given)) {
        slow::refuse(reader, given, field.map_or("t in `kinetic`", |_| magnetic::KEY));
        return None;
    }
    if let Some(field) = field {
        return magnetic::system(reader, given, potential, field);
    }
    if explicit_time::is_in_kinetic(reader, given) {
        return many_parts::with_time_in_kinetic(reader, given, potential);
    }
    let problem = formula::problem(reader, given, &potential, slow.as_ref())?;
    slow::system(reader, given, problem, split)
}

/// Refuses keys that belong to another way than the one that is given.
fn refuse_keys_of_others(reader: &mut Reader<'_>, given: &Given, ways: &[&str], bodies: &[GivenBody]) {
    if *ways != [doubled::HAMILTONIAN] {
        given.refuse(reader, &[doubled::COUPLING], |key| {
            (format!("{key} requires `{}`", doubled::HAMILTONIAN), format!("remove `{key}`"))
        });
    }
    if !matches!(*ways, ["potential" | "pair"]) {
        given.refuse(reader, &[SLOW], |key| {
            let help = format!("remove `{key}`, or give the fast forces by a formula");
            (format!("{key} requires `potential` or `pair`"), help)
        });
    }
    if *ways != ["potential"] {
        given.refuse(reader, &[magnetic::KEY], |key| {
            let help = format!("remove `{key}`, or give U by a formula: potential = \"0\"");
            (format!("{key} requires `potential`"), help)
        });
    }
    if !ways.is_empty() || bodies.is_empty() {
        refuse_keys_of_bodies(reader, given);
    }
}

/// Refuses what only bodies can have.
fn refuse_keys_of_bodies(reader: &mut Reader<'_>, given: &Given) {
    given.refuse(reader, &["units", "elements", "barycentric", "central", "external", "particles"], |key| {
        (format!("{key} requires bodies"), format!("remove `{key}`, or give the bodies in sections [[body]]"))
    });
}
