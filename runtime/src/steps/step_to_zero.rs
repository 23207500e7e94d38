//! Steps of a part of h to where a function of the state is 0: to a physical time in transformed time, to a surface of
//! section.

use crate::number::{Number, Real};
use crate::steps::integrator::Integrator;

/// More iterations than any number type needs: bisections alone find double precision in 60.
const MOST_ITERATIONS: u32 = 400;

/// Makes one step after which the physical time, the last coordinate, is `until` to the last digits, and returns its
/// size as a part of h. The step of the integrator itself must not end before `until`.
///
/// States and `None` are as of [`step_to_zero`].
pub fn step_to_time<I>(integrator: &mut I, until: &I::Number) -> Option<I::Number>
where
    I: Integrator<Number: Real> + ?Sized,
{
    step_to_zero(integrator, |integrator| {
        let mut missed = integrator.state().q().last().expect("a system has a coordinate").clone();
        missed.subtract(until);
        missed
    })
}

/// Makes one step after which a function of the state is 0 to the last digits, and returns its size as a part of h: a
/// point of the trajectory with the error of a step of the scheme, as in M. Hénon, Physica D 5 (1982) 412. The function
/// must not have the same sign at the present state and after the step of the integrator itself.
///
/// The step is an [`Integrator::part_of_step`]: of a processed scheme the present state has to be one of the
/// trajectory, after the [post-map](Integrator::postprocess), and so is the one at the end.
///
/// The size is found by the secant method, within a bracket that shrinks in each iteration, with a trial step in each.
/// `None` if the function is 0 already, or if it is not finite after a trial step; the system is then as it was.
pub fn step_to_zero<I>(integrator: &mut I, value: impl FnMut(&mut I) -> I::Number) -> Option<I::Number>
where
    I: Integrator<Number: Real> + ?Sized,
{
    let context = integrator.state().context();
    let zero = <I::Number as Number>::zero(&context);
    let start = (integrator.state().q().to_vec(), integrator.state().p().to_vec());
    let mut search = Search { start, value, best: None };
    let mut low = (zero.clone(), (search.value)(integrator));
    if low.1 == zero {
        return None;
    }
    let one = <I::Number as Number>::from_rational(&num_traits::One::one(), &context);
    let missed = search.after(integrator, &one)?;
    let mut high = (one, missed);
    let mut latest = [low.clone(), high.clone()];
    for _ in 0..MOST_ITERATIONS {
        let part = next_part(&latest, [&low, &high]);
        if high.1 == zero || part == low.0 || part == high.0 {
            break;
        }
        let missed = search.after(integrator, &part)?;
        let point = (part, missed);
        let [_, newest] = latest;
        latest = [newest, point.clone()];
        let is_low = point.1 != zero && point.1.is_below_zero() == low.1.is_below_zero();
        *(if is_low { &mut low } else { &mut high }) = point;
    }
    let (part, _) = search.best.clone()?;
    search.after(integrator, &part)?;
    Some(part)
}

/// A part of h with the value of the function after its step.
type Point<N> = (N, N);

/// The secant through the two latest points, or the middle of the bracket where that is outside.
fn next_part<N: Real>(latest: &[Point<N>; 2], [low, high]: [&Point<N>; 2]) -> N {
    let [(a, missed_a), (b, missed_b)] = latest;
    let (mut part, mut slope, mut change) = (b.clone(), missed_b.clone(), b.clone());
    slope.subtract(missed_a);
    change.subtract(a);
    change.multiply(missed_b);
    change.divide(&slope);
    part.subtract(&change);
    if !(low.0 < part && part < high.0) {
        part.assign_sum(&low.0, &high.0);
        part.divide_integer(2);
    }
    part
}

struct Search<N, F> {
    start: (Vec<N>, Vec<N>),
    /// The function.
    value: F,
    /// The part after which it is nearest to 0, and its size there.
    best: Option<Point<N>>,
}

impl<N: Real, F> Search<N, F> {
    /// The value after a step of this part of h from the start; `None` if it is not finite.
    fn after<I>(&mut self, integrator: &mut I, part: &N) -> Option<N>
    where
        I: Integrator<Number = N> + ?Sized,
        F: FnMut(&mut I) -> N,
    {
        let Search { start, value, best } = self;
        let begin = |integrator: &mut I| integrator.system().state_mut().set(&start.0, &start.1);
        begin(integrator);
        integrator.part_of_step(part);
        let value = value(integrator);
        if !value.is_finite() {
            begin(integrator);
            return None;
        }
        let mut size = value.clone();
        size.make_absolute();
        if best.as_ref().is_none_or(|(_, best)| size < *best) {
            *best = Some((part.clone(), size));
        }
        Some(value)
    }
}
