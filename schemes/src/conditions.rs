//! The order conditions of one kind, each with its value for a scheme and how exactly the value must be met.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{FromPrimitive, One, Signed, Zero};

use crate::arithmetic::{Arithmetic, Fixed, FixedPoint, Sensitive, Sensitivity};
use crate::claims::Kinetic;
use crate::map::Map;
use crate::map_kind::MapKind;
use crate::near_integrable::{self, Power};
use crate::nystrom::tree_conditions;
use crate::order::{Condition, lyndon_words, weighed, word_conditions};
use crate::part_words::{self, part_maps};
use crate::scheme::Held;
use crate::symbolic::{Fraction, Ratio, Rational};

/// Bits beyond the bits of the exact values, for the growth of the error.
const MARGIN_BITS: u32 = 64;

/// The most bits for weights that are held to some digits: the bounds of the errors grow by far fewer.
const MOST_BITS: u32 = 8000;

/// Conditions that a claim needs.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Family {
    /// The conditions of a class of kinetic energies.
    Kinetic(Kinetic),
    /// The conditions of a power of ε.
    Power(Power),
}

/// A condition with its value.
pub(crate) struct Evaluated {
    pub(crate) condition: Condition,
    pub(crate) found: Fraction,
    /// Bound of the error of `found`.
    error: Fraction,
    /// The largest difference from the value needed that rounded weights account for.
    tolerance: Fraction,
}

impl Evaluated {
    /// found − needed
    pub(crate) fn distance(&self) -> Fraction {
        let (found, needed) = (&self.found, &self.condition.needed);
        let distance = found.numer() * needed.denom() - needed.numer() * found.denom();
        Fraction::new(distance, found.denom() * needed.denom())
    }

    /// A bound of the difference from the value needed.
    pub(crate) fn uncertainty(&self) -> Fraction {
        let (found, needed, error) = (&self.found, &self.condition.needed, &self.error);
        debug_assert!(error.numer().is_zero() || found.denom() == error.denom());
        let distance = (found.numer() * needed.denom() - needed.numer() * found.denom()).abs();
        Fraction::new(distance + error.numer() * needed.denom(), found.denom() * needed.denom())
    }

    /// Whether the condition is met, and the digits of the weights suffice to decide that.
    pub(crate) fn holds(&self) -> bool {
        self.is_met() && self.is_decided()
    }

    /// Whether the value needed is within the tolerance.
    pub(crate) fn is_met(&self) -> bool {
        self.uncertainty() <= self.tolerance
    }

    /// Whether the arithmetic's own rounding is far below what the weights' rounding accounts for.
    fn is_resolved(&self) -> bool {
        self.error.numer() * self.tolerance.denom() * 1000 <= self.tolerance.numer() * self.error.denom()
    }

    /// Whether the weights have enough digits to distinguish a condition that is met from one that is not.
    fn is_decided(&self) -> bool {
        let thousandfold = Fraction::new(self.tolerance.numer() * 1000, self.tolerance.denom().clone());
        thousandfold <= self.condition.needed
    }
}

/// A step with the conditions that it is to meet.
trait Step {
    /// The weights of its maps.
    fn weights(&self) -> impl Iterator<Item = &Rational>;

    /// The conditions up to an order, low orders first, with their values.
    fn values<A: Arithmetic>(&self, highest: u32, arithmetic: &A) -> Vec<(Condition, A::Value)>;
}

/// Kicks and drifts, and the conditions of a family.
struct OfFamily<'a>(&'a [Map], Family);

impl Step for OfFamily<'_> {
    fn weights(&self) -> impl Iterator<Item = &Rational> {
        self.0.iter().map(|map| &map.weight)
    }

    fn values<A: Arithmetic>(&self, highest: u32, arithmetic: &A) -> Vec<(Condition, A::Value)> {
        values_at(&weighed(self.0, arithmetic), self.1, highest, arithmetic)
    }
}

/// Kicks, drifts and the weights of the middle parts between them, and the conditions for this number of parts.
struct OfParts<'a>((&'a [Map], &'a [Rational]), usize);

