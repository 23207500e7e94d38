//! Ratios of integers that need not be in lowest terms.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};

use crate::symbolic::number::ratio::{Ratio, compare};
use crate::symbolic::number::rational::Rational;

/// numerator/denominator with a positive denominator, not reduced: for numbers so long that their common divisors take
/// longer to find than they save.
#[derive(Debug, Clone)]
pub struct Fraction {
    numerator: BigInt,
    denominator: BigInt,
}

impl Fraction {
    /// numerator/denominator
    ///
    /// # Panics
    /// If the denominator is not positive.
    pub fn new(numerator: BigInt, denominator: BigInt) -> Self {
        assert!(denominator.is_positive(), "the denominator must be positive");
        Fraction { numerator, denominator }
    }

    /// The same number in lowest terms.
    pub fn reduced(self) -> Rational {
        Rational::new(self.numerator, self.denominator)
    }

    /// The nearest `f64`, half to even; infinite beyond the largest.
    pub fn to_f64(&self) -> f64 {
        let ratio = BigRational::new_raw(self.numerator.clone(), self.denominator.clone());
        ratio.to_f64().expect("every ratio has a nearest f64")
    }
}

impl Ratio for Fraction {
    fn numer(&self) -> &BigInt {
        &self.numerator
    }

    fn denom(&self) -> &BigInt {
        &self.denominator
    }
}

impl From<Rational> for Fraction {
    fn from(value: Rational) -> Self {
        let (numerator, denominator) = value.into_parts();
        Fraction { numerator, denominator }
    }
}

/// 2/4 equals 1/2.
impl PartialEq for Fraction {
    fn eq(&self, other: &Self) -> bool {
        compare(self, other).is_eq()
    }
}

impl Eq for Fraction {}

impl PartialOrd for Fraction {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Fraction {
    fn cmp(&self, other: &Self) -> Ordering {
        compare(self, other)
    }
}

impl PartialEq<Rational> for Fraction {
    fn eq(&self, other: &Rational) -> bool {
        compare(self, other).is_eq()
    }
}

impl PartialOrd<Rational> for Fraction {
    fn partial_cmp(&self, other: &Rational) -> Option<Ordering> {
        Some(compare(self, other))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fraction_is_what_it_is_in_lowest_terms() {
        let half = Fraction::new(2.into(), 4.into());
        assert_eq!(half, Fraction::from(Rational::new(1.into(), 2.into())));
        assert!(half < Fraction::new(20.into(), 30.into()));
        assert_eq!(half.to_f64(), 0.5);
        assert_eq!(half.reduced().numer(), &BigInt::from(1));
    }
}
