//! The noise of the modified energy in double precision against the length of the run, for several ways to take the
//! differences of states.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};
use shadowstep::problems::Kepler;
use shadowstep::shadow::run::{States, Trajectory};
use shadowstep::shadow::{Bilinear, BuildEstimator, Estimator};
use shadowstep::tables::shipped;
use shadowstep::{Increments, Motion, Stepper, UnitMasses};

use crate::Error;
use crate::figures::states::Interruptible;

/// How the estimator takes the differences of neighbouring states.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Differences {
    /// β is a running sum; differences of q and p are those of the states.
    Sums,
    /// β by the increment of each step; q and p as before.
    OfBeta,
    /// q, p and β by the increments of each step.
    Increments,
}

/// The estimates near the apocentres of a part of a run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Block {
    /// The number of the last step.
    pub(crate) steps: u64,
    /// The largest max − min over ten steps on either side of an apocentre.
    pub(crate) scatter: f64,
    /// The mean at the apocentres less that of the first block.
    pub(crate) wander: f64,
}

/// Steps on either side of an apocentre.
const REACH: usize = 10;

/// A block while its part of the run is computed.
#[derive(Default)]
struct Sums {
    scatter: f64,
    sum: f64,
    apocentres: u32,
}

/// Störmer–Verlet on Kepler's problem, e = 0.6, h = 1/20, by E_8: blocks that end at 10³, 10^3.5, … steps.
pub(crate) fn blocks(
    steps: u64,
    differences: Differences,
    continues: &dyn Fn(f64) -> bool,
) -> Result<Vec<Block>, Error> {
    let scheme = shipped("stormer-verlet").expect("it is shipped");
    let stepper = Stepper::new(scheme, "1/20").expect("h is not 0");
    let start = Motion::new(Kepler, UnitMasses, vec![0.4, 0.0], vec![0.0, 2.0]).expect("the dimensions agree");
    let mut estimator = Bilinear::new(8).build(stepper.step_size(), 2, &()).expect("k = 8 is valid");
    let failed =
        |error: shadowstep::shadow::run::RunError| Error::run(error.to_string(), "this calculation has no options");
    let trajectory = Trajectory::new(stepper.with(start), steps, estimator.states() / 2).map_err(failed)?;
    // asking costs as much as a step
    let continues = |n: i64| n % 1024 != 0 || continues(n as f64 / steps as f64);
    let mut trajectory = Interruptible { states: trajectory, continues };
    let mut near: VecDeque<(f64, f64)> = VecDeque::new();
    let (mut blocks, mut part, mut first, mut end, mut sum) = (Vec::new(), Sums::default(), None, 1000.0, 0.0);
    while let Some(state) = trajectory.advance().map_err(failed)? {
        let beta = beta(differences, *state.increments.beta, &mut sum);
        let given = match differences {
            Differences::Increments => state.increments,
            Differences::OfBeta | Differences::Sums => Increments::of_beta(&beta),
        };
        let Some(estimate) = estimator.push(state.q, state.p, given) else { continue };
        near.push_back((estimate.q[0].hypot(estimate.q[1]), *estimate.value));
        if near.len() > 2 * REACH + 1 {
            near.pop_front();
        }
        part.include(&near);
        if state.n as f64 >= end && part.apocentres > 0 {
            let mean = part.sum / f64::from(part.apocentres);
            let wander = mean - *first.get_or_insert(mean);
            blocks.push(Block { steps: state.n.unsigned_abs(), scatter: part.scatter, wander });
            part = Sums::default();
            end *= 10_f64.sqrt();
        }
    }
    Ok(blocks)
}

/// The increment of β that the estimator gets; a running sum loses digits as it grows.
fn beta(differences: Differences, beta: f64, sum: &mut f64) -> f64 {
    match differences {
        Differences::Increments | Differences::OfBeta => beta,
        Differences::Sums => {
            let before = *sum;
            *sum += beta;
            *sum - before
        }
    }
}

impl Sums {
    /// The middle of the newest estimates may be an apocentre.
    fn include(&mut self, near: &VecDeque<(f64, f64)>) {
        let r = |i: usize| near[i].0;
        if near.len() <= 2 * REACH || !(r(REACH) > 1.0 && r(REACH - 1) < r(REACH) && r(REACH) >= r(REACH + 1)) {
            return;
        }
        let values = near.iter().map(|(_, value)| *value);
        let range = values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min);
        self.scatter = self.scatter.max(range);
        self.sum += near[REACH].1 + 0.5;
        self.apocentres += 1;
    }
}
