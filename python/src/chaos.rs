//! Whether a trajectory is chaotic.

use pyo3::prelude::*;
use serde_json::json;
use shadowstep_scenes::Error;
use shadowstep_scenes::chaos::{ChaosRequest, conclusion};
use shadowstep_scenes::posed::Posed;
use shadowstep_scenes::run::Run;
use shadowstep_scenes::tangent::Vectors;

use crate::errors::exception;
use crate::given_run::{GivenRun, Times};
use crate::waiting::waiting_for;

/// The records of runs at h and, if `half` is true, h/2, with what both say, as JSON.
#[pyfunction]
#[pyo3(signature = (run, *, vectors, exponents, half, progress))]
pub(crate) fn chaos(
    py: Python<'_>,
    run: GivenRun,
    vectors: usize,
    exponents: Option<usize>,
    half: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<String> {
    let given = run.read(py)?;
    let vectors = exponents.map_or(Vectors::Free(vectors), Vectors::Orthonormal);
    let problem = given.problem.clone();
    let found = waiting_for(py, progress, Some(&problem), move |watched| -> Result<String, Error> {
        let posed = given.posed()?;
        let Times { h, steps, physical_end, .. } = &given.times;
        let run = Run { propagator: &posed.scheme.name, h, steps: *steps, order: None, windows: Run::WINDOWS };
        let numbers = (given.arithmetic, given.displaced);
        let followed = Posed::new(&posed.system, &posed.scheme.scheme, run, numbers);
        let followed = Posed { until: physical_end.as_ref(), ..followed };
        let request = ChaosRequest { posed: followed, vectors, every: given.every };
        let mut records = Vec::new();
        for parts in if half { 1..=2 } else { 1..=1 } {
            records.push(request.run(parts, &mut watched.observer())?);
        }
        let conclusion = match &records[..] {
            [whole, half] => conclusion(whole, half),
            _ => records[0].motion.to_string(),
        };
        Ok(json!({ "records": records, "conclusion": conclusion }).to_string())
    });
    found?.map_err(|error| exception(py, error))
}
