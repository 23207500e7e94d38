//! Ctrl-C and SIGTERM: a run ends after its present state, or a second later wherever it is.

use std::panic;
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, Thread};
use std::time::{Duration, Instant};

use shadowstep_scenes::run::Run;
use shadowstep_scenes::{Error, remove_temporary_files};
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use crate::report;

/// How long a run may take to end after its present state.
const PATIENCE: Duration = Duration::from_millis(800);

/// How often signals are looked for.
const TICK: Duration = Duration::from_millis(20);

/// The stack of a computation in another thread is as large as that of the first one.
const STACK: usize = 8 << 20;

/// Whether a signal has asked the run to end.
pub(crate) struct Interrupt {
    state: Arc<State>,
}

#[derive(Default)]
struct State {
    asked: AtomicBool,
    /// The run ends, and is waited for.
    ends: AtomicBool,
    /// The run has not ended in time.
    late: AtomicBool,
    /// The thread that waits for the run in another thread.
    attendant: Mutex<Option<Thread>>,
}

impl Interrupt {
    /// From now on the first signal asks the run to end. If it does not soon, or at a second signal, the program ends
    /// with the error that this was interrupted, and with this hint; it leaves no incomplete files.
    ///
    /// It is called before the first file is created: without it a signal ends the program wherever it is.
    ///
    /// SIGHUP, from a closed terminal, is left to `nohup`.
    pub(crate) fn listen(what: impl Into<String>, hint: impl Into<String>) -> Self {
        let (state, signalled) = (Arc::<State>::default(), Arc::<AtomicBool>::default());
        for signal in [SIGINT, SIGTERM] {
            // without a handler the program ends at once
            let _ = flag::register(signal, Arc::clone(&signalled));
        }
        let (seen, what, hint) = (Arc::clone(&state), what.into(), hint.into());
        thread::spawn(move || {
            seen.attend(&signalled);
            leave(&Error::run(format!("{what}: interrupted"), hint));
        });
        Interrupt { state }
    }

    /// An error if the run is asked to end, which has reached n.
    pub(crate) fn check(&self, run: Run<'_>, n: i64, hint: &str) -> Result<(), Error> {
        if self.ends() {
            return Err(Error::run(format!("{}: interrupted at n = {n}", run.name()), hint));
        }
        Ok(())
    }

    /// Whether the run is asked to end; if so, the caller ends it.
    pub(crate) fn ends(&self) -> bool {
        let asked = self.asked();
        if asked {
            self.state.ends.store(true, Ordering::Relaxed);
        }
        asked
    }

    /// Whether the run is asked to end, of which the caller may be a part.
    pub(crate) fn asked(&self) -> bool {
        self.state.asked.load(Ordering::Relaxed)
    }

    /// Computes something in another thread. If that does not end in time after a signal, `save` is called before the
    /// program ends.
    pub(crate) fn attended<R: Send>(&self, compute: impl FnOnce() -> R + Send, save: impl FnOnce() -> Error) -> R {
        let done = AtomicBool::new(false);
        let attendant = thread::current();
        *self.state.attendant.lock().unwrap_or_else(PoisonError::into_inner) = Some(attendant.clone());
        thread::scope(|scope| {
            let work = || {
                let _end = Wakes { attendant, done: &done };
                compute()
            };
            let worker = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work);
            let worker = worker.expect("a thread can be started");
            while !done.load(Ordering::Acquire) {
                if self.state.late.load(Ordering::Relaxed) {
                    leave(&save());
                }
                thread::park();
            }
            worker.join().unwrap_or_else(|panic| panic::resume_unwind(panic))
        })
    }
}

impl State {
    /// Waits for a signal, and for the run to end after it: until it has had its time, or until another signal.
    fn attend(&self, signalled: &AtomicBool) {
        while !signalled.swap(false, Ordering::Relaxed) {
            thread::sleep(TICK);
        }
        self.asked.store(true, Ordering::Relaxed);
        let asked = Instant::now();
        while !signalled.load(Ordering::Relaxed) && (self.ends.load(Ordering::Relaxed) || asked.elapsed() < PATIENCE) {
            thread::sleep(TICK);
        }
        self.late.store(true, Ordering::Relaxed);
        if let Some(attendant) = &*self.attendant.lock().unwrap_or_else(PoisonError::into_inner) {
            attendant.unpark();
            thread::sleep(PATIENCE);
        }
    }
}

/// Wakes the thread that waits for a computation when it ends, be it by a panic.
struct Wakes<'a> {
    attendant: Thread,
    done: &'a AtomicBool,
}

impl Drop for Wakes<'_> {
    fn drop(&mut self) {
        self.done.store(true, Ordering::Release);
        self.attendant.unpark();
    }
}

/// Ends the program with an error, without incomplete files.
fn leave(error: &Error) -> ! {
    remove_temporary_files();
    process::exit(report::error(error) as i32)
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::env;
    use std::process::{Command, Stdio};

    const SELF: &str = "interrupt::tests::in_a_program_of_its_own";

    /// Computes for longer than a test may take, and saves something when it is asked to end.
    #[test]
    #[ignore = "the program that the other test interrupts"]
    fn in_a_program_of_its_own() {
        let interrupt = Interrupt::listen("a test", "it is over");
        assert_eq!(interrupt.attended(|| 7, || unreachable!()), 7);
        println!("begun");
        let save = || {
            println!("saved");
            Error::run("a test: interrupted", "it is over")
        };
        interrupt.attended(|| thread::sleep(Duration::from_secs(120)), save);
        println!("computed");
    }

    /// A long computation does not keep the program from saving what it has.
    #[test]
    fn what_is_complete_is_saved_during_a_long_computation() {
        use std::io::{BufRead, BufReader, Read};
        let mut child = Command::new(env::current_exe().unwrap())
            .args([SELF, "--exact", "--ignored", "--nocapture"])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut out = BufReader::new(child.stdout.take().unwrap());
        let mut line = String::new();
        while !line.contains("begun") {
            line.clear();
            assert_ne!(out.read_line(&mut line).unwrap(), 0, "it ends before it begins");
        }
        assert!(Command::new("kill").arg(child.id().to_string()).status().unwrap().success());
        let (mut rest, mut err) = (String::new(), String::new());
        out.read_to_string(&mut rest).unwrap();
        child.stderr.take().unwrap().read_to_string(&mut err).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(3), "{rest}{err}");
        assert_eq!(rest, "saved\n");
        assert!(err.contains("error: a test: interrupted\n  hint: it is over"), "{err}");
    }
}
