//! Where a run crosses a surface of section, g(q, p) = 0: a step of a part of h from the state before, at whose end g
//! is 0.

use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep::steps::step_to_zero;
use shadowstep::{Rational, Real};
use shadowstep_schemes::symbolic::decimal::to_text;

use crate::columns::evaluator::Evaluator;
use crate::run::Run;
use crate::run::arithmetic::GUARD_DIGITS;
use crate::run::snapshots::Snapshot;
use crate::scene::{Direction, SceneNumber, Surface, System};

/// Why displaced forces have no crossings.
pub(crate) const NEEDS_PARTS_OF_STEPS: &str =
    "displaced forces belong to whole steps, and a section needs parts of a step";

/// Finds the crossings of a run, whose states it takes one after the other.
pub(crate) struct Crossings<N: SceneNumber> {
    value: Evaluator<N>,
    direction: Direction,
    /// The state at t = 0, in the coordinates of the steps.
    start: Point<N>,
    /// The digits that the start has, in bits, where it is known to fewer than the numbers have.
    bits_of_start: u32,
    /// The state before, of a processed scheme that of the trajectory, and g there.
    before: Option<(N, Point<N>)>,
}

/// q and p.
type Point<N> = (Vec<N>, Vec<N>);

impl<N: SceneNumber> Crossings<N> {
    /// Of a surface that was checked for the system.
    pub(crate) fn new(Surface { expression, direction }: &Surface, system: &System, context: &N::Context) -> Self {
        let value = Evaluator::of_run(expression, system, context).expect("it was checked for the system");
        let rounded = system.q.iter().chain(&system.p).filter(|value| value.rounded);
        // a number that has fewer is exact, as the root of 1
        let digits =
            rounded.map(|value| significant_digits(&value.value)).filter(|digits| *digits > GUARD_DIGITS as usize);
        let digits = digits.max();
        let bits = digits.map_or(f64::INFINITY, |digits| digits as f64 * std::f64::consts::LOG2_10);
        Crossings {
            value,
            direction: *direction,
            start: system.start(context),
            bits_of_start: N::precision(context).in_bits().min(bits as u32),
            before: None,
        }
    }

