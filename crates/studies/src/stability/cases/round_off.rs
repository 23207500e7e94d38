//! Round-off over 10⁵ to 10⁸ steps in double precision.

use std::f64::consts::TAU;

use shadowstep::steps::integrator::VectorIntegrator;
use shadowstep_scenes::start::Steps;

use crate::stability::prelude::*;

/// The case.
pub(super) struct RoundOff;

/// The change of the modified energy since the start, as a part of |H|, at each number of steps.
#[derive(Serialize, Deserialize)]
pub(super) struct Changes {
    changes: Vec<f64>,
    /// The error of an estimate.
    error: f64,
}

const PHASES: u32 = 32;
const ECCENTRICITY: f64 = 0.2;
/// Estimates of order 16, of which the best of a period counts.
const ORDER: u32 = 16;
/// A wander of n^a has a from 0.35 to 0.65, for the spread of 32 phases over two decades; a drift has 1.
const WANDERS: (f64, f64) = (0.35, 0.65);
/// Compensated sums wander less by this factor at least.
const GAIN: f64 = 10.0;
const GAIN_BETWEEN: &str = "With its uncertainty the gain is on both sides of 10; more phases would decide.";
const LIKE_A_WANDER: &str = "What is seen is neither a wander alone nor a drift alone; longer runs would part them.";
/// A drift of the mean over the phases is seen beyond this multiple of its standard error.
const SEEN: f64 = 3.0;
const ENERGY: f64 = -0.5;

impl Case for RoundOff {
    type Measured = Changes;

    fn complete(scheme: &Examined, mut values: Values) -> Option<Values> {
        // the same number of evaluations, to a factor of a few
        let longest = values.remove("decades")?.as_u64()? as u32 - u32::from(scheme.evaluations() > 1);
        let steps = (2 * (longest - 3)..=2 * longest).map(|half| 10_f64.powf(f64::from(half) / 2.0) as u64);
        values.insert("steps".to_owned(), steps.collect());
        Some(values)
    }

    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<Changes, Error> {
        let h = trial.step();
        let (q, p) = start_at(trial.get::<f64>("phase") / f64::from(PHASES));
        let mut system = shipped("kepler", &[]);
        [system.problem.q, system.problem.p] = [q, p].map(|values| known_values(values.map(rational)));
        let compensated = trial.get::<String>("sums") == "Compensated";
        let steps = Steps { compensated, ..steps_of(trial.scheme(), &h, Begin::Step) };
        let orbit = &mut *start::<f64>(&system, steps, &());
        let (initial, mut error) = modified_energy(orbit);
        let (mut n, mut changes) = (0, Vec::new());
        for steps in trial.get::<Vec<u64>>("steps") {
            while n < steps {
                let next = (n + 1_000_000).min(steps);
                orbit.steps(next - n);
                n = next;
                if !continues(n as f64 / trial.steps() as f64) {
                    return Ok(Changes { changes, error });
                }
            }
            // the orbit goes on from here: the estimate's steps are not counted
            let here = orbit.state().clone();
            let (value, own_error) = modified_energy(orbit);
            orbit.system().state_mut().set(here.q(), here.p());
            orbit.system().state_mut().set_remainders(&here.remainders());
            error = error.max(own_error);
            changes.push((value - initial) / ENERGY);
        }
        Ok(Changes { changes, error: error / ENERGY.abs() })
    }

