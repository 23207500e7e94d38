//! How a caller follows a run and its control, and stops them.

use crate::run::Run;
use crate::texts::error::Error;

/// Follows a run and its control; `()` does nothing.
pub trait Follower: Send {
    /// The run, or its control on the exact flow, has reached the state n.
    ///
    /// # Errors
    /// What ends the run.
    fn reaches(&mut self, run: Run<'_>, n: i64) -> Result<(), Error> {
        let _ = (run, n);
        Ok(())
    }

    /// The run is complete, and its control begins, which has as many steps.
    fn begins_control(&mut self, run: Run<'_>) {
        let _ = run;
    }

    /// There is no control, for this reason.
    fn no_control(&mut self, error: &Error) {
        let _ = error;
    }
}

impl Follower for () {}
