//! The proposals that a scheme makes in Hamiltonian Monte Carlo: their errors and acceptance on a Gaussian target, and
//! the step for which they cost least.
//!
//! A proposal is a trajectory of n steps of size h from momenta that are drawn anew. Its expected error of the energy
//! is Σ ρ(hω_i) sin²(nφ_i) ([`crate::sampling`]), its acceptance follows ([`crate::gaussian`]), and what it costs is n
//! times the evaluations of the gradient in a step, divided by the acceptance: for a fixed length of time that is the
//! cost per accepted trajectory. It is least at an acceptance that depends on the order r: in many dimensions, where
//! the error is proportional to h^(2r), at 0.65 for order 2 (Beskos and others 2013) and at 0.80 for order 4.

use shadowstep_schemes::Proved;
use thiserror::Error;

use crate::gaussian::{Gaussian, acceptance};
use crate::oscillator::Oscillator;
use crate::stability::Stability;

/// A scheme that makes proposals.
#[derive(Clone, Debug)]
pub struct Proposals {
    step: Oscillator,
    limit: f64,
    evaluations: u64,
}

/// Why a scheme makes none: displayed, it follows the scheme's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum Unsuited {
    /// Detailed balance needs proposals that are reversible in time.
    #[error("is not symmetric, so that its steps are not reversible in time, as Hamiltonian Monte Carlo needs them")]
    NotSymmetric,
    /// A pre-map and its inverse at the ends are each other's reversal in time up to a power of h only.
    #[error(
        "is a processed scheme, whose pre-map and post-map are not reversible in time, as Hamiltonian Monte Carlo \
            needs them"
    )]
    Processed,
    /// It is not for T + U.
    #[error("is made for H of three parts and more, not for T + U")]
    Parts,
    /// Its stability is not known.
    #[error("has a step of very many maps, whose stability is not known")]
    Long,
}

/// A proposal on a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proposal {
    /// The step size.
    pub h: f64,
    /// The number of steps.
    pub steps: u64,
    /// Evaluations of the gradient, Hessian–vector products counted as such. The one at the start is known from the
    /// trajectory before.
    pub gradients: u64,
    /// The expected error of the energy in equilibrium, in units of the temperature.
    pub error: f64,
    /// The largest expected error for any number of steps of this size.
    pub largest_error: f64,
    /// The mean of min(1, e^−ΔH).
    pub acceptance: f64,
}

impl Proposal {
    /// Evaluations of the gradient per accepted trajectory.
    pub fn cost(&self) -> f64 {
        self.gradients as f64 / self.acceptance
    }
}

/// Numbers of steps grow by this part in a search, whose minimum is so flat that a part of it costs 1e-4 at most.
const GROWTH: f64 = 0.01;

/// The most steps of a proposal that is searched.
pub const MOST_STEPS: u64 = 1_000_000_000;

impl Proposals {
    /// Those of a scheme.
    ///
    /// # Errors
    /// A scheme that is not reversible in time, or not for T + U.
    pub fn of(proved: &Proved) -> Result<Proposals, Unsuited> {
        if proved.scheme.inner.is_some() || proved.proof.many_parts.is_some() {
            return Err(Unsuited::Parts);
        }
        if proved.scheme.processor.is_some() {
            return Err(Unsuited::Processed);
        }
        if !proved.proof.symmetric {
            return Err(Unsuited::NotSymmetric);
        }
        let stability = Stability::of_scheme(proved).ok_or(Unsuited::Long)?;
        let limit = stability.limit.parse().map_err(|_| Unsuited::Long)?;
        let evaluations = (proved.plan.evaluations + proved.plan.hessian_products) as u64;
        Ok(Proposals { step: Oscillator::of_scheme(proved), limit, evaluations })
    }

    /// The proposal of this number of steps, at least 1, over a time; `None` where they are unstable.
    pub fn proposal(&self, target: &Gaussian, time: f64, steps: u64) -> Option<Proposal> {
        let h = time / steps as f64;
        if h * target.fastest() >= self.limit {
            return None;
        }
        let errors: Vec<f64> =
            target.frequencies().iter().map(|omega| self.step.energy_error(h * omega, steps)).collect();
        let largest_error = target.frequencies().iter().map(|omega| self.step.rho(h * omega)).sum();
        let gradients = steps.saturating_mul(self.evaluations);
        let error = errors.iter().sum();
        Some(Proposal { h, steps, gradients, error, largest_error, acceptance: acceptance(&errors) })
    }

    /// The proposal over a time that costs least per accepted trajectory; `None` if none of at most [`MOST_STEPS`] is
    /// accepted.
    pub fn cheapest(&self, target: &Gaussian, time: f64) -> Option<Proposal> {
        let mut best: Option<Proposal> = None;
        for steps in self.numbers_of_steps(target, time) {
            // no acceptance is larger than 1
            if best.is_some_and(|best| (steps * self.evaluations) as f64 >= best.cost()) {
                break;
            }
            let found = self.proposal(target, time, steps).filter(|found| found.acceptance > 0.0);
            best = found.filter(|found| best.is_none_or(|best| found.cost() < best.cost())).or(best);
        }
        best
    }

