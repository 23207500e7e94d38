//! Kepler's problem with eccentricities from 0 to 0.999 and steps from fine to hopeless: when the monitor says that a
//! step is too large, and when the orbit is lost.

use std::f64::consts::TAU;

use num_traits::FromPrimitive;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use serde_json::json;
use shadowstep_schemes::symbolic::decimal::to_text;

use crate::chart::{Axis, Chart, Curve, Marker};
use crate::stability::prelude::*;
use crate::stability::watched::watched;

/// The case.
pub(super) struct Kepler;

/// What became of an orbit that begins at its apocentre.
#[derive(Serialize, Deserialize)]
pub(super) struct Orbit {
    watched: Watched,
    /// The first state at which it is unbound, or its semi-major axis has changed by a factor of 2: far from the
    /// centre.
    lost: Option<u64>,
    /// The largest change of the energy between apocentres as a part of it, in the first and in the second half of the
    /// run.
    changes: [f64; 2],
}

/// A window at every step, so that the monitor gives its verdict as early as it can.
const EVERY: u64 = 1;
/// By then it has the windows for one.
const FIRST_VERDICT: u64 = 25;
/// Orbits are drawn again if fewer periods can be computed.
const LEAST_PERIODS: f64 = 10.0;
const SEED: u64 = 20_061_122;
/// The energy is looked at farther from the centre than the semi-major axis.
const FAR: f64 = 1.0;
/// An orbit is kept if its energy at the apocentres changes by less, and by less than this part of the energy error.
const KEPT: f64 = 0.01;
const PART: f64 = 0.25;
/// The monitor calls an energy error too large from this part of T on.
const AS_LARGE: f64 = 0.4;
/// The most alarms on orbits that are kept.
const FALSE_ALARMS: f64 = 0.02;
const FEW: &str = "Fewer than 20 orbits do not show that nothing is missed; a full examination has more.";

impl Case for Kepler {
    type Measured = Orbit;

