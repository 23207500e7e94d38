//! [[body]]: the bodies of a planetary system, by Cartesian states or orbital elements.

mod body;
mod particles;

pub(super) use body::GivenBody;

use std::collections::BTreeSet;
use std::ops::Range;

use num_traits::{One, Zero};
use shadowstep::Rational;
use shadowstep::systems::pairs::Separation;
use shadowstep::systems::wisdom_holman::Bodies;
use shadowstep_schemes::symbolic::Exact;
use toml::de::DeTable;

use super::elements::{InLimbs, Vector};
use super::given::Given;
use super::horizons::HorizonsVector;
use super::kinetic;
use super::names::check_name;
use super::of_bodies;
use super::parts::{self, Split};
use super::reader::Reader;
use super::units::{self, LengthAndTime};
use crate::document::keys::BODY;
use crate::document::schema::Table;
use crate::scene::{
    EnergyOfBodies, Formula, GRAVITY, InitialValueProblem, KineticEnergy, PairEnergy, PotentialEnergy, System,
};
use shadowstep_schemes::document::Text;

/// The most bodies: what is read of each takes some milliseconds.
const MOST_BODIES: usize = 1000;

/// What the elements of a planet are relative to.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Centre {
    /// The central body.
    Body,
    /// The centre of mass of the bodies before.
    Inner,
}

const CENTRES: [(&str, Centre); 2] = [("heliocentric", Centre::Body), ("jacobi", Centre::Inner)];

/// Reads all sections [[body]].
pub(super) fn given(reader: &mut Reader<'_>, root: &DeTable<'_>) -> Vec<GivenBody> {
    let Some(value) = root.get(BODY.name()) else { return Vec::new() };
    let tables = value.get_ref().as_array().map_or(std::slice::from_ref(value), |array| &array[..]);
    if tables.len() > MOST_BODIES {
        let message = format!("{} bodies are too many", tables.len());
        reader.toml.fault(&value.span(), message, format!("at most {MOST_BODIES} are read from elements"));
        return Vec::new();
    }
    let source = reader.toml.source;
    let body = |value| Some(GivenBody::read(reader, &Table::of_value(source, value, &BODY)?));
    tables.iter().filter_map(body).collect()
}

/// Bodies with their exact states so far.
struct Placing {
    g: Rational,
    /// Where they are known.
    units: Option<LengthAndTime>,
    dimensions: usize,
    centre: Centre,
    masses: Vec<Rational>,
    /// Positions and velocities.
    states: Vec<[Vec<Rational>; 2]>,
    /// For orbits of particles, of which there may be very many.
    in_limbs: Option<InLimbs>,
}

/// The system of the bodies.
pub(super) fn system(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    bodies: &[GivenBody],
    split: Split,
) -> Option<System> {
    let mut parameters = given.own_parameters(reader);
    let constant = constant(reader, &given.problem, &parameters);
    let mut particles = match given.problem.text("particles") {
        Some(_) if reader.is_cursory => return None,
        Some(file) => particles::of_file(reader, &file)?,
        None => Vec::new(),
    };
    if bodies.iter().all(|body| body.name.is_some()) {
        name_all(&mut particles);
    }
    let bodies: Vec<&GivenBody> = bodies.iter().chain(&particles).collect();
    let bodies = &bodies[..];
    let (g, units) = constant?;
    let centre = given.problem.word("elements", &CENTRES).unwrap_or(Centre::Body);
    let dimensions = bodies.iter().find_map(|body| body.q.as_ref()).map_or(3, |q| q.value.len());
    let masses = masses(reader, bodies)?;
    if masses.iter().filter(|mass| !mass.is_zero()).count() < 2 {
        let at = bodies.first().map_or(&given.problem.at, |body| &body.at);
        let message = "a planetary system has a central body and at least one planet with mass";
        return reader.toml.wrong(at, message, "add [[body]]");
    }
    let in_limbs = InLimbs::with_digits(reader.arithmetic.value_digits());
    let mut placing = Placing { g: g.clone(), units, dimensions, centre, masses, states: Vec::new(), in_limbs };
    let before = reader.toml.faults.len();
    agree(reader, bodies);
    for (index, body) in bodies.iter().enumerate() {
        let known = reader.toml.faults.len();
        let state = placing.state(reader, index, body).unwrap_or_else(|| placing.origin());
        body.name_line(&mut reader.toml.faults[known..]);
        if body.line.is_some() && reader.toml.faults.len() > known {
            // the other lines of a file may have the same fault
            return None;
        }
        placing.states.push(state);
    }
    let names = names(reader, bodies);
    if reader.toml.faults.len() > before {
        return None;
    }
    placing.refuse_one_place(reader, bodies)?;
    if given.problem.truth("barycentric") == Some(true) {
        placing.move_to_barycentre();
    }
    if !parameters.iter().any(|(name, _)| name == "g") {
        parameters.push(("g".to_owned(), Exact { value: g, rounded: false }));
    }
    if has_names_of_energy(reader, given) {
        return None;
    }
    let counts = (bodies.len(), bodies.len() - placing.massive(), dimensions);
    let of_bodies = of_bodies::energies(reader, given, counts, &parameters)?;
    placing.refuse_forces_on_particles(reader, given, &of_bodies, &parameters)?;
    let (problem, bodies) = placing.into_system(reader, (parameters, of_bodies), &names, &given.problem.at)?;
    parts::split(reader, given, problem, split, Some((bodies, dimensions)))
}

