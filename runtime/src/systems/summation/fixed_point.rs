//! Sums in fixed point: each coordinate is a whole multiple of a power of two, so that steps are undone to the last
//! bit.

use thiserror::Error;

use super::{Half, Remainders, Summation};
use crate::number::{Dual, Number};
use crate::systems::coordinates::Coordinates;
use crate::systems::kinetic::Kinetic;

/// A number whose value is one of double precision: `f64`, and its [dual numbers](Dual).
pub trait InDouble: Number {
    /// x
    fn double(&self) -> f64;

    /// x ← the value; derivatives stay.
    fn set_double(&mut self, value: f64);

    /// Derivatives ← derivatives + those of a.
    fn add_derivatives(&mut self, a: &Self);
}

impl InDouble for f64 {
    #[inline(always)]
    fn double(&self) -> f64 {
        *self
    }

    #[inline(always)]
    fn set_double(&mut self, value: f64) {
        *self = value;
    }

    #[inline(always)]
    fn add_derivatives(&mut self, _: &Self) {}
}

impl<const K: usize> InDouble for Dual<f64, K> {
    #[inline(always)]
    fn double(&self) -> f64 {
        self.value
    }

    #[inline(always)]
    fn set_double(&mut self, value: f64) {
        self.value = value;
    }

    #[inline(always)]
    fn add_derivatives(&mut self, a: &Self) {
        self.derivatives.iter_mut().zip(a.derivatives).for_each(|(own, a)| *own += a);
    }
}

/// q and p as whole multiples of powers of two, in 64 bits.
///
/// A kick adds −weight·gradient, rounded to a multiple, to p; a drift adds to q in the same way. The sums are exact,
/// and an increment depends on the other half of the state only: the kick or drift with the negative weight takes away
/// the same number, and [`Stepper::step_back`](crate::Stepper::step_back) undoes a step to the last bit, whatever the
/// scheme.
///
/// The coordinate i is a multiple of 2⁻⁶² times its range, rounded up to a power of two. Sums are as good as
/// [`Compensated`](super::Compensated) ones where the coordinate is not much smaller than its range. A coordinate that
/// exceeds twice its range, rounded up so, or gets an increment larger than that range, becomes NaN and stays so until
/// it is set.
///
/// Derivatives of dual numbers are added plainly, and are undone up to round-off: a gradient by
/// [steps back](crate::tangent::Adjoint) is then one along the very states of the steps.
///
/// A step is undone only where the gradient depends on q alone: not on a list of neighbours that was made for earlier
/// positions.
///
/// H. Rein, D. Tamayo, *JANUS: a bit-wise reversible integrator for N-body dynamics*, Mon. Not. R. Astron. Soc. 473
/// (2018) 3351.
#[derive(Clone, Debug)]
pub struct FixedPoint<V> {
    q: Multiples,
    p: Multiples,
    /// What a drift adds to q.
    increment: V,
}

/// Coordinates as multiples.
#[derive(Clone, Debug)]
struct Multiples {
    values: Vec<i64>,
    /// A power of two for each coordinate, and 1 over it.
    units: Vec<f64>,
    per_unit: Vec<f64>,
    /// Whether the values are those of the coordinates, which were not set since.
    current: bool,
}

/// In place of a multiple that is out of range.
const LOST: i64 = i64::MIN;
/// The ulp of this number is 1: what is added to it and taken away again is rounded to an integer, ties to even.
const ROUNDS: f64 = 6_755_399_441_055_744.0;
/// Numbers to be rounded that way are smaller than this.
const ROUNDED: f64 = 2_251_799_813_685_248.0;
/// The multiple at the end of the range, 2⁶²: the sum of two such multiples does not overflow.
const LARGEST: f64 = 4_611_686_018_427_387_904.0;

impl<V> FixedPoint<V> {
    /// For coordinates q and p within these ranges.
    pub(crate) fn of<N: InDouble>((q, p): (&V, &V), (q_ranges, p_ranges): (&[f64], &[f64])) -> Result<Self, RangeError>
    where
        V: Coordinates<N>,
    {
        let increment = q.clone();
        let [q, p] = [(q, q_ranges, "q"), (p, p_ranges, "p")]
            .map(|(values, ranges, name)| Multiples::of(values.as_ref(), ranges, name));
        Ok(FixedPoint { q: q?, p: p?, increment })
    }

    #[inline]
    fn add_increment<N: InDouble>(&mut self, q: &mut [N])
    where
        V: Coordinates<N>,
    {
        let increment = self.increment.as_ref();
        self.q.add(q, |i| increment[i].clone());
    }
}

