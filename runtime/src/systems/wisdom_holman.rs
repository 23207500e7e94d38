//! Planetary systems H = A + B with A solved exactly: Kepler orbits about the central body, and the interactions of the
//! planets.
//!
//! Schemes for H = A + εB, such as the SABA and ABAH families, gain their factor ε only where A is the larger part
//! *and* its flow is exact (Wisdom & Holman, Astron. J. 102 (1991) 1528; Laskar & Robutel, Celest. Mech. 80 (2001) 39).
//! Here a drift moves the centre of mass and each planet on its Kepler orbit, A = P₀²/2M + Σ (P_i²/2m_i′ − κ_i/|Q_i|),
//! and a kick is by the rest of the forces.
//!
//! Along an exact flow of A the modified energy's β grows by ∫(qᵀA_q + pᵀA_p − 2A) dt (Moan & Niesen, eq. 2). A
//! quadratic form adds nothing; of p²/2m − κ/r the integrand is 3κ/r, and ∫dt/r is the universal anomaly s, which the
//! [Kepler drift](crate::systems::kepler_drift) has found anyway: **β += 3κ s**. B is homogeneous of degree −1, so that
//! a kick adds −3B times its weight.
//!
//! In `f64` three planets and more drift together, each in a lane of [`Lanes`](crate::number::Lanes), with the bits
//! that they have one by one.
//!
//! In Jacobi coordinates B depends on Q only, and of A only T = Σ P²/2m′ does not commute with it. So `[B,[A,B]]` is
//! `[B,[T,B]]`, and a gradient kick is the flow of −½B_QᵀM′⁻¹B_Q as for H = T + U. With v = M′⁻¹B_Q its rate of β is
//! −vᵀ∂(−3B)/∂Q = 3vᵀB_Q.
//!
//! Particles of mass 0 come after the bodies with mass. Their momenta are divided by their mass, and they have no
//! energy.
//!
//! B may have a potential of the inertial positions beside the attraction, of any form ([`WisdomHolman::beside`]):
//! relativity, an oblate body, a tide.

mod beside;
mod bodies;
mod coordinates;
mod encounters;
mod heliocentric;
mod interactions;
mod jacobi;
mod orbits;
mod particles;
pub mod secular;
mod together;

pub use beside::NoPotential;
pub use bodies::{Bodies, BodiesError};
pub use coordinates::PlanetaryCoordinates;
pub use encounters::{Encounters, Shells};
pub use heliocentric::DemocraticHeliocentric;
pub use jacobi::Jacobi;
pub use orbits::Orbits;

use crate::number::Number;
use crate::systems::coordinates::first_not_finite;
use crate::systems::displaced::Displacements;
use crate::systems::evaluated::Evaluated;
use crate::systems::gradient_kicks::{GradientKicks, PartOfKicks, Place, are_displaced};
use crate::systems::increments::Carried;
use crate::systems::potential::Potential;
use crate::systems::state::{State, VectorState};
use crate::systems::summation::{Compensated, Half};
use crate::systems::system::System;
use beside::Beside;

/// A planetary system in D dimensions with its state, in coordinates `C`: [`Jacobi`] or [`DemocraticHeliocentric`].
///
/// The first body is the central one. Positions and momenta of the [`System`] are the canonical coordinates Q and P;
/// [`inertial`](WisdomHolman::inertial) converts them.
///
/// ```
/// use shadowstep::systems::wisdom_holman::{Bodies, Jacobi, WisdomHolman};
/// use shadowstep::{Stepper, System, exact, tables};
///
/// // two planets of a thousandth of the central mass, with G = 1
/// let masses = ["1", "1/1000", "1/1000"].map(|mass| exact(mass).unwrap());
/// let bodies = Bodies::new(exact("1").unwrap(), masses.to_vec())?;
/// let (q, p) = ([0.0, 0.0, 1.0, 0.0, 0.0, 1.8], [0.0, -0.001, 0.0, 0.001, -0.00074, 0.0]);
/// let mut planets = WisdomHolman::<_, Jacobi<_, 2>, 2>::new(&bodies, (&q, &p), &())?;
///
/// let before = planets.energy();
/// let stepper = Stepper::new(tables::shipped("saba4").unwrap(), "1/4")?;
/// for _ in 0..1000 {
///     stepper.step(&mut planets);
/// }
/// assert!((planets.energy() / before - 1.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct WisdomHolman<N: Number, C, const D: usize, P = NoPotential> {
    interaction: Interaction<N, C, D, P>,
    orbits: orbits::Advance<N, D>,
    at: Evaluated<N>,
}