/// Refuses tables of Horizons of different centres, frames or epochs, and a central body without a state that is not
/// their centre.
fn agree(reader: &mut Reader<'_>, bodies: &[&GivenBody]) {
    let tables = || {
        bodies.iter().filter_map(|body| body.horizons.as_ref()).filter_map(|(at, table)| Some((at, table.as_ref()?)))
    };
    let Some((at, first)) = tables().next() else { return };
    if let Some(central) = bodies.first().filter(|body| !body.has_state()) {
        let name = central.name.as_ref().map(|name| name.value.as_str());
        if let Some(centre) = first.other_centre(name) {
            let message = format!("the states are relative to {centre}, where the first body would be");
            let help = "give the first body a table of its own with this centre, or ask Horizons for tables whose \
                centre is that body, CENTER='500@10' for the Sun; one of another centre has its name: name = \"earth\"";
            reader.toml.fault(at, message, help);
        }
    }
    for (at, table) in tables().skip(1) {
        if let Some(message) = table.differs(first) {
            reader.toml.fault(at, message, "ask Horizons for tables with one centre, frame and time");
        }
    }
}

/// Refuses parameters that have a name of the bodies' energy; whether there are any.
fn has_names_of_energy(reader: &mut Reader<'_>, given: &Given<'_, '_>) -> bool {
    let before = reader.toml.faults.len();
    for (name, _) in given.parameters.iter().filter(|(name, _)| ["r2", "m_i", "m_j"].contains(&name.value.as_str())) {
        let message = format!("with [[body]], `{}` is a name in {GRAVITY}, the energy of two bodies", name.value);
        reader.toml.fault(&name.at, message, "give it another name");
    }
    reader.toml.faults.len() > before
}

/// The gravitational constant from `units`, with these, or from a parameter g.
fn constant(
    reader: &mut Reader<'_>,
    problem: &Table<'_, '_>,
    parameters: &[(String, Exact)],
) -> Option<(Rational, Option<LengthAndTime>)> {
    let parameter = parameters.iter().find(|(name, _)| name == "g").map(|(_, value)| value.value.clone());
    match (problem.table("units"), parameter) {
        (Some(units), None) => units::constant(&units).map(|(constant, units)| (constant, Some(units))),
        (None, Some(g)) => Some((g, None)),
        (Some(units), Some(_)) => {
            let help = "remove `units`, or the parameter g";
            reader.toml.wrong(&units.at, "g is given by the units and by a parameter", help)
        }
        (None, None) => {
            let help = "add units = { length = \"AU\", time = \"day\", mass = \"solar\" }, or parameters = { g = 1 }";
            reader.toml.wrong(&problem.at, "the gravitational constant is missing", help)
        }
    }
}

