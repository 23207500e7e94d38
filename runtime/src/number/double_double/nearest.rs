//! Rounding of rational numbers.

use num_traits::ToPrimitive;

use super::DoubleDouble;
use crate::Rational;

/// The double-double nearest to a rational number: its high part is the nearest `f64`, its low part the `f64` nearest
/// to the rest.
pub(super) fn nearest(value: &Rational) -> DoubleDouble {
    let to_f64 = |value: &Rational| value.to_f64().expect("every rational has a nearest f64");
    let high = to_f64(value);
    let rest = Rational::from_float(high).map(|high| to_f64(&(value - high)));
    rest.map_or(DoubleDouble::every(high), |low| DoubleDouble::new(high, low))
}
