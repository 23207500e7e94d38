//! The elementary functions of enclosed numbers.
//!
//! Each function reduces a rational number to the range where its [series](crate::symbolic::number::series) is short. The image
//! of an interval under a monotone function is enclosed by the values at its ends.

use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::symbolic::number::ball::Ball;
use crate::symbolic::number::function::Function;
use crate::symbolic::number::interval::Interval;
use crate::symbolic::number::rational::Rational;
use crate::symbolic::number::rounding::at_places;
use crate::symbolic::number::series::{Curve, half_pi, inverse_tangent, log_two, sine_and_versine};

/// For arguments of larger magnitude exp is out of the range of enclosed numbers.
const LARGEST_EXPONENT: u32 = 70_000;

/// The decimal places in which tanh of such an argument agrees with 1: 2/(e^2x + 1) is less than 10^-60000.
const PLACES_OF_ONE: i64 = 60_000;

/// π
pub(crate) fn pi(digits: u32) -> Interval {
    half_pi(bits(digits)).to_interval(1)
}

/// The image of an interval, with ends to about `digits` significant digits; `None` for numbers that are too large or
/// too small.
///
/// The interval must be inside the domain: positive for log, from −1 to 1 for asin and acos, and without a pole of tan.
pub(crate) fn image(function: Function, interval: &Interval, digits: u32) -> Option<Interval> {
    match function {
        Function::Exp => increasing(interval, |x| exp(x, digits)),
        Function::Log => increasing(interval, |x| Some(log(x, digits))),
        Function::Sin => Some(sin_and_cos(interval, digits).0),
        Function::Cos => Some(sin_and_cos(interval, digits).1),
        Function::Tan => {
            let (sin, cos) = sin_and_cos(interval, digits);
            Some(sin.multiply(&cos.reciprocal()))
        }
        Function::Sinh => increasing(interval, |x| sinh(x, digits)),
        Function::Cosh => cosh(interval, digits),
        Function::Tanh => increasing(interval, |x| tanh(x, digits)),
        Function::Atan => increasing(interval, |x| Some(atan(x, digits))),
        Function::Asin => increasing(interval, |x| Some(asin(x, digits))),
        Function::Acos => increasing(&interval.negate(), |x| Some(acos(&-x, digits))),
    }
}

/// sin and cos: their values in the middle of the interval ± its half width, as no slope exceeds 1.
pub(crate) fn sin_and_cos(interval: &Interval, digits: u32) -> (Interval, Interval) {
    if interval.is_point() {
        return sin_and_cos_of_number(&interval.low, digits);
    }
    let two = Rational::from_integer(2.into());
    let middle = (&interval.low + &interval.high) / &two;
    let half = (&interval.high - &interval.low) / two;
    let around = Interval { low: -&half, high: half };
    let (sin, cos) = sin_and_cos_of_number(&middle, digits);
    let spread = |value: Interval| value.add(&around).within_one().expect("sin and cos are between -1 and 1");
    (spread(sin), spread(cos))
}

/// sin and cos of a multiple of π, from its exact distance to the nearest multiple of π/2: they are known to all digits
/// also next to their zeros, and the zeros are 0.
pub(crate) fn sin_and_cos_of_pi(multiple: &Rational, digits: u32) -> (Interval, Interval) {
    let half = Rational::new(1.into(), 2.into());
    let quarter = (multiple * Rational::from_integer(2.into()) + &half).floor();
    let rest = multiple - &quarter * half;
    let (sin, cos) = match rest.is_zero() {
        true => (Interval::point(&rest), Interval::point(&Rational::one())),
        false => {
            let fine = bits(digits) + zero_bits(rest.numer(), rest.denom());
            // the multiple of π/2 is between -1/2 and 1/2
            near_zero(&Ball::ratio(&(rest.numer() * 2), rest.denom(), fine).multiply(&half_pi(fine)))
        }
    };
    turned(&quarter.to_integer(), sin, cos)
}

/// sin and cos of an angle between −1 and 1.
fn near_zero(angle: &Ball) -> (Interval, Interval) {
    let (sine, versine) = sine_and_versine(Curve::Circle, angle);
    (sine.to_interval(0), Ball::one(versine.bits()).subtract(&versine).to_interval(0))
}

