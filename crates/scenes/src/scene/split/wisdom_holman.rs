//! The Kepler orbits of planets, and their interactions.

use std::f64::consts::TAU;

use num_traits::Signed;
use serde_json::{Value, json};
use shadowstep::number::CorrectlyRounded;
use shadowstep::systems::kinetic::General;
use shadowstep::systems::wisdom_holman::{
    Bodies, DemocraticHeliocentric, Encounters, Jacobi, PlanetaryCoordinates, Shells, WisdomHolman,
};
use shadowstep::tables::TableScheme;
use shadowstep::{MotionError, Number, Potential, Rational, Real, Scheme, System as _, ValidFor};
use shadowstep_schemes::symbolic::decimal::to_text;

use super::{Class, Needs, ShownCoordinates, Split, State};
use crate::run::start::{SceneIntegrator, Steps};
use crate::scene::{EnergyAt, InitialValueProblem, energy_of};
use crate::texts::refusal::{Refusal, Unsupported};

/// A planetary system of point masses, the central body first.
#[derive(Clone, Debug)]
pub struct Planets {
    /// The coordinates of the steps; states are shown in inertial ones.
    pub coordinates: CanonicalCoordinates,
    /// The gravitational constant and the masses.
    pub bodies: Bodies,
    /// 2 or 3.
    pub dimensions: usize,
    /// How planets that come close to each other move; in heliocentric coordinates only.
    pub encounters: Option<CloseEncounters>,
}

/// Planets that are near each other attract each other in drifts, by [`Encounters`].
#[derive(Clone, Debug)]
pub struct CloseEncounters {
    /// Below this distance.
    pub shells: Shells,
    /// Substeps of a step that are made there, at least.
    pub substeps: u32,
}

/// Canonical coordinates of a planetary system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CanonicalCoordinates {
    /// [`Jacobi`]
    Jacobi,
    /// [`DemocraticHeliocentric`]
    DemocraticHeliocentric,
}

impl CanonicalCoordinates {
    /// Its value of the key `parts`.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            CanonicalCoordinates::Jacobi => "wisdom-holman",
            CanonicalCoordinates::DemocraticHeliocentric => "wisdom-holman-heliocentric",
        }
    }
}

/// Calls a method of [`Planets`] for their coordinates.
macro_rules! in_coordinates {
    ($planets:expr, $method:ident::<$number:ty>($($argument:expr),*)) => {
        match ($planets.coordinates, $planets.dimensions) {
            (CanonicalCoordinates::Jacobi, 2) => $planets.$method::<$number, Jacobi<$number, 2>, 2>($($argument),*),
            (CanonicalCoordinates::Jacobi, _) => $planets.$method::<$number, Jacobi<$number, 3>, 3>($($argument),*),
            (CanonicalCoordinates::DemocraticHeliocentric, 2) => {
                $planets.$method::<$number, DemocraticHeliocentric<$number, 2>, 2>($($argument),*)
            }
            (CanonicalCoordinates::DemocraticHeliocentric, _) => {
                $planets.$method::<$number, DemocraticHeliocentric<$number, 3>, 3>($($argument),*)
            }
        }
    };
}

/// Positions in an inertial frame, from Q.
pub(crate) type Positions<N> = Box<dyn FnMut(&[N], &mut [N])>;

/// A number for each planet, from Q.
pub(crate) type OfPlanets = Box<dyn FnMut(&[f64]) -> Vec<f64>>;

impl Split for Planets {
    fn needs(&self, _: &InitialValueProblem) -> Needs {
        match self.coordinates {
            CanonicalCoordinates::Jacobi => Needs::of_class(Class::Quadratic),
            CanonicalCoordinates::DemocraticHeliocentric => Needs {
                no_gradient_kicks: Some(Unsupported {
                    reason: "but in heliocentric coordinates the kicks depend on the momenta, so that [B,[A,B]] is no kick",
                    hint: "write parts = \"wisdom-holman\" for Jacobi coordinates, or use a scheme such as abah864",
                }),
                ..Needs::of_class(Class::EveryKinetic)
            },
        }
    }

    fn metadata(&self) -> Option<(&'static str, Value)> {
        let name = self.coordinates.name();
        let value = match &self.encounters {
            None => json!(name),
            Some(CloseEncounters { shells, substeps }) => {
                json!({ "name": name, "encounters": { "within": to_text(shells.radius()), "substeps": substeps } })
            }
        };
        Some(("parts", value))
    }

