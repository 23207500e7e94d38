//! The order conditions of one kind, each with its value for a scheme and how exactly the value must be met.

use num_bigint::BigInt;
use num_traits::{FromPrimitive, Signed, Zero};
use shadowstep_symbolic::{Fraction, Ratio, Rational};

use crate::arithmetic::{Arithmetic, ExactArithmetic, FixedPoint, Sensitivity};
use crate::claims::Kinetic;
use crate::map::Map;
use crate::near_integrable::{self, Power};
use crate::order::Condition;
use crate::scheme::Held;
use crate::{nystrom, order};

/// Conditions that a claim needs.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Family {
    /// Those of a class of kinetic energies.
    Kinetic(Kinetic),
    /// Those of a power of ε.
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

    /// Whether the weights have enough digits to distinguish a condition that is met from one that is not.
    fn is_decided(&self) -> bool {
        let thousandfold = Fraction::new(self.tolerance.numer() * 1000, self.tolerance.denom().clone());
        thousandfold <= self.condition.needed
    }
}

/// The conditions of a family up to an order, low orders first, with their values for weights held to some digits.
pub(crate) fn evaluated(maps: &[Map], held: Held, family: Family, highest: u32) -> Vec<Evaluated> {
    match held {
        Held::Exactly => evaluated_exactly(maps, family, highest),
        Held::Digits(digits) => evaluated_within(maps, digits, family, highest),
    }
}

fn evaluated_exactly(maps: &[Map], family: Family, highest: u32) -> Vec<Evaluated> {
    let zero = || Fraction::from(Rational::zero());
    values(maps, family, worth_exactness(maps, family, highest), &ExactArithmetic)
        .into_iter()
        .map(|(condition, found)| Evaluated { condition, found: found.into(), error: zero(), tolerance: zero() })
        .collect()
}

fn evaluated_within(maps: &[Map], digits: u32, family: Family, highest: u32) -> Vec<Evaluated> {
    let arithmetic = FixedPoint::new(digits);
    let unit = BigInt::from(10).pow(digits - 1);
    let slopes = values(maps, family, highest, &Sensitivity);
    values(maps, family, highest, &arithmetic)
        .into_iter()
        .zip(slopes)
        .map(|((condition, value), (_, sensitive))| {
            let (found, error) = arithmetic.read(&value);
            let slope = Rational::from_f64(sensitive.slope).unwrap_or_else(Rational::zero);
            let tolerance = Fraction::new(slope.numer().clone(), slope.denom() * &unit);
            Evaluated { condition, found, error, tolerance }
        })
        .collect()
}

/// The first order that certainly fails, or the highest: exact arithmetic beyond it would be slow and decide nothing.
fn worth_exactness(maps: &[Map], family: Family, highest: u32) -> u32 {
    let arithmetic = FixedPoint::new(60);
    let fails = |(condition, value): &(Condition, _)| {
        let (found, error) = arithmetic.read(value);
        let evaluated =
            Evaluated { condition: condition.clone(), found, error: Rational::zero().into(), tolerance: error };
        !evaluated.is_met()
    };
    values(maps, family, highest, &arithmetic).iter().find(|c| fails(c)).map_or(highest, |(c, _)| c.order)
}

fn values<A: Arithmetic>(maps: &[Map], family: Family, highest: u32, arithmetic: &A) -> Vec<(Condition, A::Value)> {
    match family {
        Family::Kinetic(Kinetic::Any) => order::conditions(maps, highest, arithmetic),
        Family::Kinetic(Kinetic::Quadratic) => nystrom::conditions(maps, highest, arithmetic),
        Family::Power(power) => near_integrable::conditions(maps, power, highest, arithmetic),
    }
}
