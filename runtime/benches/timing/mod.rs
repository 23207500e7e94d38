//! Medians over rounds in which all contestants take turns, and ratios within one round, of the CPU time of this
//! thread.

use std::time::Duration;

use rustix::time::{ClockId, clock_gettime};

const ROUNDS: usize = 21;

/// A contestant: its name, and a run of a given number of repetitions.
pub(crate) type Contestant<'a> = (&'static str, Box<dyn FnMut(u32) + 'a>);

/// Medians over the rounds.
pub(crate) struct Measured {
    /// The time of a repetition.
    pub(crate) nanoseconds: f64,
    /// The ratio of this time to the first contestant's in the same round.
    pub(crate) ratio: f64,
}

/// Lets the contestants run in turn.
pub(crate) fn measure(contestants: &mut [Contestant<'_>], repetitions: u32) -> Vec<Measured> {
    let mut times = vec![Vec::new(); contestants.len()];
    for _ in 0..ROUNDS {
        for ((_, run), times) in contestants.iter_mut().zip(&mut times) {
            let start = cpu_time();
            run(repetitions);
            times.push((cpu_time() - start).as_secs_f64() * 1e9 / f64::from(repetitions));
        }
    }
    let ratio = |own: &[f64]| median(own.iter().zip(&times[0]).map(|(own, first)| own / first));
    times.iter().map(|own| Measured { nanoseconds: median(own.iter().copied()), ratio: ratio(own) }).collect()
}

/// The CPU time of this thread: on a machine with other load, the time on the clock means nothing.
fn cpu_time() -> Duration {
    Duration::try_from(clock_gettime(ClockId::ThreadCPUTime)).expect("it is positive")
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Prints the contestants' times and their ratios to the first one, as a table of Markdown.
pub(crate) fn compare(title: &str, mut contestants: Vec<Contestant<'_>>, repetitions: u32) {
    let measured = measure(&mut contestants, repetitions);
    head(title);
    for ((name, _), Measured { nanoseconds, ratio }) in contestants.iter().zip(&measured) {
        println!("| {name} | {nanoseconds:.1} | {ratio:.3} |");
    }
}

/// The heading of a table, and its head.
pub(crate) fn head(title: &str) {
    println!("\n### {title}\n\n| | ns | ratio |\n| --- | --- | --- |");
}
