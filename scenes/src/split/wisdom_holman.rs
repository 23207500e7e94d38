//! The Kepler orbits of planets, and their interactions.

use serde_json::{Value, json};
use shadowstep::displaced::Displacements;
use shadowstep::number::Rounded;
use shadowstep::wisdom_holman::{Bodies, DemocraticHeliocentric, Jacobi, PlanetaryCoordinates, WisdomHolman};
use shadowstep::{MotionError, Number, System as _};

use super::{Class, Needs, Shown, Split, State};
use crate::boxed::Boxed;
use crate::refusal::{NoGradientKicks, Refusal};
use crate::scene::{EnergyAt, InitialValueProblem};
use crate::start::{Steps, Work};

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
    /// Its value of the key `parts`.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Canonical::Jacobi => "wisdom-holman",
            Canonical::DemocraticHeliocentric => "wisdom-holman-heliocentric",
        }
    }
}

/// A number for each planet, from Q.
pub(crate) type OfPlanets = Box<dyn FnMut(&[f64]) -> Vec<f64>>;

impl Split for Planets {
    fn needs(&self, _: &InitialValueProblem) -> Needs {
        match self.coordinates {
            Canonical::Jacobi => Needs::of_class(Class::Quadratic),
            Canonical::DemocraticHeliocentric => Needs {
                no_gradient_kicks: Some(NoGradientKicks {
                    reason: "but in heliocentric coordinates the kicks depend on the momenta, so that [B,[A,B]] is no kick",
                    hint: "write parts = \"wisdom-holman\" for Jacobi coordinates, or use a scheme such as abah864",
                }),
                ..Needs::of_class(Class::EveryKinetic)
            },
        }
    }

    fn metadata(&self) -> Option<(&'static str, Value)> {
        Some(("parts", json!(self.coordinates.name())))
    }

    fn start<N: Number + 'static>(
        &self,
        _: &InitialValueProblem,
        inertial: State<N>,
        context: &N::Context,
    ) -> State<N> {
        self.canonical((&inertial.0, &inertial.1), context)
    }

    fn shown<N: Number + 'static>(&self, _: &InitialValueProblem, context: &N::Context) -> Option<Shown<N>> {
        Some(self.inertial(context))
    }

    fn energy<N: Rounded + 'static>(&self, problem: &InitialValueProblem, context: &N::Context) -> EnergyAt<N> {
        let (q, p) = self.start(problem, problem.initial(context), context);
        let system = self.system((&q, &p), false, None, context);
        let mut system = system.expect("the dimensions were read with the system");
        Box::new(move |q, p| system.energy_at(q, p))
    }

    fn with<N: Rounded + 'static, W: Work<N>>(
        &self,
        _: &InitialValueProblem,
        steps: Steps<'_>,
        (q, p): State<N>,
        context: &N::Context,
        work: W,
    ) -> Result<W::Output, MotionError> {
        let system = self.system((&q, &p), steps.compensated, steps.displacements(context), context)?;
        Ok(steps.begin(steps.scheme.clone(), system, context, work))
    }
}

impl Planets {
    /// The parts of a system of bodies that attract each other.
    ///
    /// # Errors
    /// Another system.
    pub(crate) fn of(coordinates: Canonical, bodies: Option<(Bodies, usize)>) -> Result<Self, Refusal> {
        match bodies {
            Some((bodies, dimensions)) => Ok(Planets { coordinates, bodies, dimensions }),
            None => Err(Refusal::new(
                "only bodies that attract each other have these parts",
                "remove `parts`, give the bodies in sections [[body]], or use a problem such as outer-solar-system",
            )),
        }
    }

    /// From the coordinates of the steps to inertial ones.
    pub(crate) fn inertial<N: Number + 'static>(&self, context: &N::Context) -> Shown<N> {
        match (self.coordinates, self.dimensions) {
            (Canonical::Jacobi, 2) => shown::<N, Jacobi<N, 2>, 2>(self, context),
            (Canonical::Jacobi, _) => shown::<N, Jacobi<N, 3>, 3>(self, context),
            (Canonical::DemocraticHeliocentric, 2) => shown::<N, DemocraticHeliocentric<N, 2>, 2>(self, context),
            (Canonical::DemocraticHeliocentric, _) => shown::<N, DemocraticHeliocentric<N, 3>, 3>(self, context),
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
    fn system<N: Number + 'static>(
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
    fn canonical<N: Number + 'static>(&self, inertial: (&[N], &[N]), context: &N::Context) -> (Vec<N>, Vec<N>) {
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

fn shown<N: Number + 'static, C: PlanetaryCoordinates<N, D> + 'static, const D: usize>(
    planets: &Planets,
    context: &N::Context,
) -> Shown<N> {
    let mut coordinates = C::new(&planets.bodies, context);
    Shown::by(planets.bodies.count() * D, context, move |state, shown| coordinates.assign_inertial(state, shown))
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
