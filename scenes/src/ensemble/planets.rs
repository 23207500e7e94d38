//! Planets in lanes: trajectories of an ensemble that differ in their initial states, not in their masses.

use shadowstep::number::Lanes;
use shadowstep::shadow::ensemble::{Block, EnsembleError, Outcome};
use shadowstep::systems::wisdom_holman::{DemocraticHeliocentric, Jacobi, PlanetaryCoordinates, WisdomHolman};
use shadowstep::{Scheme, ValidFor};

use super::{Ensemble, error_of};
use crate::error::Error;
use crate::family::Parsed;
use crate::lanes::{LANES, in_lanes};
use crate::scene::System;
use crate::scene::split::{CanonicalCoordinates, Planets};
use crate::start::Begin;

/// The planets of a system, if there are steps of them in lanes: kicks by the attraction of the bodies alone, and no close encounters.
pub(super) fn in_lanes_of(system: &System) -> Option<&Planets> {
    let planets = system.parts.planets()?;
    (planets.encounters.is_none() && system.problem.beside::<f64>(&()).is_none()).then_some(planets)
}

/// Why trajectories are not computed together.
enum Apart {
    /// Their masses differ.
    Masses,
    /// A scene cannot be read.
    Scene(Error),
}

/// All trajectories; `None` if their masses differ.
///
/// # Errors
/// As [`Ensemble::outcomes`].
pub(super) fn outcomes(
    ensemble: &Ensemble,
    planets: &Planets,
    parsed: &Parsed<'_>,
    continues: impl Fn() -> bool + Sync,
) -> Result<Option<Vec<Outcome>>, Error> {
    use CanonicalCoordinates::{DemocraticHeliocentric as Heliocentric, Jacobi as InJacobi};
    let steps = ensemble.first.steps_from(Begin::InitialState);
    let (ensemble, all) = (&ensemble, (parsed, continues));
    let found = match (planets.coordinates, planets.dimensions) {
        (InJacobi, 2) => computed::<Jacobi<_, 2>, 2, _>(ensemble, steps.quadratic(), all),
        (InJacobi, _) => computed::<Jacobi<_, 3>, 3, _>(ensemble, steps.quadratic(), all),
        (Heliocentric, 2) => computed::<DemocraticHeliocentric<_, 2>, 2, _>(ensemble, steps.for_every_kinetic(), all),
        (Heliocentric, _) => computed::<DemocraticHeliocentric<_, 3>, 3, _>(ensemble, steps.for_every_kinetic(), all),
    };
    let mut outcomes = match found {
        Ok(outcomes) => outcomes,
        Err(EnsembleError::System(Apart::Masses)) => return Ok(None),
        Err(error) => {
            let of_scene = |apart| match apart {
                Apart::Scene(error) => error,
                Apart::Masses => unreachable!("it is no error"),
            };
            return Err(error_of(error, of_scene));
        }
    };
    // steps are in other coordinates than rows
    let mut shown = planets.inertial::<f64>(&());
    for Outcome { q, p, .. } in &mut outcomes {
        let (of_q, of_p) = shown.of_state(q, p);
        (*q, *p) = (of_q.to_vec(), of_p.to_vec());
    }
    Ok(Some(outcomes))
}

fn computed<C, const D: usize, S>(
    ensemble: &Ensemble,
    scheme: S,
    (parsed, continues): (&Parsed<'_>, impl Fn() -> bool + Sync),
) -> Result<Vec<Outcome>, EnsembleError<Apart>>
where
    C: PlanetaryCoordinates<Lanes<LANES>, D>,
    S: Scheme<Weights<Lanes<LANES>>: Sync> + ValidFor<C::Class> + Sync,
{
    let system = |block: Block<LANES>| {
        let systems = block.trajectories().map(|t| ensemble.system(parsed, t)).collect::<Result<Vec<System>, Error>>();
        let systems = systems.map_err(Apart::Scene)?;
        let bodies = |system: &System| in_lanes_of(system).map(|planets| planets.bodies.clone());
        let Some(first) = bodies(&systems[0]) else { return Err(Apart::Masses) };
        if !systems.iter().all(|system| bodies(system).as_ref() == Some(&first)) {
            return Err(Apart::Masses);
        }
        let (q, p): (Vec<_>, Vec<_>) = (in_lanes(|lane| &systems[lane].q), in_lanes(|lane| &systems[lane].p));
        let system = WisdomHolman::<_, C, D>::new(&first, (&q, &p), &()).expect("exact numbers are finite");
        Ok(if ensemble.first.arithmetic.is_compensated() { system.compensated() } else { system })
    };
    ensemble.trajectories().run_while(&ensemble.stepper(scheme), system, continues)
}

#[cfg(test)]
mod tests {
    use shadowstep::tables::Source;

    use super::super::alone;
    use super::*;

    /// A star and planets, which all trajectories have at other places; of the mass 1/1000 times `mass`.
    fn ensemble(parts: &str, digits: &str, planets: usize, mass: &str) -> Ensemble {
        let body = |i| {
            format!(
                "[[body]]\nname = \"p{i}\"\nmass = \"{mass}/{i}\"\na = \"{i} + s/10\"\ne = \"1/5 + s/9\"\ni = \"20 + 10*s\"\nM = \"{i}0 + 100*s\"\n"
            )
        };
        let bodies: String = (1..=planets).map(body).collect();
        let values = (-10..=10).map(|i| format!("\"{i}/20\"")).collect::<Vec<_>>().join(", ");
        let text = format!(
            "[problem]\nparts = \"{parts}\"\nparameters = {{ g = 1 }}\n[[body]]\nname = \"star\"\nmass = 1\n{bodies}\
             [run]\nscheme = \"saba2\"\nstep = \"1/4\"\nsteps = 60\ndigits = \"{digits}\"\n\
             [output]\nmodified_energy = {{ estimator = \"bilinear\", order = 8, every = 20 }}\n\
             [ensemble]\ncolumns = {{ s = [{values}] }}\n"
        );
        Ensemble::read(Source { path: "scene.toml".to_owned(), text }).unwrap_or_else(|error| panic!("{error}"))
    }

    fn together(ensemble: &Ensemble) -> Option<Vec<Outcome>> {
        let planets = in_lanes_of(&ensemble.first.system).unwrap();
        outcomes(ensemble, planets, &ensemble.family.parsed().unwrap(), || true).unwrap()
    }

    #[test]
    fn planets_in_lanes_have_the_bits_of_planets_alone() {
        for parts in ["wisdom-holman", "wisdom-holman-heliocentric"] {
            for (planets, digits) in [(1, "double"), (2, "compensated"), (9, "double")] {
                let ensemble = ensemble(parts, digits, planets, "1/1000");
                let found = together(&ensemble).expect("the masses are the same");
                let parsed = ensemble.family.parsed().unwrap();
                assert_eq!(found.len(), 21);
                for (t, found) in found.iter().enumerate() {
                    let scene = ensemble.scene(&parsed, t).unwrap();
                    let alone = alone::outcome(&scene, ensemble.observed, &|| true).unwrap();
                    assert!(alone.not_finite.is_none() && alone.modified_drift.is_some());
                    assert_eq!(*found, alone, "{parts}, {planets} planets, trajectory {t}");
                }
            }
        }
    }

    #[test]
    fn other_masses_are_computed_alone() {
        let ensemble = ensemble("wisdom-holman", "double", 2, "(1 + s)/1000");
        assert!(together(&ensemble).is_none());
        assert_eq!(ensemble.outcomes(|| true).unwrap().len(), 21);
    }
}