fn masses(reader: &mut Reader<'_>, bodies: &[&GivenBody]) -> Option<Vec<Rational>> {
    let mut masses = Vec::new();
    // the last body of mass 0 with its place
    let mut particle = None;
    for (index, body) in bodies.iter().enumerate() {
        let text = body.mass.as_ref();
        masses.push(text.and_then(|text| {
            let value = reader.evaluate(text)?;
            if value.value.is_zero() && index > 0 {
                particle = Some(&text.at);
                return Some(value.value);
            }
            if let Some(at) = particle.take() {
                let help = "bodies of mass 0 come last: put them after all bodies with mass";
                return reader.toml.wrong(at, "a body of mass 0 is before a body with mass", help);
            }
            kinetic::check_mass(reader, &value, &text.at).map(|()| value.value)
        }));
    }
    masses.into_iter().collect()
}

/// Names particle1, particle2, … for particles without names.
fn name_all(particles: &mut [GivenBody]) {
    for (index, particle) in particles.iter_mut().enumerate() {
        particle.name.get_or_insert_with(|| Text::at(&format!("particle{}", index + 1), particle.at.clone()));
    }
}

/// The names of the bodies, or their numbers if one has no name.
fn names(reader: &mut Reader<'_>, bodies: &[&GivenBody]) -> Vec<String> {
    let (mut names, mut known): (Vec<String>, _) = (Vec::new(), BTreeSet::new());
    for body in bodies {
        let Some(name) = &body.name else { return (1..=bodies.len()).map(|body| body.to_string()).collect() };
        let before = reader.toml.faults.len();
        check_name(reader, name);
        body.name_line(&mut reader.toml.faults[before..]);
        if !known.insert(&name.value) {
            let message = format!("the body `{}` is named twice", name.value);
            reader.toml.fault(&name.at, message, "give it another name");
        }
        names.push(name.value.clone());
    }
    names.into_iter().map(|name| format!("_{name}")).collect()
}

impl Placing {
    /// Refuses two bodies with mass at one place, whose energy is infinite.
    fn refuse_one_place(&self, reader: &mut Reader<'_>, bodies: &[&GivenBody]) -> Option<()> {
        // a state that cannot be read is the origin
        let states = if reader.toml.faults.is_empty() { &self.states[..self.massive()] } else { &[] };
        for (j, [place, _]) in states.iter().enumerate() {
            if let Some(i) = states[..j].iter().position(|[other, _]| other == place) {
                let other = bodies[i]
                    .name
                    .as_ref()
                    .map_or_else(|| format!("body {}", i + 1), |name| format!("`{}`", name.value));
                return reader.toml.wrong(
                    &bodies[j].at,
                    format!("this body is at the place of {other}"),
                    "give it another place",
                );
            }
        }
        Some(())
    }

    /// How many bodies have a mass: those before the others.
    fn massive(&self) -> usize {
        self.masses.iter().take_while(|mass| !mass.is_zero()).count()
    }

    fn origin(&self) -> [Vec<Rational>; 2] {
        [(); 2].map(|()| vec![Rational::zero(); self.dimensions])
    }

    /// Position and velocity of a body.
    fn state(&mut self, reader: &mut Reader<'_>, index: usize, body: &GivenBody) -> Option<[Vec<Rational>; 2]> {
        if let Some((at, table)) = &body.horizons {
            return self.of_horizons(reader, (at, table.as_ref()));
        }
        match (&body.q, &body.v) {
            (Some(q), Some(v)) => {
                let mut values = |list| {
                    let values = reader.values(list, self.dimensions, "dimension")?;
                    Some(values.into_iter().map(|exact| exact.value).collect::<Vec<_>>())
                };
                let (q, v) = (values(q), values(v));
                Some([q?, v?])
            }
            _ if index == 0 => match body.is_by_elements() {
                false => Some(self.origin()),
                true => {
                    let help = "give it q and v, or nothing for a body at the origin";
                    reader.toml.wrong(&body.at, "the first body is the central one and has no orbit", help)
                }
            },
            _ => self.on_orbit(reader, index, body),
        }
    }

    /// The state of a table of Horizons.
    fn of_horizons(
        &self,
        reader: &mut Reader<'_>,
        (at, table): (&Range<usize>, Option<&HorizonsVector>),
    ) -> Option<[Vec<Rational>; 2]> {
        if self.dimensions != 3 {
            let help = "give the other bodies positions in three dimensions";
            return reader.toml.wrong(at, "a table of Horizons has three dimensions", help);
        }
        let units = self.units.as_ref()?;
        table.map(|table| table.in_units(units))
    }

