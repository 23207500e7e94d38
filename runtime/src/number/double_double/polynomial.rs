//! Sums of powers.

use super::DoubleDouble;

/// c₀ + x (c₁ + x (c₂ + …)) over `double` and then `single`, which are so small that `f64` is enough for the sum of
/// their terms.
#[inline(always)]
pub(super) fn polynomial(x: DoubleDouble, double: &[(f64, f64)], single: &[(f64, f64)]) -> DoubleDouble {
    let tail = single.iter().rev().fold(0.0, |sum, &(c, _)| sum * x.high + c);
    double.iter().rev().fold(DoubleDouble::every(tail), |sum, &c| DoubleDouble::of(c).plus_product(sum, x))
}

/// Every second coefficient.
pub(super) fn alternate<const N: usize>(coefficients: &[(f64, f64)]) -> [(f64, f64); N] {
    std::array::from_fn(|i| coefficients[2 * i])
}
