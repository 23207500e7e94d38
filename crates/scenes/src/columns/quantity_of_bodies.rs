//! Quantities of bodies in the numbers of a run: the kinetic energy and the virial of all, those by a formula, and the
//! elements of osculating Kepler orbits.

mod by_formula;
mod orbit;
mod sums;

use std::ops::Range;

use num_traits::Zero;
use shadowstep::systems::formula::FormulaValue;
use shadowstep::{Rational, Real};

use self::orbit::Orbit;
use crate::document::quantity::{Compute, ELEMENTS, Element, Function, KINETIC, Quantity, VIRIAL};
use crate::scene::bodies::Bodies;
use crate::scene::{GRAVITY, PotentialEnergy, SceneNumber, System};
use crate::texts::refusal::{Refusal, refuse};

/// The centre of mass of the bodies before, and of all bodies.
pub(crate) const JACOBI: &str = "jacobi";
pub(crate) const BARYCENTRE: &str = "barycentre";

/// The elements of every body about a centre, as names of columns with formulas: those of the first body about the
/// barycentre only, and those of a plane without `i` and `node`; none without bodies.
pub(crate) fn elements_of(system: &System, centre: Option<&str>) -> Vec<(String, String)> {
    let Some(bodies) = Bodies::of(system) else { return Vec::new() };
    // the name of the first body, unless it could be another centre
    let of_first = bodies.names.first().map(String::as_str).filter(|name| ![JACOBI, BARYCENTRE].contains(name));
    let about = centre.or(of_first).map_or(String::new(), |centre| format!(", {centre}"));
    let elements = ELEMENTS.iter().filter(|(_, element)| match element {
        Element::Inclination | Element::Node => bodies.dimensions == 3,
        Element::MeanLongitude => false,
        _ => true,
    });
    let first = usize::from(centre != Some(BARYCENTRE));
    let named = |body: &String| {
        let joint = if body.parse::<usize>().is_ok() { "" } else { "_" };
        let of = |(name, _): &(&str, Element)| (format!("{name}{joint}{body}"), format!("{name}({body}{about})"));
        elements.clone().map(of).collect::<Vec<_>>()
    };
    bodies.names.iter().skip(first).flat_map(named).collect()
}

/// A quantity of bodies by their numbers.
#[derive(Clone, Debug)]
pub(crate) enum QuantityOfBodies {
    /// T(p)
    Kinetic,
    /// −qᵀU_q
    Virial,
    /// A formula in the coordinates and momenta.
    Formula(String),
    Element(Box<ElementOfBody>),
}

/// An element of a body's osculating orbit about a centre of mass.
#[derive(Clone, Debug)]
pub(crate) struct ElementOfBody {
    element: Element,
    body: Range<usize>,
    /// The body's mass, by which momenta are divided: 1 of a body of mass 0.
    mass: Rational,
    /// The coordinates of the bodies of the centre, with their masses as parts of its mass.
    centre: Vec<(Range<usize>, Rational)>,
    /// The mass of the centre.
    centre_mass: Rational,
    /// G times the mass of the two; of the barycentre of all, of that alone.
    parameter: Rational,
}

impl ElementOfBody {
    /// Of a body about the first one, or about another centre.
    fn of(system: &System, bodies: &Bodies, element: Element, arguments: &[String]) -> Result<Self, Refusal> {
        let (name, centre) = match arguments {
            [name] => (name, None),
            [name, centre] => (name, Some(centre)),
            _ => {
                return refuse(
                    "an element is one of a body, about the first body or another centre",
                    "write a(earth), a(moon, earth), a(earth, jacobi) or a(earth, barycentre)",
                );
            }
        };
        let number = bodies.number(name)?;
        let centre: Vec<usize> = match centre.map(String::as_str) {
            None => vec![0],
            Some(word @ (JACOBI | BARYCENTRE)) if bodies.names.iter().any(|own| own == word) => {
                let message = format!("`{word}` could be the body or the centre of mass of this name here");
                return refuse(message, "give the body another name");
            }
            Some(JACOBI) => (0..number).collect(),
            Some(BARYCENTRE) => (0..bodies.names.len()).collect(),
            Some(other) => vec![bodies.number(other)?],
        };
        ElementOfBody::new(system, bodies, (element, number), &centre)
    }

