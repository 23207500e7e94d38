//! Bodies and the energy of each pair of them.

use shadowstep::pairs::{Ends, Separation};
use shadowstep_symbolic::{Exact, Expression, Kind, is_symmetric, parse};

use super::bodies::{Bodies, refuse_reserved};
use super::kinetic::masses;
use super::numbers::Numbers;
use super::problem::Given;
use crate::complaint::remark;
use crate::scene::pairs::PairEnergy;
use crate::scene::reader::{Reader, Text};
use crate::scene::system::{KineticEnergy, PotentialEnergy, System};

/// The energy of a pair, as the scene has it.
pub(super) struct PairFormula {
    pub(super) text: Text,
    pub(super) separation: Separation,
}

impl PairFormula {
    /// Finds out what the formula is in.
    pub(super) fn read(reader: &mut Reader<'_>, text: Text) -> Option<PairFormula> {
        let help = "r2 is the square of the distance, d = q_j - q_i the difference on a line: \"-g*m_i*m_j/sqrt(r2)\"";
        let expression = match parse(&text.value) {
            Ok(expression) => expression,
            Err(error) => return reader.wrong(&text.place(&error.range), error.to_string(), help),
        };
        let mut found = Vec::new();
        separations(&expression, &mut found);
        found.dedup();
        match found[..] {
            [separation] => Some(PairFormula { text, separation }),
            [] => reader.wrong(&text.at, "the energy of a pair is a formula in `r2` or in `d`, here is neither", help),
            _ => reader.wrong(&text.at, "the energy of a pair is a formula in `r2` or in `d`, here are both", help),
        }
    }
}

fn separations(expression: &Expression, found: &mut Vec<Separation>) {
    match &expression.kind {
        Kind::Number(_) => {}
        Kind::Name(name) => found.extend(Separation::named(name)),
        Kind::Negate(inner) => separations(inner, found),
        Kind::Binary(_, left, right) => [left, right].into_iter().for_each(|part| separations(part, found)),
        Kind::Call { arguments, .. } => arguments.iter().for_each(|part| separations(part, found)),
    }
}

impl Given {
    /// The system of bodies with this energy of each pair.
    pub(super) fn pairs(self, reader: &mut Reader<'_>, pair: Option<PairFormula>) -> Option<System> {
        self.refuse(reader, &["coordinates", "momenta"], |key| {
            let names = "x1, y1, …, px1, py1, …, or on a line q1, …, p1, …";
            (format!("with `pair` {key} have names by themselves"), format!("leave out `{key}`: the names are {names}"))
        });
        let parameters = self.own_parameters(reader);
        self.parameters.iter().for_each(|(name, _)| refuse_reserved(reader, name));
        let dimensions = self.dimensions(reader, pair.as_ref());
        let bodies = self.bodies(reader);
        if let Some(initial) = &self.initial {
            self.state.all_there(reader, initial);
        }
        let (pair, bodies, dimensions) = (pair?, bodies?, dimensions?);
        let (coordinates, momenta) = names(bodies.count, dimensions);
        let kinetic = match self.has_names_of_bodies(reader, &coordinates, &momenta) {
            true => None,
            false => self.kinetic_energy(reader, &momenta, &parameters),
        };
        let masses = self.masses.as_ref().and_then(|numbers| {
            let values = bodies.values(reader, numbers)?;
            let masses = masses(reader, numbers, values)?;
            Some(masses.into_iter().flat_map(|mass| vec![mass; dimensions]).collect::<Vec<_>>())
        });
        if self.place("masses").or(self.place("kinetic")).is_none() {
            remark_on_masses(&bodies);
        }
        let values = |reader: &mut Reader<'_>, numbers: &Numbers| bodies.values_in_space(reader, numbers, dimensions);
        let (q, p) = self.state.values(reader, values, masses.as_deref());
        let kinetic = kinetic.unwrap_or(KineticEnergy::Masses(masses));
        let potential = PotentialEnergy::Pairs(self.pair_energy(reader, &pair, bodies, dimensions, &parameters));
        Some(System { potential, kinetic, parameters, coordinates, momenta, q: q?, p: p? })
    }

