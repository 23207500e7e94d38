//! New tables: printed decimals polished to more digits, and searches for schemes.

use pyo3::prelude::*;
use rayon::prelude::*;
use shadowstep::tables::Source;
use shadowstep_analysis::polish::{self, NotPolished};
use shadowstep_analysis::search::{Candidate, Request, Search};
use shadowstep_scenes::{Error, library};
use shadowstep_schemes::shipped;

use crate::errors::{Fallible, usage};
use crate::waiting::waiting;

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
        let wanted = polish::Request { digits, free: &free, split_kicks, closed_gaps: &closed_gaps };
        Ok(polish::polish(&source, &library::beside_or_shipped, &wanted).map_err(of_polish)?.text)
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
