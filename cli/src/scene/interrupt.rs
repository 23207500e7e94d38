//! Ctrl-C and a polite `kill`: a run ends after its present step.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

static ASKED: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// From now on the first signal asks the run to end, and the second ends it.
///
/// A terminal that is closed (SIGHUP) is not listened to: `nohup` sees to that.
pub(crate) fn listen() {
    let asked = ASKED.get_or_init(Arc::default);
    for signal in [SIGINT, SIGTERM] {
        // without a handler the program ends at once, and files are whole nevertheless
        let _ = flag::register_conditional_shutdown(signal, 128 + signal, Arc::clone(asked));
        let _ = flag::register(signal, Arc::clone(asked));
    }
}

/// Whether the run is asked to end.
pub(crate) fn asked() -> bool {
    ASKED.get().is_some_and(|asked| asked.load(Ordering::Relaxed))
}
