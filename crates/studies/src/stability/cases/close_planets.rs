//! Two planets on circular orbits near each other: Hill's stability, close approaches, and what a run says of them.

use std::f64::consts::TAU;

use crate::stability::prelude::*;
use crate::stability::scene_run::{RunResult, digits, run_scene};

/// The case.
pub(super) struct ClosePlanets;

/// The mass of each planet as a part of the star's.
const MASS: f64 = 1e-5;
/// 2√3 mutual Hill radii.
const STABLE: f64 = 3.464;
/// Up to here the planets are surely in the chaotic zone.
const CHAOTIC: f64 = 2.4;
/// Planets that are nearer than a Hill radius have a close encounter.
const ENCOUNTER: f64 = 1.0;
/// Steps with this number of kicks a period of the inner planet.
const KICKS: f64 = 30.0;
/// An error of H that is lost in an encounter, as a part of H: it oscillates by 1e-6 without.
const LOST: f64 = 1e-4;
const SHORT: &str = "The run of a quick examination is too short; a full one decides.";

impl Case for ClosePlanets {
    type Measured = RunResult;

    fn complete(scheme: &Examined, values: Values) -> Option<Values> {
        (!scheme.has_gradient_kicks()).then_some(values)
    }

    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<RunResult, Error> {
        let h = format!("{:.6e}", TAU / KICKS * trial.evaluations() as f64);
        let steps = (trial.get::<f64>("periods") * TAU / h.parse::<f64>().expect("it is a number")) as u64;
        // (a + 1)/2 mutual Hill radii, Δ times, are a − 1
        let radius = (2.0 * MASS / 3.0).cbrt() * trial.get::<f64>("separation") / 10.0 / 2.0;
        let text = format!(
            "[problem]\nparts = \"wisdom-holman\"\nparameters = {{ g = 1 }}\n\
             [[body]]\nname = \"star\"\nmass = 1\n\
             [[body]]\nname = \"inner\"\nmass = {MASS:e}\na = 1\n\
             [[body]]\nname = \"outer\"\nmass = {MASS:e}\na = {:.6}\nM = 180\n\
             [run]\nscheme = \"{}\"\nstep = {h}\nsteps = {steps}\ndigits = {}\n[output]\nenergy = {{ every = 1000 }}\n",
            (1.0 + radius) / (1.0 - radius),
            trial.name(),
            digits(trial.arithmetic)
        );
        run_scene(text, continues)
    }

    fn judge(all: &[&Done<'_, RunResult>]) -> Vec<Row> {
        let (mut parts, mut verdicts, mut points) = (Vec::new(), Vec::new(), Vec::new());
        for Done { trial, found } in all {
            let separation = trial.get::<f64>("separation") / 10.0;
            let (described, verdict, closest) = outcome(found, separation, !trial.suite.quick);
            parts.push(format!("Δ = {separation:.1}: {described}"));
            verdicts.push(verdict);
            points.extend(closest.map(|closest| (separation, closest.log10())));
        }
        vec![Row::of(&all[0].trial, parts.join("; "), Verdict::of_all(verdicts)).with(points)]
    }
}

/// What a run says, whether it is as predicted, and the closest approach. A run that is not `long` is too short for an
/// encounter that must come, and for a verdict of the monitor: slow oscillations of the modified energy look like
/// permanent changes.
fn outcome(said: &RunResult, separation: f64, long: bool) -> (String, Verdict, Option<f64>) {
    let RunResult::Ended(ended) = said else {
        return ("fails".to_owned(), Verdict::from(separation < STABLE), None);
    };
    let (closest, lost) = (ended.hill_radii.unwrap_or(f64::MAX), ended.energy > LOST);
    let parts = [format!("{closest:.2} Hill radii"), format!("{:.0e}", ended.energy), ended.word().to_owned()];
    let (possible, shown) = match separation > STABLE {
        true => (closest > ENCOUNTER && !lost, !ended.is_reported()),
        false => (!(lost && ended.fine), separation > CHAOTIC || closest < ENCOUNTER),
    };
    let verdict =
        if possible && !shown && !long { Verdict::NotDecided(SHORT) } else { Verdict::from(possible && shown) };
    (parts.join(", "), verdict, Some(closest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stability::scene_run::Ended;

    /// What short runs cannot show is not decided; what contradicts the theory in any run differs.
    #[test]
    fn a_run_that_is_too_short_decides_neither_way() {
        let verdict = |separation, hill_radii, energy, verdict: &str, long| {
            let fine = verdict == "bounded";
            let ended = Ended {
                energy,
                verdict: verdict.to_owned(),
                fine,
                encounters: 0,
                closest: String::new(),
                hill_radii: Some(hill_radii),
                energies: Vec::new(),
                last: Vec::new(),
            };
            outcome(&RunResult::Ended(ended), separation, long).1
        };
        let both = |separation, hill_radii, energy, said| {
            [false, true].map(|long| verdict(separation, hill_radii, energy, said, long))
        };
        use Verdict::{Agrees, Differs, NotDecided};
        let alarm = "the modified energy is not conserved";
        // saba4 and abah864, 400 periods
        assert_eq!(both(8.0, 8.1, 2e-7, alarm), [NotDecided(SHORT), Differs]);
        assert_eq!(both(2.4, 1.15, 3e-4, "undecided"), [NotDecided(SHORT), Differs]);
        assert_eq!(both(8.0, 8.1, 2e-7, "bounded"), [Agrees, Agrees]);
        assert_eq!(both(8.0, 0.9, 2e-7, "bounded"), [Differs, Differs]);
        assert_eq!(both(8.0, 8.1, 2e-4, alarm), [Differs, Differs]);
        assert_eq!(both(2.4, 0.3, 2e-4, "bounded"), [Differs, Differs]);
    }
}