impl Multiples {
    fn of(values: &[impl InDouble], ranges: &[f64], name: &'static str) -> Result<Self, RangeError> {
        let values: Vec<f64> = values.iter().map(InDouble::double).collect();
        if ranges.len() != values.len() {
            return Err(RangeError::Length { name, coordinates: values.len(), ranges: ranges.len() });
        }
        let beyond = |(value, range): (&f64, &f64)| value.is_nan() || value.abs() > *range;
        if let Some(index) = ranges.iter().position(|range| !(1e-280..=1e280).contains(range)) {
            return Err(RangeError::Range { name, index, range: ranges[index] });
        }
        if let Some(index) = values.iter().zip(ranges).position(beyond) {
            return Err(RangeError::Beyond { name, index, value: values[index], range: ranges[index] });
        }
        let units: Vec<f64> = ranges.iter().map(|range| power_of_two_from(*range) / LARGEST).collect();
        let per_unit = units.iter().map(|unit| 1.0 / unit).collect();
        Ok(Multiples { values: vec![0; values.len()], units, per_unit, current: false })
    }

    /// Takes coordinates that were set, and rounds them.
    #[inline]
    fn settle(&mut self, coordinates: &mut [impl InDouble]) {
        if !self.current {
            self.current = true;
            self.values.fill(0);
            for (i, x) in coordinates.iter_mut().enumerate() {
                let value = x.double();
                self.add_double(i, value, x);
            }
        }
    }

    /// Adds increments, each rounded, and sets the coordinates to the sums.
    #[inline]
    fn add<N: InDouble>(&mut self, coordinates: &mut [N], mut increment: impl FnMut(usize) -> N) {
        for (i, x) in coordinates.iter_mut().enumerate() {
            self.add_to(i, &increment(i), x);
        }
    }

    /// Adds an increment, rounded, to one coordinate.
    #[inline]
    fn add_to<N: InDouble>(&mut self, index: usize, increment: &N, x: &mut N) {
        self.add_double(index, increment.double(), x);
        x.add_derivatives(increment);
    }

    /// The same without derivatives.
    #[inline(always)]
    fn add_double(&mut self, index: usize, increment: f64, x: &mut impl InDouble) {
        let value = &mut self.values[index];
        *value = sum(*value, multiple(increment * self.per_unit[index]));
        x.set_double(if *value == LOST { f64::NAN } else { *value as f64 * self.units[index] });
    }

    /// What the multiples are more than the coordinates, which are the multiples rounded.
    fn remainders<N: InDouble>(&self, coordinates: &[N]) -> Vec<N> {
        let remainder = |(i, x): (usize, &N)| {
            let mut remainder = N::zero(&x.context());
            remainder.set_double(match self.values[i] {
                LOST => 0.0,
                value => (value - multiple(x.double() * self.per_unit[i])) as f64 * self.units[i],
            });
            remainder
        };
        coordinates.iter().enumerate().map(remainder).collect()
    }

    /// Adds remainders to multiples of the coordinates.
    fn include(&mut self, remainders: &[impl InDouble]) {
        for (i, remainder) in remainders.iter().enumerate() {
            self.values[i] = sum(self.values[i], multiple(remainder.double() * self.per_unit[i]));
        }
    }
}

/// The smallest power of two from x on.
fn power_of_two_from(x: f64) -> f64 {
    let below = f64::from_bits(x.to_bits() & f64::INFINITY.to_bits());
    if below < x { 2.0 * below } else { below }
}

/// The nearest integer, ties to even: the same for x and −x but for the sign.
#[inline]
fn multiple(x: f64) -> i64 {
    if x.abs() < ROUNDED {
        ((x + ROUNDS) - ROUNDS) as i64
    } else if x.abs() <= LARGEST {
        x.round_ties_even() as i64
    } else {
        LOST // also what is not a number
    }
}

#[inline]
fn sum(a: i64, b: i64) -> i64 {
    if a == LOST || b == LOST { LOST } else { a.checked_add(b).unwrap_or(LOST) }
}

impl<N: InDouble, V: Coordinates<N>> Summation<N> for FixedPoint<V> {
    #[inline]
    fn kick(&mut self, weight: &N, gradient: &[N], p: &mut [N]) {
        let mut increment = weight.clone();
        self.p.add(p, |i| {
            increment.assign_product(weight, &gradient[i]);
            increment.negate();
            increment.clone()
        });
    }

    #[inline]
    fn drift<K: Kinetic<N>>(&mut self, kinetic: &K, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
        self.increment.as_mut().iter_mut().for_each(N::assign_zero);
        kinetic.drift(weight, p, self.increment.as_mut(), scratch);
        self.add_increment(q);
    }

    #[inline]
    fn drift_augmented<K: Kinetic<N>>(
        &mut self,
        kinetic: &K,
        weight: &N,
        p: &[N],
        q: &mut [N],
        (added, beta): (&mut [N], &mut N),
        scratch: &mut [N],
    ) {
        self.increment.as_mut().iter_mut().for_each(N::assign_zero);
        kinetic.drift_augmented(weight, p, self.increment.as_mut(), beta, scratch);
        added.iter_mut().zip(self.increment.as_ref()).for_each(|(own, increment)| own.add(increment));
        self.add_increment(q);
    }

