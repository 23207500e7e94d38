//! How fast the states of a linear system grow.

use shadowstep::number::CorrectlyRounded;
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::tables::TableScheme;
use shadowstep::{Number, Rational, Real, Stepper, System};

/// Growth is measured when the growing part is e^25 times as large as the others.
const SEPARATED: f64 = 25.0;

/// Three digits of the rate.
pub(crate) const TOLERANCE: f64 = 5e-4;

/// The steps of some turns.
const TURN: u64 = 300;

/// After this number of steps a part that grows with this rate is separated from the others. The rate is measured over as many more.
pub(crate) fn steps_to_see(rate: f64) -> u64 {
    (SEPARATED / rate).ceil() as u64
}

/// The growth of log|(q, p)| per step, from `count` steps on to twice as many, where `rate` is expected.
///
/// A growing state may turn as well, which changes its size: the largest one of [`TURN`] steps counts, less what the expected rate makes of
/// their places.
pub(crate) fn growth<N: CorrectlyRounded, M: System<Number = N, Class = Quadratic>>(
    stepper: &Stepper<TableScheme, N>,
    system: &mut M,
    (rate, count): (f64, u64),
) -> f64 {
    // the second half of the first part is separated well enough
    let (mut scaled, turn) = (0.0, TURN.min(count / 2).max(1));
    let mut largest_at = |end: u64, system: &mut M, from: u64| {
        let mut largest = f64::NEG_INFINITY;
        for n in from + 1..=end {
            stepper.step(system);
            let size = size(system);
            if n + turn > end {
                largest = largest.max(scaled + size.ln() - rate * n as f64);
            }
            // the step is linear, so that a state that is divided by its size goes on in the same direction
            if size > 1e30 {
                scaled += size.ln();
                scale_down(system, size);
            }
        }
        largest
    };
    let at_count = largest_at(count, system, 0);
    let at_end = largest_at(2 * count, system, count);
    rate + (at_end - at_count) / count as f64
}

/// |(q, p)|
pub(crate) fn size<M: System<Number: Real>>(system: &M) -> f64 {
    system.q().iter().chain(system.p()).fold(0.0, |size: f64, x| size.hypot(x.to_f64()))
}

fn scale_down<M: System>(system: &mut M, size: f64) {
    let context = system.state().context();
    let size = Rational::from_float(size).expect("it is finite");
    let divisor = M::Number::from_rational(&size, &context);
    let divided = |numbers: &[M::Number]| {
        let mut numbers = numbers.to_vec();
        numbers.iter_mut().for_each(|number| number.divide(&divisor));
        numbers
    };
    let (q, p) = (divided(system.q()), divided(system.p()));
    system.state_mut().set(&q, &p);
}
