//! Rational powers and roots, and the largest size of numbers.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::Signed;
#[cfg(feature = "graph")]
use num_traits::{One, ToPrimitive, Zero};

use crate::symbolic::number::rational::Rational;

/// The most bits of an exact numerator or denominator.
pub(crate) const MOST_BITS: u64 = 100_000;

/// The integer power; `None` if it would be too long.
pub(crate) fn rational_power(value: &Rational, exponent: u32) -> Option<Rational> {
    let bits = value.numer().bits().max(value.denom().bits());
    let least = (bits - 1).checked_mul(exponent.into())?;
    // A ratio in lowest terms stays so.
    let power = || Rational::new_raw(value.numer().pow(exponent), value.denom().pow(exponent));
    (least <= MOST_BITS).then(power)
}

/// The rational number whose power of this order is the value, if there is one.
pub(crate) fn perfect_root(value: &Rational, order: u32) -> Option<Rational> {
    if value.is_negative() && order.is_even() {
        return None;
    }
    let root = |whole: &BigInt| Some(whole.nth_root(order)).filter(|root| root.pow(order) == *whole);
    Some(Rational::new_raw(root(value.numer())?, root(value.denom())?))
}

/// value^exponent, if that is a rational of reasonable size.
#[cfg(feature = "graph")]
pub(crate) fn exact_power(value: &Rational, exponent: &Rational) -> Option<Rational> {
    if value.is_zero() && exponent.is_negative() {
        return None;
    }
    let order = exponent.denom().to_u32()?;
    let root = if order == 1 { value.clone() } else { perfect_root(value, order)? };
    let count = exponent.numer().magnitude().to_u32();
    // The powers of these are never too long.
    let count = if root.is_zero() || root.is_one() { Some(1) } else { count };
    let power = rational_power(&root, count?)?;
    Some(if exponent.is_negative() { power.recip() } else { power })
}
