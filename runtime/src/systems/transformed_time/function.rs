//! The functions f of transformed times, and their derivatives.

use num_traits::{One, Signed, ToPrimitive, Zero};
use shadowstep_schemes::symbolic::decimal::to_text;
use thiserror::Error;

use crate::Rational;
use crate::number::Number;

/// The largest numerator and denominator of an exponent, and of the exponent less 1.
const LARGEST: u32 = 32;

/// How the fictitious time s runs: dt/ds = f′(−U).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimeTransformation {
    /// f(x) = ln x, thus dt/ds = 1/(−U).
    Logarithmic,
    /// f(x) = x^γ/γ, thus dt/ds = (−U)^(γ−1): Sundman's transformations whose parts stay explicit.
    Power(Exponent),
}

/// γ = numerator/denominator, not 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Exponent {
    numerator: i32,
    denominator: u32,
}

impl Exponent {
    /// γ
    pub fn value(self) -> Rational {
        Rational::new(self.numerator.into(), self.denominator.into())
    }
}

/// An exponent that is refused.
#[derive(Clone, PartialEq, Eq, Error)]
pub enum ExponentError {
    /// γ = 0.
    #[error("the exponent 0 makes f constant; its limit is the logarithmic time")]
    Zero,
    /// γ is not a fraction of small whole numbers.
    #[error("the exponent {0} must be a fraction with a numerator and denominator of at most {LARGEST}")]
    NotSmall(String),
}

shadowstep_schemes::debug_as_text!(ExponentError);

impl TimeTransformation {
    /// f(x) = x^γ/γ
    ///
    /// # Errors
    /// γ = 0, and one whose numerator or denominator is above 32.
    pub fn power(exponent: &Rational) -> Result<Self, ExponentError> {
        if exponent.is_zero() {
            return Err(ExponentError::Zero);
        }
        let small = |exponent: &Rational| {
            let numerator = exponent.numer().to_i32().filter(|n| n.unsigned_abs() <= LARGEST)?;
            Some((numerator, exponent.denom().to_u32().filter(|d| *d <= LARGEST)?))
        };
        let less = small(&(exponent - Rational::one()));
        let (numerator, denominator) =
            small(exponent).filter(|_| less.is_some()).ok_or_else(|| ExponentError::NotSmall(to_text(exponent)))?;
        debug_assert_eq!(exponent.is_negative(), numerator < 0);
        Ok(TimeTransformation::Power(Exponent { numerator, denominator }))
    }

    /// f′ ← f′(x)
    pub(super) fn derivative<N: Number>(self, Place { x, derivative, one, spare, .. }: &mut Place<'_, N>) {
        let TimeTransformation::Power(Exponent { numerator, denominator }) = self else {
            return derivative.assign_quotient(one, x);
        };
        // x^(a/b)
        let (a, b) = (numerator - denominator.cast_signed(), denominator);
        match b {
            1 => spare.assign(x),
            2 => spare.assign_sqrt(x),
            _ => spare.assign_root(x, b),
        }
        derivative.assign(one);
        for _ in 0..a.unsigned_abs() {
            derivative.multiply(spare);
        }
        if a < 0 {
            spare.assign_quotient(one, derivative);
            derivative.assign(spare);
        }
    }

    /// value ← f(x), after [`derivative`](TimeTransformation::derivative)
    pub(super) fn value<N: Number>(self, x: &N, derivative: &N, value: &mut N) {
        match self {
            TimeTransformation::Logarithmic => value.assign_log(x),
            TimeTransformation::Power(Exponent { numerator, denominator }) => {
                value.assign_product(x, derivative);
                value.multiply_integer(denominator.cast_signed());
                value.divide_integer(numerator);
            }
        }
    }
}

impl std::fmt::Display for TimeTransformation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            TimeTransformation::Logarithmic => f.write_str("logarithmic"),
            TimeTransformation::Power(Exponent { numerator, denominator: 1 }) => write!(f, "power {numerator}"),
            TimeTransformation::Power(Exponent { numerator, denominator }) => {
                write!(f, "power {numerator}/{denominator}")
            }
        }
    }
}

/// Scratch numbers of a part: x with f′(x).
pub(super) struct Place<'a, N> {
    pub(super) x: &'a mut N,
    pub(super) derivative: &'a mut N,
    pub(super) value: &'a mut N,
    pub(super) spare: &'a mut N,
    one: &'a N,
}

impl<'a, N: Number> Place<'a, N> {
    /// How many there are.
    pub(super) const SCRATCH: usize = 5;

    /// Prepares them, and returns the others.
    pub(super) fn prepare<'s>(scratch: &'s mut [N], context: &N::Context) -> &'s mut [N] {
        let (own, others) = scratch.split_at_mut(Self::SCRATCH);
        own[Self::SCRATCH - 1] = N::from_rational(&Rational::one(), context);
        others
    }

    /// Them, and the others.
    pub(super) fn of(scratch: &'a mut [N]) -> (Self, &'a mut [N]) {
        let (own, others) = scratch.split_at_mut(Self::SCRATCH);
        let [x, derivative, value, spare, one] = own else { unreachable!("there are {} numbers", Self::SCRATCH) };
        (Place { x, derivative, value, spare, one }, others)
    }

    /// x ← NaN where x < 0, where f is not defined: 1/x has a value there, with which time would run backwards.
    pub(super) fn refuse_negative(&mut self) {
        self.spare.assign_sqrt(self.x);
        self.spare.multiply_integer(0);
        self.x.add(self.spare);
    }
}