    fn start<N: Number + 'static>(
        &self,
        _: &InitialValueProblem,
        (mut q, mut p): State<N>,
        context: &N::Context,
    ) -> State<N> {
        let inertial = (q.clone(), p.clone());
        in_coordinates!(self, convert::<N>(&inertial, (&mut q, &mut p), context));
        (q, p)
    }

    fn shown<N: Number + 'static>(&self, _: &InitialValueProblem, context: &N::Context) -> Option<ShownCoordinates<N>> {
        Some(self.inertial(context))
    }

    fn energy<N: CorrectlyRounded + 'static>(
        &self,
        problem: &InitialValueProblem,
        context: &N::Context,
    ) -> EnergyAt<N> {
        in_coordinates!(self, energy_at::<N>(problem, context))
    }

    fn integrator<N: CorrectlyRounded + 'static>(
        &self,
        problem: &InitialValueProblem,
        steps: Steps<'_>,
        (q, p): State<N>,
        context: &N::Context,
    ) -> Result<SceneIntegrator<N>, MotionError> {
        let (coordinates, dimension) = (q.len(), self.bodies.count() * self.dimensions);
        if coordinates != dimension {
            return Err(MotionError::Potential { coordinates, dimension });
        }
        if p.len() != coordinates {
            return Err(MotionError::Momenta { coordinates, momenta: p.len() });
        }
        let state = (problem, (q, p));
        Ok(match (self.coordinates, self.dimensions) {
            (CanonicalCoordinates::Jacobi, 2) => {
                self.moved::<N, Jacobi<N, 2>, 2, _>(steps.quadratic(), steps, &state, context)
            }
            (CanonicalCoordinates::Jacobi, _) => {
                self.moved::<N, Jacobi<N, 3>, 3, _>(steps.quadratic(), steps, &state, context)
            }
            (CanonicalCoordinates::DemocraticHeliocentric, dimensions) => {
                let scheme = steps.for_every_kinetic();
                if self.encounters.is_some() {
                    return Ok(match dimensions {
                        2 => self.moved_close::<N, 2>(scheme, steps, &state, context),
                        _ => self.moved_close::<N, 3>(scheme, steps, &state, context),
                    });
                }
                match dimensions {
                    2 => self.moved::<N, DemocraticHeliocentric<N, 2>, 2, _>(scheme, steps, &state, context),
                    _ => self.moved::<N, DemocraticHeliocentric<N, 3>, 3, _>(scheme, steps, &state, context),
                }
            }
        })
    }

    fn has_dominant_part(&self) -> bool {
        true
    }
}

impl Planets {
    /// The parts of a system of bodies that attract each other.
    ///
    /// # Errors
    /// Another system; one with energies beside the attraction, in heliocentric coordinates.
    pub(crate) fn of(
        coordinates: CanonicalCoordinates,
        problem: &InitialValueProblem,
        bodies: Option<(Bodies, usize)>,
    ) -> Result<Self, Refusal> {
        let has_more = problem.has_energies_of_bodies();
        match bodies {
            Some(_) if has_more && coordinates == CanonicalCoordinates::DemocraticHeliocentric => Err(Refusal::new(
                "in heliocentric coordinates kicks move the planets, so that `central` and `external` have no exact \
                    flow with them",
                "write parts = \"wisdom-holman\" for Jacobi coordinates",
            )),
            Some((bodies, dimensions)) => Ok(Planets { coordinates, bodies, dimensions, encounters: None }),
            None => Err(Refusal::new(
                "only bodies that attract each other have these parts",
                "remove `parts`, give the bodies in sections [[body]], or use a problem such as outer-solar-system",
            )),
        }
    }

