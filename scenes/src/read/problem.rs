//! [problem]: the system, given in one of five ways, each with its file.

use std::ops::Range;

use shadowstep::number::AnyLimbs;
use shadowstep::pairs::Separation;

use super::given::Given;
use super::pair::PairFormula;
use super::planets::{self, GivenBody, GivenParts, Settings};
use super::reader::Reader;
use super::{formula, many_parts, pair, shipped};
use crate::scene::{KineticEnergy, MOST_COORDINATES, Parts, Planets, PotentialEnergy, System, stiffness};
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
        refuse_keys_of_bodies(reader, &given);
    }
    if let Some(value) = problem.get("parts").filter(|value| many_parts::is_list(value)) {
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
            let system = shipped::system(reader, &given, &name?)?;
            in_parts(reader, &given, system, settings.parts?)
        }
        ["potential"] => {
            given.needs(reader, problem, "coordinates");
            let system = formula::system(reader, &given, &potential?)?;
            in_parts(reader, &given, system, settings.parts?)
        }
        ["pair"] => {
            given.needs(reader, problem, "bodies");
            // a formula in d has one dimension
            if pair.as_ref().is_some_and(|pair| pair.separation == Separation::SquaredDistance) {
                given.needs(reader, problem, "dimensions");
            }
            let system = pair::system(reader, &given, pair)?;
            in_parts(reader, &given, system, settings.parts?)
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

/// The system in the parts that its steps have.
fn in_parts(reader: &mut Reader<'_>, given: &Given, system: System, parts: GivenParts) -> Option<System> {
    let at = given.place("parts").unwrap_or(&given.problem);
    let parts = match (parts, &system.potential) {
        (GivenParts::KineticAndPotential, _) => return Some(system),
        (GivenParts::Linear, _) => linear(reader, at, &system)?,
        (GivenParts::Planets(coordinates), PotentialEnergy::Shipped(setup)) if setup.bodies().is_some() => {
            let (bodies, dimensions) = setup.bodies()?;
            Parts::WisdomHolman(Planets { coordinates, bodies, dimensions })
        }
        (GivenParts::Planets(_), _) => {
            let help =
                "remove `parts`, give the bodies in sections [[body]], or use a problem such as outer-solar-system";
            return reader.toml.wrong(at, "only bodies that attract each other have these parts", help);
        }
    };
    Some(System { parts, ..system })
}

/// T(p) + ½qᵀKq and the rest of U.
fn linear(reader: &mut Reader<'_>, at: &Range<usize>, system: &System) -> Option<Parts> {
    let coordinates = system.q.len();
    let refused = match () {
        () if coordinates > MOST_COORDINATES => {
            Some(format!("a linear part has at most {MOST_COORDINATES} coordinates, not {coordinates}"))
        }
        () if matches!(system.kinetic, KineticEnergy::Formula(_)) => {
            Some("a linear part requires T by masses, not by a formula".to_owned())
        }
        () if reader.arithmetic.is_compensated() => Some("a linear part has no compensated sums".to_owned()),
        () if reader.arithmetic.digits() > MOST_DIGITS => {
            Some(format!("a linear part is computed to {MOST_DIGITS} digits"))
        }
        () => None,
    };
    if let Some(message) = refused {
        return reader.toml.wrong(at, message, "remove `parts`, or change that");
    }
    match stiffness(|count| system.potential::<AnyLimbs>(count)) {
        Some(stiffness) => Some(Parts::Linear(stiffness)),
        None => reader.toml.wrong(
            at,
            "U has no second derivatives at q = 0",
            "remove `parts`: the force has no linear part",
        ),
    }
}

/// The most digits of a run with a linear part, whose flow is computed in more.
const MOST_DIGITS: u32 = 288;

/// Refuses what only bodies can have.
fn refuse_keys_of_bodies(reader: &mut Reader<'_>, given: &Given) {
    given.refuse(reader, &["units", "elements", "barycentric"], |key| {
        (format!("{key} requires bodies"), format!("remove `{key}`, or give the bodies in sections [[body]]"))
    });
}