/// sin and cos after this number of quarter turns.
fn turned(quarters: &BigInt, sin: Interval, cos: Interval) -> (Interval, Interval) {
    match (quarters & BigInt::from(3)).to_u8() {
        Some(0) => (sin, cos),
        Some(1) => (cos, sin.negate()),
        Some(2) => (sin.negate(), cos.negate()),
        _ => (cos.negate(), sin),
    }
}

/// From the lower end's lower value to the higher end's higher one.
fn increasing(interval: &Interval, function: impl Fn(&Rational) -> Option<Interval>) -> Option<Interval> {
    let low = function(&interval.low)?;
    if interval.is_point() {
        return Some(low);
    }
    Some(Interval { low: low.low, high: function(&interval.high)?.high })
}

// ---- of a number ----

/// The bits of `digits` digits and a few more: 10/3 exceeds log2 10.
fn bits(digits: u32) -> u64 {
    u64::from(digits) * 10 / 3 + 32
}

/// −log2 |numerator/denominator|, rounded up, if that is positive.
fn zero_bits(numerator: &BigInt, denominator: &BigInt) -> u64 {
    (denominator.bits() + 1).saturating_sub(numerator.bits())
}

/// log2 |x|, rounded up, if that is positive.
fn integer_bits(x: &Rational) -> u64 {
    (x.numer().bits() + 1).saturating_sub(x.denom().bits())
}

fn is_huge(x: &Rational) -> bool {
    *x.numer().magnitude() > x.denom().magnitude() * LARGEST_EXPONENT
}

/// e^x = 2^k e^(x − k log 2), to `digits` significant digits, and to as many after the point where e^x is near 1.
fn exp(x: &Rational, digits: u32) -> Option<Interval> {
    if is_huge(x) {
        return None;
    }
    let fine = bits(digits) + 20;
    let log_two = log_two(fine);
    let x = Ball::ratio(x.numer(), x.denom(), fine);
    let k = x.nearest_quotient(&log_two);
    let (sinh, versine) = sine_and_versine(Curve::Hyperbola, &x.subtract(&log_two.times(&k)));
    let power = Ball::one(fine).add(&versine).add(&sinh);
    Some(power.to_interval(k.to_i64()?))
}

/// log x = k log 2 + log m, where m = x/2^k is between 2/3 and 4/3, and log m = 2 artanh (m − 1)/(m + 1).
fn log(x: &Rational, digits: u32) -> Interval {
    if x.is_one() {
        return Interval::point(&Rational::zero());
    }
    let mut k = x.numer().bits() as i64 - x.denom().bits() as i64;
    let scaled = |k: i64| (x.numer() << (-k).max(0), x.denom() << k.max(0));
    let (mut n, mut d) = scaled(k);
    if &n * 3 > &d * 4 {
        k += 1;
    } else if &n * 3 < &d * 2 {
        k -= 1;
    }
    (n, d) = scaled(k);
    let (difference, sum) = (&n - &d, n + d);
    let near_one = if k == 0 { zero_bits(&difference, &sum) } else { 0 };
    let fine = bits(digits) + near_one + u64::from(k.unsigned_abs().checked_ilog2().unwrap_or(0));
    let half = inverse_tangent(Curve::Hyperbola, &Ball::ratio(&difference, &sum, fine));
    let log = half.times(&2.into());
    if k == 0 { log.to_interval(0) } else { log.add(&log_two(fine).times(&k.into())).to_interval(0) }
}

/// sin x and cos x, both to `digits` significant digits, from the distance to the nearest multiple of π/2.
fn sin_and_cos_of_number(x: &Rational, digits: u32) -> (Interval, Interval) {
    if x.is_zero() {
        return (Interval::point(x), Interval::point(&Rational::one()));
    }
    let (quarters, distance) = reduced(x, bits(digits));
    let (sin, cos) = near_zero(&distance);
    turned(&quarters, sin, cos)
}

