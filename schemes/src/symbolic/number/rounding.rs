//! Rounding of rationals to decimal numbers, in exact integer arithmetic.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{ToPrimitive, Zero};

use crate::symbolic::number::ratio::Ratio;
use crate::symbolic::number::rational::Rational;

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
    let places = match u64::try_from(places) {
        Ok(places) if !units.is_zero() => places,
        Ok(_) => return Rational::zero(),
        Err(_) => return Rational::from_integer(units * ten(places.unsigned_abs())),
    };
    // common divisors of most units and a power of ten are found by a few divisions
    let twos = units.trailing_zeros().unwrap_or(0).min(places);
    let (rest, fives) = without_fives(&units >> twos, places.min(MOST_FIVES));
    if fives == MOST_FIVES {
        return Rational::new(units, ten(places));
    }
    Rational::new_raw(rest, power_of_five(places - fives) << (places - twos))
}

/// 5^exponent.
pub(crate) fn power_of_five(exponent: u64) -> BigInt {
    let short = u32::try_from(exponent).ok().and_then(|exponent| 5_u64.checked_pow(exponent));
    short.map_or_else(|| num_traits::Pow::pow(BigInt::from(5), exponent), BigInt::from)
}

/// A number other than 0 without its factors of 5, or this number of them; and their number.
pub(crate) fn without_fives(mut number: BigInt, most: u64) -> (BigInt, u64) {
    let mut fives = 0;
    if let Some(mut limb) = number.to_i64() {
        while fives < most && limb % 5 == 0 {
            (limb, fives) = (limb / 5, fives + 1);
        }
        return (limb.into(), fives);
    }
    let five = BigInt::from(5);
    while fives < most && number.is_multiple_of(&five) {
        number /= &five;
        fives += 1;
    }
    (number, fives)
}

/// Units with more factors of 5 have a common divisor that is worth a search.
const MOST_FIVES: u64 = 20;

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_in_lowest_terms() {
        for units in [0_i64, 1, -1, 2, 5, -50, 1250, 3_125_000, 7 << 40, 1_220_703_125] {
            for places in [-3, 0, 1, 2, 9, 17] {
                let found = at_places(units.into(), places);
                let (above, below) = if places < 0 { (ten(3), ten(0)) } else { (ten(0), ten(places as u64)) };
                let expected = Rational::new(BigInt::from(units) * above, below);
                assert_eq!((found.numer(), found.denom()), (expected.numer(), expected.denom()), "{units} {places}");
            }
        }
        // 10^30 and 5^40
        for units in [ten(30), num_traits::Pow::pow(BigInt::from(5), 40u64)] {
            for places in [10, 30, 45] {
                assert_eq!(at_places(units.clone(), places), Rational::new(units.clone(), ten(places as u64)));
            }
        }
    }
}
