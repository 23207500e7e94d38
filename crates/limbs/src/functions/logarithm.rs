//! The natural logarithm: of an `f64` near it, and of the rest as an area hyperbolic tangent; and roots of any order.

use super::constants::LOG_2;
use super::exponential::{exp, exp_times_power};
use super::fraction::{fraction, number, square};
use super::series::series;
use super::tables::INVERSES;
use crate::newton::top;
use crate::{Limbs, fixed};

/// log x
pub(super) fn log<const W: usize>(x: &Limbs<W>) -> Limbs<W> {
    if !x.is_regular() || x.negative {
        return match x {
            _ if x.is_zero() => -Limbs::INFINITY,
            _ if x.is_infinite() && !x.negative => *x,
            _ => Limbs::NAN,
        };
    }
    // x = m 2^e, m about from √1/2 to √2
    let halves = x.mantissa[W - 1] >> 32 < 0xb504_f334;
    let e = x.exponent - i32::from(halves);
    let m = Limbs { exponent: i32::from(halves), ..*x };
    let rest = &m - &Limbs::ONE;
    if rest.is_zero() || rest.exponent < -20 {
        let own = twice_area_tangent(&rest, &m);
        return if e == 0 { own } else { &own + &times_log_2(e) };
    }
    let near = Limbs::from(m.to_f64().ln());
    let ratio = &m * &exp(&-near);
    let own = &near + &twice_area_tangent(&(&ratio - &Limbs::ONE), &ratio);
    if e == 0 { own } else { &own + &times_log_2(e) }
}

fn times_log_2<const W: usize>(e: i32) -> Limbs<W> {
    number(&top(&LOG_2), 0).times_integer(e)
}

/// log y = 2 artanh((y − 1)/(y + 1)) for |y − 1| < 2^-20, from y − 1, which is exact, and y.
fn twice_area_tangent<const W: usize>(rest: &Limbs<W>, y: &Limbs<W>) -> Limbs<W> {
    if rest.is_zero() {
        return Limbs::ZERO;
    }
    let t = (rest / &(y + &Limbs::ONE)).times_power_of_two(1);
    let half = t.times_power_of_two(-1);
    let bits = 2 * half.exponent.unsigned_abs() as usize;
    let mut factor = fixed::shift_down(&series(&square(&fraction(&half)), bits, &INVERSES, false), 1);
    factor[W - 1] |= 1 << 63;
    &t * &number(&factor, 1)
}

/// The real root of an order n; of a negative x only if n is odd.
pub(super) fn root<const W: usize>(x: &Limbs<W>, n: u32) -> Limbs<W> {
    let odd = !n.is_multiple_of(2);
    if n == 0 || x.is_nan() || x.is_below_zero() && !odd {
        return Limbs::NAN;
    }
    let negative = x.negative && odd;
    if !x.is_regular() {
        return Limbs { negative, ..*x };
    }
    let root = match n {
        1 => x.abs(),
        2 => x.sqrt(),
        4 => x.sqrt().sqrt(),
        _ => {
            let log = &log(&x.abs()) / &Limbs::from(i64::from(n));
            if log.is_zero() { Limbs::ONE } else { exp_times_power(&log, 0) }
        }
    };
    Limbs { negative, ..root }
}