    /// The proposal over a time with the fewest steps whose acceptance is at least this, where it increases with their
    /// number; `None` if none of at most [`MOST_STEPS`] has it.
    pub fn with_acceptance(&self, target: &Gaussian, time: f64, wanted: f64) -> Option<Proposal> {
        let enough = |steps: u64| self.proposal(target, time, steps).filter(|found| found.acceptance >= wanted);
        let (mut too_few, mut found) = (0, None);
        for steps in self.numbers_of_steps(target, time) {
            found = enough(steps);
            if found.is_some() {
                break;
            }
            too_few = steps;
        }
        let mut least = found?;
        while least.steps - too_few > 1 {
            let middle = u64::midpoint(too_few, least.steps);
            match enough(middle) {
                Some(found) => least = found,
                None => too_few = middle,
            }
        }
        Some(least)
    }

    /// Numbers of stable steps over a time: all of them up to a hundred, then with gaps.
    fn numbers_of_steps(&self, target: &Gaussian, time: f64) -> impl Iterator<Item = u64> {
        let fewest = (time * target.fastest() / self.limit).floor() as u64;
        let next = |steps: &u64| steps.checked_add(((*steps as f64 * GROWTH) as u64).max(1));
        std::iter::successors(Some(fewest.saturating_add(1)), next).take_while(|steps| *steps <= MOST_STEPS)
    }
}

#[cfg(test)]
mod tests {
    use num_traits::ToPrimitive;
    use shadowstep_schemes::{Map, shipped_names, shipped_proved};

    use super::*;

    fn proposals(name: &str) -> Proposals {
        Proposals::of(shipped_proved(name).unwrap()).unwrap()
    }

    /// The optimum of h · 2Φ(−√(μ/2)) with μ ∝ h^(2r).
    #[test]
    fn the_cheapest_acceptance_depends_on_the_order() {
        for (name, known) in [("stormer-verlet", 0.651), ("yoshida4", 0.796), ("yoshida6-a", 0.856)] {
            // its dimension is so large that steps are small
            let target = Gaussian::new(Gaussian::spread(100).frequencies().repeat(100)).unwrap();
            let found = proposals(name).cheapest(&target, 100.0).unwrap();
            assert!((found.acceptance - known).abs() < 0.02, "{name}: {found:?}");
        }
    }

    #[test]
    fn a_wanted_acceptance_is_that_of_the_fewest_steps() {
        let target = Gaussian::spread(200);
        for (name, wanted) in [("stormer-verlet", 0.651), ("bcss3", 0.9), ("chin-4a", 0.8)] {
            let (proposals, time) = (proposals(name), target.quarter_period());
            let found = proposals.with_acceptance(&target, time, wanted).unwrap();
            let fewer = proposals.proposal(&target, time, found.steps - 1).unwrap();
            assert!(found.acceptance >= wanted && fewer.acceptance < wanted, "{name}: {found:?} {fewer:?}");
            assert!(found.error <= found.largest_error);
        }
    }

    #[test]
    fn too_many_steps_are_not_searched() {
        let target = Gaussian::new(vec![1e-12, 1.0]).unwrap();
        assert_eq!(proposals("stormer-verlet").cheapest(&target, target.quarter_period()), None);
        assert_eq!(proposals("stormer-verlet").with_acceptance(&target, f64::MAX, 0.5), None);
    }

    /// The matrix [[A, B], [C, D]] of steps that are reversible in time has A = D. That of a kernel between a pre-map
    /// and its inverse does not.
    #[test]
    fn processed_schemes_are_not_reversible() {
        for name in shipped_names() {
            let proved = shipped_proved(name).unwrap();
            let Some(processor) = &proved.scheme.processor else { continue };
            assert_eq!(Proposals::of(proved).unwrap_err(), Unsuited::Processed, "{name}");
            let undone = processor.post.iter().rev().map(|map| Map { kind: map.kind, weight: -map.weight.clone() });
            let maps: Vec<_> = undone.chain(proved.scheme.maps()).chain(processor.post.iter().cloned()).collect();
            let [[a, _], [_, d]] = Oscillator::of(&maps, |weight| weight.to_f64().unwrap()).columns(1.0);
            assert!((a - d).abs() > 1e-10, "{name}: {a} {d}");
        }
    }

    #[test]
    fn what_is_not_reversible_or_not_of_two_parts_is_refused() {
        for (name, why) in
            [("ruth3", Unsuited::NotSymmetric), ("r-respa-4", Unsuited::Parts), ("blanes6-7", Unsuited::Processed)]
        {
            assert_eq!(Proposals::of(shipped_proved(name).unwrap()).unwrap_err(), why);
        }
    }
}