/// B, with the coordinates in which it is one.
#[derive(Clone, Debug)]
struct Interaction<N, C, const D: usize, P> {
    coordinates: C,
    beside: Option<Box<Beside<N, P>>>,
    gradient_kicks: Option<Box<GradientKicks<N>>>,
}

impl<N: Number, C: PlanetaryCoordinates<N, D>, const D: usize> WisdomHolman<N, C, D> {
    /// The system at inertial positions and momenta, body after body.
    ///
    /// # Errors
    /// A state of another number of bodies; an infinite q or p, or one that is NaN.
    pub fn new(bodies: &Bodies, (q, p): (&[N], &[N]), context: &N::Context) -> Result<Self, BodiesError> {
        let dimension = bodies.count() * D;
        for found in [q.len(), p.len()] {
            if found != dimension {
                return Err(BodiesError::State { found, bodies: bodies.count(), dimensions: D });
            }
        }
        if let Some(name) = first_not_finite(q, p) {
            return Err(BodiesError::NotFinite { name });
        }
        let zeros = || vec![N::zero(context); dimension];
        let coordinates = C::new(bodies, context);
        let orbits = orbits::Advance::new(coordinates.orbits(), context);
        let at = Evaluated::new(State::new(zeros(), zeros(), context).compensated_if(false));
        let interaction = Interaction { coordinates, beside: None, gradient_kicks: None };
        let mut system = WisdomHolman { interaction, orbits, at };
        system.set_inertial(q, p);
        Ok(system)
    }

    /// The same system with a potential of the inertial positions, body after body, as a part of B.
    ///
    /// Kicks are its flow together with the attraction; β and the modified energy take it for what it is, of whatever
    /// degree. Gradient kicks need its [second derivatives](Potential::hessian), unless they are by displaced forces.
    ///
    /// ```
    /// use shadowstep::systems::potential::from_fn;
    /// use shadowstep::systems::wisdom_holman::{Bodies, Jacobi, WisdomHolman};
    /// use shadowstep::{Stepper, System, exact, tables};
    ///
    /// // a tide k m |x|²/2 of each body of the plane
    /// let tide = from_fn(4, |x, gradient| {
    ///     let (k, m) = (0.01, [1.0, 1.0, 0.001, 0.001]);
    ///     (0..4).for_each(|i| gradient[i] = k * m[i] * x[i]);
    ///     (0..4).map(|i| gradient[i] * x[i]).sum::<f64>() / 2.0
    /// });
    /// let bodies = Bodies::new(exact("1")?, vec![exact("1")?, exact("1/1000")?])?;
    /// let state = (&[0.0, 0.0, 1.0, 0.0][..], &[0.0, 0.0, 0.0, 0.001][..]);
    /// let mut planets = WisdomHolman::<_, Jacobi<_, 2>, 2>::new(&bodies, state, &())?.beside(Some(tide))?;
    ///
    /// let before = planets.energy();
    /// let stepper = Stepper::new(tables::shipped("saba4").unwrap(), "1/10")?;
    /// for _ in 0..1000 {
    ///     stepper.step(&mut planets);
    /// }
    /// assert!((planets.energy() / before - 1.0).abs() < 1e-8);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A potential of another dimension; coordinates in which kicks depend on momenta, so that B would have no exact
    /// flow.
    pub fn beside<P: Potential<N>>(self, potential: Option<P>) -> Result<WisdomHolman<N, C, D, P>, BodiesError> {
        let WisdomHolman { interaction: Interaction { coordinates, gradient_kicks, .. }, orbits, at } = self;
        let dimension = at.state.q.len();
        if let Some(found) = potential.as_ref().map(Potential::dimension).filter(|found| *found != dimension) {
            return Err(BodiesError::Potential { found, bodies: dimension / D, dimensions: D });
        }
        if potential.is_some() && !C::HAS_GRADIENT_KICKS {
            return Err(BodiesError::NoFlow);
        }
        let beside = potential.map(|potential| Box::new(Beside::new(potential, &at.state.context())));
        let interaction = Interaction { coordinates, beside, gradient_kicks };
        Ok(WisdomHolman { interaction, orbits, at: Evaluated::new(at.state) })
    }
}

