//! Values with their slopes along all unknowns, in fixed point: the derivatives of order conditions, exact up to
//! rounding, by the same sums of products as the values.

use num_bigint::BigInt;
use num_traits::{One, Zero};
use shadowstep_schemes::symbolic::Rational;

use shadowstep_schemes::arithmetic::Arithmetic;

/// Numbers m·2^−bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Duals {
    pub(super) bits: u32,
}

/// A value and its derivative along each unknown; none at all for a constant.
#[derive(Clone, Debug)]
pub(super) struct Dual {
    pub(super) value: BigInt,
    pub(super) slopes: Vec<BigInt>,
}

impl Duals {
    /// Enough bits for a number of decimal digits.
    pub(super) fn digits(digits: u32) -> Duals {
        Duals { bits: (f64::from(digits) * std::f64::consts::LOG2_10).ceil() as u32 }
    }

    /// A rational in units, rounded down.
    pub(super) fn units(self, value: &Rational) -> BigInt {
        (value.numer() << self.bits) / value.denom()
    }

    /// Units as a rational.
    pub(super) fn rational(self, units: BigInt) -> Rational {
        Rational::new(units, BigInt::one() << self.bits)
    }
}

impl Arithmetic for Duals {
    type Value = Dual;

    fn zero(&self) -> Dual {
        Dual { value: BigInt::zero(), slopes: Vec::new() }
    }

    fn one(&self) -> Dual {
        Dual { value: BigInt::one() << self.bits, slopes: Vec::new() }
    }

    fn weight(&self, weight: &Rational) -> Dual {
        Dual { value: self.units(weight), slopes: Vec::new() }
    }

    fn add_product(&self, target: &mut Dual, a: &Dual, b: &Dual) {
        target.value += (&a.value * &b.value) >> self.bits;
        for (factor, other) in [(a, b), (b, a)] {
            if target.slopes.is_empty() && !factor.slopes.is_empty() {
                target.slopes = vec![BigInt::zero(); factor.slopes.len()];
            }
            for (sum, slope) in target.slopes.iter_mut().zip(&factor.slopes).filter(|(_, slope)| !slope.is_zero()) {
                *sum += (slope * &other.value) >> self.bits;
            }
        }
    }

    fn divide(&self, a: &Dual, n: u32) -> Dual {
        Dual { value: &a.value / n, slopes: a.slopes.iter().map(|slope| slope / n).collect() }
    }
}
