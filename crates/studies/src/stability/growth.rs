//! How fast the states of a linear system grow.

use crate::stability::integrator::AnyIntegrator;

/// Growth is measured when the growing part is e^25 times as large as the others.
const SEPARATED: f64 = 25.0;

/// Three digits of the rate.
pub(crate) const TOLERANCE: f64 = 5e-4;

/// The steps of some turns.
const TURN: u64 = 300;

/// After this number of steps a part that grows with this rate is separated from the others. The rate is measured over
/// as many more.
pub(crate) fn steps_to_see(rate: f64) -> u64 {
    (SEPARATED / rate).ceil() as u64
}

/// The growth of log|(q, p)| per step, from `count` steps on to twice as many, where `rate` is expected.
///
/// A growing state may turn as well, which changes its size: the largest one of [`TURN`] steps counts, less what the
/// expected rate makes of their places.
pub(crate) fn growth(run: &mut dyn AnyIntegrator, (rate, count): (f64, u64)) -> f64 {
    // the second half of the first part is separated well enough
    let (mut scaled, turn) = (0.0, TURN.min(count / 2).max(1));
    let mut largest_at = |from: u64, end: u64| {
        let mut largest = f64::NEG_INFINITY;
        for n in from + 1..=end {
            run.step();
            let size = run.size();
            if n + turn > end {
                largest = largest.max(scaled + size.ln() - rate * n as f64);
            }
            // the step is linear, so that a state that is divided by its size goes on in the same direction
            if size > 1e30 {
                scaled += size.ln();
                run.divide(size);
            }
        }
        largest
    };
    let at_count = largest_at(0, count);
    let at_end = largest_at(count, 2 * count);
    rate + (at_end - at_count) / count as f64
}
