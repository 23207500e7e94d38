//! Medians over rounds in which all contestants take turns, and ratios within one run.

use std::time::Instant;

const ROUNDS: usize = 21;

/// A contestant: its name and a run of so many repetitions.
pub(crate) type Contestant<'a> = (&'static str, Box<dyn FnMut(u32) + 'a>);

/// Nanoseconds per repetition, the median over the rounds, for each contestant.
pub(crate) fn medians(contestants: &mut [Contestant<'_>], repetitions: u32) -> Vec<f64> {
    let mut times = vec![Vec::new(); contestants.len()];
    for _ in 0..ROUNDS {
        for ((_, run), times) in contestants.iter_mut().zip(&mut times) {
            let start = Instant::now();
            run(repetitions);
            times.push(start.elapsed().as_secs_f64() * 1e9 / f64::from(repetitions));
        }
    }
    times
        .into_iter()
        .map(|mut times| {
            times.sort_by(f64::total_cmp);
            times[ROUNDS / 2]
        })
        .collect()
}

/// Prints the contestants' times and their ratios to the first one.
pub(crate) fn compare(title: &str, mut contestants: Vec<Contestant<'_>>, repetitions: u32) {
    let times = medians(&mut contestants, repetitions);
    println!("\n{title}");
    for ((name, _), time) in contestants.iter().zip(&times) {
        println!("  {name:<48} {time:>10.1} ns {:>8.3}", time / times[0]);
    }
}
