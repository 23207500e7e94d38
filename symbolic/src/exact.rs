//! A syntax tree to its value: exact while it is rational, else rounded once and correctly.
//!
//! An irrational root, value of a function or π is enclosed in an interval, and so is all that depends on it. If both ends of
//! the whole formula's interval round to the same decimal, that is the value; if not, the formula
//! is computed again with twice the digits.

mod functions;

use std::collections::BTreeMap;
use std::ops::Range;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::decimal::{round_significant, to_significant};
use crate::elementary::pi;
use crate::fault::{EvaluationError, Fault, HIGHEST_ROOT, NO_NAMES};
use crate::function::{Function, PI, ROOTS, hint_at_functions};
use crate::interval::Interval;
use crate::nearest::hint;
use crate::rounding::{at_places, compare};
use crate::{Expression, Kind, Operation, Rational};

/// More digits would take long and meet the limits on the size of numbers.
const MOST_DIGITS: u32 = 5000;

/// Digits beyond those asked for in the first attempt.
const GUARD_DIGITS: u32 = 20;

/// Each attempt has twice the digits of the one before.
const ATTEMPTS: u32 = 4;

/// The most bits of an exact numerator or denominator.
pub(crate) const MOST_BITS: u64 = 100_000;

/// A number as a rational.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Exact {
    /// The number, or the decimal that stands for it.
    pub value: Rational,
    /// Whether something irrational went into it, a root, a value of a function or π, here or in a name it was computed
    /// from.
    pub rounded: bool,
}

/// Computes an expression.
///
/// Rational arithmetic, roots of perfect powers, and the few rational values of functions, such as
/// `exp(0)` and `acos(1)`, are exact, whatever the names were computed from. With any other root or
/// value of a function, or with `pi` (unless a name hides it), the value of the whole expression is
/// correctly rounded to `digits` significant decimal digits (at least 1, at most 5000), half to even.
///
/// The functions are sqrt, cbrt, exp, log (the natural logarithm), sin, cos, tan, sinh, cosh, tanh,
/// atan, asin and acos. They are enclosed rigorously, in integer arithmetic alone.
///
/// An irrational expression that cannot be told from zero with eight times these digits counts as
/// zero, so that `sin(pi)` is 0; one that cannot be told from the middle between two decimals counts
/// as being there; and the argument of a root or function that cannot be told from the border of
/// the domain counts as the border: `asin(sin(pi/2))` is pi/2, `log(sin(pi))` and `tan(pi/2)` have no value.
///
/// # Errors
/// An [`EvaluationError`] for an unknown name or function, a division by zero, `0^0`, an even root
/// of a negative number, a function outside its domain, an exponent that is not an exact rational,
/// and for numbers that are too large, too small or too near to each other to compute with.
pub fn evaluate(
    expression: &Expression,
    names: &BTreeMap<String, Exact>,
    digits: u32,
) -> Result<Exact, EvaluationError> {
    let digits = digits.clamp(1, MOST_DIGITS);
    for attempt in 0..ATTEMPTS {
        let last = attempt + 1 == ATTEMPTS;
        let evaluator = Evaluator { names, digits: (digits + GUARD_DIGITS) << attempt, last };
        match evaluator.value(expression) {
            Ok(Value::Exact(exact)) => return Ok(exact),
            Ok(Value::Enclosed(interval)) => {
                if let Some(value) = settled(&interval, digits, last) {
                    return Ok(Exact { value, rounded: true });
                }
            }
            Err(Stop::Fault(error)) => return Err(error),
            Err(Stop::Undecided) => {}
        }
    }
    Err(EvaluationError { fault: Fault::Cancellation(digits), range: expression.range.clone() })
}

/// The one decimal that all numbers in the interval round to.
fn settled(interval: &Interval, digits: u32, last: bool) -> Option<Rational> {
    let rounded = |digits| {
        let low = round_significant(&interval.low, digits);
        compare(&low, &round_significant(&interval.high, digits)).is_eq().then_some(low)
    };
    if !last {
        return rounded(digits);
    }
    // A number this close to zero, or to the middle between two decimals, counts as being there.
    let tiny = at_places(BigInt::one(), 4 * i64::from(digits));
    let width = &interval.high - &interval.low;
    if interval.contains_zero() && compare(&width, &tiny).is_lt() {
        return Some(Rational::zero());
    }
    rounded(digits).or_else(|| Some(round_significant(&rounded(4 * digits)?, digits)))
}

/// The value of a part of the expression.
enum Value {
    Exact(Exact),
    /// Some number in the interval.
    Enclosed(Interval),
}

impl Value {
    fn interval(&self) -> Interval {
        match self {
            Value::Exact(exact) => Interval::point(&exact.value),
            Value::Enclosed(interval) => interval.clone(),
        }
    }

