//! Bodies and the energy of each pair of them.

use shadowstep::systems::pairs::{Ends, Separation};
use shadowstep_schemes::symbolic::{Exact, Expression, ExpressionKind, is_symmetric, parse};

use super::bodies::{Bodies, refuse_reserved};
use super::cutoff::cutoff;
use super::given::Given;
use super::kinetic;
use super::numbers::Numbers;
use super::reader::Reader;
use super::{explicit_time, formula};
use crate::run::note::Note;
use crate::scene::{Formula, InitialValueProblem, PairCutoff, PairEnergy, PotentialEnergy};
use shadowstep_schemes::document::Text;

const HELP: &str =
    "r2 is the square of the distance, d = q_j - q_i the difference in one dimension: \"-g*m_i*m_j/sqrt(r2)\"";

/// The formula of the energy of a pair.
pub(super) struct PairFormula {
    text: Text,
    expression: Expression,
    pub(super) separation: Separation,
}

impl PairFormula {
    /// Reads the formula and finds the separation that it contains.
    pub(super) fn read(reader: &mut Reader<'_>, text: Text) -> Option<PairFormula> {
        match PairFormula::read_if(reader, text)? {
            Ok(pair) => Some(pair),
            Err(text) => reader.toml.wrong(
                &text.at,
                "the energy of a pair must be a formula in `r2` or in `d`; this one has neither",
                HELP,
            ),
        }
    }

    /// The same of a text that is perhaps not a formula of pairs, which is returned then.
    pub(super) fn read_if(reader: &mut Reader<'_>, text: Text) -> Option<Result<PairFormula, Text>> {
        let expression = match parse(&text.value) {
            Ok(expression) => expression,
            Err(error) => return reader.toml.wrong(&text.place(&error.range), error.to_string(), HELP),
        };
        let mut found = Vec::new();
        expression.visit(&mut |part| {
            if let ExpressionKind::Name(name) = &part.kind {
                found.extend(Separation::named(name));
            }
        });
        found.dedup();
        match found[..] {
            [separation] => Some(Ok(PairFormula { text, expression, separation })),
            [] => Some(Err(text)),
            _ => reader.toml.wrong(
                &text.at,
                "the energy of a pair must be a formula in `r2` or in `d`; this one has both",
                HELP,
            ),
        }
    }
}

/// A slow potential beside pairs: of all pairs, or of the coordinates.
pub(super) type Slow = Result<PairFormula, Text>;

/// The problem of bodies with this energy of each pair, and with it the slow potential of another one.
pub(super) fn problem(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    pair: Option<PairFormula>,
    slow: Option<Slow>,
) -> Option<(InitialValueProblem, Option<PotentialEnergy>)> {
    let parameters = given.own_parameters(reader);
    given.parameters.iter().for_each(|(name, _)| refuse_reserved(reader, name));
    let dimensions = dimensions(reader, given, pair.as_ref());
    let bodies = Bodies::read(reader, &given.problem, &given.parameters);
    let of_slow = slow.as_ref().map(|slow| slow.as_ref().map_or_else(|text| text, |pair| &pair.text));
    let kinetic = given.problem.text("kinetic");
    let formulas = [pair.as_ref().map(|pair| &pair.text), kinetic.as_ref(), of_slow];
    explicit_time::refuse(reader, given, formulas, "a sum over pairs of bodies")?;
    let (pair, bodies, dimensions) = (pair?, bodies?, dimensions?);
    let (coordinates, momenta) = names(bodies.count, dimensions);
    let named = !has_names_of_bodies(reader, given, &coordinates, &momenta);
    let masses = given.masses.as_ref().and_then(|numbers| {
        let values = bodies.values(reader, numbers)?;
        let masses = kinetic::masses(reader, numbers, values)?;
        Some(masses.into_iter().flat_map(|mass| vec![mass; dimensions]).collect::<Vec<_>>())
    });
    if given.place("masses").or(given.place("kinetic")).is_none() {
        note_masses(reader, &bodies);
    }
    let values = |reader: &mut Reader<'_>, numbers: &Numbers| bodies.values_in_space(reader, numbers, dimensions);
    let (q, p) = given.state.values(reader, values, masses.as_deref());
    let kinetic = if named { kinetic::kinetic(reader, given, &momenta, &parameters, masses) } else { None };
    let potential =
        pair_energy(reader, given, &pair, bodies.clone(), dimensions, &parameters).map(PotentialEnergy::Pairs);
    let slow = match slow {
        Some(slow) => Some(slow_potential(reader, given, slow, (bodies, dimensions), (&coordinates, &parameters))?),
        None => None,
    };
    let problem = InitialValueProblem {
        potential: potential?,
        kinetic: kinetic?,
        parameters,
        coordinates,
        momenta,
        q: q?,
        p: p?,
        explicit_time: false,
    };
    Some((problem, slow))
}

