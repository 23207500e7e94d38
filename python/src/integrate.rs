//! Runs into arrays.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde_json::json;
use shadowstep::shadow::EstimatorSettings;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::columns;
use shadowstep_scenes::computation::{Computation, FollowedNumber};
use shadowstep_scenes::integrate::{KeptStates, Samples};
use shadowstep_scenes::posed::Posed;
use shadowstep_scenes::run::{OrderSetting, Run};
use shadowstep_scenes::stability::note_of_steps;
use shadowstep_scenes::{Direction, Error, NamedExpression, Note, Observer, estimator};

use crate::derivatives::{By, Request, columns as of_vectors};
use crate::errors::exception;
use crate::estimator::Options;
use crate::given::word;
use crate::given_run::{GivenRun, SystemWithScheme, Times};
use crate::scene::Summarising;
use crate::waiting::waiting_for;

/// What is looked for on the way: a condition that ends the run, a surface of section with the name of its direction,
/// and formulas with the names of their values.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Events {
    end: Option<String>,
    section: Option<(String, String)>,
    values: Vec<(String, String)>,
}

/// Makes a run, and gives a dictionary of its states: arrays in double precision, else lists of decimal texts. With
/// tangent vectors, each of which begins with components of `tangent`, it is made once more with these. With a number
/// of windows it has a summary, which compares modified energies in about as many.
#[pyfunction]
#[pyo3(signature = (run, *, options, events, tangent, windows, progress))]
pub(crate) fn integrate<'py>(
    py: Python<'py>,
    run: GivenRun,
    options: Option<Options>,
    events: Events,
    tangent: Vec<Vec<String>>,
    windows: Option<u64>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let Events { end, section, values } = events;
    let section = section.map(|(text, name)| Ok::<_, PyErr>((text, word(py, "direction", &name, &Direction::NAMES)?)));
    let section = section.transpose()?;
    let estimator = options.map(|options| options.settings(py)).transpose()?;
    let is_between = estimator.as_ref().is_some_and(EstimatorSettings::is_between);
    let names: Vec<String> = values.iter().map(|(name, _)| name.clone()).collect();
    let mut request = Request::of(py, run.read(py)?, By::directions(py, &tangent)?)?;
    let given = request.run.problem.clone();
    let found = waiting_for(py, progress, Some(&given), move |watched| {
        let run = &request.run;
        let posed = run.posed()?;
        let runs = (&run.times, run.displaced);
        let mut summarising = Summarising::new(watched, Vec::new());
        let mut watching = watched.observer();
        let observer: &mut dyn Observer = if windows.is_some() { &mut summarising } else { &mut watching };
        let columns =
            values.iter().map(|(name, text)| posed.system.column(name, text)).collect::<Result<Vec<_>, _>>()?;
        let rows = (run.every, section.as_ref(), end.as_deref(), windows.unwrap_or(Run::WINDOWS));
        let (found, mut notes) = posed.run(runs, (rows, &columns), estimator.as_ref(), run.arithmetic, observer)?;
        notes.extend(run.times.note.clone());
        notes.splice(..0, run.problem.notes(run.arithmetic)?);
        let mut vectors = Vec::new();
        if request.has_variables() {
            // as far as the run went
            request.run.times.steps = found.steps();
            vectors = request.forward(&mut watched.observer())?.by;
        }
        Ok((found, vectors, notes, posed.system, summarising.summary()?))
    });
    let (found, vectors, notes, system, summary) = found?.map_err(|error| exception(py, error))?;
    let dictionary = found.into_dictionary(py, &names)?;
    dictionary.set_item("notes", PyList::new(py, notes.iter().map(Note::to_string))?)?;
    dictionary.set_item("coordinates", &system.coordinates)?;
    dictionary.set_item("momenta", &system.momenta)?;
    dictionary.set_item("is_between", is_between)?;
    dictionary.set_item("summary", summary)?;
    dictionary.set_item("tangent", of_vectors(py, vectors)?)?;
    Ok(dictionary)
}

/// The period of states, a section, a condition that ends the run, and the windows of the summary.
type Rows<'a> = (u64, Option<&'a (String, Direction)>, Option<&'a str>, u64);

/// The names that columns of every system may have.
#[pyfunction]
pub(crate) fn fixed_names() -> Vec<&'static str> {
    columns::fixed_names().collect()
}

