//! The results that figures request.
//!
//! A figure is a function that requests results and draws them. Results that are not known yet are noted and computed,
//! and the figure is drawn again, until none is missing. So the results that it needs and the charts that it draws are
//! in one place, and it may request more depending on earlier results.

use std::cell::RefCell;
use std::collections::HashMap;

use shadowstep::Real;
use shadowstep::shadow::EstimatorSettings;

use crate::Store;
use crate::figures::calculation::{Calculation, Outcome, Quantity};
use crate::figures::escape::Escape;
use crate::figures::measured::{Drift, Energies, Orbit};
use crate::figures::noise::{Block, Differences};
use crate::figures::numbers::{Wide, log10, number};
use crate::figures::run::Run;
use crate::verdict::Coverage;
use crate::{Error, Observer};

/// The results of all figures.
pub(crate) struct Results {
    /// Whether grids are coarser.
    pub(crate) quick: bool,
    /// By the JSON of the calculation; `None` if it failed.
    known: HashMap<String, Option<Outcome>>,
    missing: RefCell<Vec<Calculation>>,
    /// The results that the present figure uses, for its data.
    used: RefCell<Vec<Used>>,
}

/// What was computed, and the outcome, for the data of a figure.
pub(crate) type Used = (Quantity, Outcome);

/// log₁₀ of a drift, and of the permanent change and its largest jump if the change is resolved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sizes {
    pub(crate) drift: f64,
    pub(crate) permanent: Option<(f64, f64)>,
}

impl Results {
    pub(crate) fn new(quick: bool) -> Self {
        Results { quick, known: HashMap::new(), missing: RefCell::default(), used: RefCell::default() }
    }

    /// Computes the missing results; returns whether there were any.
    pub(crate) fn compute(&mut self, store: &mut Store, observer: &mut dyn Observer) -> Result<bool, Error> {
        let missing = self.missing.take();
        let found = store.compute(&missing, observer)?;
        self.known.extend(missing.iter().map(key).zip(found));
        Ok(!missing.is_empty())
    }

    /// Takes the missing results from the store; returns whether there were any, or `None` if the store lacks one.
    pub(crate) fn take_kept(&mut self, store: &Store) -> Option<bool> {
        let missing = self.missing.take();
        let found = store.kept(&missing)?;
        self.known.extend(missing.iter().map(key).zip(found.into_iter().map(Some)));
        Some(!missing.is_empty())
    }

    /// The results that have been used since the last call.
    pub(crate) fn take_used(&self) -> Vec<Used> {
        self.used.take()
    }

    /// An outcome, which the data of the figure have; it is noted if it is not known.
    fn request(&self, quantity: Quantity) -> Option<Outcome> {
        let calculation = quantity.clone().calculation();
        let Some(known) = self.known.get(&key(&calculation)) else {
            self.missing.borrow_mut().push(calculation);
            return None;
        };
        let outcome = known.clone()?;
        self.used.borrow_mut().push((quantity, outcome.clone()));
        Some(outcome)
    }

    /// The drift of a run.
    fn drift(&self, run: &Run, estimator: &EstimatorSettings) -> Option<Drift> {
        let outcome = self.request(Quantity::Drift { run: run.clone(), estimator: estimator.clone() })?;
        let Outcome::Drift(drift) = outcome else { unreachable!("a drift was requested") };
        Some(drift)
    }

    /// The sizes of the drift of a run.
    pub(crate) fn sizes(&self, run: &Run, estimator: &EstimatorSettings) -> Option<Sizes> {
        let drift = self.drift(run, estimator)?;
        let resolved = drift.permanent.as_ref().filter(|permanent| permanent.resolved);
        let permanent = resolved.map(|permanent| (log10(&permanent.change), log10(&permanent.largest_jump)));
        Some(Sizes { drift: log10(&drift.drift), permanent })
    }

    /// log₁₀ of the drift of a run; NaN, a missing point, if there is none.
    pub(crate) fn log10_drift(&self, run: &Run, estimator: &EstimatorSettings) -> f64 {
        self.sizes(run, estimator).map_or(f64::NAN, |sizes| sizes.drift)
    }

    /// −log₁₀ of the difference between the drift of a run and that of the same run with more digits.
    pub(crate) fn digits_held(&self, run: &Run, estimator: &EstimatorSettings, digits: u32) -> Option<f64> {
        let [this, more] = [run.clone(), run.clone().digits(digits)].map(|run| self.drift(&run, estimator));
        Some(-(&number(&this?.drift) - &number(&more?.drift)).log10_abs())
    }

    /// The modified energies of a run.
    pub(crate) fn energies(&self, run: &Run, estimator: &EstimatorSettings) -> Option<Energies> {
        let outcome = self.request(Quantity::Energies { run: run.clone(), estimator: estimator.clone() })?;
        let Outcome::Energies(energies) = outcome else { unreachable!("energies were requested") };
        Some(energies)
    }

    /// Whether and when the body of a run escapes.
    pub(crate) fn escape(&self, run: &Run) -> Option<Escape> {
        let outcome = self.request(Quantity::Escape { run: run.clone() })?;
        let Outcome::Escape(escape) = outcome else { unreachable!("an escape was requested") };
        Some(escape)
    }

    /// The positions of a run.
    pub(crate) fn orbit(&self, run: &Run) -> Option<Orbit> {
        let outcome = self.request(Quantity::Orbit { run: run.clone() })?;
        let Outcome::Orbit(orbit) = outcome else { unreachable!("an orbit was requested") };
        Some(orbit)
    }

    /// log₁₀ of the largest |q − q of the exact flow| of a run.
    pub(crate) fn coordinate_error(&self, run: &Run) -> Option<f64> {
        let outcome = self.request(Quantity::CoordinateError { run: run.clone() })?;
        let Outcome::Number(error) = outcome else { unreachable!("a number was requested") };
        Some(log10(&error))
    }

    /// H at the end of a run less H at its start.
    pub(crate) fn transit(&self, run: &Run) -> Option<Wide> {
        let outcome = self.request(Quantity::Transit { run: run.clone() })?;
        let Outcome::Number(change) = outcome else { unreachable!("a number was requested") };
        Some(number(&change))
    }

    /// log₁₀ of max − min of the modified Hamiltonian along a run, as a series up to each of the grades.
    pub(crate) fn series(&self, run: &Run) -> Option<Vec<f64>> {
        let outcome = self.request(Quantity::Series { run: run.clone() })?;
        let Outcome::Numbers(found) = outcome else { unreachable!("a series was requested") };
        Some(found.iter().map(|value| log10(value)).collect())
    }

    /// Scatter and wander in double precision.
    pub(crate) fn noise(&self, steps: u64, differences: Differences) -> Option<Vec<Block>> {
        let outcome = self.request(Quantity::Noise { steps, differences })?;
        let Outcome::Blocks(blocks) = outcome else { unreachable!("blocks were requested") };
        Some(blocks)
    }

    /// Which of the values of the full grids are computed.
    pub(crate) fn coverage(&self) -> Coverage {
        if self.quick { Coverage::Some } else { Coverage::All }
    }

    /// The values of a grid: all, or for a quick figure some of them.
    pub(crate) fn grid<'a, T>(&self, all: &'a [T], some: &'a [T]) -> &'a [T] {
        if self.quick { some } else { all }
    }
}

fn key(calculation: &Calculation) -> String {
    serde_json::to_string(calculation).expect("a calculation can be written as JSON")
}
