//! exp, log and the hyperbolic functions, from tables of 32 powers and of 47 logarithms and from series.

use super::DoubleDouble;
use super::arithmetic::two_sum;
use super::constants::{INVERSE_FACTORIALS, INVERSES, LOG_2, LOG_2_32, TABLES};
use super::polynomial::{alternate, polynomial};

/// Beyond, e^(−|x|) is less than 2⁻¹⁰⁸ of e^|x|.
const ONE_SIDED: f64 = 40.0;

pub(super) fn exp(x: DoubleDouble) -> DoubleDouble {
    shifted_exp(x, 0)
}

/// 2^shift exp x = 2^(shift + ⌊k/32⌋) 2^(k mod 32 / 32) exp r, x = k log 2/32 + r
fn shifted_exp(x: DoubleDouble, shift: i32) -> DoubleDouble {
    if x.high.is_nan() || x.high.abs() > 800.0 {
        return DoubleDouble::every(x.high.exp());
    }
    let (a, b) = LOG_2_32;
    let k = nearest_integer(x.high / a);
    let rest = DoubleDouble::of(two_sum(x.high, -k * a)) + DoubleDouble::every(x.low) - DoubleDouble::of(b).times(k);
    let k = k as i32;
    let power = DoubleDouble::of(TABLES.powers[k.rem_euclid(32) as usize]);
    let exp = power.plus_product(power, small_exp_minus_1(rest));
    let result = times_power_of_two(exp, k.div_euclid(32) + shift);
    if result.high.is_finite() { result } else { DoubleDouble::every(f64::INFINITY) }
}

/// exp x − 1 for |x| ≤ log 2/64
fn small_exp_minus_1(x: DoubleDouble) -> DoubleDouble {
    x.plus_product(x.square(), polynomial(x, &INVERSE_FACTORIALS[2..8], &INVERSE_FACTORIALS[8..14]))
}

/// log x = e log 2 − log c + log(1 + f), x = 2^e m with m from 0.707 to 1.414, c m = 1 + f, c of 9 bits near 1/m
pub(super) fn log(x: DoubleDouble) -> DoubleDouble {
    if !(x.high > 0.0 && x.high < f64::INFINITY) {
        return DoubleDouble::every(x.high.ln());
    }
    let (x, shift) = if x.high < f64::MIN_POSITIVE { (times_power_of_two(x, 60), -60) } else { (x, 0) };
    let e = exponent(x.high * std::f64::consts::SQRT_2);
    let m = times_power_of_two(x, -e);
    let index = (nearest_integer(m.high * 64.0) as usize).clamp(45, 91) - 45;
    let (c, minus_log_c) = TABLES.logarithms[index];
    let [high, low] = [m.high, m.low].map(|part| DoubleDouble::every(part).times(c)); // exact
    let f = (high - DoubleDouble::every(1.0)) + low;
    // log(1 + f) = f − f² (1/2 − f (1/3 − …))
    let small = f.minus_product(f.square(), polynomial(-f, &INVERSES[1..9], &INVERSES[9..]));
    let (a, b) = LOG_2;
    let e = f64::from(e + shift);
    DoubleDouble::every(e * a) + (DoubleDouble::of(b).times(e) + (small + DoubleDouble::of(minus_log_c)))
}

/// sinh x = ½(eˣ − 1/eˣ), for |x| < 1 a series
pub(super) fn sinh(x: DoubleDouble) -> DoubleDouble {
    let size = x.absolute();
    if size.high < 1.0 {
        return small_sinh(x);
    }
    let half = shifted_exp(size, -1);
    let sinh = if size.high > ONE_SIDED { half } else { half - DoubleDouble::every(0.25) / half };
    if x.high < 0.0 { -sinh } else { sinh }
}

/// Σ x^(2n + 1)/(2n + 1)!, |x| < 1
fn small_sinh(x: DoubleDouble) -> DoubleDouble {
    let square = x.square();
    let terms: [_; 14] = alternate(&INVERSE_FACTORIALS[3..]);
    x.plus_product(x * square, polynomial(square, &terms[..8], &terms[8..]))
}

pub(super) fn cosh(x: DoubleDouble) -> DoubleDouble {
    let size = x.absolute();
    let half = shifted_exp(size, -1);
    if size.high > ONE_SIDED { half } else { half + DoubleDouble::every(0.25) / half }
}

/// tanh x = 1 − 2/(e^2x + 1), for |x| < 1 sinh x/√(1 + sinh² x)
pub(super) fn tanh(x: DoubleDouble) -> DoubleDouble {
    let one = DoubleDouble::every(1.0);
    let size = x.absolute();
    if size.high < 1.0 {
        let sinh = small_sinh(x);
        return sinh / (one + sinh.square()).sqrt();
    }
    let tanh = if size.high > ONE_SIDED { one } else { one - DoubleDouble::every(2.0) / (exp(size.scaled(2.0)) + one) };
    if x.high < 0.0 { -tanh } else { tanh }
}

/// The nearest integer of x, |x| < 2⁵¹.
pub(super) fn nearest_integer(x: f64) -> f64 {
    const SHIFT: f64 = 1.5 * (1_u64 << 52) as f64;
    (x + SHIFT) - SHIFT
}

/// ⌊log₂ x⌋ of a normal x > 0
pub(super) fn exponent(x: f64) -> i32 {
    (x.to_bits() >> 52) as i32 - 1023
}

/// x 2^n for |n| ≤ 2040
pub(super) fn times_power_of_two(x: DoubleDouble, n: i32) -> DoubleDouble {
    let power = |n: i32| f64::from_bits(((1023 + n) as u64) << 52);
    let half = n / 2;
    x.scaled(power(half)).scaled(power(n - half))
}
