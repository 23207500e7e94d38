//! The Kepler orbits of planets as nodes of a graph, in inertial positions and momenta.
//!
//! Brackets are the same in all canonical coordinates, and those of the steps are linear in the inertial ones.

use num_traits::{One, Zero};
use shadowstep::Rational;
use shadowstep_schemes::symbolic::Node;

use super::SymbolicHamiltonian;
use crate::scene::split::{CanonicalCoordinates, Planets};
use crate::texts::refusal::Refusal;

/// A = P₀²/2M + Σ (P_i²/2m_i′ − κ_i/|Q_i|)
pub(super) struct Orbits {
    pub(super) kinetic: Node,
    pub(super) potential: Node,
}

/// Of a planet: what Q and P are of the inertial positions and momenta, body after body, with m′ and κ/g.
struct OnOrbit {
    q: Vec<Rational>,
    p: Vec<Rational>,
    mass: Rational,
    attraction: Rational,
}

impl SymbolicHamiltonian {
    /// The orbits, with the parameter g.
    pub(super) fn orbits(&mut self, planets: &Planets) -> Result<Orbits, Refusal> {
        if planets.encounters.is_some() {
            return Err(Refusal::new(
                "the modified Hamiltonian is derived from formulas, and planets in close encounters have none",
                "remove `encounters`, or write `modified_energy` for its values",
            ));
        }
        let g = self.parameters.iter().position(|name| name == "g").expect("g is a parameter");
        let g = self.graph.parameter(g);
        let masses = planets.bodies.masses();
        let total: Rational = masses.iter().sum();
        let half = |mass: Rational| (mass * Rational::from_integer(2.into())).recip();
        let momentum = self.combined(&vec![Rational::one(); masses.len()], planets.dimensions, true);
        let mut kinetic = vec![(self.square(&momentum), half(total))];
        let mut potential = Vec::new();
        for planet in 1..masses.len() {
            let OnOrbit { q, p, mass, attraction } = match planets.coordinates {
                CanonicalCoordinates::Jacobi => jacobi(masses, planet),
                CanonicalCoordinates::DemocraticHeliocentric => heliocentric(masses, planet),
            };
            let momentum = self.combined(&p, planets.dimensions, true);
            kinetic.push((self.square(&momentum), half(mass)));
            let place = self.combined(&q, planets.dimensions, false);
            let square = self.square(&place);
            let inverse = self.graph.power(square, &Rational::new((-1).into(), 2.into()));
            potential.push((self.graph.times(g, inverse), -attraction));
        }
        Ok(Orbits { kinetic: self.graph.sum(&kinetic), potential: self.graph.sum(&potential) })
    }

    /// The vector Σ c_i q_i, or that of the momenta.
    fn combined(&mut self, coefficients: &[Rational], dimensions: usize, momenta: bool) -> Vec<Node> {
        let first = if momenta { self.coordinates.len() / 2 } else { 0 };
        let component = |axis: usize| {
            let bodies = coefficients.iter().enumerate().filter(|(_, c)| !c.is_zero());
            let terms: Vec<_> =
                bodies.map(|(body, c)| (self.graph.coordinate(first + body * dimensions + axis), c.clone())).collect();
            self.graph.sum(&terms)
        };
        (0..dimensions).map(component).collect()
    }
}

/// Q_i = q_i − Σ_{j<i} m_j q_j/η_{i−1}, P_i = (η_{i−1} p_i − m_i Σ_{j<i} p_j)/η_i, m_i′ = m_i η_{i−1}/η_i, κ_i = g m_i
/// η_{i−1}
fn jacobi(masses: &[Rational], i: usize) -> OnOrbit {
    let inner: Rational = masses[..i].iter().sum();
    let with = &inner + &masses[i];
    let of = |before: &dyn Fn(&Rational) -> Rational, own: Rational| {
        let rest = masses[i + 1..].iter().map(|_| Rational::zero());
        masses[..i].iter().map(before).chain([own]).chain(rest).collect()
    };
    OnOrbit {
        q: of(&|mass| -mass / &inner, Rational::one()),
        p: of(&|_| -&masses[i] / &with, &inner / &with),
        mass: &masses[i] * &inner / &with,
        attraction: &masses[i] * &inner,
    }
}

/// Q_i = q_i − q_0, P_i = p_i − (m_i/M) Σ p_j, κ_i = g m_0 m_i
fn heliocentric(masses: &[Rational], i: usize) -> OnOrbit {
    let total: Rational = masses.iter().sum();
    let own = |body: usize, value: Rational| if body == i { value + Rational::one() } else { value };
    let bodies = 0..masses.len();
    OnOrbit {
        q: bodies.clone().map(|body| own(body, if body == 0 { -Rational::one() } else { Rational::zero() })).collect(),
        p: bodies.map(|body| own(body, -&masses[i] / &total)).collect(),
        mass: masses[i].clone(),
        attraction: &masses[i] * &masses[0],
    }
}