/// The slow potential: all pairs have it, of a chain too.
fn slow_potential(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    slow: Slow,
    (bodies, dimensions): (Bodies, usize),
    (coordinates, parameters): (&[String], &[(String, Exact)]),
) -> Option<PotentialEnergy> {
    let pair = match slow {
        Ok(pair) => pair,
        Err(text) => return formula::potential(reader, &text, coordinates, parameters).map(PotentialEnergy::Formula),
    };
    if given.place("box").is_some() || matches!(given_ends(given), Some(Ends::Periodic | Ends::Fixed)) {
        let help = "write the slow potential in the coordinates x1, y1, …, or the bodies in open space";
        return reader.toml.wrong(&pair.text.at, "slow forces of pairs have no periodic images and no walls", help);
    }
    if pair.separation == Separation::Difference && dimensions != 1 {
        let message = format!("a formula in `d` requires one dimension, not {dimensions}");
        return reader.toml.wrong(&pair.text.at, message, "write the formula in `r2`");
    }
    of_pairs(reader, &pair, (bodies, None, None), dimensions, parameters).map(PotentialEnergy::Pairs)
}

fn pair_energy(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    pair: &PairFormula,
    bodies: Bodies,
    dimensions: usize,
    parameters: &[(String, Exact)],
) -> Option<PairEnergy> {
    let before = reader.toml.faults.len();
    let ends = ends(reader, given, &bodies);
    let cutoff = match (pair.separation, given.place("cutoff").or(given.place("box"))) {
        (Separation::Difference, Some(at)) => reader.toml.wrong(
            &at,
            "a cutoff requires a formula in `r2`",
            "write the formula in `r2`, and `dimensions = 1`",
        ),
        _ => cutoff(reader, &given.problem, dimensions),
    };
    let energy = of_pairs(reader, pair, (bodies, ends, cutoff?.map(Box::new)), dimensions, parameters);
    energy.filter(|_| reader.toml.faults.len() == before)
}

/// The energy of the pairs of these bodies, of a chain if it has ends, up to a cutoff if there is one.
fn of_pairs(
    reader: &mut Reader<'_>,
    pair: &PairFormula,
    (bodies, ends, cutoff): (Bodies, Option<Ends>, Option<Box<PairCutoff>>),
    dimensions: usize,
    parameters: &[(String, Exact)],
) -> Option<PairEnergy> {
    let formula = match Formula::pair(&pair.text.value, pair.separation, &bodies.properties, parameters) {
        Ok(formula) => formula,
        Err(error) => {
            let help = "the energy of a pair is a smooth formula such as \"-g*m_i*m_j/sqrt(r2)\"";
            return reader.toml.wrong(&pair.text.place(&error.range()), error.to_string(), help);
        }
    };
    reader.refuse_numbers(&pair.text, &formula.meaning().numbers());
    let properties = bodies.properties.iter().flat_map(|(name, _)| [format!("{name}_i"), format!("{name}_j")]);
    let properties: Vec<String> = properties.collect();
    let parameters: Vec<String> = parameters.iter().map(|(name, _)| name.clone()).collect();
    if ends.is_none() && is_symmetric(&pair.expression, pair.separation, &properties, &parameters) == Some(false) {
        reader.notes.push(Note::AsymmetricPair { formula: pair.text.value.clone() });
    }
    let Bodies { count, properties } = bodies;
    Some(PairEnergy {
        formula,
        dimensions,
        bodies: count,
        particles: 0,
        properties,
        ends,
        cutoff,
        of_bodies: Vec::new(),
    })
}

