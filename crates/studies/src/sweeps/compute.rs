//! Computing chunks with several threads.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use shadowstep_scenes::family::Parsed;

use crate::sweeps::chunk::{self, Chunk};
use crate::sweeps::manifest::Manifest;
use crate::sweeps::partial::Partial;
use crate::sweeps::plan::SweepPlan;
use crate::sweeps::record::Record;
use crate::{Error, Observer, Progress};

/// How often the observer is asked.
const TICK: Duration = Duration::from_millis(50);

/// What has been computed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Computed {
    /// How many runs were made.
    pub runs: u64,
    /// How many of them failed.
    pub failed: u64,
    /// One of those: its number and why it failed.
    pub first_failure: Option<(u64, String)>,
}

/// Computes chunks that are not there yet, with all threads of the current rayon pool. A run that fails stops nothing.
///
/// The bytes of the files do not depend on the number of threads, nor on earlier calls that were interrupted at any
/// moment.
///
/// # Errors
/// A file that cannot be written; an observer that stops the computation.
pub fn compute(
    plan: &SweepPlan,
    manifest: &Manifest,
    folder: &Path,
    chunks: impl IntoIterator<Item = Chunk, IntoIter: Send + Clone>,
    observer: &mut dyn Observer,
) -> Result<Computed, Error> {
    let (chunks, parsed) = (chunks.into_iter(), plan.family.parsed()?);
    let all = chunks.clone().map(|chunk| chunk.count(manifest.runs)).sum();
    let stops = AtomicBool::new(false);
    let state = Mutex::new(State { chunks, open: Vec::new(), computed: Computed::default(), saved: 0, error: None });
    let threads = rayon::current_num_threads();
    let due = Due { plan, parsed: &parsed, manifest, folder, stops: &stops, threads };
    let (works, working) = mpsc::channel::<()>();
    let made = thread::scope(|scope| {
        let spawn = |_| {
            // dropped when the thread ends, be it by a panic
            let works = works.clone();
            let work = || {
                let _works = works;
                due.work(&state);
            };
            thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work).ok()
        };
        // where memory is limited there are fewer threads
        let workers: Vec<_> = (0..threads).map_while(spawn).collect();
        drop(works);
        attend(&working, &state, &stops, all, observer);
        let made = workers.len();
        workers.into_iter().for_each(|worker| worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        made
    });
    if made == 0 {
        return Err(Error::run("no thread can be started", "allow the process more memory"));
    }
    let state = state.into_inner().unwrap_or_else(PoisonError::into_inner);
    match state.error {
        Some(error) => Err(error),
        None if stops.load(Ordering::Relaxed) => {
            let message = format!("interrupted: {} runs of this call are saved", state.computed.runs);
            Err(Error::run(message, "the same command computes the others"))
        }
        None => Ok(state.computed),
    }
}

/// Bytes of a thread's stack: without optimisation a run of long numbers has many copies of them there, more than the
/// usual 2 MiB.
const STACK: usize = 4 << 20;

/// Waits for the threads; shows the progress, and stops them when the observer asks for it.
fn attend<I>(
    working: &Receiver<()>,
    state: &Mutex<State<I>>,
    stops: &AtomicBool,
    all: u64,
    observer: &mut dyn Observer,
) {
    let (mut shown, mut is_working) = (u64::MAX, true);
    while is_working {
        is_working = working.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout);
        if observer.stops() {
            stops.store(true, Ordering::Relaxed);
        }
        let (made, saved) = {
            let state = locked(state);
            (state.computed.runs, state.saved)
        };
        if made + saved != std::mem::replace(&mut shown, made + saved) && !stops.load(Ordering::Relaxed) {
            // what was saved before took no time
            let fraction = made as f64 / (all - saved).max(1) as f64;
            let count = |runs: u64| usize::try_from(runs).unwrap_or(usize::MAX);
            observer.progress(Progress { done: count(made + saved), all: count(all), fraction });
        }
    }
}

/// What is to be computed.
struct Due<'a> {
    plan: &'a SweepPlan,
    parsed: &'a Parsed<'a>,
    manifest: &'a Manifest,
    folder: &'a Path,
    stops: &'a AtomicBool,
    threads: usize,
}

/// What is being computed. At most one chunk is open for each thread, whatever the number of runs.
struct State<I> {
    chunks: I,
    open: Vec<Partial>,
    computed: Computed,
    /// How many runs were saved by earlier calls.
    saved: u64,
    error: Option<Error>,
}

impl Due<'_> {
    /// Makes runs until there are no more.
    fn work<I: Iterator<Item = Chunk>>(&self, state: &Mutex<State<I>>) {
        while !self.stops.load(Ordering::Relaxed) {
            let next = self.next(&mut locked(state));
            let done = match next {
                Ok(None) => return,
                Ok(Some((chunk, runs))) => {
                    self.plan.make(self.parsed, &runs, self.stops, |record| self.keep(state, chunk, &record))
                }
                Err(error) => Err(error),
            };
            if let Err(error) = done {
                self.stops.store(true, Ordering::Relaxed);
                locked(state).error.get_or_insert(error);
            }
        }
    }

    /// The next runs, of an open chunk or of one that is opened for them.
    fn next<I: Iterator<Item = Chunk>>(&self, state: &mut State<I>) -> Result<Option<(Chunk, Vec<u64>)>, Error> {
        loop {
            for partial in &mut state.open {
                let runs = partial.take(self.plan.batch(), self.threads);
                if !runs.is_empty() {
                    return Ok(Some((partial.header.chunk, runs)));
                }
            }
            let Some(chunk) = state.chunks.next() else { return Ok(None) };
            if is_there(self.manifest, self.folder, chunk) {
                state.saved += chunk.count(self.manifest.runs);
                continue;
            }
            let partial = Partial::open(self.folder, self.manifest.header(self.plan, chunk))?;
            state.saved += partial.records.len() as u64;
            match partial.is_complete() {
                true => partial.finish(self.folder)?,
                false => state.open.push(partial),
            }
        }
    }

    /// Keeps a record, and the chunk of which it is the last one.
    fn keep<I>(&self, state: &Mutex<State<I>>, chunk: Chunk, record: &Record) -> Result<(), Error> {
        let mut state = locked(state);
        let is_of = |partial: &Partial| partial.header.chunk == chunk;
        let place = state.open.iter().position(is_of).expect("a chunk stays open while it has runs");
        state.open[place].keep(record)?;
        state.computed.include(record);
        if !state.open[place].is_complete() {
            return Ok(());
        }
        let complete = state.open.swap_remove(place);
        drop(state);
        complete.finish(self.folder)
    }
}

impl Computed {
    fn include(&mut self, record: &Record) {
        self.runs += 1;
        self.failed += u64::from(record.failure.is_some());
        let failure = record.failure.clone().map(|failure| (record.run, failure));
        self.first_failure = self.first_failure.take().into_iter().chain(failure).min();
    }
}

/// Whether the file of a chunk is there, whole, and of this manifest. One that is damaged is computed again.
pub fn is_there(manifest: &Manifest, folder: &Path, chunk: Chunk) -> bool {
    let found = chunk::read(folder, chunk, manifest.runs, |_| Ok(()));
    found.is_ok_and(|read| read.is_ok_and(|header| manifest.check_header(&header).is_ok()))
}

/// A thread that panicked leaves no partial changes.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
