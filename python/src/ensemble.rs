//! Ensembles: many trajectories at once, in lanes and on all cores.

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use shadowstep::Rational;
use shadowstep::tables::Source;
use shadowstep_scenes::Error;
use shadowstep_scenes::ensemble::Ensemble;

use crate::errors::exception;
use crate::waiting::waiting;

/// Computes the trajectories of a scene whose numbers contain the names of columns; q and p are flat.
#[pyfunction]
#[pyo3(signature = (text, names, columns, *, progress))]
pub(crate) fn ensemble<'py>(
    py: Python<'py>,
    text: String,
    names: Vec<String>,
    columns: Vec<PyReadonlyArray1<'py, f64>>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let failed = |error| exception(py, error);
    let trajectories = columns.first().map_or(0, |column| column.as_array().len());
    let rows =
        (0..trajectories).map(|t| names.iter().zip(&columns).map(|(name, column)| cell(name, column, t)).collect());
    let rows = rows.collect::<Result<Vec<Vec<Rational>>, Error>>().map_err(failed)?;
    let outcomes = waiting(py, progress, move |watched| {
        let ensemble = Ensemble::with_columns(Source { path: "ensemble".to_owned(), text }, names, rows)?;
        ensemble.outcomes(|| watched.continues())
    });
    let outcomes = outcomes?.map_err(failed)?;
    let all = PyDict::new(py);
    let numbers = |number: fn(&shadowstep::shadow::ensemble::Outcome) -> f64| {
        PyArray1::from_vec(py, outcomes.iter().map(number).collect())
    };
    all.set_item("q", PyArray1::from_vec(py, outcomes.iter().flat_map(|outcome| outcome.q.clone()).collect()))?;
    all.set_item("p", PyArray1::from_vec(py, outcomes.iter().flat_map(|outcome| outcome.p.clone()).collect()))?;
    all.set_item("energy_error", numbers(|outcome| outcome.energy_error.unwrap_or(f64::NAN)))?;
    all.set_item("modified_drift", numbers(|outcome| outcome.modified_drift.unwrap_or(f64::NAN)))?;
    all.set_item("energy_start", numbers(|outcome| outcome.energies[0]))?;
    all.set_item("energy_end", numbers(|outcome| outcome.energies[1]))?;
    let ends = |outcome: &shadowstep::shadow::ensemble::Outcome| outcome.modified_energies.unwrap_or([f64::NAN; 2]);
    let modified = outcomes.iter().map(ends);
    all.set_item("modified_start", PyArray1::from_vec(py, modified.clone().map(|[start, _]| start).collect()))?;
    all.set_item("modified_end", PyArray1::from_vec(py, modified.map(|[_, end]| end).collect()))?;
    let not_finite =
        outcomes.iter().map(|outcome| outcome.not_finite.map_or(-1, |n| i64::try_from(n).unwrap_or(i64::MAX)));
    all.set_item("not_finite", PyArray1::from_vec(py, not_finite.collect::<Vec<i64>>()))?;
    Ok(all)
}

fn cell(name: &str, column: &PyReadonlyArray1<'_, f64>, t: usize) -> Result<Rational, Error> {
    let value = column.as_array()[t];
    Rational::from_float(value)
        .ok_or_else(|| Error::usage(format!("{name} of trajectory {t} is {value}"), "give finite numbers"))
}
