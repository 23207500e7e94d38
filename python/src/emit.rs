//! Schemes as code of other ecosystems.

use pyo3::prelude::*;
use shadowstep_emit::Target;

use crate::errors::usage;
use crate::scheme::Table;
use crate::waiting::waiting;

/// The text of a scheme for a target.
#[pyfunction]
pub(crate) fn emit(py: Python<'_>, scheme: &Table, target: &str) -> PyResult<String> {
    let target: Target = target.parse().map_err(|_| {
        let names: Vec<_> = Target::ALL.iter().map(|target| target.name()).collect();
        usage(py, format!("there is no target `{target}`"), format!("it is one of {}", names.join(", ")))
    })?;
    let scheme = scheme.0.quadratic();
    waiting(py, None, move |_| shadowstep_emit::emit(&scheme, target))?
        .map_err(|refusal| usage(py, format!("{} {}", refusal.scheme, refusal.reason), refusal.hint))
}