impl<N: Number, C: PlanetaryCoordinates<N, D>, const D: usize, P: Potential<N>> WisdomHolman<N, C, D, P> {
    /// The same system with [compensated sums](crate::systems::summation::Compensated): the round-off of a kick or
    /// drift is ε times the increment, in place of ε times the coordinate.
    #[must_use]
    pub fn compensated(mut self) -> Self {
        self.at = self.at.with(|state| state.compensated_if(true));
        self
    }

    /// The same system with gradient kicks by displaced forces, of the stepper that computed these: see
    /// [`Displacements`].
    #[must_use]
    pub fn displaced(mut self, displacements: Displacements<N>) -> Self {
        let (dimension, context) = (self.at.state.q.len(), self.at.state.context());
        self.interaction.gradient_kicks = Some(Box::new(GradientKicks::new(dimension, Some(displacements), &context)));
        self
    }

    /// The inertial positions and momenta.
    pub fn inertial(&mut self) -> (Vec<N>, Vec<N>) {
        let State { q: own_q, p: own_p, .. } = &self.at.state;
        let (mut q, mut p) = (own_q.clone(), own_p.clone());
        self.interaction.coordinates.assign_inertial((own_q, own_p), (&mut q, &mut p));
        (q, p)
    }

    /// Sets the inertial positions and momenta.
    pub(crate) fn set_inertial(&mut self, q: &[N], p: &[N]) {
        let state = self.at.state_mut();
        self.interaction.coordinates.assign_from_inertial((q, p), (&mut state.q, &mut state.p));
        // the remainders of what was there before
        state.q_mut();
        state.p_mut();
    }

    /// The coordinates, which convert states.
    pub fn coordinates(&self) -> &C {
        &self.interaction.coordinates
    }

    /// gradient ← ∂B/∂Q at a Q, of the part of B that depends on Q.
    pub fn assign_gradient(&mut self, q: &[N], gradient: &mut [N]) {
        self.interaction.gradient(q, gradient, None);
    }

    /// The velocity with which the part of B that depends on P moves all planets.
    fn jump(&mut self, weight: &N, carried: Carried) {
        let Some(velocity) = self.interaction.coordinates.jump(&self.at.state.p) else { return };
        let state = self.at.state_mut();
        for index in D..state.q.len() {
            state.change(Half::Positions, index, carried, |q| q.add_product(weight, &velocity[index % D]));
        }
    }
}