    /// From the coordinates of the steps to inertial ones.
    pub(crate) fn inertial<N: Number + 'static>(&self, context: &N::Context) -> ShownCoordinates<N> {
        in_coordinates!(self, shown_by::<N>(context))
    }

    /// Computes positions in an inertial frame from those of the steps.
    pub(crate) fn inertial_positions<N: Number<Context = ()> + 'static>(&self) -> Positions<N> {
        in_coordinates!(self, positions_by::<N>())
    }

    /// The bodies with mass alone.
    pub(crate) fn without_particles(&self) -> Self {
        Planets { bodies: self.bodies.without_particles(), ..self.clone() }
    }

    /// The names or numbers of the bodies, from those of their coordinates.
    pub(crate) fn names(&self, coordinates: &[String]) -> Vec<String> {
        let names = coordinates.iter().step_by(self.dimensions);
        names.map(|name| name.trim_start_matches('x').trim_start_matches('_').to_owned()).collect()
    }

    /// The shortest period of the planets' Kepler orbits at a state in the coordinates of the steps, and the planet,
    /// counted from 1; `None` where no orbit is an ellipse.
    pub(crate) fn shortest_period(&self, q: &[f64], p: &[f64]) -> Option<(usize, f64)> {
        in_coordinates!(self, shortest::<f64>((q, p)))
    }

    fn shortest<N, C, const D: usize>(&self, (q, p): (&[N], &[N])) -> Option<(usize, f64)>
    where
        N: Real<Context = ()>,
        C: PlanetaryCoordinates<N, D>,
    {
        let coordinates = C::new(&self.bodies, &());
        let length = |vector: &[N]| vector.iter().map(|x| x.to_f64().powi(2)).sum::<f64>().sqrt();
        let states = q.chunks(D).zip(p.chunks(D)).skip(1);
        let periods = coordinates.orbits().planets.iter().zip(states).map(|(orbit, (q, p))| {
            let (mass, parameter) = (orbit.mass.to_f64(), orbit.parameter.to_f64());
            // 1/a = 2/r − v²/μ
            let inverse = 2.0 / length(q) - (length(p) / mass).powi(2) / parameter;
            TAU / (parameter * inverse.powi(3)).sqrt()
        });
        (1..).zip(periods).filter(|(_, period)| period.is_finite()).min_by(|(_, one), (_, other)| one.total_cmp(other))
    }

    /// Computes |B_Q|/|A_Q| of each planet, from Q.
    pub(crate) fn epsilon(&self, problem: &InitialValueProblem) -> OfPlanets {
        in_coordinates!(self, ratios::<f64>(problem, &()))
    }

    fn ratios<N, C, const D: usize>(&self, problem: &InitialValueProblem, context: &N::Context) -> OfPlanets
    where
        N: Number<Context = ()>,
        C: PlanetaryCoordinates<f64, D> + 'static,
    {
        let mut system = self.at_rest::<f64, C, D>(problem, context);
        // the gradient does not depend on the step size
        let any = Rational::from_integer(1.into());
        let mut close = self.encounters.is_some().then(|| self.close_at_rest::<f64, D>(&any, &()));
        let mut gradient = vec![0.0; self.bodies.count() * D];
        Box::new(move |q| {
            match &mut close {
                Some(close) => close.assign_gradient(q, &mut gradient),
                None => system.assign_gradient(q, &mut gradient),
            }
            let square = |vector: &[f64]| vector.iter().map(|x| x * x).sum::<f64>();
            let planets = system.coordinates().orbits().planets.iter().zip(q.chunks(D).zip(gradient.chunks(D)).skip(1));
            planets.map(|(orbit, (q, gradient))| square(gradient).sqrt() * square(q) / orbit.attraction).collect()
        })
    }

    /// The system at a state in the coordinates of its steps, with its stepper.
    fn moved<N, C, const D: usize, S>(
        &self,
        scheme: S,
        steps: Steps<'_>,
        (problem, (q, p)): &(&InitialValueProblem, State<N>),
        context: &N::Context,
    ) -> SceneIntegrator<N>
    where
        N: CorrectlyRounded + 'static,
        C: PlanetaryCoordinates<N, D> + 'static,
        S: Scheme + ValidFor<C::Class> + 'static,
    {
        let mut system = self.at_rest::<N, C, D>(problem, context);
        if let Some(displacements) = steps.displacements(context) {
            system = system.displaced(displacements);
        }
        if steps.compensated {
            system = system.compensated();
        }
        system.state_mut().set(q, p);
        steps.integrator(scheme, system, context)
    }

    /// The same of planets that may come close to each other.
    fn moved_close<N: CorrectlyRounded + 'static, const D: usize>(
        &self,
        scheme: TableScheme<General>,
        steps: Steps<'_>,
        (_, (q, p)): &(&InitialValueProblem, State<N>),
        context: &N::Context,
    ) -> SceneIntegrator<N> {
        let mut system = self.close_at_rest::<N, D>(steps.h.exact(), context);
        if steps.compensated {
            system = system.compensated();
        }
        system.state_mut().set(q, p);
        steps.integrator(scheme, system, context)
    }

    /// All bodies at 0, for steps of h.
    fn close_at_rest<N: Number, const D: usize>(&self, h: &Rational, context: &N::Context) -> Encounters<N, D> {
        const READ: &str = "it is a state of all bodies, and the distance and the substep were read as positive";
        let CloseEncounters { shells, substeps } = self.encounters.as_ref().expect("planets may come close");
        let zeros = vec![N::zero(context); self.bodies.count() * D];
        let substep = h.abs() / Rational::from_integer((*substeps).into());
        Encounters::new(&self.bodies, (&zeros, &zeros), shells, &substep, context).expect(READ)
    }

    fn energy_at<N: Number + 'static, C: PlanetaryCoordinates<N, D> + 'static, const D: usize>(
        &self,
        problem: &InitialValueProblem,
        context: &N::Context,
    ) -> EnergyAt<N> {
        energy_of(self.at_rest::<N, C, D>(problem, context))
    }

    /// All bodies at 0.
    fn at_rest<N: Number + 'static, C: PlanetaryCoordinates<N, D>, const D: usize>(
        &self,
        problem: &InitialValueProblem,
        context: &N::Context,
    ) -> WisdomHolman<N, C, D, Box<dyn Potential<N>>> {
        let zeros = vec![N::zero(context); self.bodies.count() * D];
        let attracted = WisdomHolman::new(&self.bodies, (&zeros, &zeros), context);
        let beside = attracted.and_then(|planets| planets.beside(problem.beside(self.bodies.particles() > 0, context)));
        beside.expect("it is a state of all bodies, and the reader refuses what heliocentric coordinates do not have")
    }

    /// The coordinates of the steps at an inertial state.
    fn convert<N: Number, C: PlanetaryCoordinates<N, D>, const D: usize>(
        &self,
        (q, p): &State<N>,
        own: (&mut [N], &mut [N]),
        context: &N::Context,
    ) {
        C::new(&self.bodies, context).assign_from_inertial((q, p), own);
    }

    fn positions_by<N: Number<Context = ()>, C: PlanetaryCoordinates<N, D> + 'static, const D: usize>(
        &self,
    ) -> Positions<N> {
        let mut coordinates = C::new(&self.bodies, &());
        Box::new(move |own, q| coordinates.assign_inertial_positions(own, q))
    }

    fn shown_by<N: Number + 'static, C: PlanetaryCoordinates<N, D> + 'static, const D: usize>(
        &self,
        context: &N::Context,
    ) -> ShownCoordinates<N> {
        let mut coordinates = C::new(&self.bodies, context);
        ShownCoordinates::by(self.bodies.count() * D, context, move |state, shown| {
            coordinates.assign_inertial(state, shown)
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::watch::observer::testing;

    /// The rows of a planet and of a particle, if there is one, with the largest interaction.
    fn run(parts: &str, beside: &str, particle: bool) -> (Vec<Vec<f64>>, Option<f64>) {
        let particle = if particle { "[[body]]\nmass = 0\na = 2\ne = 0.1\nM = 70\n" } else { "" };
        let text = format!(
            "[problem]\nparameters = {{ g = 1 }}\nparts = \"{parts}\"\n{beside}\n[[body]]\nmass = 1\n[[body]]\nmass = \
                1e-3\na = 1\ni = 20\n{particle}\
             [run]\nscheme = \"yoshida6-a\"\nstep = \"1/20\"\nuntil = 5\ndigits = \"double\"\n[output]\nenergy = \
             true\ntrajectory = true"
        );
        let scene = testing::read(&text);
        let rows = testing::rows(&scene).split_off(1);
        let rows = rows.iter().map(|row| row.iter().map(|cell| cell.parse().unwrap()).collect()).collect();
        (rows, testing::summary(&scene).interactions().map(|found| found.epsilon))
    }

    /// Bodies with mass have the bits and the interactions that they have without particles, and particles move as with
    /// the parts T(p) and U(q).
    #[test]
    fn energies_of_bodies_and_particles_go_together() {
        for beside in [
            "external = \"m*z^2/20\"",
            "central = \"-3*(g*m0)^2*m/(400*r^2)\"",
            "external = \"m*x^2/90\"\ncentral = \"m/r^3/99\"",
        ] {
            let (with, without) = (run("wisdom-holman", beside, true), run("wisdom-holman", beside, false));
            assert!(
                with.1.is_some_and(|epsilon| epsilon > 1e-3) && with.1 == without.1,
                "{beside}: {:?} {:?}",
                with.1,
                without.1
            );
            let (plain, _) = run("kinetic-potential", beside, true);
            assert_eq!((with.0.len(), without.0.len(), plain.len()), (101, 101, 101));
            for ((with, without), plain) in with.0.iter().zip(&without.0).zip(&plain) {
                // n, t, energy, 9 positions and 9 momenta; 6 of each without the particle
                assert_eq!((&with[..9], &with[12..18]), (&without[..9], &without[9..]), "{beside}");
                assert!(with.iter().zip(plain).all(|(a, b)| (a - b).abs() < 1e-7), "{beside}: {with:?} {plain:?}");
            }
        }
    }
}
