//! Planets on orbits with large eccentricities: whether the kicks resolve the pericentre.

use std::f64::consts::TAU;

use serde::Serialize;
use shadowstep::Scheme;
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_studies::Continues;
use shadowstep_studies::chart::{Axis, Chart, Curve, Mark};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;

use crate::case::Case;
use crate::scene_run::{RunResult, digits, run_scene};
use crate::suite::Suite;

/// The case.
pub(super) struct Pericentres;

/// A planet with another one far outside, or alone.
#[derive(Serialize)]
pub(super) struct Trial {
    scheme: String,
    eccentricity: &'static str,
    /// Steps in the time P_f.
    passage: u32,
    alone: bool,
    periods: u32,
}

const ECCENTRICITIES: [&str; 5] = ["0.5", "0.8", "0.9", "0.95", "0.98"];
const STEPS: [u32; 6] = [1, 2, 4, 8, 16, 32];
/// With this number of steps and more the pericentre is resolved.
const RESOLVED: u32 = 16;
/// An error of H that stays: its largest in the last fourth of the run beside that of the first.
const SAME: f64 = 2.0;
/// Round-off, as a part of H.
const ROUND_OFF: f64 = 1e-10;
const SCHEMES: [&str; 3] = ["stormer-verlet", "saba4", "abah864"];
const ROWS: f64 = 4000.0;

impl Case for Pericentres {
    const NAME: &'static str = "pericentres";
    const TITLE: &'static str = "Wisdom–Holman maps at the pericentre, e = 0.5 … 0.98";
    const THEORY: &'static str = "A planet alone is on its Kepler orbit with any step. With another planet the kicks \
        act at a few places of the pericentre passage. P_f = 2π√((1 − e)³/(1 + e)) is the time of a revolution with \
        the angular velocity there: steps that resolve it keep the error of H bounded, and steps that do not make \
        step-size resonances overlap, so that the energy wanders (Rauch and Holman, Astron. J. 117 (1999) 1087). With \
        16 steps in P_f and more the error of H is the same oscillation from the first to the last passages, and the \
        monitor calls it fine. With one it is larger by more than the 16² of a scheme of order 2.";
    const REVISION: u32 = 1;

    type Trial = Trial;
    type Measured = RunResult;

    fn trials(suite: &Suite) -> Vec<Trial> {
        let periods = suite.full_or_quick(300, 10);
        let mut trials = Vec::new();
        for scheme in suite.schemes_or(&SCHEMES) {
            if scheme.scheme.scheme.proved().scheme.has_gradient_kicks() {
                continue;
            }
            let scheme = &scheme.identity;
            for eccentricity in ECCENTRICITIES {
                let of = |(passage, alone)| Trial { scheme: scheme.clone(), eccentricity, passage, alone, periods };
                trials.extend(STEPS.map(|passage| (passage, false)).into_iter().chain([(1, true)]).map(of));
            }
        }
        trials
    }

    fn seconds(suite: &Suite, trial: &Trial) -> f64 {
        trial.steps().1 as f64 * suite.scheme(&trial.scheme).scheme.summary().evaluations as f64 * 500e-9
    }

    fn measure(
        suite: &Suite,
        trial: &Trial,
        arithmetic: Arithmetic,
        continues: Continues<'_>,
    ) -> Result<RunResult, Error> {
        let (h, steps) = trial.steps();
        let outer = if trial.alone { "" } else { OUTER };
        let text = format!(
            "[problem]\nparts = \"wisdom-holman\"\nparameters = {{ g = 1 }}\nelements = \"jacobi\"\n\
             [[body]]\nname = \"star\"\nmass = 1\n\
             [[body]]\nname = \"inner\"\nmass = 1e-3\na = 1\ne = {}\nM = 180\n{outer}\
             [run]\nscheme = \"{}\"\nstep = {h:e}\nsteps = {steps}\ndigits = {}\n[output]\nenergy = {{ every = {} }}\n",
            trial.eccentricity,
            suite.scheme(&trial.scheme).name,
            digits(arithmetic),
            (steps as f64 / ROWS).ceil()
        );
        run_scene(text, continues)
    }