impl<N: Number, C: PlanetaryCoordinates<N, D>, P: Potential<N>, const D: usize> PartOfKicks<N>
    for Interaction<N, C, D, P>
{
    fn gradient(&mut self, q: &[N], gradient: &mut [N], mut rate: Option<&mut N>) {
        self.coordinates.gradient_and_rate(q, gradient, rate.as_deref_mut());
        if let Some(beside) = &mut self.beside {
            beside.add_gradient::<C, D>(&mut self.coordinates, q, gradient, rate);
        }
    }

    fn assign_velocity(&mut self, gradient: &[N], velocity: &mut [N]) {
        let orbits = self.coordinates.orbits();
        let masses = std::iter::once(&orbits.total_mass).chain(orbits.planets.iter().map(|orbit| &orbit.mass));
        for ((velocity, gradient), mass) in velocity.chunks_mut(D).zip(gradient.chunks(D)).zip(masses) {
            velocity.iter_mut().zip(gradient).for_each(|(v, gradient)| v.assign_quotient(gradient, mass));
        }
    }

    fn hessian_product(&mut self, at: Place<'_, N>, v: &[N], product: &mut [N], rate: Option<&mut N>) {
        self.coordinates.hessian_product(at.q, v, product);
        if let Some(beside) = &mut self.beside {
            beside.add_hessian_product::<C, D>(&mut self.coordinates, (at.q, v), product);
        }
        let Some(rate) = rate else { return };
        rate.assign_zero();
        let massive = (self.coordinates.orbits().with_energy().len() + 1) * D;
        v[..massive].iter().zip(at.gradient).for_each(|(v, gradient)| rate.add_product(v, gradient));
        match self.beside {
            // QᵀB_Q − 2B = −3B
            None => rate.multiply_integer(-3),
            // of any B: its derivative is QᵀB_QQ v − vᵀB_Q
            Some(_) => {
                rate.negate();
                at.q[..massive].iter().zip(product).for_each(|(q, product)| rate.add_product(q, product));
            }
        }
    }

    fn gradient_kicks(&mut self) -> &mut Option<Box<GradientKicks<N>>> {
        &mut self.gradient_kicks
    }
}

impl<N: Number, C: PlanetaryCoordinates<N, D>, const D: usize, P: Potential<N>> System for WisdomHolman<N, C, D, P> {
    type Number = N;
    type Class = C::Class;
    type Coordinates = Vec<N>;
    type Summation = Option<Compensated<N, Vec<N>>>;

    fn state(&self) -> &VectorState<N> {
        &self.at.state
    }

    fn state_mut(&mut self) -> &mut VectorState<N> {
        self.at.state_mut()
    }

    fn clear_increments(&mut self) {
        self.at.state.clear_increments();
    }

    /// The jump and the kick by the gradient at the place where it ends: the two commute.
    fn kick(&mut self, weight: &N, carried: Carried) {
        self.jump(weight, carried);
        self.at.kick(&mut self.interaction, weight, carried);
    }

    fn drift(&mut self, weight: &N, carried: Carried) {
        self.orbits.advance(self.interaction.coordinates.orbits(), weight, self.at.state_mut(), carried);
    }

    fn has_gradient_kicks(&self) -> bool {
        let Interaction { beside, gradient_kicks, .. } = &self.interaction;
        C::HAS_GRADIENT_KICKS
            && (are_displaced(gradient_kicks.as_deref()) || beside.as_ref().is_none_or(|beside| beside.has_hessian()))
    }

    /// The gradient kick p ← p + weight·B_QQ M′⁻¹B_Q.
    fn gradient_kick(&mut self, weight: &N, carried: Carried) {
        assert!(
            C::HAS_GRADIENT_KICKS,
            "B depends on P in these coordinates: there are gradient kicks in Jacobi coordinates only"
        );
        self.at.gradient_kick(&mut self.interaction, weight, carried);
    }

    /// H is the same as in inertial coordinates.
    fn assign_energy(&mut self, at: Option<(&[N], &[N])>, energy: &mut N) {
        let Interaction { coordinates, beside, .. } = &mut self.interaction;
        let at = at.unwrap_or((self.at.state.q(), self.at.state.p()));
        coordinates.assign_interaction_energy(at, energy);
        if let Some(beside) = beside {
            beside.add_energy::<C, D>(coordinates, at.0, energy);
        }
        self.orbits.add_energy(coordinates.orbits(), at, energy);
    }

    fn assign_kinetic_energy(&mut self, at: Option<(&[N], &[N])>, kinetic: &mut N) {
        let (_, p) = at.unwrap_or((self.at.state.q(), self.at.state.p()));
        self.orbits.assign_kinetic_energy(self.interaction.coordinates.orbits(), p, kinetic);
    }

    fn massive_coordinates(&self) -> usize {
        (self.interaction.coordinates.orbits().with_energy().len() + 1) * D
    }
}
