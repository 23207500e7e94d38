//! Steps that turn a weakly anharmonic oscillator by a simple part of a turn.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};
use shadowstep::shadow::Verdict as MonitorVerdict;
use shadowstep::{Rational, Scheme};
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::library::NamedScheme;
use shadowstep_scenes::start::Begin;
use shadowstep_studies::Continues;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;

use crate::case::Case;
use crate::integrator::{self, start_in};
use crate::linear_step::LinearStep;
use crate::suite::{Examined, Suite};
use crate::systems::{of_formula, rational};
use crate::watched::MONITOR_ORDER;

/// The case.
pub(super) struct Resonances;

/// A scheme with a step that turns the oscillator by a part of a turn.
#[derive(Serialize)]
pub(super) struct Trial {
    scheme: String,
    /// A step turns by 1/n of a turn.
    n: u32,
    /// By how much hω is off the resonance, relatively.
    off: f64,
    steps: u64,
}

/// What a run has shown.
#[derive(Serialize, Deserialize)]
pub(super) struct Variation {
    /// Largest over least value of the invariant of the linear step; `None` if the scheme is unstable before it turns
    /// so far.
    ratio: Option<f64>,
    /// What the monitor reported.
    verdict: String,
    fine: bool,
    resonance: bool,
}

/// U where n is 3, from q = 1/20: the anharmonic force is a twentieth of the linear one.
const CUBIC: &str = "q^2/2 + q^3/3";
/// U where n is larger: it is a 400th.
const QUARTIC: &str = "q^2/2 + q^4/4";
const AMPLITUDE: (i64, i64) = (1, 20);
/// Off a resonance.
const OFF: f64 = 0.08;
/// An orbit that has left.
const LEFT: f64 = 100.0;
/// Off a resonance the invariant varies by a few times the relative anharmonic force: 1/20 for the cubic U, a 400th for
/// the quartic one.
const SMALL_CUBIC: f64 = 1.5;
const SMALL_QUARTIC: f64 = 1.05;
/// At n = 4 the quartic term confines Störmer–Verlet's orbits to a factor of √2 of the invariant; other schemes have
/// less.
const CONFINED: f64 = 1.6;
const SCHEMES: [&str; 4] = ["stormer-verlet", "yoshida4", "blanes-moan-s6", "blanes-moan-srkn6b"];

impl Case for Resonances {
    const NAME: &'static str = "resonances";
    const TITLE: &'static str = "Step-size resonances, hω = 2 sin(π/n) for Störmer–Verlet";
    const THEORY: &'static str = "Where a step turns the oscillator q²/2 by exactly 1/n of a turn, a term q^n of U \
        acts in the same direction at every n-th step, and no modified energy of the usual form exists. At n = 3 and \
        U = q²/2 + q³/3 small orbits change the quadratic invariant of the linear step by more than off the \
        resonance, those of Störmer–Verlet without a bound, which the monitor does not call fine. At n = 4 and U = \
        q²/2 + q⁴/4 they are confined; at n = 5, 7 and off the resonances the invariant varies in proportion to the \
        anharmonic force only.";
    const REVISION: u32 = 1;

    type Trial = Trial;
    type Measured = Variation;

    fn trials(suite: &Suite) -> Vec<Trial> {
        let steps = suite.full_or_quick(200_000, 20_000);
        let schemes = suite.schemes_or(&SCHEMES);
        let trials = |scheme: &&Examined| {
            let at = [3, 4, 5, 7].map(|n| (n, 0.0));
            let all = at.into_iter().chain([(3, -OFF), (3, OFF)]);
            all.map(|(n, off)| Trial { scheme: scheme.identity.clone(), n, off, steps }).collect::<Vec<_>>()
        };
        schemes.iter().flat_map(trials).collect()
    }

    fn seconds(suite: &Suite, trial: &Trial) -> f64 {
        trial.steps as f64 * suite.scheme(&trial.scheme).scheme.summary().evaluations as f64 * 200e-9
    }

    fn measure(suite: &Suite, trial: &Trial, arithmetic: Arithmetic, _: Continues<'_>) -> Result<Variation, Error> {
        let scheme = suite.scheme(&trial.scheme);
        Ok(match step_size(scheme, trial.n) {
            Some(h) => vary(scheme, (h * (1.0 + trial.off), trial.n == 3), trial.steps, arithmetic),
            None => Variation { ratio: None, verdict: String::new(), fine: false, resonance: false },
        })
    }

