//! Potentials as nodes of a graph: formulas, shipped problems, sums over pairs and over bodies.

use std::collections::HashMap;

use num_traits::One;
use shadowstep::Rational;
use shadowstep::systems::formula::{AXES, DISTANCE, MASSES, RelativeTo};
use shadowstep::systems::pairs::{Ends, Pair, Separation};
use shadowstep_schemes::symbolic::{Exact, Node, parse};

use super::SymbolicHamiltonian;
use crate::scene::{EnergyOfBodies, GRAVITY, InitialValueProblem, PairEnergy, PotentialEnergy};
use crate::texts::refusal::Refusal;

const READ: &str = "the formula was read with the scene";

impl SymbolicHamiltonian {
    /// A potential of the problem, whose T is known.
    pub(super) fn potential(
        &mut self,
        problem: &InitialValueProblem,
        potential: &PotentialEnergy,
        kinetic: Node,
    ) -> Result<Node, Refusal> {
        let no_formula = |what: &str| {
            let help = "write `potential` as a formula, or `modified_energy` for its values";
            Err(Refusal::new(format!("the modified Hamiltonian is derived from formulas, and {what}"), help))
        };
        match potential {
            PotentialEnergy::Formula(formula) => Ok(self.formula(formula.text())),
            PotentialEnergy::Shipped(setup) if setup.bodies().is_some() => {
                let (bodies, dimensions) = setup.bodies().expect("it is a system of bodies");
                let exact = |mass: &Rational| Exact { value: mass.clone(), rounded: false };
                let masses: Vec<_> = bodies.masses().iter().map(exact).collect();
                let ends = ends_of_pairs(bodies.count(), None);
                let gravity = (GRAVITY, Separation::SquaredDistance);
                Ok(self.sum_of_pairs(gravity, &[("m", &masses)], &ends, dimensions))
            }
            PotentialEnergy::Shipped(setup) => {
                let description = setup.problem.description();
                let whole = parse(description.hamiltonian)
                    .ok()
                    .and_then(|h| self.graph.build(&h, &self.coordinates, &self.parameters).ok());
                match whole {
                    Some(whole) => Ok(self.minus(whole, kinetic)),
                    None => no_formula(&format!("{} has none in its coordinates", description.name)),
                }
            }
            PotentialEnergy::Pairs(pairs) if pairs.cutoff.is_some() => no_formula("pairs with a cutoff have none"),
            PotentialEnergy::Pairs(pairs) => {
                let mut sum = vec![(self.pairs(pairs), Rational::one())];
                for energy in &pairs.of_bodies {
                    sum.push((self.energy_of_bodies(energy, pairs), Rational::one()));
                }
                Ok(self.graph.sum(&sum))
            }
            PotentialEnergy::Own(_) => no_formula("a function has none"),
            PotentialEnergy::OfParts => unreachable!("H of {} is the sum of its parts", problem.coordinates.join(", ")),
        }
    }

    /// The sum over pairs.
    fn pairs(&mut self, pairs: &PairEnergy) -> Node {
        let properties: Vec<_> = pairs.properties.iter().map(|(name, values)| (name.as_str(), &values[..])).collect();
        let separation = pairs.formula.meaning().separation();
        let ends = ends_of_pairs(pairs.bodies, pairs.ends);
        self.sum_of_pairs((pairs.formula.text(), separation), &properties, &ends, pairs.dimensions)
    }

    /// The sum over pairs of bodies with these properties, which are numbers in it.
    fn sum_of_pairs(
        &mut self,
        (formula, separation): (&str, Separation),
        properties: &[(&str, &[Exact])],
        ends: &[[Option<usize>; 2]],
        dimensions: usize,
    ) -> Node {
        let of = |body: char| properties.iter().map(move |(name, _)| format!("{name}_{body}"));
        let names: Vec<String> = of('i').chain(of('j')).collect();
        let expression = parse(formula).expect(READ);
        let of_pair = self.graph.build_pair(&expression, separation.name(), &names, &self.parameters).expect(READ);
        let mut terms = Vec::new();
        for ends in ends {
            let mut by = HashMap::from([(self.graph.coordinate(0), self.separation(dimensions, separation, *ends))]);
            let values = ends.iter().flat_map(|body| properties.iter().map(move |(_, of)| Some(&of[(*body)?])));
            for (property, value) in values.enumerate() {
                let value = value.expect("walls have no properties").value.clone();
                by.insert(self.graph.property(property), self.graph.number(value));
            }
            terms.extend(self.graph.replaced(&[of_pair], by).into_iter().map(|pair| (pair, Rational::one())));
        }
        self.graph.sum(&terms)
    }

