//! How H is split into parts.

use shadowstep::displaced::Displacements;
use shadowstep::transformed_time::TimeTransformation;
use shadowstep::wisdom_holman::{Bodies, DemocraticHeliocentric, Jacobi, PlanetaryCoordinates, WisdomHolman};
use shadowstep::{MotionError, Number, Rational, System as _};

use crate::boxed::Boxed;

/// The parts of H, whose flows are exact.
#[derive(Clone, Debug)]
pub enum Parts {
    /// T(p) and U(q).
    KineticAndPotential,
    /// The Kepler orbits of planets, and their interactions.
    WisdomHolman(Planets),
    /// T(p) + ½qᵀKq with this K, row by row, and what is left of U.
    Linear(Vec<Vec<Rational>>),
    /// f(T + p_t) and −f(−U): the steps are in a fictitious time.
    TransformedTime(TimeTransformation),
    /// H is the sum of these formulas.
    Formulas(Vec<String>),
}

/// A planetary system of point masses, the central body first.
#[derive(Clone, Debug)]
pub struct Planets {
    /// The coordinates of the steps; states are shown in inertial ones.
    pub coordinates: Canonical,
    /// The gravitational constant and the masses.
    pub bodies: Bodies,
    /// 2 or 3.
    pub dimensions: usize,
}

/// Canonical coordinates of a planetary system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Canonical {
    /// [`Jacobi`]
    Jacobi,
    /// [`DemocraticHeliocentric`]
    DemocraticHeliocentric,
}

impl Canonical {
    /// Its values of the key `parts`.
    pub(crate) const NAMES: [(&'static str, Canonical); 2] =
        [("wisdom-holman", Canonical::Jacobi), ("wisdom-holman-heliocentric", Canonical::DemocraticHeliocentric)];

    /// Its value of the key `parts`.
    pub(crate) fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, known)| *known == self).map_or("", |(name, _)| name)
    }
}

/// A number for each planet, from Q.
pub(crate) type OfPlanets = Box<dyn FnMut(&[f64]) -> Vec<f64>>;

/// Converts a state.
type Convert<N> = Box<dyn FnMut((&[N], &[N]), (&mut [N], &mut [N]))>;

/// Converts states of a system to those that are shown.
pub struct Shown<N> {
    convert: Convert<N>,
    q: Vec<N>,
    p: Vec<N>,
}

impl<N: Number + 'static> Shown<N> {
    fn of<C: PlanetaryCoordinates<N, D> + 'static, const D: usize>(planets: &Planets, context: &N::Context) -> Self {
        let mut coordinates = C::new(&planets.bodies, context);
        let dimension = planets.bodies.count() * D;
        Shown::by(dimension, context, move |state, shown| coordinates.assign_inertial(state, shown))
    }

    /// The conversion into states of this dimension.
    pub(super) fn by(
        dimension: usize,
        context: &N::Context,
        convert: impl FnMut((&[N], &[N]), (&mut [N], &mut [N])) + 'static,
    ) -> Self {
        let zeros = || vec![N::zero(context); dimension];
        Shown { convert: Box::new(convert), q: zeros(), p: zeros() }
    }

    /// The first `dimension` coordinates and their momenta: without t and p_t.
    pub(super) fn without_time(dimension: usize, context: &N::Context) -> Self {
        let assign = |own: &[N], shown: &mut [N]| shown.iter_mut().zip(own).for_each(|(shown, own)| shown.assign(own));
        Shown::by(dimension, context, move |(q, p), shown| {
            assign(q, shown.0);
            assign(p, shown.1);
        })
    }

    /// The positions and momenta that are shown of a state.
    pub fn of_state(&mut self, q: &[N], p: &[N]) -> (&[N], &[N]) {
        (self.convert)((q, p), (&mut self.q, &mut self.p));
        (&self.q, &self.p)
    }
}