    fn new(
        system: &System,
        bodies: &Bodies,
        (element, body): (Element, usize),
        centre: &[usize],
    ) -> Result<Self, Refusal> {
        let g = gravitational_constant(system).filter(|_| bodies.dimensions > 1);
        let Some(g) = g else {
            return refuse(
                "elements are of bodies that attract each other by Newton's law",
                "give the bodies in sections [[body]]",
            );
        };
        if centre == [body] || centre.is_empty() {
            let hint = "name a planet, or another centre: a(moon, earth), a(sun, barycentre)";
            return refuse(format!("`{}` has no orbit about itself", bodies.names[body]), hint);
        }
        let mut masses: Vec<Rational> = system.exact_masses().into_iter().step_by(bodies.dimensions).collect();
        let own_mass = masses[body].clone();
        let massive = masses.len() - system.particles();
        masses[massive..].iter_mut().for_each(Zero::set_zero);
        if let Some(particle) = centre.iter().find(|own| centre.len() == 1 && **own >= massive) {
            let message = format!("`{}` has mass 0, and nothing moves about it", bodies.names[*particle]);
            return refuse(&message, "name a body with mass");
        }
        let centre: Vec<usize> = centre.iter().copied().filter(|own| *own < massive).collect();
        let centre_mass: Rational = centre.iter().map(|own| &masses[*own]).sum();
        let both = if centre.contains(&body) { centre_mass.clone() } else { &centre_mass + &masses[body] };
        let part = |own: &usize| (bodies.coordinates(*own), &masses[*own] / &centre_mass);
        Ok(ElementOfBody {
            element,
            body: bodies.coordinates(body),
            mass: own_mass,
            centre: centre.iter().map(part).collect(),
            parameter: g * both,
            centre_mass,
        })
    }
}

/// G of bodies whose energy is −G m_i m_j/r.
fn gravitational_constant(system: &System) -> Option<Rational> {
    let is_gravity = match &system.potential {
        PotentialEnergy::Pairs(pairs) => pairs.formula.text() == GRAVITY,
        PotentialEnergy::Shipped(_) => true,
        _ => false,
    };
    let g = system.parameters.iter().find(|(name, _)| name == "g").filter(|_| is_gravity);
    g.map(|(_, g)| g.value.clone())
}

impl QuantityOfBodies {
    /// The names of the sums that a system has.
    pub(crate) fn sums(system: &System) -> impl Iterator<Item = &'static str> {
        [KINETIC, VIRIAL].into_iter().filter(|name| sums::check(name, system).is_ok())
    }

    /// Of the bodies of a system.
    pub(crate) fn new(quantity: &Quantity, system: &System) -> Result<QuantityOfBodies, Refusal> {
        let bodies = || {
            Bodies::of(system).filter(|bodies| bodies.names.len() > 1).ok_or_else(|| {
                Refusal::new("this system has no bodies", "write a formula in its coordinates and momenta")
            })
        };
        Ok(match quantity.function {
            Function::Kinetic => sums::check(KINETIC, system).map(|()| QuantityOfBodies::Kinetic)?,
            Function::Virial => sums::check(VIRIAL, system).map(|()| QuantityOfBodies::Virial)?,
            Function::OfBodies(name) => {
                QuantityOfBodies::Formula(by_formula::of(name, &quantity.arguments, (system, &bodies()?))?)
            }
            Function::Element(element) => {
                let (bodies, arguments) = (bodies()?, &quantity.arguments);
                QuantityOfBodies::Element(Box::new(ElementOfBody::of(system, &bodies, element, arguments)?))
            }
        })
    }

    /// Of this system, in the numbers of a run.
    pub(crate) fn in_numbers<N: Real + SceneNumber>(&self, system: &System, context: &N::Context) -> Compute<N> {
        match self {
            QuantityOfBodies::Kinetic => sums::kinetic(system, context),
            QuantityOfBodies::Virial => sums::virial(system, context),
            QuantityOfBodies::Formula(formula) => {
                let names = system.coordinates.iter().chain(&system.momenta).map(String::as_str);
                let mut formula = FormulaValue::new(formula, &names.collect::<Vec<_>>(), &[], context)
                    .expect("it is made of names of the system");
                Box::new(move |q, p| formula.at(&[q, p].concat()).clone())
            }
            QuantityOfBodies::Element(of) => of.in_numbers(context),
        }
    }
}

impl ElementOfBody {
    fn in_numbers<N: Real + 'static>(&self, context: &N::Context) -> Compute<N> {
        let number = |value: &Rational| N::from_rational(value, context);
        let (element, body) = (self.element, self.body.clone());
        let (mass, centre_mass, parameter) = (number(&self.mass), number(&self.centre_mass), number(&self.parameter));
        let centre: Vec<_> = self.centre.iter().map(|(own, part)| (own.clone(), number(part))).collect();
        let zero = number(&Rational::zero());
        Box::new(move |q, p| {
            let mut position = [(); 3].map(|()| zero.clone());
            let mut velocity = position.clone();
            for (axis, index) in body.clone().enumerate() {
                // Σ m_i v_i/M = Σ p_i/M
                for (own, part) in &centre {
                    position[axis].subtract_product(&q[own.start + axis], part);
                    velocity[axis].subtract(&p[own.start + axis]);
                }
                velocity[axis].divide(&centre_mass);
                position[axis].add(&q[index]);
                let mut own = p[index].clone();
                own.divide(&mass);
                velocity[axis].add(&own);
            }
            Orbit { position, velocity, parameter: parameter.clone() }.element(element)
        })
    }
}

