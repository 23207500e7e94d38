//! Roots of any order.

use super::DoubleDouble;
use super::exponential::{exponent, times_power_of_two};

/// The largest exponent of a number, rounded up: roots of a higher order are near 1.
const LARGEST_EXPONENT: i32 = 1100;

/// The real root of an order n ≥ 1; NaN of a negative number if n is even.
pub(super) fn root(x: DoubleDouble, n: u32) -> DoubleDouble {
    let size = x.absolute();
    if x.high < 0.0 && n.is_multiple_of(2) {
        return DoubleDouble::every(f64::NAN);
    }
    let root = match n {
        1 => size,
        2 => size.sqrt(),
        _ if size.high > 0.0 && size.high < f64::INFINITY => positive_root(size, n),
        _ => size,
    };
    if x.high < 0.0 { -root } else { root }
}

/// From the `f64` y near the root: x^(1/n) = y (1 + d)^(1/n), d = x/yⁿ − 1, to the second order in d
fn positive_root(x: DoubleDouble, n: u32) -> DoubleDouble {
    // x = m 2^(n e), so that no power of y under- or overflows
    let e = match i32::try_from(n) {
        Ok(n) if n < LARGEST_EXPONENT => exponent(x.high.max(f64::MIN_POSITIVE)) / n,
        _ => 0,
    };
    let m = if e == 0 { x } else { times_power_of_two(x, -e * n as i32) };
    let count = f64::from(n);
    let y = DoubleDouble::every((m.high.ln() / count).exp());
    let d = m / power(y, n) - DoubleDouble::every(1.0);
    let change = d.over(count) * DoubleDouble::every(1.0 - (1.0 - count.recip()) * d.high / 2.0);
    times_power_of_two(y.plus_product(y, change), e)
}

/// yⁿ
fn power(y: DoubleDouble, n: u32) -> DoubleDouble {
    let mut power = y;
    for bit in (0..n.ilog2()).rev() {
        power = power.square();
        if n >> bit & 1 == 1 {
            power = power * y;
        }
    }
    power
}