impl Planets {
    /// From the coordinates of the steps to inertial ones.
    pub(crate) fn shown<N: Number + 'static>(&self, context: &N::Context) -> Shown<N> {
        match (self.coordinates, self.dimensions) {
            (Canonical::Jacobi, 2) => Shown::of::<Jacobi<N, 2>, 2>(self, context),
            (Canonical::Jacobi, _) => Shown::of::<Jacobi<N, 3>, 3>(self, context),
            (Canonical::DemocraticHeliocentric, 2) => Shown::of::<DemocraticHeliocentric<N, 2>, 2>(self, context),
            (Canonical::DemocraticHeliocentric, _) => Shown::of::<DemocraticHeliocentric<N, 3>, 3>(self, context),
        }
    }

    /// Computes |B_Q|/|A_Q| of each planet, from Q.
    pub(crate) fn epsilon(&self) -> OfPlanets {
        match (self.coordinates, self.dimensions) {
            (Canonical::Jacobi, 2) => self.ratios::<Jacobi<f64, 2>, 2>(),
            (Canonical::Jacobi, _) => self.ratios::<Jacobi<f64, 3>, 3>(),
            (Canonical::DemocraticHeliocentric, 2) => self.ratios::<DemocraticHeliocentric<f64, 2>, 2>(),
            (Canonical::DemocraticHeliocentric, _) => self.ratios::<DemocraticHeliocentric<f64, 3>, 3>(),
        }
    }

    fn ratios<C: PlanetaryCoordinates<f64, D> + 'static, const D: usize>(&self) -> OfPlanets {
        let mut coordinates = C::new(&self.bodies, &());
        let mut gradient = vec![0.0; self.bodies.count() * D];
        Box::new(move |q| {
            coordinates.gradient_and_rate(q, &mut gradient, None);
            let square = |vector: &[f64]| vector.iter().map(|x| x * x).sum::<f64>();
            let planets = coordinates.orbits().planets.iter().zip(q.chunks(D).zip(gradient.chunks(D)).skip(1));
            planets.map(|(orbit, (q, gradient))| square(gradient).sqrt() * square(q) / orbit.attraction).collect()
        })
    }

    /// The system at a state in the coordinates of its steps.
    ///
    /// # Errors
    /// A state of another dimension.
    pub(crate) fn system<N: Number + 'static>(
        &self,
        (q, p): (&[N], &[N]),
        compensated: bool,
        displacements: Option<Displacements<N>>,
        context: &N::Context,
    ) -> Result<Boxed<N>, MotionError> {
        let (coordinates, dimension) = (q.len(), self.bodies.count() * self.dimensions);
        if coordinates != dimension {
            return Err(MotionError::Potential { coordinates, dimension });
        }
        if p.len() != coordinates {
            return Err(MotionError::Momenta { coordinates, momenta: p.len() });
        }
        let mut system = match (self.coordinates, self.dimensions) {
            (Canonical::Jacobi, 2) => {
                let system = self.at_rest::<N, Jacobi<N, 2>, 2>(compensated, context);
                Boxed::Quadratic(Box::new(by_forces(system, displacements)))
            }
            (Canonical::Jacobi, _) => {
                let system = self.at_rest::<N, Jacobi<N, 3>, 3>(compensated, context);
                Boxed::Quadratic(Box::new(by_forces(system, displacements)))
            }
            (Canonical::DemocraticHeliocentric, 2) => {
                Boxed::General(Box::new(self.at_rest::<N, DemocraticHeliocentric<N, 2>, 2>(compensated, context)))
            }
            (Canonical::DemocraticHeliocentric, _) => {
                Boxed::General(Box::new(self.at_rest::<N, DemocraticHeliocentric<N, 3>, 3>(compensated, context)))
            }
        };
        system.state_mut().set(q, p);
        Ok(system)
    }

    /// All bodies at 0.
    fn at_rest<N: Number, C: PlanetaryCoordinates<N, D>, const D: usize>(
        &self,
        compensated: bool,
        context: &N::Context,
    ) -> WisdomHolman<N, C, D> {
        let zeros = vec![N::zero(context); self.bodies.count() * D];
        let system = WisdomHolman::new(&self.bodies, (&zeros, &zeros), context).expect("it is a state of all bodies");
        if compensated { system.compensated() } else { system }
    }

    /// The coordinates of the steps at an inertial state.
    pub(crate) fn canonical<N: Number + 'static>(
        &self,
        inertial: (&[N], &[N]),
        context: &N::Context,
    ) -> (Vec<N>, Vec<N>) {
        let (mut q, mut p) = (inertial.0.to_vec(), inertial.1.to_vec());
        let own = (&mut q[..], &mut p[..]);
        match (self.coordinates, self.dimensions) {
            (Canonical::Jacobi, 2) => self.convert::<N, Jacobi<N, 2>, 2>(inertial, own, context),
            (Canonical::Jacobi, _) => self.convert::<N, Jacobi<N, 3>, 3>(inertial, own, context),
            (Canonical::DemocraticHeliocentric, 2) => {
                self.convert::<N, DemocraticHeliocentric<N, 2>, 2>(inertial, own, context);
            }
            (Canonical::DemocraticHeliocentric, _) => {
                self.convert::<N, DemocraticHeliocentric<N, 3>, 3>(inertial, own, context);
            }
        }
        (q, p)
    }

    fn convert<N: Number, C: PlanetaryCoordinates<N, D>, const D: usize>(
        &self,
        inertial: (&[N], &[N]),
        own: (&mut [N], &mut [N]),
        context: &N::Context,
    ) {
        C::new(&self.bodies, context).assign_from_inertial(inertial, own);
    }
}

/// With gradient kicks by displaced forces, if these are given.
fn by_forces<N: Number, C: PlanetaryCoordinates<N, D>, const D: usize>(
    system: WisdomHolman<N, C, D>,
    displacements: Option<Displacements<N>>,
) -> WisdomHolman<N, C, D> {
    match displacements {
        Some(displacements) => system.displaced(displacements),
        None => system,
    }
}
