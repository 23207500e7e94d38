//! [problem]: the system, given in one of several ways, each with its file.

use shadowstep::systems::pairs::Separation;
use shadowstep_schemes::document::Text;
use toml::de::DeTable;

use super::given::Given;
use super::pair::PairFormula;
use super::parts;
use super::planets::{self, GivenBody};
use super::reader::Reader;
use super::{doubled, encounters, explicit_time, formula, magnetic, many_parts, pair, shipped, slow};
use crate::document::schema::Table;
use crate::scene::System;
use crate::scene::split::SLOW;

/// The system with its initial state.
pub(super) fn system(reader: &mut Reader<'_>, root: &DeTable<'_>, bodies: &[GivenBody]) -> Option<System> {
    let given = Given::read(reader, root);
    let mut system = of_any_way(reader, &given, bodies)?;
    encounters::set(reader, &given.problem, &mut system)?;
    refuse_coordinates(reader, &given.problem, &system);
    Some(system)
}

/// Refuses names of a family that are those of coordinates or momenta.
fn refuse_coordinates(reader: &mut Reader<'_>, problem: &Table<'_, '_>, system: &System) {
    let mut names = reader.names.iter().map(|(name, _)| name);
    let Some(name) = names.find(|name| system.coordinates.contains(name) || system.momenta.contains(name)) else {
        return;
    };
    let message = format!("a coordinate or momentum has the name `{name}` of an axis or a column");
    reader.toml.fault(&problem.at, message, "give the axis or the column another name");
}

fn of_any_way(reader: &mut Reader<'_>, given: &Given<'_, '_>, bodies: &[GivenBody]) -> Option<System> {
    let problem = &given.problem;
    if let Some(formulas) = problem.list("parts") {
        return many_parts::system(reader, given, formulas);
    }
    let split = parts::of_word(problem);
    if let Some(name) = problem.text("name") {
        let (problem, bodies) = shipped::problem(reader, given, &name)?;
        return parts::split(reader, given, problem, split, bodies);
    }
    let slow = problem.text(SLOW);
    if let Some(potential) = problem.text("potential") {
        return of_potential(reader, given, (potential, slow), split);
    }
    if let Some(text) = problem.text("pair") {
        let pair = PairFormula::read(reader, text);
        // a formula in d has one dimension
        let in_space = pair.as_ref().is_some_and(|pair| pair.separation == Separation::SquaredDistance);
        if in_space && problem.get("dimensions").is_none() {
            reader.toml.fault(&problem.at, "the key `dimensions` is missing", "add `dimensions = 3`");
        }
        let slow = slow.and_then(|text| PairFormula::read_if(reader, text));
        let problem = pair::problem(reader, given, pair, slow)?;
        return slow::system(reader, given, problem, split);
    }
    match problem.text(doubled::HAMILTONIAN) {
        Some(hamiltonian) => doubled::system(reader, given, &hamiltonian),
        None if bodies.is_empty() => None,
        None => planets::system(reader, given, bodies, split),
    }
}

/// The system of U: with a magnetic field, with t in T, or of T(p) and U.
fn of_potential(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    (potential, slow): (Text, Option<Text>),
    split: parts::Split,
) -> Option<System> {
    if let Some(field) = given.problem.list(magnetic::KEY) {
        return magnetic::system(reader, given, potential, &field);
    }
    if explicit_time::is_in_kinetic(reader, given) {
        let help = "give H by the formulas of three parts: parts = [\"slow\", \"fast\", \"T\"]";
        given.refuse(reader, SLOW, "slow cannot be set with t in `kinetic`", help);
        return many_parts::with_time_in_kinetic(reader, given, potential);
    }
    let problem = formula::problem(reader, given, &potential, slow.as_ref())?;
    slow::system(reader, given, problem, split)
}