    fn judge(suite: &Suite, measured: &[(Trial, Variation)]) -> Finding {
        let (mut finding, mut curves) = (Finding::default(), Vec::new());
        for all in measured.chunk_by(|(one, _), (other, _)| one.scheme == other.scheme) {
            let (found, verdict) = compared(all);
            let name = &suite.scheme(&all[0].0.scheme).name;
            finding.check(name, found, verdict);
            let point = |(trial, variation): &(Trial, Variation)| {
                Some(((1.0 + trial.off) / f64::from(trial.n), (variation.ratio? - 1.0).log10()))
            };
            let mut points: Vec<_> = all.iter().filter_map(point).collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            curves.push(Curve::marked(name.clone(), points, curves.len()));
        }
        let (x, y) = (Axis::linear("turns a step, approximately"), Axis::log10("relative variation of the invariant"));
        finding.chart(
            Chart::new("How far steps near resonances carry small orbits", x, y, curves),
            "U = q²/2 + q³/3 at a third of a turn and 8 % beside it, q²/2 + q⁴/4 at 1/4, 1/5 and 1/7; an orbit that \
                leaves is at 99.",
        );
        finding
    }
}

fn compared(all: &[(Trial, Variation)]) -> (String, Verdict) {
    let mut parts = Vec::new();
    let mut verdicts = Vec::new();
    let off = all.iter().filter(|(trial, _)| trial.off != 0.0).filter_map(|(_, variation)| variation.ratio);
    let off_resonance = off.fold(1.0, f64::max);
    for (trial, variation) in all {
        let at = match trial.off {
            0.0 => format!("n = {}", trial.n),
            off => format!("{:+.0} % off 3", 100.0 * off),
        };
        let Some(ratio) = variation.ratio else {
            parts.push(format!("{at}: beyond the stability limit"));
            continue;
        };
        let resonant = trial.n == 3 && trial.off == 0.0;
        let says = if variation.resonance { ", named" } else { "" };
        parts.push(match ratio >= LEFT {
            true => format!("{at}: leaves{says}"),
            false => format!("{at}: varies by {ratio:.2}{says}"),
        });
        verdicts.push(Verdict::from(match (resonant, trial.n) {
            // what leaves must not be called fine
            (true, _) => ratio > off_resonance && (ratio < LEFT || !variation.fine),
            (false, 3) => ratio <= SMALL_CUBIC,
            (false, 4) => ratio <= CONFINED,
            (false, _) => ratio <= SMALL_QUARTIC,
        }));
    }
    (parts.join("; "), Verdict::of_all(verdicts))
}

/// The least h > 0 at which a step of q²/2 turns by 1/n of a turn.
fn step_size(scheme: &NamedScheme, n: u32) -> Option<f64> {
    let target = (TAU / f64::from(n)).cos();
    let cosine = |h: f64| LinearStep::of(&scheme.quadratic(), &rational(h)).cosine();
    // no scheme turns by more than twice its angle, so that this bracket has one crossing
    let (mut low, mut high) = (0.0, None);
    for i in 1..=200 {
        let h = TAU / f64::from(n) * f64::from(i) / 100.0;
        let cosine = cosine(h);
        if cosine <= target {
            high = Some(h);
            break;
        }
        if cosine > 1.0 {
            return None;
        }
        low = h;
    }
    let mut high = high?;
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if cosine(middle) > target { low = middle } else { high = middle }
    }
    Some(high)
}

fn vary(scheme: &NamedScheme, (h, cubic): (f64, bool), steps: u64, arithmetic: Arithmetic) -> Variation {
    let step = LinearStep::of(&scheme.quadratic(), &rational(h));
    let amplitude = Rational::new(AMPLITUDE.0.into(), AMPLITUDE.1.into());
    let start = (vec![amplitude], vec![rational(0.0)]);
    let system = of_formula(if cubic { CUBIC } else { QUARTIC }, &[], &["q"], start);
    let h = integrator::step_size(h);
    let mut run = start_in(arithmetic, &system, integrator::steps_of(scheme, &h, Begin::Step));
    run.watch(MONITOR_ORDER, (steps / 256).max(1));
    let (mut least, mut largest) = (f64::INFINITY, 0.0_f64);
    for _ in 0..steps {
        let finite = run.watched_step().is_ok();
        let invariant = step.invariant(run.q(0), run.p(0));
        (least, largest) = (least.min(invariant), largest.max(invariant));
        if !finite || largest > LEFT * least || invariant.is_nan() || least < 0.0 {
            largest = largest.max(LEFT * least.abs());
            break;
        }
    }
    let ratio = if largest >= LEFT * least { LEFT } else { largest / least };
    let said = run.monitor_outcome().verdict;
    Variation {
        ratio: Some(ratio),
        verdict: said.to_string(),
        fine: said.is_bounded(),
        resonance: matches!(said, MonitorVerdict::NearResonance { .. }),
    }
}