/// The number of dimensions; 1 for a formula in `d`.
fn dimensions(reader: &mut Reader<'_>, given: &Given<'_, '_>, pair: Option<&PairFormula>) -> Option<usize> {
    let on_a_line = pair.is_some_and(|pair| pair.separation == Separation::Difference);
    match given.problem.whole("dimensions") {
        Some(dimensions) if on_a_line && dimensions != 1 => {
            let message = format!("a formula in `d` requires one dimension, not {dimensions}");
            let help = "remove `dimensions`, or write the formula in `r2`";
            reader.toml.wrong(&given.problem.place("dimensions"), message, help)
        }
        Some(dimensions) => usize::try_from(dimensions).ok(),
        None => on_a_line.then_some(1),
    }
}

/// Refuses parameters with the name of a coordinate or momentum; whether there are any.
fn has_names_of_bodies(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    coordinates: &[String],
    momenta: &[String],
) -> bool {
    let before = reader.toml.faults.len();
    for (name, _) in &given.parameters {
        for (names, what) in [(coordinates, "coordinate"), (momenta, "momentum")] {
            if names.contains(&name.value) {
                let message = format!("the parameter `{}` has the name of a {what} of the bodies", name.value);
                reader.toml.fault(&name.at, message, "give it another name");
            }
        }
    }
    reader.toml.faults.len() > before
}

fn given_ends(given: &Given<'_, '_>) -> Option<Ends> {
    given.problem.word("neighbours", &[("free", Ends::Free), ("fixed", Ends::Fixed), ("periodic", Ends::Periodic)])
}

/// The ends of a chain, unless all pairs interact.
fn ends(reader: &mut Reader<'_>, given: &Given<'_, '_>, bodies: &Bodies) -> Option<Ends> {
    let ends = given_ends(given);
    let at = &given.problem.place("bodies");
    if ends == Some(Ends::Fixed) && !bodies.properties.is_empty() {
        let message = "bodies between fixed ends cannot have properties, because the walls have none";
        reader.toml.fault(at, message, "write `bodies = 32`, or neighbours = \"free\" or \"periodic\"");
    }
    if ends != Some(Ends::Fixed) && bodies.count == 1 {
        reader.toml.fault(
            at,
            "one body does not form a pair",
            "use two bodies or more, or one with neighbours = \"fixed\"",
        );
    }
    ends
}

/// A property named as a mass is not a mass of T by itself.
fn note_masses(reader: &mut Reader<'_>, bodies: &Bodies) {
    if let Some((name, _)) = bodies.properties.iter().find(|(name, _)| ["m", "mass"].contains(&name.as_str())) {
        reader.notes.push(Note::MassesAreOne { property: name.clone() });
    }
}

/// The names of the coordinates and momenta, body after body.
fn names(bodies: usize, dimensions: usize) -> (Vec<String>, Vec<String>) {
    let axes: &[(&str, &str)] = match dimensions {
        1 => &[("q", "p")],
        more => &[("x", "px"), ("y", "py"), ("z", "pz")][..more],
    };
    let each =
        (1..=bodies).flat_map(|body| axes.iter().map(move |(q, p)| (format!("{q}{body}"), format!("{p}{body}"))));
    each.unzip()
}