impl Step for OfParts<'_> {
    fn weights(&self) -> impl Iterator<Item = &Rational> {
        self.0.0.iter().map(|map| &map.weight).chain(self.0.1)
    }

    fn values<A: Arithmetic>(&self, highest: u32, arithmetic: &A) -> Vec<(Condition, A::Value)> {
        let OfParts((maps, middle), parts) = *self;
        let middle = middle.iter().map(|weight| arithmetic.weight(weight)).collect();
        part_words::conditions(&part_maps(weighed(maps, arithmetic), middle), parts, highest, arithmetic)
    }
}

/// The conditions of a family up to an order, low orders first, with their values for weights held to some digits.
pub(crate) fn evaluated(maps: &[Map], held: Held, family: Family, highest: u32) -> Vec<Evaluated> {
    evaluated_of(&OfFamily(maps, family), held, highest)
}

/// The conditions of a step for this number of parts, with the weights of their middle maps, in the same form.
pub(crate) fn evaluated_of_parts(
    step: (&[Map], &[Rational]),
    held: Held,
    parts: usize,
    highest: u32,
) -> Vec<Evaluated> {
    evaluated_of(&OfParts(step, parts), held, highest)
}

fn evaluated_of(step: &impl Step, held: Held, highest: u32) -> Vec<Evaluated> {
    match held {
        Held::Exactly => evaluated_exactly(step, highest),
        Held::Digits(digits) => evaluated_within(step, digits, highest),
    }
}

/// Where the weights are exact, so are the values: a value of degree n is a multiple of 1/(Dⁿ n!), D the common
/// denominator of the weights, and in fixed point with enough bits it is the only multiple within the bound of the
/// error.
fn evaluated_exactly(step: &impl Step, highest: u32) -> Vec<Evaluated> {
    let denominator = step.weights().fold(BigInt::one(), |lcm, weight| lcm.lcm(weight.denom()));
    let grid = |n: u32| denominator.pow(n) * factorial(n);
    let order = worth_exactness(step, highest, |order| grid(order).bits());
    let grids: Vec<_> = (0..=order).map(grid).collect();
    let mut bits = grids[order as usize].bits() as u32 + 2 * MARGIN_BITS;
    loop {
        let arithmetic = FixedPoint::with_bits(bits);
        let exact = |(condition, value): (Condition, Fixed)| {
            let grid = &grids[condition.order as usize];
            let found = arithmetic.multiple(&value, grid)?;
            let zero = || Fraction::from(Rational::zero());
            Some(Evaluated { found: Fraction::new(found, grid.clone()), condition, error: zero(), tolerance: zero() })
        };
        let values = step.values(order, &arithmetic).into_iter();
        match values.map(exact).collect() {
            Some(evaluated) => return evaluated,
            None => bits += bits / 2,
        }
    }
}

fn factorial(n: u32) -> BigInt {
    (1..=n).map(BigInt::from).product()
}

fn evaluated_within(step: &impl Step, digits: u32, highest: u32) -> Vec<Evaluated> {
    let unit = BigInt::from(10).pow(digits - 1);
    let tolerance = |(_, sensitive): (_, Sensitive)| {
        let slope = Rational::from_f64(sensitive.slope).unwrap_or_else(Rational::zero);
        Fraction::new(slope.numer().clone(), slope.denom() * &unit)
    };
    let tolerances: Vec<_> = step.values(highest, &Sensitivity).into_iter().map(tolerance).collect();
    let mut arithmetic = FixedPoint::new(digits);
    loop {
        let values = step.values(highest, &arithmetic).into_iter();
        let evaluated: Vec<_> = values
            .zip(&tolerances)
            .map(|((condition, value), tolerance)| {
                let (found, error) = arithmetic.read(&value);
                Evaluated { condition, found, error, tolerance: tolerance.clone() }
            })
            .collect();
        // the rounding of the arithmetic grows with the number of maps
        match evaluated.iter().all(Evaluated::is_resolved) || arithmetic.bits() >= MOST_BITS {
            true => return evaluated,
            false => arithmetic = FixedPoint::with_bits(2 * arithmetic.bits()),
        }
    }
}

