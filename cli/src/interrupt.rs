//! Ctrl-C and SIGTERM: a run ends after its present step.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use shadowstep_scenes::Error;
use shadowstep_scenes::run::Run;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// Whether a signal has asked the run to end.
pub(crate) struct Interrupt {
    asked: Arc<AtomicBool>,
}

impl Interrupt {
    /// From now on the first signal asks the run to end, and the second ends the program.
    ///
    /// SIGHUP, from a closed terminal, is left to `nohup`.
    pub(crate) fn listen() -> Self {
        let asked = Arc::default();
        for signal in [SIGINT, SIGTERM] {
            // without a handler the program ends at once, which leaves files complete too
            let _ = flag::register_conditional_shutdown(signal, 128 + signal, Arc::clone(&asked));
            let _ = flag::register(signal, Arc::clone(&asked));
        }
        Interrupt { asked }
    }

    /// An error if the run is asked to end, which has reached n.
    pub(crate) fn check(&self, run: Run<'_>, n: i64, hint: &str) -> Result<(), Error> {
        if self.asked() {
            return Err(Error::run(format!("{}: interrupted at n = {n}", run.name()), hint));
        }
        Ok(())
    }

    /// Whether the run is asked to end.
    pub(crate) fn asked(&self) -> bool {
        self.asked.load(Ordering::Relaxed)
    }
}
