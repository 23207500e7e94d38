//! The last place of 1 in any number type.

use crate::Rational;
use crate::number::Number;

/// The distance from 1 to the next number, |3 (4/3 − 1) − 1|: of 4/3 = 1.0101…₂ a third of the last place is rounded
/// away, and nothing after that.
pub(crate) fn epsilon<N: Number>(context: &N::Context) -> N {
    let rational = |above: u32, below: u32| N::from_rational(&Rational::new(above.into(), below.into()), context);
    let (mut epsilon, one) = (rational(4, 3), rational(1, 1));
    epsilon.subtract(&one);
    epsilon.multiply_integer(3);
    epsilon.subtract(&one);
    epsilon.make_absolute();
    epsilon
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_place_of_1() {
        assert_eq!(epsilon::<f64>(&()), f64::EPSILON);
        assert_eq!(epsilon::<crate::number::DoubleDouble>(&()), 2_f64.powi(-106).into());
        #[cfg(feature = "mpfr")]
        for bits in [2_u32, 3, 53, 100, 101, 400] {
            use crate::number::{Float, Precision};
            let Ok(precision) = Precision::bits(bits) else { continue };
            let expected = Float::with_val(precision.in_bits(), 1) >> (precision.in_bits() - 1);
            assert_eq!(epsilon::<Float>(&precision), expected, "{bits} bits");
        }
    }
}