    fn judge(suite: &Suite, measured: &[(Trial, RunResult)]) -> Finding {
        let mut finding = Finding::default();
        for all in measured.chunk_by(|(one, _), (other, _)| one.scheme == other.scheme) {
            let name = &suite.scheme(&all[0].0.scheme).name;
            let alone = all.iter().filter(|(trial, _)| trial.alone);
            let largest = alone.map(|(_, said)| Outcome::of(said).error).fold(0.0, f64::max);
            let exact = Verdict::from(largest <= ROUND_OFF);
            finding.check(name, format!("a planet alone, a step of P_f: error of H {largest:.0e} at most"), exact);
            for of_orbit in all.chunk_by(|(one, _), (other, _)| one.eccentricity == other.eccentricity) {
                let orbits: Vec<_> = of_orbit.iter().filter(|(trial, _)| !trial.alone).collect();
                let described = orbits.iter().map(|(trial, said)| Outcome::of(said).described(trial.passage));
                let resolved = orbits.iter().filter(|(trial, _)| trial.passage == RESOLVED);
                let resolved = resolved.map(|(_, said)| Outcome::of(said).error).fold(0.0, f64::max);
                let verdicts = orbits.iter().map(|(trial, said)| Outcome::of(said).verdict(trial.passage, resolved));
                let found = format!(
                    "e = {}, steps in P_f: {}",
                    of_orbit[0].0.eccentricity,
                    described.collect::<Vec<_>>().join("; ")
                );
                finding.check(name, found, Verdict::of_all(verdicts));
            }
        }
        finding.chart(chart(suite, measured), "Each mark is an orbit of 300 periods, 10 in a quick examination.");
        finding
    }
}

const OUTER: &str = "[[body]]\nname = \"outer\"\nmass = 0.01\na = 8\nM = 70\n";

impl Trial {
    /// The step size and the number of steps.
    fn steps(&self) -> (f64, u64) {
        let e: f64 = self.eccentricity.parse().expect("it is a number");
        let passage = TAU * ((1.0 - e).powi(3) / (1.0 + e)).sqrt();
        let h = passage / f64::from(self.passage);
        // a few digits, as they are written
        let h: f64 = format!("{h:.6e}").parse().expect("it is a number");
        (h, (f64::from(self.periods) * TAU / h) as u64)
    }
}

/// What became of a run.
struct Outcome {
    /// The largest error of H as a part of it.
    error: f64,
    grows: bool,
    word: String,
    fine: bool,
    reported: bool,
}

impl Outcome {
    fn of(said: &RunResult) -> Outcome {
        let RunResult::Ended(ended) = said else {
            return Outcome { error: f64::MAX, grows: true, word: "fails".to_owned(), fine: false, reported: true };
        };
        let energies = &ended.energies;
        let fourth = energies.len() / 4;
        let largest = |part: &[f64]| part.iter().map(|h| (h - energies[0]).abs()).fold(0.0, f64::max);
        let (first, last) = (largest(&energies[..fourth]), largest(&energies[3 * fourth..]));
        let (fine, reported) = (ended.fine, ended.is_reported());
        Outcome { error: ended.energy, grows: last > SAME * first, word: ended.word().to_owned(), fine, reported }
    }

    fn described(&self, steps: u32) -> String {
        let grows = if self.grows { ", grows" } else { "" };
        format!("{steps}: {:.0e}{grows}, {}", self.error, self.word)
    }

    /// With a number of steps in P_f, beside the error of steps that resolve it.
    fn verdict(&self, steps: u32, resolved: f64) -> Verdict {
        match steps {
            1 => Verdict::from(self.error > f64::from(RESOLVED * RESOLVED) * resolved),
            2..RESOLVED => Verdict::Agrees,
            _ if self.error < ROUND_OFF => Verdict::from(!self.reported),
            _ => Verdict::from(!self.grows && self.fine),
        }
    }
}

fn chart(suite: &Suite, measured: &[(Trial, RunResult)]) -> Chart {
    let mut curves = Vec::new();
    let scheme = &measured.first().map_or(String::new(), |(trial, _)| trial.scheme.clone());
    for (i, eccentricity) in ECCENTRICITIES.iter().enumerate() {
        let own = measured
            .iter()
            .filter(|(trial, _)| trial.scheme == *scheme && trial.eccentricity == *eccentricity && !trial.alone);
        let points: Vec<_> = own
            .map(|(trial, said)| (f64::from(trial.passage).log10(), Outcome::of(said).error.log10()))
            .filter(|(_, error)| *error < 10.0)
            .collect();
        curves.push(Curve::marked(format!("e = {eccentricity}"), points, i));
    }
    let name = if scheme.is_empty() { "" } else { &suite.scheme(scheme).name };
    let (x, y) = (Axis::log10("steps in P_f"), Axis::log10("largest error of H, as a part of H(0)"));
    let mut chart = Chart::new(format!("Pericentres with a perturbation, {name}"), x, y, curves);
    chart.marks.push(Mark::at(f64::from(RESOLVED).log10(), "16"));
    chart
}