    #[inline]
    fn change(&mut self, half: Half, index: usize, x: &mut N, add: impl Fn(&mut N)) {
        let mut increment = N::zero(&x.context());
        add(&mut increment);
        match half {
            Half::Positions => self.q.add_to(index, &increment, x),
            Half::Momenta => self.p.add_to(index, &increment, x),
        }
    }

    fn forget_positions(&mut self) {
        self.q.current = false;
    }

    fn forget_momenta(&mut self) {
        self.p.current = false;
    }

    #[inline]
    fn settle(&mut self, q: &mut [N], p: &mut [N]) {
        self.q.settle(q);
        self.p.settle(p);
    }

    fn remainders(&self, q: &[N], p: &[N]) -> Remainders<N> {
        Remainders { q: self.q.remainders(q), p: self.p.remainders(p) }
    }

    fn set_remainders(&mut self, remainders: &Remainders<N>) {
        self.q.include(&remainders.q);
        self.p.include(&remainders.p);
    }

    fn is_compensated(&self) -> bool {
        true
    }
}

/// Ranges of a fixed point that are not valid for a state.
#[derive(Clone, PartialEq, Error)]
pub enum RangeError {
    /// Not one range for each coordinate.
    #[error("{name} has {coordinates} coordinates, but {ranges} ranges")]
    Length {
        /// `q` or `p`.
        name: &'static str,
        /// The number of coordinates.
        coordinates: usize,
        /// The number of ranges.
        ranges: usize,
    },
    /// A range is not a positive number of ordinary size.
    #[error("the range of {name}[{index}] is {range:e}; it must be from 1e-280 to 1e280")]
    Range {
        /// `q` or `p`.
        name: &'static str,
        /// Which coordinate, from 0.
        index: usize,
        /// Its range.
        range: f64,
    },
    /// A coordinate is beyond its range.
    #[error("{name}[{index}] = {value:e} is beyond its range, {range:e}")]
    Beyond {
        /// `q` or `p`.
        name: &'static str,
        /// Which coordinate, from 0.
        index: usize,
        /// Its value.
        value: f64,
        /// Its range.
        range: f64,
    },
}

shadowstep_schemes::debug_as_text!(RangeError);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn multiples_are_the_nearest_integers_with_ties_to_even() {
        for (x, nearest) in [
            (0.5, 0),
            (1.5, 2),
            (2.5, 2),
            (0.4999, 0),
            (7e15 + 1.0, 7_000_000_000_000_001),
            (3e18, 3_000_000_000_000_000_000),
        ] {
            assert_eq!((multiple(x), multiple(-x)), (nearest, -nearest), "{x}");
        }
        // 2⁵¹ + 1/2 and 2⁵² − 1/2, where the way of rounding changes
        for x in [ROUNDED - 0.5, ROUNDED, ROUNDED + 0.5, ROUNDED + 1.5, 2.0 * ROUNDED - 0.5] {
            assert_eq!((multiple(x), multiple(-x)), (x.round_ties_even() as i64, -(x.round_ties_even() as i64)), "{x}");
        }
        assert_eq!([LARGEST * 1.001, f64::NAN, f64::INFINITY].map(multiple), [LOST; 3]);
    }

    #[test]
    fn ranges_are_rounded_up_to_powers_of_two() {
        assert_eq!([1.0, 1.1, 2.0, 3.0, 0.3].map(power_of_two_from), [1.0, 2.0, 2.0, 4.0, 0.5]);
    }

    #[test]
    fn what_is_lost_stays_lost() {
        assert_eq!([sum(i64::MAX, 1), sum(LOST, 5), sum(5, LOST), sum(-i64::MAX, -1)], [LOST; 4]);
        assert_eq!(sum(3, -5), -2);
    }

    /// q and p far apart in size, set and read again.
    #[test]
    fn a_state_with_its_remainders_is_the_same_state() {
        let (q, p, ranges) = (vec![0.7, 1e-7], vec![-0.1, 1e-9], vec![1.0, 1e-6]);
        let mut fixed = FixedPoint::of((&q, &p), (&ranges, &ranges)).unwrap();
        let (mut q, mut p) = (q, p);
        fixed.settle(&mut q, &mut p);
        for n in 1..100 {
            fixed.kick(&0.01, &[0.3 / f64::from(n), 1e-9], &mut p);
        }
        let remainders = fixed.remainders(&q, &p);
        assert!(
            remainders.p[0] != 0.0 && remainders.p[0].abs() < 1e-17 && remainders.q == [0.0, 0.0],
            "{remainders:?}"
        );
        let mut other = FixedPoint::of((&q, &p), (&ranges, &ranges)).unwrap();
        let before = (q.clone(), p.clone());
        other.settle(&mut q, &mut p);
        other.set_remainders(&remainders);
        assert_eq!((other.q.values, other.p.values, before), (fixed.q.values, fixed.p.values, (q, p)));
    }
}
