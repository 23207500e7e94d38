//! Ctrl-C and a polite `kill`: a run ends after its present step.

use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

/// From now on the first signal asks the run to end, and the second ends it.
pub(crate) fn listen() {
    let handler = || {
        if ASKED.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    };
    // without a handler the program ends at once, and files are whole nevertheless
    let _ = ctrlc::set_handler(handler);
}

/// Whether the run is asked to end.
pub(crate) fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}