    fn negate(self) -> Self {
        match self {
            Value::Exact(exact) => Value::Exact(Exact { value: -exact.value, ..exact }),
            Value::Enclosed(interval) => Value::Enclosed(interval.negate()),
        }
    }

    /// 1/x; the value must not be zero, nor an interval around it.
    fn reciprocal(self) -> Self {
        match self {
            Value::Exact(exact) => Value::Exact(Exact { value: exact.value.recip(), ..exact }),
            Value::Enclosed(interval) => Value::Enclosed(interval.reciprocal()),
        }
    }
}

/// Why an attempt gave no value.
enum Stop {
    Fault(EvaluationError),
    /// Whether a number is zero or negative shows only with more digits.
    Undecided,
}

fn fault(fault: Fault, range: &Range<usize>) -> Stop {
    Stop::Fault(EvaluationError { fault, range: range.clone() })
}

/// One attempt to compute an expression.
struct Evaluator<'a> {
    names: &'a BTreeMap<String, Exact>,
    /// The significant digits of the ends of intervals.
    digits: u32,
    /// Whether no attempt with more digits follows.
    last: bool,
}

impl Evaluator<'_> {
    fn value(&self, expression: &Expression) -> Result<Value, Stop> {
        let range = &expression.range;
        match &expression.kind {
            Kind::Number(value) => Ok(Value::Exact(Exact { value: value.clone(), rounded: false })),
            Kind::Name(name) => self.named(name).map_err(|unknown| fault(unknown, range)),
            Kind::Negate(inner) => Ok(self.value(inner)?.negate()),
            Kind::Binary(operation, left, right) => self.binary(*operation, left, right, range),
            Kind::Call { function, arguments } => self.call(function, arguments, range),
        }
    }

    fn named(&self, name: &str) -> Result<Value, Fault> {
        if let Some(exact) = self.names.get(name) {
            return Ok(Value::Exact(exact.clone()));
        }
        if name == PI {
            return Ok(Value::Enclosed(pi(self.digits)));
        }
        let known: Vec<&str> = self.names.keys().map(String::as_str).collect();
        let hint = hint(name, &known, &[PI], "known names", NO_NAMES);
        Err(Fault::UnknownName { name: name.to_string(), hint })
    }

    fn call(&self, name: &str, arguments: &[Expression], range: &Range<usize>) -> Result<Value, Stop> {
        let root = ROOTS.into_iter().find(|(root, _)| *root == name);
        let function = Function::named(name);
        if root.is_none() && function.is_none() {
            let unknown = Fault::UnknownFunction { name: name.to_string(), hint: hint_at_functions(name) };
            return Err(fault(unknown, range));
        }
        let [argument] = arguments else {
            let function = name.to_string();
            return Err(fault(Fault::ArgumentCount { function, found: arguments.len() }, range));
        };
        if let Some((_, order)) = root {
            return self.power(argument, &Rational::new(1.into(), order.into()), range);
        }
        let function = function.expect("every name that is not a root's is a function's, as seen above");
        self.function(function, argument, range)
    }

    fn binary(
        &self,
        operation: Operation,
        left: &Expression,
        right: &Expression,
        range: &Range<usize>,
    ) -> Result<Value, Stop> {
        let value = |part| self.value(part);
        match operation {
            Operation::Add => self.sum(&value(left)?, &value(right)?, range),
            Operation::Subtract => self.sum(&value(left)?, &value(right)?.negate(), range),
            Operation::Multiply => self.product(&value(left)?, &value(right)?, range),
            Operation::Divide => {
                let (dividend, divisor) = (value(left)?, value(right)?);
                self.not_zero(&divisor, Fault::DivisionByZero, &right.range)?;
                self.product(&dividend, &divisor.reciprocal(), range)
            }
            Operation::Power => match value(right)? {
                Value::Exact(Exact { value: exponent, rounded: false }) => self.power(left, &exponent, range),
                _ => Err(fault(Fault::InexactExponent, &right.range)),
            },
        }
    }

    fn sum(&self, a: &Value, b: &Value, range: &Range<usize>) -> Result<Value, Stop> {
        match (a, b) {
            (Value::Exact(a), Value::Exact(b)) => sized(&a.value + &b.value, a.rounded || b.rounded, range),
            _ => self.enclosed(a.interval().add(&b.interval()).outward(self.digits), range),
        }
    }

    fn product(&self, a: &Value, b: &Value, range: &Range<usize>) -> Result<Value, Stop> {
        match (a, b) {
            (Value::Exact(a), Value::Exact(b)) => sized(&a.value * &b.value, a.rounded || b.rounded, range),
            _ => self.enclosed(a.interval().multiply(&b.interval()).outward(self.digits), range),
        }
    }

    /// The base to a rational power p/q: its q-th root, or one over it, to the power |p|.
    fn power(&self, base: &Expression, exponent: &Rational, range: &Range<usize>) -> Result<Value, Stop> {
        let value = self.value(base)?;
        if exponent.is_zero() {
            self.not_zero(&value, Fault::ZeroToTheZero, range)?;
        }
        let order = exponent.denom().to_u32().filter(|order| *order <= HIGHEST_ROOT);
        let order = order.ok_or_else(|| fault(Fault::HighRoot(exponent.denom().clone()), range))?;
        let mut root = self.root(value, order, &base.range)?;
        if exponent.is_negative() {
            self.not_zero(&root, Fault::DivisionByZero, &base.range)?;
            root = root.reciprocal();
        }
        let count = exponent.numer().magnitude().to_u32();
        let count = count.ok_or_else(|| fault(Fault::AbsurdSize, range))?;
        match root {
            Value::Exact(Exact { value, rounded }) => {
                let power = rational_power(&value, count).ok_or_else(|| fault(Fault::AbsurdSize, range))?;
                sized(power, rounded, range)
            }
            Value::Enclosed(root) => self.enclosed(root.power(count, self.digits), range),
        }
    }

    /// The real root of a base, which stands at `range`.
    fn root(&self, base: Value, order: u32, range: &Range<usize>) -> Result<Value, Stop> {
        if order == 1 {
            return Ok(base);
        }
        let mut interval = base.interval();
        if order.is_even() {
            interval = self.not_negative(interval, range)?;
        }
        if let Value::Exact(Exact { value, rounded }) = base
            && let Some(value) = perfect_root(&value, order)
        {
            return Ok(Value::Exact(Exact { value, rounded }));
        }
        Ok(Value::Enclosed(interval.root(order, self.digits)))
    }

    /// Refuses a negative number; at the last attempt, what cannot be told from zero begins there.
    fn not_negative(&self, interval: Interval, range: &Range<usize>) -> Result<Interval, Stop> {
        if interval.high.is_negative() {
            return Err(fault(Fault::EvenRoot(to_significant(&interval.high, 12)), range));
        }
        match interval.low.is_negative() {
            false => Ok(interval),
            true if self.last => Ok(Interval { low: Rational::zero(), ..interval }),
            true => Err(Stop::Undecided),
        }
    }

    /// Refuses zero, and at the last attempt what cannot be told from zero.
    fn not_zero(&self, value: &Value, refusal: Fault, range: &Range<usize>) -> Result<(), Stop> {
        match value {
            Value::Exact(exact) if exact.value.is_zero() => Err(fault(refusal, range)),
            Value::Exact(_) => Ok(()),
            Value::Enclosed(interval) => self.without_zero(interval, refusal, range),
        }
    }

    /// As `not_zero`, of the number in the interval.
    fn without_zero(&self, interval: &Interval, refusal: Fault, range: &Range<usize>) -> Result<(), Stop> {
        match interval.contains_zero() {
            true if self.last => Err(fault(refusal, range)),
            true => Err(Stop::Undecided),
            false => Ok(()),
        }
    }

    fn enclosed(&self, interval: Option<Interval>, range: &Range<usize>) -> Result<Value, Stop> {
        interval.map(Value::Enclosed).ok_or_else(|| fault(Fault::AbsurdSize, range))
    }
}

/// An exact value, unless it is absurdly long.
fn sized(value: Rational, rounded: bool, range: &Range<usize>) -> Result<Value, Stop> {
    match value.numer().bits().max(value.denom().bits()) <= MOST_BITS {
        true => Ok(Value::Exact(Exact { value, rounded })),
        false => Err(fault(Fault::AbsurdSize, range)),
    }
}

/// The integer power; `None` if it would be absurdly long.
pub(crate) fn rational_power(value: &Rational, exponent: u32) -> Option<Rational> {
    let bits = value.numer().bits().max(value.denom().bits());
    let least = (bits - 1).checked_mul(exponent.into())?;
    // A ratio in lowest terms stays so.
    let power = || Rational::new_raw(value.numer().pow(exponent), value.denom().pow(exponent));
    (least <= MOST_BITS).then(power)
}

/// The rational number whose power of this order is the value, if there is one.
pub(crate) fn perfect_root(value: &Rational, order: u32) -> Option<Rational> {
    if value.is_negative() && order.is_even() {
        return None;
    }
    let root = |whole: &BigInt| Some(whole.nth_root(order)).filter(|root| root.pow(order) == *whole);
    Some(Rational::new_raw(root(value.numer())?, root(value.denom())?))
}