    /// The state of a planet on its orbit.
    fn on_orbit(&mut self, reader: &mut Reader<'_>, index: usize, body: &GivenBody) -> Option<[Vec<Rational>; 2]> {
        let elements = body.elements(reader)?;
        let inner = match self.centre {
            Centre::Body => 1,
            Centre::Inner => index.min(self.massive()),
        };
        let attracting: Rational = self.masses[..inner].iter().sum();
        let mu = &self.g * (&attracting + &self.masses[index]);
        let digits = reader.arithmetic.value_digits();
        let in_limbs = self.in_limbs.as_mut().filter(|_| self.masses[index].is_zero());
        let known = in_limbs.and_then(|formulas| elements.state_by(&mu, digits, formulas).ok());
        let relative = match known.map_or_else(|| elements.state(&mu, digits), Ok) {
            Ok(relative) => relative,
            Err(error) => return reader.toml.wrong(&body.at, error.to_string(), "choose other elements"),
        };
        if self.dimensions < 3 && relative.iter().any(|vector: &Vector| !vector[2].is_zero()) {
            let help = "give the other bodies positions in three dimensions";
            return reader.toml.wrong(&body.at, "this orbit is not in the plane of the other bodies", help);
        }
        let mut state = self.mean(inner, &attracting);
        for (sum, part) in state.iter_mut().zip(&relative) {
            sum.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
        }
        Some(state)
    }

    /// The centre of mass of the first bodies, whose mass is given, and its velocity.
    fn mean(&self, bodies: usize, mass: &Rational) -> [Vec<Rational>; 2] {
        let mut mean = self.origin();
        for (state, own) in self.states[..bodies].iter().zip(&self.masses) {
            for (sum, part) in mean.iter_mut().zip(state) {
                sum.iter_mut().zip(part).for_each(|(sum, part)| *sum += part * own / mass);
            }
        }
        mean
    }

    fn move_to_barycentre(&mut self) {
        let mean = self.mean(self.massive(), &self.masses.iter().sum());
        for state in &mut self.states {
            for (own, by) in state.iter_mut().zip(&mean) {
                own.iter_mut().zip(by).for_each(|(own, by)| *own -= by);
            }
        }
    }

    /// Refuses energies that are not proportional to the mass, where there is a particle: the limit of force by mass is
    /// not that of a unit mass then.
    fn refuse_forces_on_particles(
        &self,
        reader: &mut Reader<'_>,
        given: &Given<'_, '_>,
        energies: &[EnergyOfBodies],
        parameters: &[(String, Exact)],
    ) -> Option<()> {
        let Some([q, _]) = self.states.get(self.massive()) else { return Some(()) };
        let double = |value: &Rational| <f64 as shadowstep::Number>::from_rational(value, &());
        let (place, central) = (q.iter().map(double).collect::<Vec<_>>(), double(&self.masses[0]));
        let Some(wrong) = energies.iter().find(|energy| !energy.is_proportional_to_mass(&place, central, parameters))
        else {
            return Some(());
        };
        let message = format!("with bodies of mass 0, `{}` must be proportional to m", wrong.key());
        reader.toml.wrong(
            &given.problem.place(wrong.key()),
            message,
            "write the energy of a mass m as m times a formula without m",
        )
    }