/// k and x − k π/2 to `certain` bits, for the nearest k or one next to it. The loop ends, as x is rational and
/// not 0.
fn reduced(x: &Rational, certain: u64) -> (BigInt, Ball) {
    if integer_bits(x) == 0 {
        // between -1 and 1: the series needs no more
        return (BigInt::zero(), Ball::ratio(x.numer(), x.denom(), certain + zero_bits(x.numer(), x.denom())));
    }
    let mut fine = certain + integer_bits(x) + 16;
    loop {
        let quarter = half_pi(fine);
        let number = Ball::ratio(x.numer(), x.denom(), fine);
        let k = number.nearest_quotient(&quarter);
        let distance = number.subtract(&quarter.times(&k));
        if let Some(excess) = distance.certain_bits().checked_sub(certain) {
            // More bits would only take time.
            return (k, distance.with_bits(distance.bits() - excess));
        }
        fine *= 2;
    }
}

/// (e^x − e^−x)/2, with more digits where the two almost cancel
fn sinh(x: &Rational, digits: u32) -> Option<Interval> {
    let power = exp(x, digits + cancelled(x))?;
    Some(half(&power.add(&power.reciprocal().negate())))
}

/// (e^x + e^−x)/2; the least is at 0.
fn cosh(interval: &Interval, digits: u32) -> Option<Interval> {
    let at = |x: &Rational| {
        let power = exp(x, digits)?;
        Some(half(&power.add(&power.reciprocal())))
    };
    let (low, high) = (at(&interval.low)?, at(&interval.high)?);
    let (low, high) = if low.high <= high.high { (low, high) } else { (high, low) };
    let low = if interval.contains_zero() { Rational::one() } else { low.low };
    Some(Interval { low, high: high.high })
}

/// 1 − 2/(e^2x + 1), with more digits where the two almost cancel
fn tanh(x: &Rational, digits: u32) -> Option<Interval> {
    let one = Interval::point(&Rational::one());
    if is_huge(x) {
        let nearly = Rational::one() - at_places(BigInt::one(), PLACES_OF_ONE.min(2 * i64::from(digits)));
        let interval = Interval { low: nearly, high: Rational::one() };
        return Some(if x.is_negative() { interval.negate() } else { interval });
    }
    if x.is_negative() {
        return Some(tanh(&-x, digits)?.negate());
    }
    // Twice the argument of exp, within its domain, is the square.
    let power = exp(x, digits + cancelled(x))?;
    let rest = power.multiply(&power).add(&one).reciprocal();
    Some(one.add(&rest.add(&rest).negate()))
}

/// The decimal places between the point and the first digit of x, about.
fn cancelled(x: &Rational) -> u32 {
    u32::try_from(zero_bits(x.numer(), x.denom()) / 3).unwrap_or(u32::MAX)
}

fn half(interval: &Interval) -> Interval {
    interval.multiply(&Interval::point(&Rational::new(1.into(), 2.into())))
}

/// arctan x, from 1/x where |x| > 1: arctan x + arctan 1/x = ± π/2
fn atan(x: &Rational, digits: u32) -> Interval {
    if x.is_negative() {
        return atan(&-x, digits).negate();
    }
    if x.is_zero() {
        return Interval::point(x);
    }
    let (n, d) = (x.numer(), x.denom());
    if n > d {
        let fine = bits(digits);
        return half_pi(fine).subtract(&inverse_tangent(Curve::Circle, &Ball::ratio(d, n, fine))).to_interval(0);
    }
    let fine = bits(digits) + zero_bits(n, d);
    inverse_tangent(Curve::Circle, &Ball::ratio(n, d, fine)).to_interval(0)
}

/// arcsin x = ± arctan √(x²/(1 − x²))
fn asin(x: &Rational, digits: u32) -> Interval {
    if x.is_negative() {
        return asin(&-x, digits).negate();
    }
    if x.is_one() {
        return half_pi(bits(digits)).to_interval(0);
    }
    let square = x * x;
    let tangent = &square / (Rational::one() - &square);
    arctan_of_root(&tangent, digits)
}

/// arccos x = 2 arctan √((1 − x)/(1 + x))
fn acos(x: &Rational, digits: u32) -> Interval {
    let one = Rational::one();
    if (-x).is_one() {
        return pi(digits);
    }
    let half = arctan_of_root(&((&one - x) / (&one + x)), digits);
    half.add(&half)
}

fn arctan_of_root(square: &Rational, digits: u32) -> Interval {
    let Interval { low, high } = Interval::point(square).root(2, digits + 2);
    Interval { low: atan(&low, digits).low, high: atan(&high, digits).high }
}
