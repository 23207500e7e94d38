//! Work without Python's lock, until it is done or Ctrl-C is pressed.

use std::sync::atomic::{AtomicBool, AtomicI64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use shadowstep_scenes::Observer;
use shadowstep_tasks::Progress;

/// Signals are asked for this often.
const SIGNALS: Duration = Duration::from_millis(40);

/// The stack of the thread that works: unoptimised builds need more than the default.
const STACK: usize = 16 << 20;

/// What a computation reports, and whether it is to stop.
#[derive(Debug, Default)]
pub(crate) struct Watched {
    stop: AtomicBool,
    n: AtomicI64,
}

impl Watched {
    /// An observer of a run.
    pub(crate) fn observer(&self) -> impl Observer + '_ {
        Watching(self)
    }

    /// An observer of tasks on all cores.
    pub(crate) fn observer_of_tasks(&self) -> impl shadowstep_tasks::Observer + '_ {
        Watching(self)
    }

    /// Whether the computation is to go on.
    pub(crate) fn continues(&self) -> bool {
        !self.stop.load(Ordering::Relaxed)
    }

    /// It has reached the state n, or n tasks; returns whether it is to go on.
    pub(crate) fn reaches(&self, n: i64) -> bool {
        self.n.store(n, Ordering::Relaxed);
        self.continues()
    }
}

struct Watching<'a>(&'a Watched);

impl Observer for Watching<'_> {
    fn progress(&mut self, n: i64) {
        self.0.reaches(n);
    }

    fn stops(&mut self) -> bool {
        !self.0.continues()
    }
}

impl shadowstep_tasks::Observer for Watching<'_> {
    fn progress(&mut self, progress: Progress) {
        // in thousandths of the work
        self.0.reaches((progress.fraction * 1000.0) as i64);
    }

    fn stops(&mut self) -> bool {
        !self.0.continues()
    }
}

/// Does some work in a thread of its own, while Python's other threads run; `progress`, if there is one, is called with the n of the
/// state that was reached.
///
/// # Errors
/// `KeyboardInterrupt` after Ctrl-C, or what another handler of signals or `progress` raises.
pub(crate) fn waiting<T: Send>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Watched) -> T + Send,
) -> PyResult<T> {
    let watched = &Watched::default();
    thread::scope(|scope| {
        let (done, is_done) = channel();
        let is_done = Mutex::new(is_done); // one thread waits, but the closures of `detach` are shared
        let begun = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, move || {
            let _ = done.send(work(watched));
        });
        begun.map_err(|error| PyRuntimeError::new_err(format!("no thread can be started: {error}")))?;
        let mut raised = Ok(());
        loop {
            match py.detach(|| is_done.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(SIGNALS)) {
                Ok(found) => return raised.map(|()| found),
                Err(RecvTimeoutError::Disconnected) => return Err(PyRuntimeError::new_err("a computation panicked")),
                Err(RecvTimeoutError::Timeout) if raised.is_err() => {}
                Err(RecvTimeoutError::Timeout) => {
                    raised = py.check_signals();
                    if let (Ok(()), Some(progress)) = (&raised, progress) {
                        raised = progress.call1((watched.n.load(Ordering::Relaxed),)).map(|_| ());
                    }
                    watched.stop.store(raised.is_err(), Ordering::Relaxed);
                }
            }
        }
    })
}
