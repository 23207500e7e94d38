//! Energies of each body from a formula read at run time, beside those of pairs.

use std::sync::Arc;

use shadowstep_schemes::symbolic::Rational;

use super::newest::Role;
use super::{FormulaError, FormulaPotential, derive};
use crate::number::Number;
use crate::systems::potential::{HessianProduct, Potential};

/// The names of the coordinates in formulas.
pub const AXES: [&str; 3] = ["x", "y", "z"];
/// The name of the distance.
pub const DISTANCE: &str = "r";
/// The names of the masses: of the body, of the first body.
pub const MASSES: [&str; 2] = ["m", "m0"];

/// What the positions in a formula of bodies are relative to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RelativeTo {
    /// The first body, which has no energy of its own: relativity, an oblate central body.
    FirstBody,
    /// The origin of an inertial frame: tides.
    Origin,
}

/// The sum over bodies of an energy of each, from a formula in its position x, y, z, the distance r = √(x² + y² + z²),
/// its mass m, the mass m0 of the first body, and parameters. The potential has the inertial positions, body after
/// body.
///
/// ```
/// use shadowstep::systems::formula::{FormulaOfBodies, RelativeTo};
/// use shadowstep::systems::wisdom_holman::{Bodies, Jacobi, WisdomHolman};
/// use shadowstep::{System, exact};
///
/// // the potential that turns the pericentre as general relativity does
/// let formula = "-3*(g*m0)^2*m/(c^2*r^2)";
/// let relativity =
///     FormulaOfBodies::<f64>::new(formula, RelativeTo::FirstBody, 2, &[1.0, 0.5], &[("g", 1.0), ("c", 8.0)])?;
/// let bodies = Bodies::new(exact("1")?, vec![exact("1")?, exact("1/2")?])?;
/// let state = (&[0.0, 0.0, 2.0, 0.0][..], &[0.0; 4][..]);
/// let mut planets = WisdomHolman::<_, Jacobi<_, 2>, 2>::new(&bodies, state, &())?.beside(Some(relativity))?;
/// assert_eq!(planets.energy(), -0.5 / 2.0 - 3.0 * 0.5 / 64.0 / 4.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct FormulaOfBodies<N> {
    relative_to: RelativeTo,
    dimensions: usize,
    bodies: usize,
    /// How many of them are of mass 0: the last ones.
    particles: usize,
    /// Of each body, or of each but the first.
    formulas: Vec<FormulaPotential<N>>,
}

impl<N: Number> FormulaOfBodies<N> {
    /// The energies of bodies with these masses, in 1 to 3 dimensions, with the values of parameters.
    ///
    /// # Errors
    /// A text that is not a valid formula, unknown or repeated names, functions that are not smooth.
    ///
    /// # Panics
    /// Of more than 3 dimensions, or no bodies.
    pub fn new(
        formula: &str,
        relative_to: RelativeTo,
        dimensions: usize,
        masses: &[N],
        parameters: &[(&str, N)],
    ) -> Result<Self, FormulaError> {
        let variables = [&AXES[..dimensions], &[DISTANCE]].concat();
        let with = |mass: &N| {
            let masses = MASSES.into_iter().zip([mass.clone(), masses[0].clone()]);
            parameters.iter().cloned().chain(masses).collect::<Vec<_>>()
        };
        let derived = derive(Role::Body, formula, &variables, &with(&masses[0]))?;
        let of = |mass: &N| {
            let values = with(mass).into_iter().map(|(_, value)| value).collect();
            FormulaPotential::of(Arc::clone(&derived), dimensions, values)
        };
        let first = usize::from(relative_to == RelativeTo::FirstBody);
        Ok(FormulaOfBodies {
            relative_to,
            dimensions,
            bodies: masses.len(),
            particles: 0,
            formulas: masses[first..].iter().map(of).collect(),
        })
    }

    /// The same, where the last bodies are particles of mass 0, which are given as ones of mass 1: these have a force
    /// for a unit mass, that of an energy proportional to the mass, and no energy, and do not react on the first body.
    #[must_use]
    pub fn with_particles(self, particles: usize) -> Self {
        FormulaOfBodies { particles, ..self }
    }