    /// Takes the state n, the next one, at which the integrator is. If g has a zero between it and the state before,
    /// `take` sees the integrator at the crossing, a state of the trajectory, and the part of a step from the state
    /// before; the integrator is then at its state again, to the last bit.
    pub(crate) fn state<T>(
        &mut self,
        n: i64,
        integrator: &mut VectorIntegrator<'_, N>,
        take: impl FnOnce(&mut VectorIntegrator<'_, N>, &N) -> T,
    ) -> Option<T> {
        let (now, point) = match n {
            0 => self.at_start(integrator),
            _ => at_output(integrator, |integrator| {
                let point = (integrator.state().q().to_vec(), integrator.state().p().to_vec());
                (self.present(integrator), point)
            }),
        };
        let before = self.before.take().filter(|(value, _)| self.direction.is_of(value, &now));
        let found = before.and_then(|(value, (q, p))| {
            let state = Snapshot::of(n, integrator.state());
            integrator.system().state_mut().set(&q, &p);
            let part = step_to_zero(integrator, |integrator| self.present(integrator));
            let part = part.filter(|_| is_zero(&self.present(integrator), [&value, &now]) && is_finite(integrator));
            let taken = part.map(|part| take(integrator, &part));
            // only here: a state that is set has its gradient evaluated again
            state.restore(integrator);
            taken
        });
        self.before = Some((now, point));
        found
    }

    /// g of the state of the system.
    fn present(&mut self, integrator: &mut VectorIntegrator<'_, N>) -> N {
        let no_time = || unreachable!("g does not depend on t, unless t is a coordinate");
        self.value.value(integrator.system(), no_time).clone()
    }

    /// The start as it is given, which a processed scheme has but for the round-off of its maps. Where g has no digit
    /// beyond that of the start it is 0: a start on the surface is no crossing.
    fn at_start(&mut self, integrator: &mut VectorIntegrator<'_, N>) -> (N, Point<N>) {
        let Crossings { value, start, bits_of_start, .. } = self;
        let mut at = |(q, p): &Point<N>| value.value_at_other(integrator.system(), (q, p)).clone();
        let mut given = at(start);
        // as round-off does, but half of the digits larger
        let bits_moved = *bits_of_start / 2;
        let change = (0..4).map(|k| {
            let mut change = at(&moved(start, k, bits_moved));
            change.subtract(&given);
            change.log10_abs()
        });
        let round_off = change.fold(f64::NEG_INFINITY, f64::max)
            - f64::from(*bits_of_start - bits_moved - BITS_OF_ROUND_OFF) * std::f64::consts::LOG10_2;
        if given.log10_abs() <= round_off {
            given.assign_zero();
        }
        (given, start.clone())
    }
}

/// Round-off of a few operations, of numbers with less than their last digit.
const BITS_OF_ROUND_OFF: u32 = 4;

/// A state of which each number is changed by another part of 2⁻ᵇ of it: no symmetry of a formula has these directions.
fn moved<N: Real>((q, p): &Point<N>, direction: i64, bits: u32) -> Point<N> {
    let move_by = |(i, x): (usize, &N)| {
        // the multiples of the golden ratio are spread most evenly
        let part = (0.618_033_988_749_895 * ((4 * i as i64 + direction + 1) as f64)).fract() - 0.5;
        let part =
            Rational::from_float(part).expect("it is finite") * Rational::from_integer(2.into()).pow(1 - bits as i32);
        let mut change = N::from_rational(&part, &x.context());
        change.multiply(x);
        change.add(x);
        change
    };
    let mut numbers: Vec<N> = q.iter().chain(p).enumerate().map(move_by).collect();
    let p = numbers.split_off(q.len());
    (numbers, p)
}

/// The digits of a decimal.
fn significant_digits(value: &Rational) -> usize {
    to_text(value).trim_start_matches(['-', '0', '.']).bytes().filter(u8::is_ascii_digit).count()
}

/// Whether the state is: a step past a singularity may have none between that is.
fn is_finite<N: Real>(integrator: &VectorIntegrator<'_, N>) -> bool {
    let state = integrator.state();
    state.q().iter().chain(state.p()).all(N::is_finite)
}

/// Whether a value is 0 beside those at both ends of the step. Where the sign changes at a pole or at the turn of an
/// angle, the least value that is found is that of an end, or has its size; where there is a zero, it is the round-off
/// of the formula, as that of an end may be.
fn is_zero<N: Real>(value: &N, ends: [&N; 2]) -> bool {
    // in decades
    const SMALL: f64 = 3.0;
    const ROUND_OFF: f64 = 9.0;
    let [before, now] = ends.map(Real::log10_abs);
    let (least, largest, value) = (before.min(now), before.max(now), value.log10_abs());
    value < least - SMALL || (least < largest - ROUND_OFF && value < largest - SMALL)
}

impl Run<'_> {
    /// The time of a crossing, a part of a step after the state n.
    pub(crate) fn time_of_crossing<N: SceneNumber>(&self, n: i64, part: &N, context: &N::Context) -> N {
        let mut time = N::from_rational(self.h.exact(), context);
        time.multiply(part);
        time.add(&self.time_in(n, context));
        time
    }
}

impl Direction {
    /// The directions by their names.
    pub const NAMES: [(&'static str, Direction); 3] =
        [("up", Direction::Up), ("down", Direction::Down), ("both", Direction::Both)];

    /// Whether g goes through 0 in this direction between two states.
    fn is_of<N: Real>(self, before: &N, now: &N) -> bool {
        let zero = N::zero(&now.context());
        let (up, down) = (*before < zero && *now >= zero, *before > zero && *now <= zero);
        match self {
            Direction::Up => up,
            Direction::Down => down,
            Direction::Both => up || down,
        }
    }
}

#[cfg(test)]
mod tests;
