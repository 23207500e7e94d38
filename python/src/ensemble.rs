//! Ensembles: many trajectories at once, in lanes and on all cores.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use shadowstep::Rational;
use shadowstep::shadow::ensemble::Outcome;
use shadowstep::tables::Source;
use shadowstep_scenes::ensemble::Ensemble;

use crate::arrays::Rows;
use crate::errors::{Fallible, usage};
use crate::waiting::waiting_for;

/// Computes the trajectories of a scene whose numbers contain the names of columns; q and p are flat.
#[pyfunction]
pub(crate) fn ensemble<'py>(
    py: Python<'py>,
    text: String,
    names: Vec<String>,
    columns: Vec<Rows>,
    progress: Option<&Bound<'py, PyAny>>,
) -> Fallible<Bound<'py, PyDict>> {
    let outcomes = waiting_for(py, progress, None, move |watched| {
        let trajectories = columns.first().map_or(0, |column| column.numbers.len());
        let cell = |(name, column): (&String, &Rows), t: usize| {
            let value = column.numbers[t];
            Rational::from_float(value)
                .ok_or_else(|| usage(format!("{name} of trajectory {t} is {value}"), "give finite numbers"))
        };
        let row = |t| names.iter().zip(&columns).map(|column| cell(column, t)).collect::<Fallible<_>>();
        let rows = (0..trajectories).map(row).collect::<Fallible<Vec<Vec<Rational>>>>()?;
        let ensemble = Ensemble::with_columns(Source { path: "ensemble".to_owned(), text }, names, rows)?;
        Ok(ensemble.outcomes(|| watched.continues())?)
    })?;
    let all = PyDict::new(py);
    let numbers: [(_, fn(&Outcome) -> f64); 6] = [
        ("energy_error", |outcome| outcome.energy_error.unwrap_or(f64::NAN)),
        ("modified_drift", |outcome| outcome.modified_drift.unwrap_or(f64::NAN)),
        ("energy_start", |outcome| outcome.energies[0]),
        ("energy_end", |outcome| outcome.energies[1]),
        ("modified_start", |outcome| outcome.modified_energies.map_or(f64::NAN, |[start, _]| start)),
        ("modified_end", |outcome| outcome.modified_energies.map_or(f64::NAN, |[_, end]| end)),
    ];
    for (name, number) in numbers {
        all.set_item(name, PyArray1::from_vec(py, outcomes.iter().map(number).collect()))?;
    }
    all.set_item("q", PyArray1::from_vec(py, outcomes.iter().flat_map(|outcome| outcome.q.clone()).collect()))?;
    all.set_item("p", PyArray1::from_vec(py, outcomes.iter().flat_map(|outcome| outcome.p.clone()).collect()))?;
    let first = |outcome: &Outcome| outcome.not_finite.map_or(-1, |n| i64::try_from(n).unwrap_or(i64::MAX));
    all.set_item("not_finite", PyArray1::from_vec(py, outcomes.iter().map(first).collect::<Vec<i64>>()))?;
    Ok(all)
}