    fn trials<'a>(suite: &'a Suite, table: &'a Table) -> Vec<Trial<'a>> {
        let mut random = Pcg64Mcg::seed_from_u64(SEED);
        let schemes = table.schemes(suite);
        let (count, most_steps) = suite.full_or_quick((500, 200_000.0), (60, 10_000.0));
        let mut uniform = move |from: f64, to: f64| {
            let unit = (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
            from + (to - from) * unit
        };
        let mut trials = Vec::new();
        while trials.len() < count {
            let scheme = schemes[trials.len() % schemes.len()];
            let gap = 10_f64.powf(uniform(-3.0, 0.0));
            // a part of the period of a circle through the pericentre, for each evaluation of the force
            let part = 10_f64.powf(uniform(-2.7, -0.5));
            let h = part * TAU * gap.powf(1.5) * scheme.evaluations() as f64;
            let steps = (300.0 * TAU / h).min(most_steps);
            if steps * h >= LEAST_PERIODS * TAU {
                let [eccentricity, h] = [1.0 - gap, h].map(short);
                let values = json!({ "eccentricity": eccentricity, "h": h, "steps": steps as u64 });
                let values = values.as_object().cloned().expect("it is an object");
                trials.push(Trial::of(suite, table, scheme, values));
            }
        }
        trials
    }

    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<Orbit, Error> {
        let apocentre = [
            ("eccentricity", trial.get("eccentricity")),
            ("x", "1 + eccentricity".to_owned()),
            ("py", "sqrt((1 - eccentricity)/(1 + eccentricity))".to_owned()),
        ];
        let run = &mut *trial.start(&shipped("kepler", &apocentre), &step_size(&*trial.get::<String>("h")));
        let mut apocentres = Apocentres { half: trial.steps() / 2, ..Apocentres::default() };
        let watched = watched(run, EVERY, trial.steps(), continues, &mut |n, run| {
            apocentres.include(n, [run.q(0), run.q(1)], [run.p(0), run.p(1)]);
            ControlFlow::Continue(())
        });
        Ok(Orbit { watched, lost: apocentres.lost, changes: apocentres.changes })
    }

    fn judge(all: &[&Done<'_, Orbit>]) -> Vec<Row> {
        let counts = Counts::of(all.iter().map(|one| &one.found));
        vec![Row::of(&all[0].trial, counts.described(), counts.verdict())]
    }

    fn finish(finding: &mut Finding, all: &[Done<'_, Orbit>]) {
        let counts = Counts::of(all.iter().map(|one| &one.found)).described();
        finding.found(format!("All {} orbits, drawn with the seed {SEED}: {counts}.", all.len()));
        finding.chart(chart(all), "Each orbit is at most 300 periods long, and starts at its apocentre.");
    }
}

/// A number with few digits, to be read.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.4e}").parse().expect("it is a number");
    to_text(&Rational::from_f64(rounded).expect("it is finite"))
}

/// Follows the energy far from the centre.
#[derive(Default)]
struct Apocentres {
    half: u64,
    /// The distances of the last two states.
    before: [f64; 2],
    lost: Option<u64>,
    changes: [f64; 2],
}

/// H of every orbit with a semi-major axis of 1.
const ENERGY: f64 = -0.5;

impl Apocentres {
    fn include(&mut self, n: u64, q: [f64; 2], p: [f64; 2]) {
        let distance = q[0].hypot(q[1]);
        let [last, before_last] = self.before;
        self.before = [distance, last];
        if distance < FAR {
            return;
        }
        let energy = (p[0] * p[0] + p[1] * p[1]) / 2.0 - 1.0 / distance;
        // a = −1/2E
        if !(2.0 * ENERGY..=ENERGY / 2.0).contains(&energy) {
            self.lost.get_or_insert(n);
        }
        // the state before this one was the farthest: the energy there is nearly this one
        if last > before_last && last >= distance {
            let change = &mut self.changes[usize::from(n > self.half)];
            *change = change.max(((energy - ENERGY) / ENERGY).abs()).min(f64::MAX);
        }
    }
}

/// What became of an orbit, and what the monitor reported of it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Outcome {
    Kept { alarm: bool },
    Changed { alarm: bool },
    LostAtOnce,
    LostReportedBefore,
    LostReportedAfter,
    LostNotReported,
}

impl Orbit {
    fn outcome(&self) -> Outcome {
        let alarm = self.watched.alarm;
        match (self.lost, alarm) {
            (Some(lost), Some(alarm)) if alarm <= lost => Outcome::LostReportedBefore,
            (Some(lost), Some(_)) if lost < FIRST_VERDICT => Outcome::LostAtOnce,
            (Some(_), Some(_)) => Outcome::LostReportedAfter,
            (Some(_), None) if self.watched.finite && self.watched.fine => Outcome::LostNotReported,
            (Some(_), None) => Outcome::LostReportedAfter,
            (None, _) => {
                let error = self.watched.energy_error.unwrap_or(f64::INFINITY);
                let kept = self.changes.into_iter().all(|change| change <= (PART * error).min(KEPT));
                // an energy error as large as T is reported whatever is conserved
                let alarm = alarm.is_some() && error < AS_LARGE;
                if kept { Outcome::Kept { alarm } } else { Outcome::Changed { alarm } }
            }
        }
    }
}

/// The outcomes of orbits.
struct Counts {
    outcomes: Vec<Outcome>,
    /// Parts of the time to the loss at which it was reported, in their order.
    parts: Vec<f64>,
}

impl Counts {
    fn of<'a>(orbits: impl Iterator<Item = &'a Orbit> + Clone) -> Counts {
        let before = orbits.clone().filter(|orbit| orbit.outcome() == Outcome::LostReportedBefore);
        let part = |orbit: &Orbit| Some(orbit.watched.alarm? as f64 / orbit.lost? as f64);
        let mut parts: Vec<f64> = before.filter_map(part).collect();
        parts.sort_by(f64::total_cmp);
        Counts { outcomes: orbits.map(Orbit::outcome).collect(), parts }
    }

    fn count(&self, outcome: Outcome) -> usize {
        self.outcomes.iter().filter(|other| **other == outcome).count()
    }

    /// How many are kept, and how many of them are reported.
    fn kept(&self) -> (usize, usize) {
        let alarms = self.count(Outcome::Kept { alarm: true });
        (self.count(Outcome::Kept { alarm: false }) + alarms, alarms)
    }

    fn described(&self) -> String {
        use Outcome::{Changed, LostAtOnce, LostNotReported, LostReportedAfter, LostReportedBefore};
        let [at_once, before, after, not_reported] =
            [LostAtOnce, LostReportedBefore, LostReportedAfter, LostNotReported].map(|lost| self.count(lost));
        let [silent, reported] = [false, true].map(|alarm| self.count(Changed { alarm }));
        let ((kept, false_alarms), changed) = (self.kept(), silent + reported);
        let median = self.parts.get(self.parts.len() / 2);
        let early = median.map_or(String::new(), |part| format!(" (after {part:.2} of the time, median)"));
        format!(
            "{} lost: {at_once} before a verdict is possible, {before} reported before{early}, {after} with or after \
             the loss, {not_reported} called fine; {kept} kept, {false_alarms} of them reported; {changed} changed \
             without a loss, {reported} of them reported",
            at_once + before + after + not_reported
        )
    }

