//! Computing chunks with several threads.

use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::{self, Thread};
use std::time::Duration;

use shadowstep_scenes::Error;
use shadowstep_scenes::family::Parsed;
use shadowstep_studies::{Observer, Progress};

use crate::chunk::{self, Chunk, Header};
use crate::manifest::{Manifest, VERSION};
use crate::partial::Partial;
use crate::plan::SweepPlan;
use crate::record::Record;

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
    let (chunks, parsed) = (chunks.into_iter(), plan.family().parsed()?);
    let runs = |chunk: Chunk| chunk.runs(manifest.runs);
    let all = chunks.clone().map(runs).map(|runs| runs.end - runs.start).sum();
    let stops = AtomicBool::new(false);
    let state = Mutex::new(State { chunks, open: Vec::new(), computed: Computed::default(), saved: 0, error: None });
    let (threads, attendant) = (rayon::current_num_threads(), thread::current());
    let due = Due { plan, parsed: &parsed, manifest, folder, stops: &stops, threads };
    let working = AtomicUsize::new(threads);
    let work = || {
        let _end = Ends { working: &working, attendant: &attendant };
        due.work(&state);
    };
    let made = thread::scope(|scope| {
        // where memory is limited there are fewer threads
        let spawn = |_| thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work).ok();
        let workers: Vec<_> = (0..threads).map_while(spawn).collect();
        (workers.len()..threads).for_each(|_| drop(Ends { working: &working, attendant: &attendant }));
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

/// At its end a thread is counted off before the waiting thread wakes, be it by a panic.
struct Ends<'a> {
    working: &'a AtomicUsize,
    attendant: &'a Thread,
}

impl Drop for Ends<'_> {
    fn drop(&mut self) {
        self.working.fetch_sub(1, Ordering::Release);
        self.attendant.unpark();
    }
}

/// Waits for the threads; shows the progress, and stops them when the observer asks for it.
fn attend<I>(
    working: &AtomicUsize,
    state: &Mutex<State<I>>,
    stops: &AtomicBool,
    all: u64,
    observer: &mut dyn Observer,
) {
    let mut shown = u64::MAX;
    while working.load(Ordering::Acquire) > 0 {
        thread::park_timeout(TICK);
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
    open: Vec<Open>,
    computed: Computed,
    /// How many runs were saved by earlier calls.
    saved: u64,
    error: Option<Error>,
}

/// A chunk of which some runs are not saved.
struct Open {
    chunk: Chunk,
    header: Header,
    partial: Partial,
    /// The next run that may have to be made.
    next: u64,
    end: u64,
    /// How many are being made.
    running: usize,
}

impl Due<'_> {
    /// Makes runs until there are no more.
    fn work<I: Iterator<Item = Chunk>>(&self, state: &Mutex<State<I>>) {
        while !self.stops.load(Ordering::Relaxed) {
            let next = self.next(&mut locked(state));
            let done = match next {
                Ok(Some(Work::Runs(chunk, runs))) => self.make(state, chunk, &runs),
                Ok(Some(Work::Finish(open))) => self.finish(open),
                Ok(None) => return,
                Err(error) => Err(error),
            };
            if let Err(error) = done {
                self.stops.store(true, Ordering::Relaxed);
                locked(state).error.get_or_insert(error);
            }
        }
    }

    /// The next runs, of an open chunk or of one that is opened for them.
    fn next<I: Iterator<Item = Chunk>>(&self, state: &mut State<I>) -> Result<Option<Work>, Error> {
        loop {
            for open in &mut state.open {
                let runs = open.take(self.plan.batch(), self.threads);
                if !runs.is_empty() {
                    return Ok(Some(Work::Runs(open.chunk, runs)));
                }
            }
            // a chunk all of whose runs were saved before
            if let Some(place) = state.open.iter().position(Open::is_complete) {
                return Ok(Some(Work::Finish(state.open.swap_remove(place))));
            }
            let Some(chunk) = state.chunks.next() else { return Ok(None) };
            if is_there(self.manifest, self.folder, chunk) {
                let runs = chunk.runs(self.manifest.runs);
                state.saved += runs.end - runs.start;
                continue;
            }
            let header = header(self.plan, self.manifest, chunk);
            let runs = chunk.runs(self.manifest.runs);
            let partial = Partial::open(self.folder, chunk, &header, runs.clone())?;
            state.saved += partial.records.len() as u64;
            state.open.push(Open { chunk, header, partial, next: runs.start, end: runs.end, running: 0 });
        }
    }

    /// Makes runs and keeps their records.
    fn make<I>(&self, state: &Mutex<State<I>>, chunk: Chunk, runs: &[u64]) -> Result<(), Error> {
        self.plan.make(self.parsed, runs, self.stops, |record| self.keep(state, chunk, &record))
    }

    fn keep<I>(&self, state: &Mutex<State<I>>, chunk: Chunk, record: &Record) -> Result<(), Error> {
        let mut state = locked(state);
        let place =
            state.open.iter().position(|open| open.chunk == chunk).expect("a chunk stays open while it has runs");
        state.open[place].running -= 1;
        state.open[place].partial.keep(record)?;
        state.computed.include(record);
        if state.open[place].is_complete() {
            let open = state.open.swap_remove(place);
            drop(state);
            return self.finish(open);
        }
        Ok(())
    }

    fn finish(&self, open: Open) -> Result<(), Error> {
        chunk::write(self.folder, open.chunk, &open.header, &open.partial.into_records())
    }
}

/// What a thread does next.
enum Work {
    Runs(Chunk, Vec<u64>),
    Finish(Open),
}

impl Open {
    /// Takes runs that are not saved, `most` at most, and fewer at the end of the chunk, so that all threads have some.
    fn take(&mut self, most: usize, threads: usize) -> Vec<u64> {
        let left = usize::try_from(self.end - self.next).unwrap_or(usize::MAX);
        let most = most.min(left.div_ceil(2 * threads));
        let saved = &self.partial.records;
        let runs: Vec<u64> = (self.next..self.end).filter(|run| !saved.contains_key(run)).take(most).collect();
        self.next = runs.last().filter(|_| runs.len() == most).map_or(self.end, |last| last + 1);
        self.running += runs.len();
        runs
    }

    fn is_complete(&self) -> bool {
        self.next == self.end && self.running == 0
    }
}

impl Computed {
    fn include(&mut self, record: &Record) {
        self.runs += 1;
        if let Some(failure) = &record.failure {
            self.failed += 1;
            let first = self.first_failure.get_or_insert_with(|| (record.run, failure.clone()));
            if record.run < first.0 {
                *first = (record.run, failure.clone());
            }
        }
    }
}

/// The header of a chunk that this process makes.
fn header(plan: &SweepPlan, manifest: &Manifest, chunk: Chunk) -> Header {
    let runs = chunk.runs(manifest.runs);
    Header {
        shadowstep: VERSION.to_owned(),
        digests: manifest.digests.clone(),
        functions: plan.functions().map(str::to_owned),
        chunk: chunk.number,
        of: chunk.of,
        first: runs.start,
        runs: runs.end - runs.start,
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
