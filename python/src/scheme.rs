//! Schemes with what is proved of them.

use pyo3::prelude::*;
use shadowstep::tables::Source;
use shadowstep_scenes::Error;
use shadowstep_scenes::library::{self, NamedScheme};
use shadowstep_scenes::scheme_record::SchemeFacts;

use crate::errors::Fallible;
use crate::waiting::waiting;

/// A proved scheme.
#[pyclass(frozen, module = "shadowstep._shadowstep")]
pub(crate) struct Table(pub(crate) NamedScheme);

#[pymethods]
impl Table {
    /// The scheme that a word means: a shipped one, or a table's file.
    #[staticmethod]
    fn of_word(py: Python<'_>, word: String) -> Fallible<Self> {
        waiting(py, move |_| Ok(Table(library::scheme(&word).map_err(Error::from)?)))
    }

    /// The scheme of a table's text; `path` names it in messages, and `name`, if there is one, is by which it was asked
    /// for.
    #[staticmethod]
    #[pyo3(signature = (text, path, name = None))]
    fn of_text(py: Python<'_>, text: String, path: String, name: Option<String>) -> Fallible<Self> {
        let source = Source { path, text };
        let named = waiting(py, move |_| Ok(library::scheme_of(&source).map_err(Error::from)?))?;
        Ok(Table(NamedScheme { name: name.unwrap_or(named.name), scheme: named.scheme }))
    }

    /// The path of the table, by which it finds the tables beside it.
    #[getter]
    fn path(&self) -> &str {
        &self.0.scheme.proved().scheme.table.source.path
    }

    /// By which it was asked for.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// Everything that is known of it, as JSON.
    fn record(&self, py: Python<'_>) -> Fallible<String> {
        let scheme = self.0.quadratic();
        waiting(
            py,
            move |_| Ok(serde_json::to_string(&SchemeFacts::of(scheme.proved()).record()).map_err(Error::from)?),
        )
    }

    /// What can be said without an analysis: (name, order for every T(p) or None, order for quadratic T, evaluations a
    /// step); of a processed scheme the effective orders.
    fn facts(&self) -> (&str, Option<u32>, u32, usize) {
        let proved = self.0.scheme.proved();
        let orders = proved.orders();
        let general = orders.general.map(|order| order.order);
        (&proved.scheme.table.name.value, general, orders.quadratic.order, proved.plan.evaluations)
    }

    /// The text of the table.
    #[getter]
    fn text(&self) -> &str {
        &self.0.scheme.proved().scheme.table.source.text
    }
}

/// The names of the shipped schemes.
#[pyfunction]
pub(crate) fn shipped_names() -> Vec<&'static str> {
    shadowstep::tables::shipped_names()
}
