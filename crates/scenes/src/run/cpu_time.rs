//! The CPU time of the present thread: what a run costs, whatever else the machine does.

use std::time::Duration;

/// The moment from which time is counted.
#[derive(Clone, Copy, Debug)]
pub struct CpuTime {
    begin: Duration,
}

impl CpuTime {
    /// Counts from now on.
    pub fn begin() -> Self {
        CpuTime { begin: of_thread() }
    }

    /// The CPU time that the thread has taken since.
    pub fn elapsed(&self) -> Duration {
        of_thread().saturating_sub(self.begin)
    }
}

#[cfg(unix)]
fn of_thread() -> Duration {
    use rustix::time::{ClockId, clock_gettime};
    clock_gettime(ClockId::ThreadCPUTime).try_into().unwrap_or_default()
}

/// Where threads have no such clock, the time that passes.
#[cfg(not(unix))]
fn of_thread() -> Duration {
    use std::sync::LazyLock;
    use std::time::Instant;

    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed()
}
