//! Inverse trigonometric functions: the angle of a point, of an `f64` near it and of the rest by the series of the arc
//! tangent.

use super::constants::QUARTER_PI;
use super::fraction::{fraction, number, square};
use super::series::series;
use super::tables::INVERSES;
use super::trigonometric::sin_cos;
use crate::newton::top;
use crate::{Limbs, fixed};

/// The angle of (x, y), y ≥ 0, from 0 to π; the point need not be on the unit circle.
fn angle<const W: usize>(y: &Limbs<W>, x: &Limbs<W>) -> Limbs<W> {
    let near = if y.is_zero() && !x.negative { 0.0 } else { y.to_f64().atan2(x.to_f64()) };
    if near < 1e-7 {
        return small_angle(&(y / x));
    }
    let near = Limbs::from(near);
    let (sin, cos) = sin_cos(&near);
    let across = &(y * &cos) - &(x * &sin);
    let along = &(x * &cos) + &(y * &sin);
    &near + &small_angle(&(&across / &along))
}

/// arctan t of |t| < 2^-20
fn small_angle<const W: usize>(t: &Limbs<W>) -> Limbs<W> {
    if !t.is_regular() {
        return *t;
    }
    let bits = 2 * t.exponent.unsigned_abs() as usize;
    let mut factor = series(&square(&fraction(t)), bits, &INVERSES, true);
    if fixed::is_zero(&factor) {
        return *t;
    }
    fixed::negate(&mut factor);
    t * &number(&factor, 0)
}

/// arctan x
pub(super) fn atan<const W: usize>(x: &Limbs<W>) -> Limbs<W> {
    if x.is_zero() || x.is_nan() {
        return *x;
    }
    let magnitude = if x.is_infinite() || x.exponent > 64 * W as i32 + 64 {
        number(&top(&QUARTER_PI), 1)
    } else {
        angle(&x.abs(), &Limbs::ONE)
    };
    Limbs { negative: x.negative, ..magnitude }
}

/// arcsin x
pub(super) fn asin<const W: usize>(x: &Limbs<W>) -> Limbs<W> {
    if x.is_zero() {
        return *x;
    }
    let other = other_side(x);
    let angle = if other.is_nan() { other } else { angle(&x.abs(), &other) };
    Limbs { negative: x.negative, ..angle }
}

/// arccos x
pub(super) fn acos<const W: usize>(x: &Limbs<W>) -> Limbs<W> {
    let other = other_side(x);
    if other.is_nan() { other } else { angle(&other, x) }
}

/// √(1 − x²); NaN for |x| > 1.
fn other_side<const W: usize>(x: &Limbs<W>) -> Limbs<W> {
    (&(&Limbs::ONE - x) * &(&Limbs::ONE + x)).sqrt()
}
