//! Rounding of rationals to decimal numbers, in exact integer arithmetic.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::Zero;

use crate::number::ratio::Ratio;
use crate::number::rational::Rational;

/// The direction of rounding.
#[derive(Clone, Copy)]
pub(crate) enum Direction {
    Down,
    Up,
    /// To the nearer decimal; of two equally near ones to that with an even last digit.
    Nearest,
}

/// 10^exponent.
pub(crate) fn ten(exponent: u64) -> BigInt {
    num_traits::Pow::pow(BigInt::from(10), exponent)
}

/// units / 10^places.
pub(crate) fn at_places(units: BigInt, places: i64) -> Rational {
    let power = ten(places.unsigned_abs());
    if places > 0 { Rational::new(units, power) } else { Rational::from_integer(units * power) }
}

/// Numerator and denominator of value * 10^places, not reduced.
pub(crate) fn scaled(value: &impl Ratio, places: i64) -> (BigInt, BigInt) {
    let power = ten(places.unsigned_abs());
    if places >= 0 {
        (value.numer() * power, value.denom().clone())
    } else {
        (value.numer().clone(), value.denom() * power)
    }
}

/// The integer next to value * 10^places in the given direction.
pub(crate) fn units(value: &impl Ratio, places: i64, direction: Direction) -> BigInt {
    let (numerator, denominator) = scaled(value, places);
    let (floor, rest) = numerator.div_mod_floor(&denominator);
    let up = match direction {
        Direction::Down => false,
        Direction::Up => !rest.is_zero(),
        Direction::Nearest => match (rest * 2u8).cmp(&denominator) {
            Ordering::Less => false,
            Ordering::Equal => floor.is_odd(),
            Ordering::Greater => true,
        },
    };
    floor + u8::from(up)
}

/// The number of the form n / 10^places next to the value in the given direction.
pub(crate) fn to_places(value: &impl Ratio, places: i64, direction: Direction) -> Rational {
    at_places(units(value, places, direction), places)
}

/// The largest k with 10^k <= |value|; zero for the value zero.
pub(crate) fn magnitude(value: &impl Ratio) -> i64 {
    if value.numer().is_zero() {
        return 0;
    }
    // Bit lengths bound |value| below by a power of two, and so k to one or two candidates.
    let bits = value.numer().bits() as i64 - value.denom().bits() as i64;
    let mut k = ((bits - 1) as f64 * std::f64::consts::LOG10_2).floor() as i64;
    while reaches(value, k + 1) {
        k += 1;
    }
    k
}

/// Whether 10^k <= |value|.
fn reaches(value: &impl Ratio, k: i64) -> bool {
    let (numerator, denominator) = scaled(value, -k);
    numerator.magnitude() >= denominator.magnitude()
}

/// The decimal places that `digits` significant digits of the value reach to.
pub(crate) fn places(value: &impl Ratio, digits: u32) -> i64 {
    i64::from(digits.max(1)) - 1 - magnitude(value)
}
