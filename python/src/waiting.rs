//! Work without Python's lock, until it is done or Ctrl-C is pressed.

use std::cell::RefCell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::atomic::{AtomicBool, AtomicI64, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use std::{hint, thread};

use pyo3::exceptions::{PyRecursionError, PyRuntimeError};
use pyo3::prelude::*;
use shadowstep_scenes::{Error, Note, Observer, Summary};
use shadowstep_studies::Progress;

use crate::errors::Fallible;
use crate::given::Given;
use crate::values::Json;

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
    /// An observer of a run, or of tasks on all cores.
    pub(crate) fn observer(&self) -> Watching<'_> {
        Watching { watched: self, summarises: false, notes: Vec::new(), summary: None }
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

/// Watches a run, and keeps its notes, and its summary where one is wanted.
pub(crate) struct Watching<'a> {
    pub(crate) watched: &'a Watched,
    pub(crate) summarises: bool,
    pub(crate) notes: Vec<Note>,
    summary: Option<Summary>,
}

impl Watching<'_> {
    /// The summary as lines and as an object.
    pub(crate) fn summary(&self) -> Result<Option<(String, Json)>, Error> {
        self.summary.as_ref().map(|summary| Ok((summary.to_string(), Json::of(summary)?))).transpose()
    }
}

impl Observer for Watching<'_> {
    fn progress(&mut self, n: i64) {
        self.watched.reaches(n);
    }

    fn note(&mut self, note: &Note) {
        self.notes.push(note.clone());
    }

    fn summarises(&self) -> bool {
        self.summarises
    }

    fn summary(&mut self, summary: &Summary) {
        self.summary = Some(summary.clone());
    }

    fn stops(&mut self) -> bool {
        !self.watched.continues()
    }
}

impl shadowstep_studies::Observer for Watching<'_> {
    fn progress(&mut self, progress: Progress) {
        // in thousandths of the work
        self.watched.reaches((progress.fraction * 1000.0) as i64);
    }

    fn stops(&mut self) -> bool {
        !self.watched.continues()
    }
}

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

/// Does some work in a thread of its own, while Python's other threads run.
///
/// # Errors
/// `KeyboardInterrupt` after Ctrl-C, or what another handler of signals raises: the work is asked to end, and not
/// waited for where it does not end soon. `RecursionError` where forces compute what needs these forces.
pub(crate) fn waiting<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&Watched) -> Fallible<T> + Send + 'static,
) -> Fallible<T> {
    waiting_for(py, None, None, work)
}

/// As [`waiting`]; `progress`, if there is one, is called with the n of the state that was reached. Work with the
/// forces of a problem is asked to end where these raise something.
///
/// # Errors
/// Also what `progress` or the forces have raised.
pub(crate) fn waiting_for<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    problem: Option<&Given>,
    work: impl FnOnce(&Watched) -> Fallible<T> + Send + 'static,
) -> Fallible<T> {
    let within = within(new_number()).filter(|all| all.len() <= DEEPEST).ok_or_else(|| {
        let message = "the forces of a computation compute what needs these forces again, without an end";
        PyRecursionError::new_err(message)
    })?;
    let result = asked(py, (progress, problem), within, spawned, work);
    problem.map_or(Ok(()), |problem| problem.raised(py))?;
    result
}

/// What a thread does.
pub(crate) type Task = Box<dyn FnOnce() + Send>;

/// A thread for computations.
pub(crate) fn spawned(task: Task) -> PyResult<()> {
    let begun = thread::Builder::new().stack_size(STACK).spawn(task);
    begun.map(drop).map_err(|error| PyRuntimeError::new_err(format!("no thread can be started: {error}")))
}

/// Sends some work to a thread, for these computations, and waits for its answer as [`waiting_for`] does; a panic goes
/// on here.
pub(crate) fn asked<T: Send + 'static>(
    py: Python<'_>,
    (progress, problem): (Option<&Bound<'_, PyAny>>, Option<&Given>),
    within: Vec<u64>,
    send: impl FnOnce(Task) -> PyResult<()>,
    work: impl FnOnce(&Watched) -> Fallible<T> + Send + 'static,
) -> Fallible<T> {
    let watched = Arc::<Watched>::default();
    let (done, is_done) = channel();
    let of_thread = Arc::clone(&watched);
    send(Box::new(move || {
        WITHIN.replace(within);
        drop(done.send(panic::catch_unwind(AssertUnwindSafe(|| work(&of_thread)))));
    }))?;
    let answer = match soon(&is_done) {
        Some(answer) => answer,
        None => awaited(py, (progress, problem), &watched, is_done)?,
    };
    answer.unwrap_or_else(|panic| panic::resume_unwind(panic))
}

/// What comes within some microseconds: to fall asleep and to be woken takes longer than a short task.
pub(crate) fn soon<T>(receiver: &Receiver<T>) -> Option<T> {
    const PATIENCE: Duration = Duration::from_micros(20);
    let begun = Instant::now();
    while begun.elapsed() < PATIENCE {
        match receiver.try_recv() {
            Ok(value) => return Some(value),
            Err(_) => hint::spin_loop(),
        }
    }
    None
}

fn awaited<T: Send>(
    py: Python<'_>,
    (progress, problem): (Option<&Bound<'_, PyAny>>, Option<&Given>),
    watched: &Watched,
    is_done: Receiver<T>,
) -> PyResult<T> {
    let is_done = Mutex::new(is_done); // one thread waits, but the closures of `detach` are shared
    let mut raised: Option<(PyErr, Instant)> = None;
    loop {
        match py.detach(|| is_done.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(SIGNALS)) {
            Ok(answer) => return raised.map_or(Ok(answer), |(error, _)| Err(error)),
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
