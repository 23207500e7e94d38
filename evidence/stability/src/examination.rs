//! From a request to the findings.

use std::path::Path;

use shadowstep_scenes::Error;
use shadowstep_studies::finding::Finding;
use shadowstep_studies::{Observer, Store, named};

use crate::case::{Entry, Trial};
use crate::cases::CASES;
use crate::suite::Suite;

/// A case of the list.
#[derive(Clone, Copy)]
pub struct CaseEntry(&'static Entry);

impl CaseEntry {
    /// The name by which it is requested.
    pub fn name(&self) -> &'static str {
        self.0.name
    }

    /// Its heading.
    pub fn title(&self) -> &'static str {
        self.0.title
    }

    /// What theory predicts.
    pub(crate) fn theory(&self) -> &'static str {
        self.0.theory
    }
}

/// The names of all cases, in the order of the report.
pub fn names() -> Vec<&'static str> {
    CASES.iter().map(|entry| entry.name).collect()
}

/// The cases with these names; all, if there are none.
///
/// # Errors
/// An unknown name.
pub fn entries(requested: &[String]) -> Result<Vec<CaseEntry>, Error> {
    Ok(named(CASES, |entry| entry.name, "case", requested)?.into_iter().map(CaseEntry).collect())
}

/// Makes the trials that the folder does not have yet, all cases together, and gives what each case has shown. A failed
/// trial is reported to the observer and stops no other.
///
/// # Errors
/// A folder that cannot be written or that another process uses; an observer that stops the computation.
pub fn examine(
    suite: &Suite,
    cases: &[CaseEntry],
    folder: &Path,
    observer: &mut dyn Observer,
) -> Result<Vec<(CaseEntry, Finding)>, Error> {
    let mut store = Store::open(folder, observer)?;
    let by_case: Vec<Vec<Trial<'_>>> = cases.iter().map(|case| case.0.trials(suite)).collect();
    let counts: Vec<usize> = by_case.iter().map(Vec::len).collect();
    let trials: Vec<Trial<'_>> = by_case.into_iter().flatten().collect();
    let mut results = store.compute(&trials, observer)?.into_iter();
    let finding = |(case, count): (&CaseEntry, usize)| {
        let own = results.by_ref().take(count).collect();
        (*case, case.0.finding(suite, own))
    };
    Ok(cases.iter().zip(counts).map(finding).collect())
}
