//! From a request to the findings.

use std::path::Path;

use crate::finding::Finding;
use crate::stability::case::{Calculated, CaseEntry};
use crate::stability::cases::CASES;
use crate::stability::suite::Suite;
use crate::{Error, Observer, Store, named};

/// The names of all cases, in the order of the report.
pub fn names() -> Vec<&'static str> {
    CASES.iter().map(|entry| entry.name).collect()
}

/// The cases with these names; all, if there are none.
///
/// # Errors
/// An unknown name.
pub fn entries(requested: &[String]) -> Result<Vec<&'static CaseEntry>, Error> {
    named(&CASES, |entry| entry.name, "case", requested)
}

/// Makes the trials that the folder does not have yet, all cases together, and gives what each case has shown. A failed
/// trial is reported to the observer and stops no other.
///
/// # Errors
/// A folder that cannot be written or that another process uses; an observer that stops the computation.
pub fn examine(
    suite: &Suite,
    cases: &[&'static CaseEntry],
    folder: &Path,
    observer: &mut dyn Observer,
) -> Result<Vec<(&'static CaseEntry, Finding)>, Error> {
    let mut store = Store::open(folder, observer)?;
    let by_case: Vec<Vec<Calculated<'_>>> = cases.iter().map(|case| case.trials(suite)).collect();
    let counts: Vec<usize> = by_case.iter().map(Vec::len).collect();
    let trials: Vec<Calculated<'_>> = by_case.into_iter().flatten().collect();
    let mut results = store.compute(&trials, observer)?.into_iter();
    let finding = |(case, count): (&&'static CaseEntry, usize)| {
        let own = results.by_ref().take(count).collect();
        (*case, case.finding(suite, own))
    };
    Ok(cases.iter().zip(counts).map(finding).collect())
}
