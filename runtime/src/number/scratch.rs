//! scratch
use super::{LimbAccess, Number, Ordered, Parts};
use crate::Rational;
use num_traits::{Signed, Zero};
use shadowstep_limbs::Limbs;
use std::fmt;
/// x
#[derive(Clone, Copy, Debug)]
pub struct Lim<const L: usize>(pub Limbs<L>);
impl<const L: usize> PartialEq for Lim<L> { fn eq(&self, o: &Self) -> bool { self.0 == o.0 } }
impl<const L: usize> PartialOrd for Lim<L> { #[inline] fn partial_cmp(&self, o: &Self) -> Option<std::cmp::Ordering> { self.0.partial_cmp(&o.0) } }
impl<const L: usize> fmt::Display for Lim<L> { fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result { write!(f, "{}", self.0.to_f64()) } }
fn no() -> ! { unimplemented!() }
impl<const L: usize> Number for Lim<L> {
    type Context = ();
    type Register<'a> = &'a mut Self;
    const LIMBS: Option<LimbAccess<Self>> = Some(LimbAccess {
        limbs: L,
        parts: |x| match x.0.exponent() {
            Some(exponent) => Parts::Regular { negative: x.0.is_sign_negative(), exponent: exponent.into(), significand: x.0.mantissa() },
            None if x.0.is_zero() => Parts::Zero,
            None => Parts::NotFinite,
        },
        assign: |x, negative, magnitude, exponent| x.0 = Limbs::from_magnitude(negative, magnitude, exponent, false),
        assign_nan: |x| x.0 = Limbs::NAN,
    });
    fn register(&mut self) -> &mut Self { self }
    fn zero(_: &()) -> Self { Lim(Limbs::ZERO) }
    fn from_rational(v: &Rational, _: &()) -> Self {
        if v.is_zero() { return Lim(Limbs::ZERO) }
        let s = 64 * L as i64 + 128 + v.denom().bits() as i64 - v.numer().bits() as i64;
        let s = s.max(0);
        let q = (v.numer().abs() << s as u64) / v.denom();
        Lim(Limbs::from_magnitude(v.is_negative(), &q.magnitude().to_u64_digits(), -s, true))
    }
    fn context(&self) {}
    fn assign_zero(&mut self) { self.0 = Limbs::ZERO }
    #[inline] fn assign(&mut self, a: &Self) { *self = *a }
    #[inline] fn assign_sum(&mut self, a: &Self, b: &Self) { self.0 = &a.0 + &b.0 }
    #[inline] fn assign_difference(&mut self, a: &Self, b: &Self) { self.0 = &a.0 - &b.0 }
    #[inline] fn assign_product(&mut self, a: &Self, b: &Self) { self.0 = &a.0 * &b.0 }
    fn assign_quotient(&mut self, a: &Self, b: &Self) { self.0 = &a.0 / &b.0 }
    fn assign_sqrt(&mut self, a: &Self) { self.0 = a.0.sqrt() }
    fn assign_reciprocal_sqrt(&mut self, a: &Self) { self.0 = &Limbs::ONE / &a.0.sqrt() }
    fn assign_root(&mut self, _: &Self, _: u32) { no() }
    fn assign_exp(&mut self, _: &Self) { no() }
    fn assign_sin(&mut self, _: &Self) { no() }
    fn assign_cos(&mut self, _: &Self) { no() }
    fn assign_log(&mut self, _: &Self) { no() }
    fn assign_tan(&mut self, _: &Self) { no() }
    fn assign_sinh(&mut self, _: &Self) { no() }
    fn assign_cosh(&mut self, _: &Self) { no() }
    fn assign_tanh(&mut self, _: &Self) { no() }
    fn assign_atan(&mut self, _: &Self) { no() }
    fn assign_asin(&mut self, _: &Self) { no() }
    fn assign_acos(&mut self, _: &Self) { no() }
    #[inline] fn add(&mut self, a: &Self) { self.0 += &a.0 }
    #[inline] fn subtract(&mut self, a: &Self) { self.0 -= &a.0 }
    #[inline] fn multiply(&mut self, a: &Self) { self.0 *= &a.0 }
    fn divide(&mut self, a: &Self) { self.0 = &self.0 / &a.0 }
    #[inline] fn add_product(&mut self, a: &Self, b: &Self) { self.0 += &(&a.0 * &b.0) }
    #[inline] fn subtract_product(&mut self, a: &Self, b: &Self) { self.0 -= &(&a.0 * &b.0) }
    fn multiply_integer(&mut self, n: i32) { self.0 = self.0.times_integer(n) }
    fn divide_integer(&mut self, n: i32) { self.0 = self.0.over_integer(n) }
    fn negate(&mut self) { self.0 = -self.0 }
    fn make_absolute(&mut self) { self.0 = self.0.abs() }
    fn make_at_least(&mut self, a: &Self) { if *self < *a { *self = *a } }
    fn make_at_most(&mut self, a: &Self) { if *self > *a { *self = *a } }
    fn make_nan_where_square_overflows(&mut self, _: &Self) {}
    fn is_finite(&self) -> bool { self.0.is_finite() }
}
impl<const L: usize> Ordered for Lim<L> {
    #[inline] fn is_below_zero(&self) -> bool { self.0.is_sign_negative() && !self.0.is_zero() }
    fn to_f64(&self) -> f64 { self.0.to_f64() }
    fn log10_abs(&self) -> f64 { let (f, e) = self.0.to_f64_exponent(); f.abs().log10() + f64::from(e) * std::f64::consts::LOG10_2 }
    fn to_text(&self) -> String { self.to_string() }
}