    fn into_system(
        self,
        reader: &mut Reader<'_>,
        (parameters, of_bodies): (Vec<(String, Exact)>, Vec<EnergyOfBodies>),
        names: &[String],
        at: &Range<usize>,
    ) -> Option<(InitialValueProblem, Bodies)> {
        let Placing { g, dimensions, masses, states, .. } = self;
        let exact = |value: Rational| Exact { value, rounded: true };
        let bodies = match Bodies::new(g, masses.clone()) {
            Ok(bodies) => bodies,
            Err(error) => return reader.toml.wrong(at, error.to_string(), "use positive masses and units"),
        };
        let axes = [("x", "px"), ("y", "py"), ("z", "pz")];
        let (coordinates, momenta) = names
            .iter()
            .flat_map(|name| axes[..dimensions].iter().map(move |(q, p)| (format!("{q}{name}"), format!("{p}{name}"))))
            .unzip();
        // a momentum is v, if it is divided by a mass that is 0
        let one = Rational::one();
        let of_momenta = || masses.iter().map(|mass| if mass.is_zero() { &one } else { mass });
        let p = states.iter().zip(of_momenta()).flat_map(|([_, v], mass)| v.iter().map(move |v| exact(v * mass)));
        let of_coordinates: Vec<_> = of_momenta().flat_map(|mass| vec![exact(mass.clone()); dimensions]).collect();
        let unit = of_coordinates.iter().all(|mass| mass.value.is_one());
        let properties = vec![("m".to_owned(), masses.iter().cloned().map(exact).collect())];
        let formula = match Formula::pair(GRAVITY, Separation::SquaredDistance, &properties, &parameters) {
            Ok(formula) => formula,
            Err(error) => return reader.toml.wrong(at, error.to_string(), "give the parameters other names"),
        };
        let (count, particles) = (bodies.count(), bodies.particles());
        let pairs = PairEnergy {
            formula,
            dimensions,
            bodies: count,
            particles,
            properties,
            ends: None,
            cutoff: None,
            of_bodies,
        };
        let problem = InitialValueProblem {
            p: p.collect(),
            q: states.iter().flat_map(|[q, _]| q.iter().cloned().map(exact)).collect(),
            potential: PotentialEnergy::Pairs(pairs),
            kinetic: KineticEnergy::Masses((!unit).then_some(of_coordinates)),
            parameters,
            coordinates,
            momenta,
            explicit_time: false,
        };
        Some((problem, bodies))
    }
}

#[cfg(test)]
mod tests {
    use crate::watch::observer::testing::{read, rows};

    /// Two planets, the second by elements, with these lines in [problem].
    fn scene(problem: &str, second: &str) -> String {
        format!(
            "[problem]\n{problem}\n[[body]]\nmass = 1\n[[body]]\nmass = 0.1\nq = [2, 0]\nv = [0, 1]\n[[body]]\nmass = \
                0.01\n{second}\n\
             [run]\nscheme = \"abah864\"\nstep = 1\nsteps = 9\ndigits = \"double\"\n[output]\nenergy = true"
        )
    }

    const G: &str = "parts = \"wisdom-holman\"\nparameters = { g = 1 }";

    #[test]
    fn elements_are_relative_to_the_central_body_or_to_the_inner_ones() {
        let position = |problem: &str| {
            let scene = read(&scene(&format!("{G}\n{problem}"), "a = 4\nM = 0"));
            let numbers =
                scene.system.q.iter().map(|exact| <f64 as shadowstep::Number>::from_rational(&exact.value, &()));
            numbers.collect::<Vec<_>>()
        };
        assert_eq!(position(""), [0.0, 0.0, 2.0, 0.0, 4.0, 0.0]);
        let centre = 0.2 / 1.1;
        assert!((position("elements = \"jacobi\"")[4] - 4.0 - centre).abs() < 1e-15);
        let centred = position("barycentric = true");
        assert!((centred[0] + (0.2 + 0.04) / 1.11).abs() < 1e-15 && (centred[4] - centred[0] - 4.0).abs() < 1e-15);
    }

    #[test]
    fn the_constant_follows_from_the_units() {
        let units = "units = { length = \"AU\", time = \"day\", mass = \"solar\" }";
        let scene = read(&scene(&format!("parts = \"wisdom-holman\"\n{units}"), "a = 4"));
        let (name, g) = &scene.system.parameters[0];
        // Gauss's constant squared, known to 1e-9 of it since the masses are nominal
        let squared = 0.01720209895_f64.powi(2);
        let g = <f64 as shadowstep::Number>::from_rational(&g.value, &());
        assert!(name == "g" && (g / squared - 1.0).abs() < 1e-9 && g != squared, "{g:e}");
    }

    #[test]
    fn gradient_kicks_are_exact_or_by_displaced_forces() {
        let text = scene("parts = \"wisdom-holman\"\nparameters = { g = 1 }", "a = 4").replace("abah864", "chin-4a");
        let displaced = text.replace("[run]", "[run]\ngradient_kicks = \"displaced\"");
        let [exact, displaced] = [&text, &displaced].map(|text| read(text));
        assert_ne!(rows(&exact), rows(&displaced));
        let heads = [exact, displaced].map(|scene| scene.metadata()["gradient_kicks"].clone());
        assert_eq!(heads, [serde_json::Value::Null, "displaced".into()]);
    }
}
