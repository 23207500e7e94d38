//! Work without Python's lock, until it is done or Ctrl-C is pressed.

use std::cell::RefCell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::atomic::{AtomicBool, AtomicI64, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use pyo3::exceptions::{PyRecursionError, PyRuntimeError};
use pyo3::prelude::*;
use shadowstep_scenes::Observer;
use shadowstep_studies::Progress;

use crate::given::Given;

/// Signals are asked for this often.
const SIGNALS: Duration = Duration::from_millis(40);

/// After Ctrl-C the work has this time to end; then its thread is left to itself.
const PATIENCE: Duration = Duration::from_millis(150);

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
    pub(crate) fn observer_of_tasks(&self) -> impl shadowstep_studies::Observer + '_ {
        Watching(self)
    }

    /// Whether the computation is to go on.
    pub(crate) fn continues(&self) -> bool {
        !self.stop.load(Ordering::Relaxed)
    }

    /// It has reached the state n, or the n-th task; returns whether it is to go on.
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

impl shadowstep_studies::Observer for Watching<'_> {
    fn progress(&mut self, progress: Progress) {
        // in thousandths of the work
        self.0.reaches((progress.fraction * 1000.0) as i64);
    }

    fn stops(&mut self) -> bool {
        !self.0.continues()
    }
}

/// The answer of a thread: what it has found, or its panic.
pub(crate) type Answer<T> = thread::Result<T>;

/// At most this number of computations wait for each other, each within the forces of the one before: their cost is a
/// power of the evaluations in a step.
const DEEPEST: usize = 4;

thread_local! {
    /// The computations within whose forces this thread works: those that wait for it.
    static WITHIN: RefCell<Vec<u64>> = const { RefCell::new(Vec::new()) };
}

/// A number that no other computation has.
pub(crate) fn new_number() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    NEXT.fetch_add(1, Ordering::Relaxed)
}

/// The computations that wait for what this thread does, with one more; `None` if it is one of them.
pub(crate) fn within(number: u64) -> Option<Vec<u64>> {
    let mut all = WITHIN.with_borrow(Clone::clone);
    (!all.contains(&number)).then(|| {
        all.push(number);
        all
    })
}

/// Work of a thread for these computations.
pub(crate) fn working_for<T>(all: Vec<u64>, work: impl FnOnce() -> T) -> T {
    WITHIN.replace(all);
    work()
}

/// Does some work in a thread of its own, while Python's other threads run; `progress`, if there is one, is called with
/// the n of the state that was reached.
///
/// # Errors
/// `KeyboardInterrupt` after Ctrl-C, or what another handler of signals or `progress` raises: the work is asked to end,
/// and not waited for where it does not end soon. `RecursionError` where forces compute what needs these forces.
pub(crate) fn waiting<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Watched) -> T + Send + 'static,
) -> PyResult<T> {
    waiting_for(py, progress, None, work)
}

/// As [`waiting`], of work with the forces of a problem: it is asked to end where these raise something.
///
/// # Errors
/// Also what the forces have raised.
pub(crate) fn waiting_for<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    problem: Option<&Given>,
    work: impl FnOnce(&Watched) -> T + Send + 'static,
) -> PyResult<T> {
    let within = within(new_number()).filter(|all| all.len() <= DEEPEST).ok_or_else(|| {
        let message = "the forces of a computation compute what needs these forces again, without an end";
        PyRecursionError::new_err(message)
    })?;
    let watched = Arc::<Watched>::default();
    let (done, is_done) = channel();
    let of_thread = Arc::clone(&watched);
    spawned(move || drop(done.send(answered(|| working_for(within, || work(&of_thread))))))?;
    let found = awaited(py, (progress, problem), &watched, is_done);
    problem.map_or(Ok(()), |problem| problem.raised(py)).and(found)
}

/// A thread for computations.
pub(crate) fn spawned(work: impl FnOnce() + Send + 'static) -> PyResult<()> {
    let begun = thread::Builder::new().stack_size(STACK).spawn(work);
    begun.map(drop).map_err(|error| PyRuntimeError::new_err(format!("no thread can be started: {error}")))
}

/// What some work answers; a panic goes on in the thread that waits for it.
pub(crate) fn answered<T>(work: impl FnOnce() -> T) -> Answer<T> {
    panic::catch_unwind(AssertUnwindSafe(work))
}

/// Waits for the answer of another thread, as [`waiting_for`] does.
pub(crate) fn awaited<T: Send>(
    py: Python<'_>,
    (progress, problem): (Option<&Bound<'_, PyAny>>, Option<&Given>),
    watched: &Watched,
    is_done: Receiver<Answer<T>>,
) -> PyResult<T> {
    let is_done = Mutex::new(is_done); // one thread waits, but the closures of `detach` are shared
    let mut raised: Option<(PyErr, Instant)> = None;
    loop {
        match py.detach(|| is_done.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(SIGNALS)) {
            Ok(Ok(found)) => return raised.map_or(Ok(found), |(error, _)| Err(error)),
            Ok(Err(panic)) => panic::resume_unwind(panic),
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err("the thread of a computation has ended"));
            }
            Err(RecvTimeoutError::Timeout) => match raised {
                Some((error, since)) if since.elapsed() > PATIENCE => return Err(error),
                Some(_) => {}
                None => {
                    let mut checked = py.check_signals();
                    if let (Ok(()), Some(progress)) = (&checked, progress) {
                        checked = progress.call1((watched.n.load(Ordering::Relaxed),)).map(|_| ());
                    }
                    let is_over = checked.is_err() || problem.is_some_and(|problem| problem.has_raised(py));
                    watched.stop.store(is_over, Ordering::Relaxed);
                    raised = checked.err().map(|error| (error, Instant::now()));
                }
            },
        }
    }
}
