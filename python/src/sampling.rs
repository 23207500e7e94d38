//! Schemes for Hamiltonian Monte Carlo on a Gaussian.

use pyo3::prelude::*;
use shadowstep_analysis::gaussian::Gaussian;
use shadowstep_scenes::sampling::{SamplingTarget, Wanted};

use crate::errors::{exception, usage};
use crate::scheme::Table;
use crate::waiting::waiting;

/// The steps, their size, the gradients, the expected error of the energy, the largest one, and the acceptance.
type Numbers = (u64, f64, u64, f64, f64, f64);

/// The proposals of a scheme.
#[pyfunction]
pub(crate) fn proposal(
    py: Python<'_>,
    scheme: &Table,
    frequencies: Vec<f64>,
    time: Option<f64>,
    acceptance: Option<f64>,
    steps: Option<u64>,
) -> PyResult<Numbers> {
    let gaussian = Gaussian::new(frequencies).map_err(|error| {
        usage(py, error.to_string(), "give positive numbers: 1/σ of a direction with standard deviation σ")
    })?;
    let wanted = match (acceptance, steps) {
        (None, None) => Wanted::LeastCost,
        (Some(rate), None) => Wanted::Acceptance(rate),
        (None, Some(steps)) => Wanted::Steps(steps),
        (Some(_), Some(_)) => return Err(usage(py, "acceptance and steps exclude each other", "give one of them")),
    };
    let target = SamplingTarget::new(gaussian, time, wanted).map_err(|error| exception(py, error))?;
    let scheme = scheme.0.clone();
    let found = waiting(py, None, move |_| target.record(&scheme))?.map_err(|error| exception(py, error))?;
    Ok((found.steps, found.step, found.gradients, found.error, found.largest_error, found.acceptance))
}