    fn pair_energy(
        &self,
        reader: &mut Reader<'_>,
        pair: &PairFormula,
        bodies: Bodies,
        dimensions: usize,
        parameters: &[(String, Exact)],
    ) -> PairEnergy {
        let energy = PairEnergy {
            formula: pair.text.value.clone(),
            separation: pair.separation,
            dimensions,
            ends: self.ends(reader, &bodies),
            bodies: bodies.count,
            properties: bodies.properties,
        };
        if let Err(error) = energy.pair::<f64>(parameters, &()) {
            let help = "the energy of a pair is a smooth formula such as \"-g*m_i*m_j/sqrt(r2)\"";
            reader.fault(&pair.text.place(&error.range()), error.to_string(), help);
        }
        let properties = energy.properties.iter().flat_map(|(name, _)| [format!("{name}_i"), format!("{name}_j")]);
        let properties: Vec<String> = properties.collect();
        let parameters: Vec<String> = parameters.iter().map(|(name, _)| name.clone()).collect();
        let separation = pair.separation.name().to_owned();
        reader.refuse_constants(&pair.text, properties.iter().chain(&parameters).chain([&separation]));
        let symmetric = parse(&pair.text.value).ok();
        let symmetric = symmetric.and_then(|text| is_symmetric(&text, pair.separation, &properties, &parameters));
        if energy.ends.is_none() && symmetric == Some(false) {
            let formula = &pair.text.value;
            remark(format_args!("{formula} changes when bodies are exchanged; i is the one with the smaller number"));
        }
        energy
    }

    /// How many dimensions there are: on a line one.
    fn dimensions(&self, reader: &mut Reader<'_>, pair: Option<&PairFormula>) -> Option<usize> {
        let on_a_line = pair.is_some_and(|pair| pair.separation == Separation::Difference);
        match (self.dimensions, self.place("dimensions")) {
            (Some(dimensions), Some(at)) if on_a_line && dimensions != 1 => {
                let message = format!("a formula in d is for bodies on a line, and here are {dimensions} dimensions");
                reader.wrong(at, message, "leave it out, or write the formula in `r2`")
            }
            (None, None) => on_a_line.then_some(1),
            (dimensions, _) => dimensions,
        }
    }

    /// Refuses parameters with the name of a coordinate or momentum; whether there are any.
    fn has_names_of_bodies(&self, reader: &mut Reader<'_>, coordinates: &[String], momenta: &[String]) -> bool {
        let before = reader.faults.len();
        for (name, _) in &self.parameters {
            for (names, what) in [(coordinates, "coordinate"), (momenta, "momentum")] {
                if names.contains(&name.value) {
                    let message = format!("the parameter `{}` has the name of a {what} of the bodies", name.value);
                    reader.fault(&name.at, message, "give it another name");
                }
            }
        }
        reader.faults.len() > before
    }

    /// The ends of a chain, unless all pairs interact.
    fn ends(&self, reader: &mut Reader<'_>, bodies: &Bodies) -> Option<Ends> {
        let ends = self.neighbours;
        let at = self.place("bodies").unwrap_or(&self.problem);
        if ends == Some(Ends::Fixed) && !bodies.properties.is_empty() {
            let message = "between fixed ends bodies have no properties: the walls would need them, too";
            reader.fault(at, message, "write `bodies = 32`, or neighbours = \"free\" or \"periodic\"");
        }
        if ends != Some(Ends::Fixed) && bodies.count == 1 {
            reader.fault(at, "one body makes no pair", "two bodies do, or one with neighbours = \"fixed\"");
        }
        ends
    }
}

/// Tells that a property of this name is no mass of T by itself.
fn remark_on_masses(bodies: &Bodies) {
    if let Some((name, _)) = bodies.properties.iter().find(|(name, _)| ["m", "mass"].contains(&name.as_str())) {
        remark(format_args!("all masses of T are 1; `masses = \"{name}\"` takes them from the property {name}"));
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