    fn verdict(&self) -> Verdict {
        let (kept, false_alarms) = self.kept();
        match () {
            () if self.count(Outcome::LostNotReported) > 0 => Verdict::Differs,
            () if false_alarms as f64 > FALSE_ALARMS * kept as f64 => Verdict::Differs,
            // a few orbits do not show that nothing is missed
            () if self.outcomes.len() < 20 => Verdict::NotDecided(FEW),
            () => Verdict::Agrees,
        }
    }
}

/// A label, which outcomes it is for, and their marker.
type OutcomeMarker = (&'static str, fn(Outcome) -> bool, Marker);

fn chart(all: &[Done<'_, Orbit>]) -> Chart {
    let kinds: [OutcomeMarker; 7] = [
        ("kept", |o| o == Outcome::Kept { alarm: false }, Marker::Circle),
        ("kept, reported", |o| o == Outcome::Kept { alarm: true }, Marker::FilledSquare),
        ("changed", |o| matches!(o, Outcome::Changed { .. }), Marker::Plus),
        ("lost at once", |o| o == Outcome::LostAtOnce, Marker::Nabla),
        ("lost, reported before", |o| o == Outcome::LostReportedBefore, Marker::Triangle),
        ("lost, reported after", |o| o == Outcome::LostReportedAfter, Marker::Cross),
        ("lost, called fine", |o| o == Outcome::LostNotReported, Marker::FilledTriangle),
    ];
    let place = |trial: &Trial<'_>| {
        let number = |name: &str| trial.get::<String>(name).parse::<f64>().unwrap_or(f64::NAN);
        let gap = 1.0 - number("eccentricity");
        (gap.log10(), (number("h") / trial.evaluations() as f64 / (TAU * gap.powf(1.5))).log10())
    };
    let curves = kinds.iter().enumerate().filter_map(|(i, (label, is_of, marker))| {
        let own = all.iter().filter(|one| is_of(one.found.outcome()));
        let points: Vec<_> = own.map(|one| place(&one.trial)).collect();
        (!points.is_empty()).then(|| Curve::dots(*label, points, i, *marker))
    });
    Chart::new(
        "Which orbits are lost, and when that is reported",
        Axis::log10("1 − e"),
        Axis::log10("h per evaluation, in pericentre periods"),
        curves.collect(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn orbit(lost: Option<u64>, alarm: Option<u64>, changes: [f64; 2], energy_error: f64, fine: bool) -> Orbit {
        let watched = Watched {
            steps: 1000,
            finite: true,
            energy_error: Some(energy_error),
            verdict: String::new(),
            fine,
            undecided: false,
            alarm,
            alarmed: None,
        };
        Orbit { watched, lost, changes }
    }

    #[test]
    fn outcomes_follow_from_loss_and_alarm() {
        let quiet = [1e-6; 2];
        assert!(orbit(None, None, quiet, 1e-3, true).outcome() == Outcome::Kept { alarm: false });
        assert!(orbit(None, Some(500), quiet, 1e-3, false).outcome() == Outcome::Kept { alarm: true });
        assert!(orbit(None, Some(500), quiet, 0.5, false).outcome() == Outcome::Kept { alarm: false }, "as large as T");
        assert!(orbit(None, Some(500), [8e-4, 9e-4], 1e-3, false).outcome() == Outcome::Changed { alarm: true });
        assert!(orbit(Some(700), Some(500), quiet, 1.0, false).outcome() == Outcome::LostReportedBefore);
        assert!(orbit(Some(400), Some(500), quiet, 1.0, false).outcome() == Outcome::LostReportedAfter);
        assert!(orbit(Some(3), Some(500), quiet, 1.0, false).outcome() == Outcome::LostAtOnce);
        assert!(orbit(Some(400), None, quiet, 1e-3, true).outcome() == Outcome::LostNotReported);
    }

    #[test]
    fn a_loss_that_is_called_fine_differs() {
        let kept: Vec<_> = (0..40).map(|_| orbit(None, None, [1e-6; 2], 1e-3, true)).collect();
        assert_eq!(Counts::of(kept.iter()).verdict(), Verdict::Agrees);
        let lost = orbit(Some(400), None, [1e-6; 2], 1e-3, true);
        assert_eq!(Counts::of(kept.iter().chain([&lost])).verdict(), Verdict::Differs);
        let alarms = [(); 2].map(|()| orbit(None, Some(500), [1e-6; 2], 1e-3, false));
        assert_eq!(Counts::of(kept.iter().chain(&alarms)).verdict(), Verdict::Differs, "2 of 42");
        assert_eq!(Counts::of(kept[..5].iter()).verdict(), Verdict::NotDecided(FEW));
    }
}
