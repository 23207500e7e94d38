//! Runs into arrays.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::json;
use shadowstep_scenes::columns;
use shadowstep_scenes::computation::{Computation, RunNumber};
use shadowstep_scenes::derivatives::Array;
use shadowstep_scenes::integrate::{KeptStates, Samples};
use shadowstep_scenes::posed::Posed;
use shadowstep_scenes::run::Run;
use shadowstep_scenes::{Direction, Error, NamedExpression, Note, Observer};

use crate::errors::Fallible;
use crate::given::word;
use crate::given_run::{GivenRun, Options};
use crate::values::{Json, array};
use crate::waiting::{Watched, waiting_for};

/// What is looked for on the way: a condition that ends the run, a surface of section with the name of its direction,
/// formulas with the names of their values, modified energies, and a summary.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Wanted {
    end: Option<String>,
    section: Option<(String, String)>,
    values: Vec<(String, String)>,
    estimator: Option<Options>,
    summary: bool,
    /// In about how many windows that compares modified energies.
    windows: Option<u64>,
    /// Whether it is made once more, with tangent vectors.
    tangent: bool,
}

/// Makes a run, and gives a dictionary of its states; q and p are flat.
#[pyfunction]
pub(crate) fn integrate<'py>(
    py: Python<'py>,
    run: GivenRun,
    requested: Wanted,
    progress: Option<&Bound<'py, PyAny>>,
) -> Fallible<Bound<'py, PyDict>> {
    let problem = run.problem.get().clone();
    let (states, beside) = waiting_for(py, progress, Some(&problem), move |watched| made(&run, &requested, watched))?;
    let all = match states {
        States::Doubles(samples) => dictionary(py, samples, f64::NAN, Array::Doubles),
        States::Texts(samples) => dictionary(py, samples, "nan".to_owned(), Array::Texts),
    }?;
    all.set_item("is_between", beside.is_between)?;
    all.set_item("notes", beside.notes)?;
    if let Some((text, record)) = beside.summary {
        all.set_item("summary_text", text)?;
        all.set_item("summary", record)?;
    }
    Ok(all)
}

/// The names that columns of every system may have.
#[pyfunction]
pub(crate) fn fixed_names() -> Vec<&'static str> {
    columns::fixed_names().collect()
}

/// The states, in what Python has for their number type.
enum States {
    Doubles(Samples<f64>),
    Texts(Samples<String>),
}

/// What there is beside the states.
struct Beside {
    is_between: bool,
    notes: Vec<String>,
    summary: Option<(String, Json)>,
}

fn made(run: &GivenRun, requested: &Wanted, watched: &Watched) -> Fallible<(States, Beside)> {
    let Wanted { end, section, values, estimator, summary, windows, tangent } = requested;
    let (run, estimator) = (run.read()?, estimator.as_ref().map(Options::settings).transpose()?);
    if *tangent {
        run.check_steps()?;
    }
    let system = &run.problem.system;
    let section = section.as_ref().map(|(text, name)| -> Fallible<_> {
        Ok(system.section("section", text, word("direction", name, &Direction::NAMES)?)?)
    });
    let (section, end) = (section.transpose()?, end.as_ref().map(|text| system.condition("end", text)).transpose()?);
    let values = values.iter().map(|(name, text)| system.column(name, text)).collect::<Result<Vec<_>, _>>()?;
    let mut posed = Posed { ends: end.as_ref(), ..run.posed(estimator.as_ref())? };
    posed.run.windows = windows.unwrap_or(Run::WINDOWS);
    let mut observer = watched.observer();
    observer.summarises = *summary;
    let kept = (section.as_ref().map_or(KeptStates::Every(run.every), KeptStates::Crossings), &values[..]);
    let states = match run.arithmetic.is_longer_than_double() {
        false => posed.samples(kept, &(), &mut observer).map(States::Doubles),
        true => run.arithmetic.compute(InTexts { posed, kept, observer: &mut observer }).map(States::Texts),
    };
    let note = run.note_of_steps();
    let states = states.map_err(|error| match (error, &note) {
        (Error::Run { message, hint }, Some(note)) => Error::run(message, format!("{hint}; {note}")),
        (error, _) => error,
    })?;
    let [of_scheme, of_end] = &run.notes;
    let notes = run.problem.notes.iter().chain(of_scheme).chain(&note).chain(of_end).map(Note::to_string).collect();
    let is_between = estimator.is_some_and(|estimator| estimator.is_between());
    Ok((states, Beside { is_between, notes, summary: observer.summary()? }))
}

struct InTexts<'a> {
    posed: Posed<'a>,
    kept: (KeptStates<'a>, &'a [NamedExpression]),
    observer: &'a mut dyn Observer,
}

impl Computation for InTexts<'_> {
    type Output = Result<Samples<String>, Error>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output {
        Ok(self.posed.samples::<N>(self.kept, context, self.observer)?.map(N::to_text))
    }
}

fn dictionary<T: Clone>(
    py: Python<'_>,
    samples: Samples<T>,
    missing: T,
    column: fn(Vec<T>) -> Array,
) -> Fallible<Bound<'_, PyDict>> {
    let all = PyDict::new(py);
    let or_missing = |number: Option<T>| number.unwrap_or_else(|| missing.clone());
    let rows = samples.n.len();
    all.set_item("n", PyArray1::from_vec(py, samples.n))?;
    let columns = [("t", samples.t), ("q", samples.q), ("p", samples.p), ("energy", samples.energy)];
    for (name, numbers) in columns {
        all.set_item(name, array(py, column(numbers)))?;
    }
    let values = samples.values.into_iter().map(|numbers| numbers.into_iter().map(or_missing).collect());
    all.set_item("values", values.map(|numbers| array(py, column(numbers))).collect::<Vec<_>>())?;
    if !samples.modified.is_empty() {
        let orders: Vec<i64> = samples.modified.iter().map(|estimate| estimate.order.into()).collect();
        all.set_item("order", PyArray1::from_vec(py, orders))?;
        let estimate = samples.modified.into_iter().map(|estimate| (estimate.value, or_missing(estimate.error)));
        let (values, errors): (Vec<T>, Vec<T>) = estimate.unzip();
        for (name, mut numbers) in [("modified_energy", values), ("modified_energy_error", errors)] {
            numbers.resize(rows, missing.clone());
            all.set_item(name, array(py, column(numbers)))?;
        }
    }
    all.set_item("force_evaluations", samples.evaluations)?;
    all.set_item("planets", samples.interactions.map(|found| Json::of(&json!(found))).transpose()?)?;
    Ok(all)
}