    /// The same of the bodies with mass alone.
    #[must_use]
    pub fn without_particles(mut self) -> Self {
        self.formulas.truncate(self.formulas.len() - self.particles);
        self.bodies -= self.particles;
        self.particles = 0;
        self
    }

    /// The same formula in other numbers, with the masses of the bodies and the values of parameters.
    ///
    /// # Panics
    /// If there is not a mass for each body, particles included, and a value for each parameter.
    pub fn in_numbers<M: Number>(&self, masses: &[M], parameters: &[M]) -> FormulaOfBodies<M> {
        assert_eq!(masses.len(), self.bodies, "each body has a mass");
        let one = M::from_rational(&Rational::from_integer(1.into()), &masses[0].context());
        let of = |(body, formula): (usize, &FormulaPotential<N>)| {
            let mass = if self.is_particle(body) { &one } else { &masses[body] };
            formula.in_numbers([parameters, &[mass.clone(), masses[0].clone()]].concat())
        };
        FormulaOfBodies {
            relative_to: self.relative_to,
            dimensions: self.dimensions,
            bodies: self.bodies,
            particles: self.particles,
            formulas: (self.first()..).zip(&self.formulas).map(of).collect(),
        }
    }

    /// What the positions are relative to.
    pub fn relative_to(&self) -> RelativeTo {
        self.relative_to
    }

    /// The numbers in the formula.
    pub fn numbers(&self) -> Vec<&Rational> {
        self.formulas.first().map_or(Vec::new(), FormulaPotential::numbers)
    }

    fn is_particle(&self, body: usize) -> bool {
        body >= self.bodies - self.particles
    }

    /// The first body that has an energy.
    fn first(&self) -> usize {
        self.bodies - self.formulas.len()
    }

    /// place ← a position of a body, or a direction
    fn assign_place(&self, body: usize, q: &[N], place: &mut [N]) {
        let own = &q[body * self.dimensions..];
        match self.relative_to {
            RelativeTo::FirstBody => {
                place.iter_mut().zip(own).zip(q).for_each(|((place, own), first)| place.assign_difference(own, first));
            }
            RelativeTo::Origin => place.iter_mut().zip(own).for_each(|(place, own)| place.assign(own)),
        }
    }

    /// Adds the derivatives by the place of a body to those by positions.
    fn add_slope(&self, body: usize, slope: &[N], gradient: &mut [N]) {
        let (first, others) = gradient.split_at_mut(body * self.dimensions);
        others.iter_mut().zip(slope).for_each(|(sum, slope)| sum.add(slope));
        if self.relative_to == RelativeTo::FirstBody && !self.is_particle(body) {
            first.iter_mut().zip(slope).for_each(|(sum, slope)| sum.subtract(slope));
        }
    }