#[cfg(test)]
mod tests {
    use shadowstep::Number;
    use shadowstep_schemes::symbolic::decimal::from_text;

    use crate::watch::observer::testing::{read, rows};

    /// The names of columns and the cells of a row.
    fn row(problem: &str, output: &str, n: usize) -> Vec<(String, String)> {
        let run = "[run]\nscheme = \"abah864\"\nstep = \"1/10\"\nsteps = 4\ndigits = 40\n[output]";
        let rows = rows(&read(&format!("{problem}\n{run}\n{output}")));
        rows[0].iter().cloned().zip(rows[n + 1].iter().cloned()).collect()
    }

    const ORBITS: [[&str; 6]; 5] = [
        ["1", "0.0167", "7", "30", "100", "350"],
        ["5.2", "0.3", "170", "200", "300", "10"],
        ["-30", "1.5", "90", "45", "10", "-40"],
        ["2", "0.999", "0.001", "359", "0.5", "180"],
        ["9", "1e-6", "179", "1", "181", "0.25"],
    ];

    fn bodies(parts: &str, elements: &str) -> String {
        let body = |[a, e, i, node, pericentre, anomaly]: &[&str; 6]| {
            format!(
                "[[body]]\nmass = 0.001\na = {a}\ne = {e}\ni = {i}\nnode = {node}\npericentre = {pericentre}\nM = \
                    {anomaly}\n"
            )
        };
        let planets: String = ORBITS.iter().map(body).collect();
        format!("[problem]\nparameters = {{ g = 2 }}\n{elements}\n{parts}\n[[body]]\nmass = 3\n{planets}")
    }

    /// The elements at t = 0 are those of the text, which became positions and velocities by other formulas.
    #[test]
    fn elements_are_those_that_the_bodies_are_given_by() {
        let parts = ["", "parts = \"wisdom-holman\"", "parts = \"wisdom-holman-heliocentric\""];
        for (parts, centre) in parts.into_iter().flat_map(|parts| ["heliocentric", "jacobi"].map(|c| (parts, c))) {
            let output = format!("elements = {{ centre = \"{centre}\" }}");
            let row = row(&bodies(parts, &format!("elements = \"{centre}\"")), &output, 0);
            assert_eq!(row.len(), 2 + 6 * ORBITS.len());
            let expected = ORBITS.iter().enumerate().flat_map(|(body, elements)| {
                let names = ["a", "e", "i", "node", "pericentre", "M"].map(|name| format!("{name}{}", body + 2));
                names.into_iter().zip(*elements)
            });
            for ((name, cell), (expected_name, expected)) in row[2..].iter().zip(expected) {
                let error = from_text(cell).unwrap() - from_text(expected).unwrap();
                assert_eq!(*name, expected_name);
                // angles of an eccentricity of 1e-6 have 6 digits less than the numbers of 40
                assert!(
                    f64::from_rational(&error, &()).abs() < 1e-30,
                    "{name}: {cell} for {expected} ({parts}, {centre})"
                );
            }
        }
    }

    #[test]
    fn longitudes_and_the_barycentre_are_those_of_their_formulas() {
        let values = "values = { l = \"lambda(5) - node(5) - pericentre(5) - M(5)\", o = \"a(1, barycentre)\", d \
            = \"distance(1, 2)\" }\ntrajectory = true";
        let row = row(&bodies("parts = \"wisdom-holman\"", ""), values, 1);
        let value = |name: &str| {
            let cell = &row.iter().find(|(found, _)| found == name).unwrap().1;
            f64::from_rational(&from_text(cell).unwrap(), &())
        };
        let turns = value("l") / 360.0;
        assert!((turns - turns.round()).abs() < 1e-30, "{turns}");
        let masses = [3.0, 0.001, 0.001, 0.001, 0.001, 0.001];
        let mean = |of: &dyn Fn(usize) -> f64| (0..6).map(of).sum::<f64>() / 3.005;
        let square =
            |component: &dyn Fn(&str) -> f64| ["x", "y", "z"].map(|axis| component(axis).powi(2)).iter().sum::<f64>();
        let r = square(&|axis| value(&format!("{axis}1")) - mean(&|b| masses[b] * value(&format!("{axis}{}", b + 1))));
        let v = square(&|axis| value(&format!("p{axis}1")) / 3.0 - mean(&|b| value(&format!("p{axis}{}", b + 1))));
        let expected = 1.0 / (2.0 / r.sqrt() - v / (2.0 * 3.005));
        assert!((value("o") / expected - 1.0).abs() < 1e-9, "{} for {expected}", value("o"));
        let d = square(&|axis| value(&format!("{axis}1")) - value(&format!("{axis}2"))).sqrt();
        assert!((value("d") / d - 1.0).abs() < 1e-15);
    }
}
