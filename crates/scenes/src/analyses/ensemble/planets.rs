//! Planets in lanes: trajectories of an ensemble that differ in their initial states, not in their masses.

use shadowstep::number::Lanes;
use shadowstep::shadow::ensemble::{Block, Ensemble, EnsembleError, Outcome};
use shadowstep::systems::wisdom_holman::{DemocraticHeliocentric, Jacobi, PlanetaryCoordinates, WisdomHolman};
use shadowstep::{Scheme, Stepper, ValidFor};

use crate::motion::lanes::{LANES, in_lanes};
use crate::run::start::Steps;
use crate::scene::System;
use crate::scene::split::{CanonicalCoordinates, Planets};
use crate::texts::error::Error;

/// The planets of a system, if there are steps of them in lanes: kicks by the attraction of the bodies alone, and no
/// close encounters.
pub(super) fn in_lanes_of(system: &System) -> Option<&Planets> {
    let planets = system.parts.planets()?;
    (planets.encounters.is_none() && !system.problem.has_energies_of_bodies()).then_some(planets)
}

/// Why trajectories are not computed together.
pub(super) enum Apart {
    /// Their masses differ.
    Masses,
    /// A scene cannot be read.
    Scene(Error),
}

/// All trajectories; `read` makes the system of a trajectory.
///
/// # Errors
/// As [`Ensemble::run_while`]; masses that differ.
pub(super) fn outcomes(
    trajectories: &Ensemble,
    planets: &Planets,
    steps: Steps<'_>,
    read: impl Fn(usize) -> Result<System, Error> + Sync,
    continues: impl Fn() -> bool + Sync,
) -> Result<Vec<Outcome>, EnsembleError<Apart>> {
    use CanonicalCoordinates::{DemocraticHeliocentric as Heliocentric, Jacobi as InJacobi};
    let lanes = InLanes { trajectories, steps, read, continues };
    let mut outcomes = match (planets.coordinates, planets.dimensions) {
        (InJacobi, 2) => lanes.outcomes::<Jacobi<_, 2>, 2, _>(steps.quadratic()),
        (InJacobi, _) => lanes.outcomes::<Jacobi<_, 3>, 3, _>(steps.quadratic()),
        (Heliocentric, 2) => lanes.outcomes::<DemocraticHeliocentric<_, 2>, 2, _>(steps.for_every_kinetic()),
        (Heliocentric, _) => lanes.outcomes::<DemocraticHeliocentric<_, 3>, 3, _>(steps.for_every_kinetic()),
    }?;
    // steps are in other coordinates than rows
    let mut shown = planets.inertial::<f64>(&());
    for Outcome { q, p, .. } in &mut outcomes {
        let (of_q, of_p) = shown.of_state(q, p);
        (*q, *p) = (of_q.to_vec(), of_p.to_vec());
    }
    Ok(outcomes)
}

struct InLanes<'a, R, C> {
    trajectories: &'a Ensemble,
    steps: Steps<'a>,
    read: R,
    continues: C,
}

impl<R: Fn(usize) -> Result<System, Error> + Sync, C: Fn() -> bool + Sync> InLanes<'_, R, C> {
    fn outcomes<K, const D: usize, S>(&self, scheme: S) -> Result<Vec<Outcome>, EnsembleError<Apart>>
    where
        K: PlanetaryCoordinates<Lanes<LANES>, D>,
        S: Scheme<Weights<Lanes<LANES>>: Sync> + ValidFor<K::Class> + Sync,
    {
        let stepper = Stepper::new(scheme, self.steps.h.clone()).expect("the step size was read as nonzero");
        self.trajectories.run_while(&stepper, |block| self.together::<K, D>(&block), &self.continues)
    }

    /// The system of some lanes.
    fn together<K: PlanetaryCoordinates<Lanes<LANES>, D>, const D: usize>(
        &self,
        block: &Block<LANES>,
    ) -> Result<WisdomHolman<Lanes<LANES>, K, D>, Apart> {
        let systems = block.trajectories().map(&self.read).collect::<Result<Vec<System>, Error>>();
        let systems = systems.map_err(Apart::Scene)?;
        let planets = systems.iter().map(in_lanes_of).collect::<Option<Vec<&Planets>>>().ok_or(Apart::Masses)?;
        let first = &planets[0].bodies;
        if planets.iter().any(|own| own.bodies != *first) {
            return Err(Apart::Masses);
        }
        let (q, p): (Vec<_>, Vec<_>) = (in_lanes(|lane| &systems[lane].q), in_lanes(|lane| &systems[lane].p));
        let system = WisdomHolman::new(first, (&q, &p), &()).expect("exact numbers are finite");
        Ok(if self.steps.compensated { system.compensated() } else { system })
    }
}
