//! Steps that turn a weakly anharmonic oscillator by a simple part of a turn.

use std::f64::consts::TAU;

use shadowstep::shadow::Verdict as MonitorVerdict;

use crate::stability::linear_step::LinearStep;
use crate::stability::prelude::*;
use crate::stability::watched::MONITOR_ORDER;

/// The case.
pub(super) struct Resonances;

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
/// An orbit that has left.
const LEFT: f64 = 100.0;
/// Off a resonance the invariant varies by a few times the relative anharmonic force: 1/20 for the cubic U, a 400th for
/// the quartic one.
const SMALL_CUBIC: f64 = 1.5;
const SMALL_QUARTIC: f64 = 1.05;
/// At n = 4 the quartic term confines Störmer–Verlet's orbits to a factor of √2 of the invariant; other schemes have
/// less.
const CONFINED: f64 = 1.6;

impl Case for Resonances {
    type Measured = Variation;

    fn measure(trial: &Trial<'_>, _: Continues<'_>) -> Result<Variation, Error> {
        Ok(match turning_step(trial.scheme(), trial.get("n")) {
            Some(h) => vary(trial, h * (1.0 + trial.get::<f64>("off"))),
            None => Variation { ratio: None, verdict: String::new(), fine: false, resonance: false },
        })
    }

    fn judge(all: &[&Done<'_, Variation>]) -> Vec<Row> {
        let at = |one: &Done<'_, Variation>| (one.trial.get::<u32>("n"), one.trial.get::<f64>("off"));
        let off = all.iter().filter(|one| at(one).1 != 0.0).filter_map(|one| one.found.ratio);
        let off_resonance = off.fold(1.0, f64::max);
        let found = joined(all, "; ", |one| one.found.described(at(one)));
        let verdict = Verdict::of_all(all.iter().filter_map(|one| one.found.verdict(at(one), off_resonance)));
        let point = |one: &&Done<'_, Variation>| {
            let (n, off) = at(one);
            Some(((1.0 + off) / f64::from(n), (one.found.ratio? - 1.0).log10()))
        };
        let mut points: Vec<_> = all.iter().filter_map(point).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        vec![Row::of(&all[0].trial, found, verdict).with(points)]
    }
}

impl Variation {
    fn described(&self, (n, off): (u32, f64)) -> String {
        let at = if off == 0.0 { format!("n = {n}") } else { format!("{:+.0} % off 3", 100.0 * off) };
        let says = if self.resonance { ", named" } else { "" };
        match self.ratio {
            None => format!("{at}: beyond the stability limit"),
            Some(ratio) if ratio >= LEFT => format!("{at}: leaves{says}"),
            Some(ratio) => format!("{at}: varies by {ratio:.2}{says}"),
        }
    }

    fn verdict(&self, at: (u32, f64), off_resonance: f64) -> Option<Verdict> {
        let ratio = self.ratio?;
        Some(Verdict::from(match at {
            // what leaves must not be called fine
            (3, 0.0) => ratio > off_resonance && (ratio < LEFT || !self.fine),
            (3, _) => ratio <= SMALL_CUBIC,
            (4, _) => ratio <= CONFINED,
            _ => ratio <= SMALL_QUARTIC,
        }))
    }
}

/// The least h > 0 at which a step of q²/2 turns by 1/n of a turn.
fn turning_step(scheme: &NamedScheme, n: u32) -> Option<f64> {
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

fn vary(trial: &Trial<'_>, h: f64) -> Variation {
    let step = LinearStep::of(&trial.scheme().quadratic(), &rational(h));
    let amplitude = Rational::new(AMPLITUDE.0.into(), AMPLITUDE.1.into());
    let formula = if trial.get::<u32>("n") == 3 { CUBIC } else { QUARTIC };
    let system = of_formula(formula, &[], &["q"], (vec![amplitude], vec![rational(0.0)]));
    let (mut run, steps) = (trial.start(&system, &step_size(h)), trial.steps());
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
