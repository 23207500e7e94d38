//! The drift of one run.

use shadowstep::shadow::run::{DriftRecorder, EnergyDrift};

use crate::analyses::estimates::{Estimates, Finished};
use crate::execution::computation::RunNumber;
use crate::texts::error::Error;

/// The drift of a run, and what is known of the run besides.
pub(super) fn measure<N: RunNumber>(
    estimates: Estimates<'_>,
    context: &N::Context,
    mut progress: impl FnMut(i64) -> Result<(), Error>,
) -> Result<(EnergyDrift<N>, Finished<N>), Error> {
    let run = estimates.run;
    let drift = DriftRecorder::new(run.h.clone());
    let mut drift = drift.compensated_if(estimates.is_compensated());
    let finished = estimates.take::<N>(context, &mut |n, estimate| {
        drift.include(n, estimate);
        progress(n)
    })?;
    let found = drift.drift().expect("a run has the state 0");
    // both extremes may be finite where their difference overflows
    if found.drift.is_finite() { Ok((found, finished)) } else { Err(run.not_finite("the energy drift")) }
}
