//! Whether a trajectory is chaotic.

use pyo3::prelude::*;
use serde_json::json;
use shadowstep_scenes::Error;
use shadowstep_scenes::chaos::{ChaosRequest, conclusion};
use shadowstep_scenes::library::check_displaced;
use shadowstep_scenes::run::Run;
use shadowstep_scenes::tangent::Vectors;

use crate::errors::exception;
use crate::given::{Given, arithmetic, word};
use crate::integrate::{SystemWithScheme, Times, beginning_with, first_map, times};
use crate::scheme::Table;
use crate::waiting::waiting;

/// The records of runs at h and, if `half` is true, h/2, with what both say, as JSON.
#[pyfunction]
#[pyo3(signature = (problem, scheme, h, *, steps, until, first, gradient_kicks, vectors, exponents, every, half, digits, mpfr, progress))]
#[allow(clippy::too_many_arguments)] // the package's own function has the defaults
pub(crate) fn chaos(
    py: Python<'_>,
    problem: &Given,
    scheme: &Table,
    h: &str,
    steps: Option<u64>,
    until: Option<&str>,
    first: Option<&str>,
    gradient_kicks: &str,
    vectors: usize,
    exponents: Option<usize>,
    every: u64,
    half: bool,
    digits: &str,
    mpfr: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<String> {
    let arithmetic = arithmetic(py, digits, mpfr)?;
    let first = first.map(|given| first_map(py, given)).transpose()?;
    let scheme = beginning_with(py, &scheme.0, first)?;
    let displaced = word(py, "gradient_kicks", gradient_kicks, &[("exact", false), ("displaced", true)])?;
    let times = times(py, problem, arithmetic, (h, steps, until))?;
    let vectors = exponents.map_or(Vectors::Free(vectors), Vectors::Orthonormal);
    let given = problem.clone();
    let found = waiting(py, progress, move |watched| -> Result<String, Error> {
        let posed = SystemWithScheme::of(&given, &scheme, arithmetic)?;
        if displaced {
            check_displaced(&posed.scheme)?;
        }
        let Times { h, steps, physical_end, .. } = &times;
        let run = Run { propagator: &posed.scheme.name, h, steps: *steps, order: None };
        let (system, scheme, until) = (&posed.system, &posed.scheme.scheme, physical_end.as_ref());
        let request = ChaosRequest { system, scheme, run, arithmetic, displaced, until, vectors, every };
        let mut records = Vec::new();
        for parts in if half { 1..=2 } else { 1..=1 } {
            let found = request.run(parts, &mut watched.observer())?;
            records.push(found.ok_or_else(|| Error::run(format!("{}: interrupted", run.name()), "run it again"))?);
        }
        let conclusion = match &records[..] {
            [whole, half] => conclusion(whole, half),
            _ => records[0].motion.to_string(),
        };
        Ok(json!({ "records": records, "conclusion": conclusion }).to_string())
    });
    problem.raised(py)?;
    found?.map_err(|error| exception(py, error))
}