impl SystemWithScheme {
    fn run(
        &self,
        (times, displaced): (&Times, bool),
        ((every, section, end, windows), values): (Rows<'_>, &[NamedExpression]),
        estimator: Option<&EstimatorSettings>,
        arithmetic: Arithmetic,
        observer: &mut dyn Observer,
    ) -> Result<(Integrated, Vec<Note>), Error> {
        let setting = estimator.and_then(estimator::order_setting);
        let order = setting.map(|(name, value)| OrderSetting { name, value });
        let run = Run { propagator: &self.scheme.name, h: &times.h, steps: times.steps, order, windows };
        let system = &self.system;
        let ends = end.map(|text| system.condition("end", text)).transpose()?;
        let ends = ends.as_ref();
        let surface = section.map(|(text, direction)| system.section("section", text, *direction)).transpose()?;
        let kept = (surface.as_ref().map_or(KeptStates::Every(every), KeptStates::Crossings), values);
        let posed = Posed::new(system, &self.scheme.scheme, run, (arithmetic, displaced));
        let posed = Posed { until: times.physical_end.as_ref(), ends, estimator, ..posed };
        let of_steps = note_of_steps((system, system.fastest_frequency()), &self.scheme, times.h.exact());
        let found = match arithmetic.is_longer_than_double() {
            false => posed.samples::<f64>(kept, &(), observer).map(Integrated::Doubles),
            true => arithmetic.compute(InTexts { posed, kept, observer }).map(Integrated::Texts),
        };
        let found = found.map_err(|error| match (error, &of_steps) {
            (Error::Run { message, hint }, Some(note)) => Error::run(message, format!("{hint}; {note}")),
            (error, _) => error,
        })?;
        Ok((found, self.note.iter().cloned().chain(of_steps).collect()))
    }
}

struct InTexts<'a> {
    posed: Posed<'a>,
    kept: (KeptStates<'a>, &'a [NamedExpression]),
    observer: &'a mut dyn Observer,
}

impl Computation for InTexts<'_> {
    type Output = Result<Samples<String>, Error>;

    fn compute<N: FollowedNumber>(self, context: &N::Context) -> Self::Output {
        Ok(self.posed.samples::<N>(self.kept, context, self.observer)?.map(N::to_text))
    }
}

/// The states of a run, in what Python has for its number type.
enum Integrated {
    Doubles(Samples<f64>),
    Texts(Samples<String>),
}

impl Integrated {
    /// The number of the last state.
    fn steps(&self) -> u64 {
        let n = match self {
            Integrated::Doubles(samples) => &samples.n,
            Integrated::Texts(samples) => &samples.n,
        };
        n.last().map_or(0, |last| last.unsigned_abs())
    }

    fn into_dictionary<'py>(self, py: Python<'py>, names: &[String]) -> PyResult<Bound<'py, PyDict>> {
        match self {
            Integrated::Doubles(samples) => {
                dictionary(py, (samples, names), |numbers| Ok(PyArray1::from_vec(py, numbers).into_any()), f64::NAN)
            }
            Integrated::Texts(samples) => {
                dictionary(py, (samples, names), |texts| Ok(PyList::new(py, texts)?.into_any()), "nan".to_owned())
            }
        }
    }
}

/// The states, with the names of their values, as a dictionary; q and p are flat.
fn dictionary<'py, T: Clone>(
    py: Python<'py>,
    (samples, names): (Samples<T>, &[String]),
    column: impl Fn(Vec<T>) -> PyResult<Bound<'py, PyAny>>,
    missing: T,
) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    let rows = samples.n.len();
    all.set_item("n", PyArray1::from_vec(py, samples.n))?;
    let columns = [("t", samples.t), ("q", samples.q), ("p", samples.p), ("energy", samples.energy)];
    for (name, numbers) in columns {
        all.set_item(name, column(numbers)?)?;
    }
    let values = PyDict::new(py);
    for (name, numbers) in names.iter().zip(samples.values) {
        let numbers = numbers.into_iter().map(|number| number.unwrap_or_else(|| missing.clone()));
        values.set_item(name, column(numbers.collect())?)?;
    }
    all.set_item("values", values)?;
    if !samples.modified.is_empty() {
        let mut modified = samples.modified;
        let orders: Vec<i64> = modified.iter().map(|found| found.order.into()).collect();
        let errors = modified.iter().map(|found| found.error.clone().unwrap_or_else(|| missing.clone()));
        let mut errors: Vec<T> = errors.collect();
        let mut values: Vec<T> = modified.drain(..).map(|found| found.value).collect();
        values.resize(rows, missing.clone());
        errors.resize(rows, missing);
        all.set_item("modified_energy", column(values)?)?;
        all.set_item("modified_energy_error", column(errors)?)?;
        all.set_item("order", PyArray1::from_vec(py, orders))?;
    }
    all.set_item("force_evaluations", samples.evaluations)?;
    all.set_item("planets", samples.interactions.as_ref().map(|found| json!(found).to_string()))?;
    Ok(all)
}
