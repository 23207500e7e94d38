//! Order conditions in whole numbers: no fraction is reduced, which takes most of the time for weights of hundreds of
//! digits.

use num_bigint::BigInt;
use num_integer::Integer as _;
use num_traits::{One, Zero};
use shadowstep_schemes::Rational;
use shadowstep_schemes::arithmetic::Arithmetic;

/// Numbers times scale^m, m the degree in the weights. The scale is a multiple of all denominators and of order!, so
/// that a product of k weights can be divided by k! exactly.
pub(super) struct WholeNumbers {
    scale: BigInt,
}

impl WholeNumbers {
    /// For conditions of these weights up to a degree.
    pub(super) fn new<'a>(weights: impl Iterator<Item = &'a Rational>, degree: u32) -> Self {
        let factorial: BigInt = (1..=degree).product();
        WholeNumbers { scale: weights.fold(BigInt::one(), |all, weight| all.lcm(weight.denom())) * factorial }
    }

    /// The value of a condition of this degree.
    pub(super) fn value(&self, scaled: BigInt, degree: u32) -> Rational {
        Rational::new(scaled, self.scale.pow(degree))
    }
}

impl Arithmetic for WholeNumbers {
    type Value = BigInt;
    fn zero(&self) -> BigInt {
        BigInt::zero()
    }
    fn one(&self) -> BigInt {
        BigInt::one()
    }
    fn weight(&self, weight: &Rational) -> BigInt {
        weight.numer() * (&self.scale / weight.denom())
    }
    fn add_product(&self, target: &mut BigInt, a: &BigInt, b: &BigInt) {
        *target += a * b;
    }
    fn divide(&self, a: &BigInt, n: u32) -> BigInt {
        a / n
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowstep_schemes::arithmetic::ExactArithmetic;
    use shadowstep_schemes::order::{lyndon_words, weighed, word_conditions};
    use shadowstep_schemes::shipped_proved;

    #[test]
    fn conditions_are_those_in_fractions() {
        for name in ["ruth3", "pefrl", "kahan-li6"] {
            let maps = shipped_proved(name).unwrap().scheme.maps();
            let (words, scaled) = (lyndon_words(6), WholeNumbers::new(maps.iter().map(|map| &map.weight), 6));
            let whole = word_conditions(&words, &weighed(&maps, &scaled), &scaled);
            let exact = word_conditions(&words, &weighed(&maps, &ExactArithmetic), &ExactArithmetic);
            for ((condition, whole), (_, exact)) in whole.into_iter().zip(exact) {
                assert_eq!(scaled.value(whole, condition.order), exact, "{name}: {}", condition.functional);
            }
        }
    }
}
