//! The last step of a run in transformed time: to a given physical time.

use crate::increments::Carried;
use crate::number::{Number, Ordered};
use crate::scheme::{Scheme, ValidFor};
use crate::scheme_maps::Maps;
use crate::stepper::Stepper;
use crate::system::System;
use crate::weights::WeightLists;

/// More iterations than any number type needs: bisections alone find double precision in 60.
const MOST_ITERATIONS: u32 = 400;

/// Makes one step after which the physical time, the last coordinate, is `until` to the last digits, and returns its size as a part of h.
/// The scheme is that of the stepper, whose own step must not end before `until`; its weights times the part are rounded once.
///
/// The size is found by the secant method, within a bracket that shrinks in each iteration, with a trial step in each. `None` if the time
/// is `until` already, or if a trial step is not finite; the system is then as it was.
pub fn step_to_time<S, M>(stepper: &Stepper<S, M::Number>, system: &mut M, until: &M::Number) -> Option<M::Number>
where
    S: Scheme + ValidFor<M::Class>,
    M: System<Number: Ordered>,
{
    let context = system.state().context();
    let zero = <M::Number as Number>::zero(&context);
    let start = (system.q().to_vec(), system.p().to_vec());
    let mut search = Search { start, stepper, until, best: None };
    let mut low = (zero.clone(), search.missed(system));
    if low.1 == zero {
        return None;
    }
    let one = <M::Number as Number>::from_rational(&num_traits::One::one(), &context);
    let missed = search.after(system, &one)?;
    let mut high = (one, missed);
    let mut latest = [low.clone(), high.clone()];
    for _ in 0..MOST_ITERATIONS {
        let part = next_part(&latest, [&low, &high]);
        if high.1 == zero || part == low.0 || part == high.0 {
            break;
        }
        let missed = search.after(system, &part)?;
        let point = (part, missed);
        let [_, newest] = latest;
        latest = [newest, point.clone()];
        let is_low = point.1 != zero && point.1.is_below_zero() == low.1.is_below_zero();
        *(if is_low { &mut low } else { &mut high }) = point;
    }
    let (part, _) = search.best.clone()?;
    search.after(system, &part)?;
    Some(part)
}

/// A part of h with the time that its step misses.
type Point<N> = (N, N);

/// The secant through the two latest points, or the middle of the bracket where that is outside.
fn next_part<N: Ordered>(latest: &[Point<N>; 2], [low, high]: [&Point<N>; 2]) -> N {
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

struct Search<'a, S: Scheme, N: Ordered> {
    start: (Vec<N>, Vec<N>),
    stepper: &'a Stepper<S, N>,
    until: &'a N,
    /// The part that misses least, and by how much.
    best: Option<Point<N>>,
}

impl<S: Scheme, N: Ordered> Search<'_, S, N> {
    /// t − until of the system.
    fn missed<M: System<Number = N>>(&self, system: &M) -> N {
        let mut missed = system.q().last().expect("a system has a coordinate").clone();
        missed.subtract(self.until);
        missed
    }

    /// t − until after a step of this part of h from the start; `None` if it is not finite.
    fn after<M: System<Number = N>>(&mut self, system: &mut M, part: &N) -> Option<N>
    where
        S: ValidFor<M::Class>,
    {
        let times = |weight: &N, factor: &N| {
            let mut product = weight.clone();
            product.assign_product(weight, factor);
            product
        };
        let linear = |weight: &N| times(weight, part);
        // h³
        let cubic = |weight: &N| times(&times(&times(weight, part), part), part);
        let weights = S::Weights::from_vecs(self.stepper.weights().map(linear, cubic));
        system.state_mut().set(&self.start.0, &self.start.1);
        let maps = Maps::new(self.stepper.scheme(), &weights);
        M::advance(std::slice::from_mut(system), &maps, 1, Carried::Nothing);
        let missed = self.missed(system);
        if !missed.is_finite() {
            system.state_mut().set(&self.start.0, &self.start.1);
            return None;
        }
        let mut distance = missed.clone();
        distance.make_absolute();
        if self.best.as_ref().is_none_or(|(_, best)| distance < *best) {
            self.best = Some((part.clone(), distance));
        }
        Some(missed)
    }
}