/// The first order that certainly fails, or the highest: exact arithmetic beyond it would be slow and decide nothing.
///
/// The bits are doubled as long as exact arithmetic to that order takes more: weights of 250 digits, rounded but taken
/// as exact, may have order 8 to 60 digits, and at 260 it is order 3 that fails.
fn worth_exactness(step: &impl Step, highest: u32, exact_bits: impl Fn(u32) -> u64) -> u32 {
    let (mut order, mut arithmetic) = (highest, FixedPoint::new(60));
    loop {
        let fails = |(condition, value): &(Condition, _)| {
            let (found, error) = arithmetic.read(value);
            let evaluated =
                Evaluated { condition: condition.clone(), found, error: Rational::zero().into(), tolerance: error };
            !evaluated.is_met()
        };
        order = step.values(order, &arithmetic).iter().find(|c| fails(c)).map_or(order, |(c, _)| c.order);
        if 2 * u64::from(arithmetic.bits()) >= exact_bits(order) {
            return order;
        }
        arithmetic = FixedPoint::with_bits(2 * arithmetic.bits());
    }
}

/// The conditions of a family up to an order, low orders first, with their values for maps whose weights are values
/// already.
pub(crate) fn values_at<A: Arithmetic>(
    maps: &[(MapKind, A::Value)],
    family: Family,
    highest: u32,
    arithmetic: &A,
) -> Vec<(Condition, A::Value)> {
    match family {
        Family::Kinetic(Kinetic::Any) => word_conditions(&lyndon_words(highest as usize), maps, arithmetic),
        Family::Kinetic(Kinetic::Quadratic) => tree_conditions(maps, highest, arithmetic),
        Family::Power(power) => word_conditions(&near_integrable::words(power, highest), maps, arithmetic),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::ExactArithmetic;
    use crate::map::Stages;

    fn rationals(fractions: &[(i64, i64)]) -> Vec<Rational> {
        fractions.iter().map(|&(n, d)| Rational::new(n.into(), d.into())).collect()
    }

    fn merged(kick: &[Rational], drift: &[Rational]) -> Vec<Map> {
        Stages { kick: kick.to_vec(), gradient_kick: Vec::new(), drift: drift.to_vec() }.maps()
    }

    #[test]
    fn exact_weights_have_exact_values() {
        // order 3 (Ruth), and weights of no scheme in particular
        let ruth = merged(&rationals(&[(7, 24), (3, 4), (-1, 24)]), &rationals(&[(2, 3), (-2, 3), (1, 1)]));
        let any = merged(&rationals(&[(1, 3), (-2, 5), (7, 11)]), &rationals(&[(5, 7), (1, 9), (-3, 4)]));
        for (maps, orders) in [(ruth, 4), (any, 1)] {
            for kinetic in [Kinetic::Any, Kinetic::Quadratic] {
                let family = Family::Kinetic(kinetic);
                let found = evaluated_exactly(&OfFamily(&maps, family), 10);
                assert_eq!(found.iter().map(|c| c.condition.order).max(), Some(orders), "up to the first that fails");
                let exact = OfFamily(&maps, family).values(orders, &ExactArithmetic);
                assert_eq!(found.len(), exact.len());
                for (found, (condition, value)) in found.iter().zip(exact) {
                    assert!(found.found == value, "{}", condition.functional);
                    assert_eq!(found.holds(), value == condition.needed, "{}", condition.functional);
                }
            }
        }
    }

    /// `digits = 250` forgotten: exact arithmetic to order 10 would take numbers of 80 000 bits, and a minute.
    #[test]
    fn rounded_weights_taken_as_exact_fail_at_the_first_order() {
        for (name, highest) in [("hairer10-33", 10), ("yoshida8-a", 9)] {
            let maps = crate::shipped_proved(name).unwrap().scheme.maps();
            for kinetic in [Kinetic::Any, Kinetic::Quadratic] {
                let found = evaluated_exactly(&OfFamily(&maps, Family::Kinetic(kinetic)), highest);
                // a palindrome has order 2; order 3 holds to 250 digits, which is not exactly
                assert_eq!(found.iter().map(|c| c.condition.order).max(), Some(3), "{name}");
                let failing = found.iter().find(|c| !c.holds()).expect("a condition fails");
                assert_eq!(failing.condition.order, 3, "{name}");
            }
        }
    }

    #[test]
    fn the_bits_grow_with_the_maps() {
        // 1000 steps of order 1, weights of 30 digits: as many as they have is what the conditions hold to
        let thousandth = || rationals(&[(1, 1000)]).into_iter().cycle().take(1000).collect::<Vec<_>>();
        let maps = merged(&thousandth(), &thousandth());
        let found = evaluated_within(&OfFamily(&maps, Family::Kinetic(Kinetic::Any)), 30, 10);
        assert!(found.iter().all(Evaluated::is_resolved));
    }
}
