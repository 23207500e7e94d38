//! What is computed of schemes: code, proposals, the modified Hamiltonian; and new tables, polished to more digits or
//! searched for.

use pyo3::prelude::*;
use rayon::prelude::*;
use shadowstep::tables::Source;
use shadowstep_analysis::gaussian::Gaussian;
use shadowstep_analysis::polish::{self, NotPolished};
use shadowstep_analysis::search::{Candidate, Request, Search};
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::modified_hamiltonian::record::{Formulas, SeriesOptions, SeriesRecord};
use shadowstep_scenes::sampling::{SamplingTarget, Wanted};
use shadowstep_scenes::{Error, Refusal, library};
use shadowstep_schemes::shipped;
use shadowstep_schemes::symbolic::Notation;
use shadowstep_studies::emit::Target;

use crate::errors::{Fallible, usage};
use crate::given::Given;
use crate::scheme::Table;
use crate::waiting::waiting;

/// The text of a scheme for a target.
#[pyfunction]
pub(crate) fn emit(py: Python<'_>, scheme: &Table, target: &str) -> Fallible<String> {
    let target: Target = target.parse().map_err(|_| {
        let names: Vec<_> = Target::ALL.iter().map(|target| target.name()).collect();
        usage(format!("there is no target `{target}`"), format!("it is one of {}", names.join(", ")))
    })?;
    let scheme = scheme.0.quadratic();
    waiting(py, move |_| {
        shadowstep_studies::emit::emit(&scheme, target)
            .map_err(|refusal| usage(format!("{} {}", refusal.scheme, refusal.reason), refusal.hint))
    })
}

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
) -> Fallible<Numbers> {
    let gaussian = Gaussian::new(frequencies).map_err(|error| {
        usage(error.to_string(), "give positive numbers: 1/σ of a direction with standard deviation σ")
    })?;
    let condition = match (acceptance, steps) {
        (None, None) => Wanted::LeastCost,
        (Some(rate), None) => Wanted::Acceptance(rate),
        (None, Some(steps)) => Wanted::Steps(steps),
        (Some(_), Some(_)) => return Err(usage("acceptance and steps exclude each other", "give one of them")),
    };
    let target = SamplingTarget::new(gaussian, time, condition)?;
    let scheme = scheme.0.clone();
    let record = waiting(py, move |_| Ok(target.record(&scheme)?))?;
    Ok((record.steps, record.step, record.gradients, record.error, record.largest_error, record.acceptance))
}

/// The terms of the series: the power of h, the bracket, the coefficient.
#[pyfunction]
pub(crate) fn modified_series(
    py: Python<'_>,
    scheme: &Table,
    grade: u32,
    parts: Option<u32>,
    quadratic: bool,
    digits: usize,
) -> Fallible<Vec<(u32, String, String)>> {
    let scheme = scheme.0.clone();
    let options = SeriesOptions { grade, parts, quadratic, digits };
    let series = waiting(py, move |_| Ok(SeriesRecord::of(scheme.scheme.proved(), options).map_err(Error::from)?))?;
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
) -> Fallible<Texts> {
    let notation = match notation {
        "text" => Notation::Formula,
        "latex" => Notation::Latex,
        "rust" => Notation::Rust,
        "numpy" => Notation::NumPy,
        other => return Err(usage(format!("there is no notation `{other}`"), "it is one of text, latex, rust, numpy")),
    };
    let (system, scheme) = (problem.read(Arithmetic::DOUBLE)?, scheme.0.clone());
    let (formulas, function, arguments) = waiting(py, move |_| {
        let written = || -> Result<_, Refusal> {
            let formulas = Formulas::of(&system.system, &scheme, grade)?;
            // numbers of double precision
            let in_numpy = formulas.written(Notation::NumPy, 17)?;
            let function = in_numpy.function(&in_numpy.title(), Notation::NumPy);
            let arguments = in_numpy.names.into_iter().map(|(name, _)| name).collect();
            Ok((formulas.written(notation, digits)?, function, arguments))
        };
        Ok(written().map_err(Error::from)?)
    })?;
    let terms = formulas.terms.into_iter().map(|term| (term.power, term.formula)).collect();
    Ok((formulas.hamiltonian, terms, function, arguments))
}

/// The text of a table with more digits; `word` is its text, where it has line breaks, else what [`library::source`]
/// takes.
#[pyfunction]
pub(crate) fn polished(
    py: Python<'_>,
    word: String,
    digits: Option<u32>,
    free: Vec<String>,
    split_kicks: bool,
    closed_gaps: Vec<f64>,
) -> Fallible<String> {
    if closed_gaps.iter().any(|gap| !(gap.is_finite() && *gap > 0.0)) {
        let hint = "give hω near which a step turns by a multiple of π";
        return Err(usage("closed_gaps must be positive numbers", hint));
    }
    waiting(py, move |_| {
        let source = match word.contains('\n') {
            true => Source { path: "table".to_owned(), text: word },
            false => library::source(&word).map_err(Error::from)?,
        };
        let request = polish::Request { digits, free: &free, split_kicks, closed_gaps: &closed_gaps };
        Ok(polish::polish(&source, &library::beside_or_shipped, &request).map_err(of_polish)?.text)
    })
}

/// The tables that a search finds, the best first; `text` is the file of the search.
#[pyfunction]
pub(crate) fn searched(
    py: Python<'_>,
    text: String,
    path: String,
    starts: Option<usize>,
    seed: Option<u64>,
    digits: Option<u32>,
) -> Fallible<Vec<String>> {
    waiting(py, move |watched| {
        let mut request = Request::read(&Source { path, text }).map_err(Error::from)?;
        request.starts = starts.unwrap_or(request.starts);
        request.seed = seed.unwrap_or(request.seed);
        let of_library = |base: &str, _: &Source| shipped(base);
        let search = Search::new(request, &of_library).map_err(Error::from)?;
        let continues = || watched.continues();
        let start = |start: usize| search.start_while(start, &continues).filter(|_| continues());
        let candidates: Vec<Candidate> = (0..search.starts()).into_par_iter().filter_map(start).collect();
        let best = search.best(&candidates).into_iter().zip(1..);
        let table = |(candidate, n): (&Candidate, u32)| {
            let name = format!("{}-{n}", search.request.name);
            Ok(search.table(candidate, &name, digits, &of_library).map_err(of_polish)?.text)
        };
        best.map(table).collect()
    })
}

fn of_polish(error: NotPolished) -> Error {
    match error {
        NotPolished::Faults(faults) => Error::Faults(faults),
        NotPolished::Request { message, hint } | NotPolished::Unsolved { message, hint } => Error::usage(message, hint),
    }
}