    /// The bodies that have an energy, each with its formula and its part of the scratch space.
    fn each<'a>(
        &'a self,
        each: usize,
        scratch: &'a mut [N],
    ) -> impl Iterator<Item = (usize, &'a FormulaPotential<N>, &'a mut [N])> {
        // `each` is 0 where no body has an energy
        let parts = scratch.chunks_exact_mut(each.max(1));
        (self.first()..).zip(&self.formulas).zip(parts).map(|((body, formula), part)| (body, formula, part))
    }

    fn each_scratch(&self) -> usize {
        self.formulas.first().map_or(0, Potential::scratch)
    }

    fn each_hessian_scratch(&self) -> usize {
        self.formulas.first().map_or(0, HessianProduct::hessian_scratch)
    }

    /// gradient ← U_q and, if asked for, rate ← qᵀU_q − 2U
    fn assign_gradient(&self, q: &[N], gradient: &mut [N], mut rate: Option<&mut N>, scratch: &mut [N]) {
        let ([place, slope, _], [number], parts) = split(self.dimensions, scratch);
        gradient.iter_mut().chain(rate.as_deref_mut()).for_each(N::assign_zero);
        for (body, formula, scratch) in self.each(self.each_scratch(), parts) {
            self.assign_place(body, q, place);
            match rate.as_deref_mut().filter(|_| !self.is_particle(body)) {
                None => formula.gradient(place, slope, scratch),
                Some(rate) => {
                    formula.gradient_and_rate(place, slope, number, scratch);
                    rate.add(number);
                }
            }
            self.add_slope(body, slope, gradient);
        }
    }

    /// product ← U_qq v and, if asked for, rate ← qᵀU_qq v − vᵀU_q
    fn assign_product(&self, (q, v): (&[N], &[N]), product: &mut [N], mut rate: Option<&mut N>, scratch: &mut [N]) {
        let ([place, slope, direction], [number], parts) = split(self.dimensions, scratch);
        product.iter_mut().chain(rate.as_deref_mut()).for_each(N::assign_zero);
        for (body, formula, scratch) in self.each(self.each_hessian_scratch(), parts) {
            self.assign_place(body, q, place);
            self.assign_place(body, v, direction);
            match rate.as_deref_mut().filter(|_| !self.is_particle(body)) {
                None => formula.hessian_product(place, direction, slope, scratch),
                Some(rate) => {
                    formula.hessian_product_and_rate(place, direction, slope, number, scratch);
                    rate.add(number);
                }
            }
            self.add_slope(body, slope, product);
        }
    }
}

/// The numbers of scratch space beside those of the formulas: a place, a slope and a direction, and a number.
const fn own_scratch(dimensions: usize) -> usize {
    3 * dimensions + 1
}

type Own<'a, N> = ([&'a mut [N]; 3], &'a mut [N; 1], &'a mut [N]);

fn split<N>(dimensions: usize, scratch: &mut [N]) -> Own<'_, N> {
    let (place, rest) = scratch.split_at_mut(dimensions);
    let (slope, rest) = rest.split_at_mut(dimensions);
    let (direction, rest) = rest.split_at_mut(dimensions);
    let (number, rest) = rest.split_first_chunk_mut::<1>().expect("as much as asked for");
    ([place, slope, direction], number, rest)
}

impl<N: Number> Potential<N> for FormulaOfBodies<N> {
    fn dimension(&self) -> usize {
        self.bodies * self.dimensions
    }

    fn scratch(&self) -> usize {
        own_scratch(self.dimensions) + self.formulas.len() * self.each_scratch()
    }

    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        let (_, _, parts) = split(self.dimensions, scratch);
        self.each(self.each_scratch(), parts).for_each(|(_, formula, scratch)| formula.prepare(scratch, context));
    }

    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        let ([place, ..], [number], parts) = split(self.dimensions, scratch);
        energy.assign_zero();
        let massive = self.formulas.len() - self.particles;
        for (body, formula, scratch) in self.each(self.each_scratch(), parts).take(massive) {
            self.assign_place(body, q, place);
            formula.energy(place, number, scratch);
            energy.add(number);
        }
    }

    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        self.assign_gradient(q, gradient, None, scratch);
    }

    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        self.assign_gradient(q, gradient, Some(rate), scratch);
    }

    fn hessian(&self) -> Option<&dyn HessianProduct<N>> {
        Some(self)
    }
}

impl<N: Number> HessianProduct<N> for FormulaOfBodies<N> {
    fn hessian_scratch(&self) -> usize {
        own_scratch(self.dimensions) + self.formulas.len() * self.each_hessian_scratch()
    }

    fn prepare_hessian(&self, scratch: &mut [N], context: &N::Context) {
        let (_, _, parts) = split(self.dimensions, scratch);
        let each = self.each(self.each_hessian_scratch(), parts);
        each.for_each(|(_, formula, scratch)| formula.prepare_hessian(scratch, context));
    }

    fn hessian_product(&self, q: &[N], v: &[N], product: &mut [N], scratch: &mut [N]) {
        self.assign_product((q, v), product, None, scratch);
    }

    fn hessian_product_and_rate(&self, q: &[N], v: &[N], product: &mut [N], rate: &mut N, scratch: &mut [N]) {
        self.assign_product((q, v), product, Some(rate), scratch);
    }
}