    fn judge(all: &[&Done<'_, Changes>]) -> Vec<Row> {
        let sums = |one: &Done<'_, Changes>| one.trial.get::<String>("sums");
        let by_sums = all.chunk_by(|one, other| sums(one) == sums(other));
        let wanders = by_sums.filter_map(|own| {
            let changes: Vec<_> = own.iter().map(|one| &one.found).collect();
            Some((sums(own[0]).to_lowercase(), Wander::of(&own[0].trial.get::<Vec<u64>>("steps"), &changes)?))
        });
        let wanders: Vec<_> = wanders.collect();
        let trial = &all[0].trial;
        let row = |(sums, wander): &(String, Wander)| {
            let points = wander.rms.iter().map(|(n, rms)| (n.log10(), rms.log10()));
            let label = format!("{}, {sums}", trial.name());
            Row::of(trial, wander.described(), wander.verdict()).labelled(label).with(points)
        };
        let mut rows: Vec<_> = wanders.iter().map(row).collect();
        if let [(_, plain), (_, compensated)] = &wanders[..] {
            let gain = plain.last() / compensated.last();
            // two root mean squares of as many values each
            let uncertain = 2.0 * (1.0 / f64::from(PHASES)).sqrt();
            let found = format!("compensated sums wander {gain:.0} times less (± {:.0} %)", 100.0 * uncertain);
            rows.push(Row::of(trial, found, gained(gain, uncertain)));
        }
        rows
    }
}

/// Whether the gain of compensated sums is beyond the least one, with its uncertainty.
fn gained(gain: f64, uncertain: f64) -> Verdict {
    match () {
        () if gain * (1.0 - uncertain) >= GAIN => Verdict::Agrees,
        () if gain * (1.0 + uncertain) < GAIN => Verdict::Differs,
        () => Verdict::NotDecided(GAIN_BETWEEN),
    }
}

/// q and p at a part of the period.
fn start_at(part: f64) -> ([f64; 2], [f64; 2]) {
    let mean = TAU * part;
    let anomaly = (0..50).fold(mean, |anomaly, _| mean + ECCENTRICITY * anomaly.sin());
    let (sin, cos) = anomaly.sin_cos();
    let minor = (1.0 - ECCENTRICITY * ECCENTRICITY).sqrt();
    let distance = 1.0 - ECCENTRICITY * cos;
    ([cos - ECCENTRICITY, minor * sin], [-sin / distance, minor * cos / distance])
}

/// The modified energy with the least estimated error of the next period, and that error.
fn modified_energy(orbit: &mut VectorIntegrator<'_, f64>) -> (f64, f64) {
    let mut monitor = f64::monitor(orbit, ORDER, 1).expect("the orbit is finite");
    let mut best: Option<(f64, f64)> = None;
    let period = (TAU / <f64 as Number>::from_rational(orbit.step_size().exact(), &())).ceil() as u64;
    for _ in 0..period {
        orbit.step(monitor.carried());
        let sample = f64::observe(&mut monitor, orbit).expect("the orbit is finite");
        let Some(sample) = sample else { continue };
        let error = *sample.error.unwrap_or(&f64::INFINITY);
        if best.is_none_or(|(_, least)| error < least) {
            best = Some((*sample.modified, error));
        }
    }
    best.expect("a period has windows")
}

/// The growth of the changes of all phases of a scheme.
struct Wander {
    /// n and the root mean square.
    rms: Vec<(f64, f64)>,
    /// The slope of log rms against log n, and its standard error.
    exponent: f64,
    exponent_error: f64,
    /// The mean change at the end, and its standard error.
    mean: f64,
    mean_error: f64,
}

impl Wander {
    /// From the changes of each phase at these numbers of steps; `None` for few phases.
    fn of(steps: &[u64], all: &[&Changes]) -> Option<Wander> {
        let phases = all.len() as f64;
        if all.iter().any(|changes| changes.changes.len() < steps.len()) || all.len() < 8 {
            return None;
        }
        let at = |i: usize| all.iter().map(move |changes| changes.changes[i]);
        let rms: Vec<_> = steps
            .iter()
            .enumerate()
            .map(|(i, n)| (*n as f64, (at(i).map(|change| change * change).sum::<f64>() / phases).sqrt()))
            .collect();
        let last = steps.len() - 1;
        let mean = at(last).sum::<f64>() / phases;
        let variance = at(last).map(|change| (change - mean).powi(2)).sum::<f64>() / (phases - 1.0);
        // of each phase the exponent between the first and the last number of steps is not defined, that of the rms is:
        // its error is that of two root mean squares of `phases` values, 1/√(2 phases) each
        let decades = (rms[last].0 / rms[0].0).ln();
        let exponent = (rms[last].1 / rms[0].1).ln() / decades;
        let exponent_error = (1.0 / phases).sqrt() / decades;
        Some(Wander { rms, exponent, exponent_error, mean, mean_error: (variance / phases).sqrt() })
    }

    /// The root mean square at the end.
    fn last(&self) -> f64 {
        self.rms[self.rms.len() - 1].1
    }

    /// Whether the mean of all phases drifts.
    fn drifts(&self) -> bool {
        self.mean.abs() > SEEN * self.mean_error
    }

    fn described(&self) -> String {
        let (n, rms) = self.rms[self.rms.len() - 1];
        format!(
            "{rms:.1e} of H after {n:.0e} steps (rms), growing like n^({:.2} ± {:.2}); the mean is {:.1e} ± {:.1e}: {}",
            self.exponent,
            self.exponent_error,
            self.mean,
            self.mean_error,
            if self.drifts() { "it drifts" } else { "no drift is seen" }
        )
    }

    fn verdict(&self) -> Verdict {
        let (low, high) = (self.exponent - 2.0 * self.exponent_error, self.exponent + 2.0 * self.exponent_error);
        match () {
            () if self.drifts() && low > WANDERS.1 => Verdict::Differs,
            () if self.drifts() || low > WANDERS.1 || high < WANDERS.0 => Verdict::NotDecided(LIKE_A_WANDER),
            () => Verdict::Agrees,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of changes of 32 phases after n steps: `wander` √n with alternating signs and several sizes, and `drift` n.
    fn found(wander: f64, drift: f64) -> Wander {
        let steps = [100_000, 1_000_000, 10_000_000];
        let of = |phase: u32| {
            let sign = if phase.is_multiple_of(2) { 1.0 } else { -1.0 };
            let size = sign * (0.5 + f64::from(phase / 2) / 16.0);
            let changes = steps.iter().map(|&n| wander * size * (n as f64).sqrt() + drift * n as f64).collect();
            Changes { changes, error: 0.0 }
        };
        let all: Vec<_> = (0..PHASES).map(of).collect();
        Wander::of(&steps, &all.iter().collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn a_wander_agrees_and_a_drift_differs() {
        let wander = found(1e-16, 0.0);
        assert!((wander.exponent - 0.5).abs() < 1e-9 && !wander.drifts());
        assert_eq!(wander.verdict(), Verdict::Agrees);
        let drift = found(1e-16, 1e-17);
        assert!(drift.drifts() && drift.exponent > 0.9, "{}", drift.described());
        assert_eq!(drift.verdict(), Verdict::Differs);
        // a drift that is as small as the wander does not decide
        assert_eq!(found(1e-16, 3e-20).verdict(), Verdict::NotDecided(LIKE_A_WANDER));
    }

    #[test]
    fn a_gain_is_decided_beyond_its_uncertainty() {
        assert_eq!(
            [20.0, 11.0, 5.0].map(|gain| gained(gain, 0.3)),
            [Verdict::Agrees, Verdict::NotDecided(GAIN_BETWEEN), Verdict::Differs]
        );
    }

    #[test]
    fn an_orbit_begins_on_its_ellipse() {
        for phase in 0..8 {
            let (q, p) = start_at(f64::from(phase) / 8.0);
            let energy = (p[0] * p[0] + p[1] * p[1]) / 2.0 - 1.0 / q[0].hypot(q[1]);
            assert!((energy - ENERGY).abs() < 1e-15);
        }
    }
}
