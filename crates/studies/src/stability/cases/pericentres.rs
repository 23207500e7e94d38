//! Planets on orbits with large eccentricities: whether the kicks resolve the pericentre.

use std::f64::consts::TAU;

use crate::chart::{Axis, Chart, Curve, Mark};
use crate::stability::prelude::*;
use crate::stability::scene_run::{RunResult, digits, run_scene};

/// The case.
pub(super) struct Pericentres;

/// With this number of steps and more the pericentre is resolved.
const RESOLVED: u32 = 16;
/// An error of H that stays: its largest in the last fourth of the run beside that of the first.
const SAME: f64 = 2.0;
/// Round-off, as a part of H.
const ROUND_OFF: f64 = 1e-10;
const ROWS: f64 = 4000.0;

impl Case for Pericentres {
    type Measured = RunResult;

    fn complete(scheme: &Examined, values: Values) -> Option<Values> {
        (!scheme.has_gradient_kicks()).then_some(values)
    }

    fn seconds(trial: &Trial<'_>) -> f64 {
        steps(trial).1 as f64 * trial.seconds()
    }

    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<RunResult, Error> {
        let (h, steps) = steps(trial);
        let outer = if trial.get("alone") { "" } else { OUTER };
        let text = format!(
            "[problem]\nparts = \"wisdom-holman\"\nparameters = {{ g = 1 }}\nelements = \"jacobi\"\n\
             [[body]]\nname = \"star\"\nmass = 1\n\
             [[body]]\nname = \"inner\"\nmass = 1e-3\na = 1\ne = {}\nM = 180\n{outer}\
             [run]\nscheme = \"{}\"\nstep = {h:e}\nsteps = {steps}\ndigits = {}\n[output]\nenergy = {{ every = {} }}\n",
            eccentricity(trial),
            trial.name(),
            digits(trial.arithmetic),
            (steps as f64 / ROWS).ceil()
        );
        run_scene(text, continues)
    }

    fn judge(all: &[&Done<'_, RunResult>]) -> Vec<Row> {
        let (alone, orbits): (Vec<_>, Vec<_>) = all.iter().partition(|one| one.trial.get("alone"));
        let error = |one: &&&Done<'_, RunResult>| Outcome::of(&one.found).error;
        let most = largest(alone.iter().map(error));
        let found = format!("a planet alone, a step of P_f: error of H {most:.0e} at most");
        let mut rows = vec![Row::of(&all[0].trial, found, most <= ROUND_OFF)];
        for orbit in orbits.chunk_by(|one, other| eccentricity(&one.trial) == eccentricity(&other.trial)) {
            let passage = |one: &Done<'_, RunResult>| one.trial.get::<u32>("passage");
            let described = joined(orbit, "; ", |one| Outcome::of(&one.found).described(passage(one)));
            let resolved = largest(orbit.iter().filter(|one| passage(one) == RESOLVED).map(error));
            let verdicts = orbit.iter().map(|one| Outcome::of(&one.found).verdict(passage(one), resolved));
            let found = format!("e = {}, steps in P_f: {described}", eccentricity(&orbit[0].trial));
            rows.push(Row::of(&orbit[0].trial, found, Verdict::of_all(verdicts)));
        }
        rows
    }

    fn finish(finding: &mut Finding, all: &[Done<'_, RunResult>]) {
        finding.chart(chart(all), "Each mark is an orbit of 300 periods, 10 in a quick examination.");
    }
}

const OUTER: &str = "[[body]]\nname = \"outer\"\nmass = 0.01\na = 8\nM = 70\n";

fn eccentricity(trial: &Trial<'_>) -> String {
    trial.get("eccentricity")
}

/// The step size and the number of steps.
fn steps(trial: &Trial<'_>) -> (f64, u64) {
    let e: f64 = eccentricity(trial).parse().expect("it is a number");
    let passage = TAU * ((1.0 - e).powi(3) / (1.0 + e)).sqrt();
    let h = passage / trial.get::<f64>("passage");
    // a few digits, as they are written
    let h: f64 = format!("{h:.6e}").parse().expect("it is a number");
    (h, (trial.get::<f64>("periods") * TAU / h) as u64)
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

/// The orbits of the first scheme.
fn chart(all: &[Done<'_, RunResult>]) -> Chart {
    let name = all.first().map_or("", |one| one.trial.name());
    let of_first = all.iter().filter(|one| one.trial.name() == name && !one.trial.get::<bool>("alone"));
    let of_first: Vec<_> = of_first.collect();
    let curve = |(i, orbit): (usize, &[&Done<'_, RunResult>])| {
        let points = orbit
            .iter()
            .map(|one| (one.trial.get::<f64>("passage").log10(), Outcome::of(&one.found).error.log10()))
            .filter(|(_, error)| *error < 10.0);
        Curve::marked(format!("e = {}", eccentricity(&orbit[0].trial)), points.collect(), i)
    };
    let orbits = of_first.chunk_by(|one, other| eccentricity(&one.trial) == eccentricity(&other.trial));
    let (x, y) = (Axis::log10("steps in P_f"), Axis::log10("largest error of H, as a part of H(0)"));
    let title = format!("Pericentres with a perturbation, {name}");
    let mut chart = Chart::new(title, x, y, orbits.enumerate().map(curve).collect());
    chart.marks.push(Mark::at(f64::from(RESOLVED).log10(), "16"));
    chart
}
