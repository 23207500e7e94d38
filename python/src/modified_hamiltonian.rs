//! The modified Hamiltonian of a scheme: its series, and its formulas.

use pyo3::prelude::*;
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::modified_hamiltonian::record::{Formulas, SeriesOptions, SeriesRecord};
use shadowstep_symbolic::Notation;

use crate::errors::{exception, usage};
use crate::given::Given;
use crate::scheme::Table;
use crate::waiting::waiting;

/// The terms of the series: the power of h, the bracket, the coefficient.
#[pyfunction]
pub(crate) fn modified_series(
    py: Python<'_>,
    scheme: &Table,
    grade: u32,
    parts: Option<u32>,
    quadratic: bool,
    digits: usize,
) -> PyResult<Vec<(u32, String, String)>> {
    let scheme = scheme.0.clone();
    let options = SeriesOptions { grade, parts, quadratic, digits };
    let series = waiting(py, None, move |_| SeriesRecord::of(scheme.scheme.proved(), options))?;
    let series = series.map_err(|refusal| exception(py, Error::from(refusal)))?;
    Ok(series.terms.into_iter().map(|term| (term.power, term.bracket, term.coefficient)).collect())
}

/// H, the terms, a function, its arguments besides h as the system names them.
type Texts = (String, Vec<(u32, String)>, String, Vec<String>);

/// H, the terms with their powers of h, and a function of them in Python with its arguments.
#[pyfunction]
pub(crate) fn modified_formulas(
    py: Python<'_>,
    problem: &Given,
    scheme: &Table,
    grade: u32,
    notation: &str,
    digits: usize,
) -> PyResult<Texts> {
    let notation = match notation {
        "text" => Notation::Formula,
        "latex" => Notation::Latex,
        "rust" => Notation::Rust,
        "numpy" => Notation::NumPy,
        other => {
            let message = format!("there is no notation `{other}`");
            return Err(usage(py, message, "it is one of text, latex, rust, numpy"));
        }
    };
    let system = problem.system(Arithmetic::DOUBLE).map_err(|error| exception(py, error))?;
    let scheme = scheme.0.clone();
    let found = waiting(py, None, move |_| {
        let formulas = Formulas::of(&system, &scheme, grade)?;
        // numbers of double precision
        let in_numpy = formulas.written(Notation::NumPy, 17)?;
        let function = in_numpy.function(&in_numpy.title(), Notation::NumPy);
        let formulas = formulas.written(notation, digits)?;
        let arguments = in_numpy.names.into_iter().map(|(name, _)| name).collect();
        Ok((formulas, function, arguments))
    })?;
    let (formulas, function, arguments) =
        found.map_err(|refusal: shadowstep_scenes::Refusal| exception(py, Error::from(refusal)))?;
    let terms = formulas.terms.into_iter().map(|term| (term.power, term.formula)).collect();
    Ok((formulas.hamiltonian, terms, function, arguments))
}
