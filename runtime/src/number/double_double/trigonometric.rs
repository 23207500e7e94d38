//! sin, cos and their inverses, from a table of sines of multiples of π/256 and from series.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::ToPrimitive;

use super::DoubleDouble;
use super::arithmetic::two_sum;
use super::constants::{HALF_PI, INVERSE_FACTORIALS, PI_256, PI_TIMES_2_1400, TABLES, Tables};
use super::exponential::nearest_integer;
use super::nearest::nearest;
use super::polynomial::{alternate, polynomial};
use crate::Rational;

pub(super) fn sin(x: DoubleDouble) -> DoubleDouble {
    Near::of(x).map_or(DoubleDouble::every(f64::NAN), |near| near.sin())
}

pub(super) fn cos(x: DoubleDouble) -> DoubleDouble {
    Near::of(x).map_or(DoubleDouble::every(f64::NAN), |near| near.cos())
}

pub(super) fn tan(x: DoubleDouble) -> DoubleDouble {
    let (sin, cos) = sin_cos(x);
    sin / cos
}

pub(super) fn sin_cos(x: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    Near::of(x).map_or((DoubleDouble::every(f64::NAN), DoubleDouble::every(f64::NAN)), |near| (near.sin(), near.cos()))
}

/// x = t + r, t the nearest multiple of π/256: the multiple modulo 512, sin r and cos r − 1.
struct Near {
    tables: &'static Tables,
    multiple: usize,
    sin_r: DoubleDouble,
    cos_r_minus_1: DoubleDouble,
}

impl Near {
    /// None of an x that is not finite.
    #[inline(always)]
    fn of(x: DoubleDouble) -> Option<Near> {
        if !x.high.is_finite() {
            return None;
        }
        let (r, multiple) = reduced(x);
        let minus_square = -r.square();
        // |r| < 0.0062: what is left out is below 2⁻¹²⁰ r and 2⁻¹³⁹, and what is summed in `f64` below 2⁻⁵⁶ r and 2⁻⁵³
        let terms: [_; 5] = alternate(&INVERSE_FACTORIALS[3..]);
        let sin_r = r.plus_product(r * minus_square, polynomial(minus_square, &terms[..2], &terms[2..]));
        let terms: [_; 6] = alternate(&INVERSE_FACTORIALS[2..]);
        let cos_r_minus_1 = minus_square * polynomial(minus_square, &terms[..2], &terms[2..]);
        Some(Near { tables: &TABLES, multiple, sin_r, cos_r_minus_1 })
    }

    /// sin x = sin t + (sin t (cos r − 1) + cos t sin r)
    #[inline(always)]
    fn sin(&self) -> DoubleDouble {
        if self.multiple == 0 {
            return self.sin_r;
        }
        let (sin_t, cos_t) = (self.sine(self.multiple), self.sine(self.multiple + 128));
        sin_t + (cos_t * self.sin_r).plus_product(sin_t, self.cos_r_minus_1)
    }

    /// cos x = cos t + (cos t (cos r − 1) − sin t sin r)
    #[inline(always)]
    fn cos(&self) -> DoubleDouble {
        if self.multiple == 0 {
            return DoubleDouble::every(1.0) + self.cos_r_minus_1;
        }
        let (sin_t, cos_t) = (self.sine(self.multiple), self.sine(self.multiple + 128));
        cos_t + (cos_t * self.cos_r_minus_1).minus_product(sin_t, self.sin_r)
    }

    /// sin(j π/256)
    #[inline(always)]
    fn sine(&self, j: usize) -> DoubleDouble {
        let value = DoubleDouble::of(self.tables.sines[if j & 128 == 0 { j & 127 } else { 128 - (j & 127) }]);
        if j & 256 == 0 { value } else { -value }
    }
}

/// The rest of x after the nearest multiple j π/256, and j modulo 512.
fn reduced(x: DoubleDouble) -> (DoubleDouble, usize) {
    let ([a, b], c) = PI_256;
    let j = nearest_integer(x.high / a);
    if j == 0.0 {
        return (x, 0);
    }
    if x.high.abs() < 1e5 {
        let rest = DoubleDouble::of(two_sum(x.high, -j * a)) - DoubleDouble::every(j * b); // exact
        let rest = (rest + DoubleDouble::every(x.low)) - DoubleDouble::of(c).times(j);
        if rest.high.abs() > 1e-12 {
            return (rest, (j as i32).rem_euclid(512) as usize);
        }
    }
    exactly_reduced(x)
}

/// The same in integers, 2¹⁴⁰⁸ x and 2¹⁴⁰⁰ π: for large x, and for x so near to a multiple that digits cancel.
#[cold]
fn exactly_reduced(x: DoubleDouble) -> (DoubleDouble, usize) {
    let pi = BigInt::parse_bytes(PI_TIMES_2_1400.as_bytes(), 16).expect("hexadecimal digits");
    let x = shifted(x.high, 1408) + shifted(x.low, 1408);
    let j: BigInt = (BigInt::from(2) * &x + &pi).div_floor(&(BigInt::from(2) * &pi));
    let rest = nearest(&Rational::new(x - &j * pi, BigInt::from(1) << 1408));
    (rest, j.mod_floor(&BigInt::from(512)).to_usize().expect("less than 512"))
}

/// 2^bits x, an integer
fn shifted(x: f64, bits: i32) -> BigInt {
    let (mantissa, exponent, sign) = num_traits::Float::integer_decode(x);
    (BigInt::from(mantissa) * i32::from(sign)) << (i32::from(exponent) + bits)
}

/// From the `f64` z near it: arctan x = z + (x cos z − sin z)/(cos z + x sin z), the arctangent of the quotient being
/// the quotient
pub(super) fn atan(x: DoubleDouble) -> DoubleDouble {
    let z = x.high.atan();
    if x.high.is_infinite() {
        return DoubleDouble::of(HALF_PI).scaled(x.high.signum());
    }
    let (sin, cos) = sin_cos(DoubleDouble::every(z));
    DoubleDouble::every(z) + (x * cos - sin) / cos.plus_product(x, sin)
}

/// π/2 − arccos |x| where that is less steep
pub(super) fn asin(x: DoubleDouble) -> DoubleDouble {
    if x.high.abs() > STEEP {
        let asin = DoubleDouble::of(HALF_PI) - acos_near_1(x.absolute());
        return if x.high < 0.0 { -asin } else { asin };
    }
    gentle_asin(x)
}

pub(super) fn acos(x: DoubleDouble) -> DoubleDouble {
    if x.high > STEEP {
        acos_near_1(x)
    } else if x.high < -STEEP {
        DoubleDouble::of(HALF_PI).scaled(2.0) - acos_near_1(-x)
    } else {
        DoubleDouble::of(HALF_PI) - gentle_asin(x)
    }
}

/// Above, the derivative of the arcsine is above 5/3.
const STEEP: f64 = 0.8;

/// From the `f64` z near it: arcsin x = z + (x − sin z)/cos z + O(u²)/30
fn gentle_asin(x: DoubleDouble) -> DoubleDouble {
    let z = x.high.asin();
    let (sin, cos) = sin_cos(DoubleDouble::every(z));
    DoubleDouble::every(z) + (x - sin) / cos
}

/// arccos x = 2 arcsin √((1 − x)/2)
fn acos_near_1(x: DoubleDouble) -> DoubleDouble {
    gentle_asin((DoubleDouble::every(1.0) - x).scaled(0.5).sqrt()).scaled(2.0)
}