    /// q_j − q_i or |q_j − q_i|²; where there is no body there is a wall at 0.
    fn separation(&mut self, dimensions: usize, separation: Separation, [i, j]: [Option<usize>; 2]) -> Node {
        let mut difference = |axis: usize| {
            let mut place = |body: Option<usize>, sign: Rational| {
                body.map(|body| (self.graph.coordinate(body * dimensions + axis), sign))
            };
            let terms = [place(j, Rational::one()), place(i, -Rational::one())];
            self.graph.sum(&terms.into_iter().flatten().collect::<Vec<_>>())
        };
        if separation == Separation::Difference {
            return difference(0);
        }
        let difference: Vec<_> = (0..dimensions).map(difference).collect();
        self.square(&difference)
    }

    /// |x|²
    pub(super) fn square(&mut self, x: &[Node]) -> Node {
        let two = Rational::from_integer(2.into());
        let squares: Vec<_> = x.iter().map(|x| (self.graph.power(*x, &two), Rational::one())).collect();
        self.graph.sum(&squares)
    }

    /// The sum over bodies of an energy of each.
    fn energy_of_bodies(&mut self, energy: &EnergyOfBodies, pairs: &PairEnergy) -> Node {
        let dimensions = pairs.dimensions;
        let masses = &pairs.properties[0].1;
        let mut coordinates: Vec<String> = AXES[..dimensions].iter().map(|name| (*name).to_owned()).collect();
        coordinates.push(DISTANCE.to_owned());
        let mut parameters = self.parameters.clone();
        parameters.extend(MASSES.map(str::to_owned));
        let of_body = self.graph.build(&parse(energy.text()).expect(READ), &coordinates, &parameters).expect(READ);
        let relative_to = energy.meaning().relative_to();
        let first = usize::from(relative_to == RelativeTo::FirstBody);
        let mut terms = Vec::new();
        for body in first..pairs.bodies {
            let place: Vec<Node> = (0..dimensions)
                .map(|axis| {
                    let own = self.graph.coordinate(body * dimensions + axis);
                    let centre = self.graph.coordinate(axis);
                    if first == 1 { self.minus(own, centre) } else { own }
                })
                .collect();
            let square = self.square(&place);
            let distance = self.graph.power(square, &Rational::new(1.into(), 2.into()));
            let mut by: HashMap<Node, Node> = HashMap::new();
            for (axis, node) in place.into_iter().chain([distance]).enumerate() {
                by.insert(self.graph.coordinate(axis), node);
            }
            for (index, mass) in (self.parameters.len()..).zip([&masses[body], &masses[0]]) {
                by.insert(self.graph.parameter(index), self.graph.number(mass.value.clone()));
            }
            terms.extend(self.graph.replaced(&[of_body], by).into_iter().map(|energy| (energy, Rational::one())));
        }
        self.graph.sum(&terms)
    }
}

/// The bodies of the pairs that interact; `None` is a wall.
fn ends_of_pairs(bodies: usize, ends: Option<Ends>) -> Vec<[Option<usize>; 2]> {
    let last = bodies - 1;
    let mut pairs: Vec<[Option<usize>; 2]> = match ends {
        None => (0..=last).flat_map(|i| (i + 1..=last).map(move |j| [Some(i), Some(j)])).collect(),
        Some(_) => (0..last).map(|i| [Some(i), Some(i + 1)]).collect(),
    };
    match ends {
        Some(Ends::Fixed) => pairs.extend([[None, Some(0)], [Some(last), None]]),
        Some(Ends::Periodic) => pairs.push([Some(last), Some(0)]),
        Some(Ends::Free) | None => {}
    }
    pairs
}
