//! One computation of an expression with a given number of digits.

use std::collections::BTreeMap;
use std::ops::Range;

use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::symbolic::evaluation::budget::Budget;
use crate::symbolic::evaluation::domain::Attempt;
use crate::symbolic::evaluation::value::{AttemptError, Exact, Value, fault};
use crate::symbolic::number::elementary::{image, pi, sin_and_cos_of_pi};
use crate::symbolic::number::function::{Function, exact_value};
use crate::symbolic::number::interval::Interval;
use crate::symbolic::number::power::{MOST_BITS, perfect_root, rational_power};
use crate::symbolic::number::rational::Rational;
use crate::symbolic::text::decimal::to_significant;
use crate::symbolic::text::error::{HIGHEST_ROOT, SemanticFault};
use crate::symbolic::text::names::{Callee, PI, callee, unknown_name};
use crate::symbolic::text::syntax::{Expression, ExpressionKind, Operation};

/// One attempt to compute an expression.
pub(super) struct Evaluator<'a> {
    pub(super) names: &'a BTreeMap<String, Exact>,
    pub(super) attempt: Attempt,
    pub(super) budget: &'a Budget,
}

/// What a root, a function and π cost, in operations.
const ROOT: u64 = 20;
const FUNCTION: u64 = 100;

/// The most bits of a multiple of π that is known as such: it is far from the limits of enclosed numbers.
const LONGEST_MULTIPLE: u64 = 30_000;

impl Evaluator<'_> {
    pub(super) fn value(&self, expression: &Expression) -> Result<Value, AttemptError> {
        let range = &expression.range;
        match &expression.kind {
            ExpressionKind::Number(value) => Ok(Value::Exact(Exact { value: value.clone(), rounded: false })),
            ExpressionKind::Name(name) => self.named(name).map_err(|unknown| fault(unknown, range)),
            ExpressionKind::Negate(inner) => Ok(self.value(inner)?.negate()),
            ExpressionKind::Binary(operation, left, right) => self.binary(*operation, left, right, range),
            ExpressionKind::Call { function, arguments } => self.call(function, arguments, range),
        }
    }

    fn named(&self, name: &str) -> Result<Value, SemanticFault> {
        if let Some(exact) = self.names.get(name) {
            return Ok(Value::Exact(exact.clone()));
        }
        if name == PI {
            // computed once for these digits
            if !self.budget.take(1, self.enclosed_bits()) {
                return Err(SemanticFault::TooMuchWork);
            }
            return Ok(Value::OfPi(Rational::one()));
        }
        let known: Vec<&str> = self.names.keys().map(String::as_str).collect();
        Err(unknown_name(name, &known))
    }

    fn call(&self, name: &str, arguments: &[Expression], range: &Range<usize>) -> Result<Value, AttemptError> {
        match callee(name, arguments).map_err(|invalid| fault(invalid, range))? {
            (Callee::Root(order), argument) => self.power(argument, &Rational::new(1.into(), order.into()), range),
            (Callee::Function(function), argument) => self.function(function, argument, range),
        }
    }

    fn function(&self, function: Function, argument: &Expression, range: &Range<usize>) -> Result<Value, AttemptError> {
        let value = self.value(argument)?;
        if let Value::Exact(Exact { value, rounded }) = &value
            && let Some(value) = exact_value(function, value)
        {
            return Ok(Value::Exact(Exact { value, rounded: *rounded }));
        }
        self.charge(FUNCTION, &[&value], range)?;
        let digits = self.attempt.digits;
        if let (Value::OfPi(multiple), Function::Sin | Function::Cos | Function::Tan) = (&value, function) {
            return self.of_multiple(function, multiple, argument, range);
        }
        let interval = self.attempt.in_domain(function, value.interval(self.attempt.digits), &argument.range)?;
        self.enclosed(image(function, &interval, digits).and_then(|image| image.outward(digits)), range)
    }

    /// sin, cos or tan of a rational multiple of π.
    fn of_multiple(
        &self,
        function: Function,
        multiple: &Rational,
        argument: &Expression,
        range: &Range<usize>,
    ) -> Result<Value, AttemptError> {
        let digits = self.attempt.digits;
        let (sin, cos) = sin_and_cos_of_pi(multiple, digits);
        let image = match function {
            Function::Sin => sin,
            Function::Cos => cos,
            _ if cos.contains_zero() => {
                let number = to_significant(&pi(digits).times(multiple).low, 12);
                return Err(fault(SemanticFault::OutsideDomain { function, argument: number }, &argument.range));
            }
            _ => sin.multiply(&cos.reciprocal()),
        };
        self.enclosed(image.outward(digits), range)
    }

    fn binary(
        &self,
        operation: Operation,
        left: &Expression,
        right: &Expression,
        range: &Range<usize>,
    ) -> Result<Value, AttemptError> {
        let value = |part| self.value(part);
        match operation {
            Operation::Add => self.sum(&value(left)?, &value(right)?, range),
            Operation::Subtract => self.sum(&value(left)?, &value(right)?.negate(), range),
            Operation::Multiply => self.product(&value(left)?, &value(right)?, range),
            Operation::Divide => {
                let (dividend, divisor) = (value(left)?, value(right)?);
                self.not_zero(&divisor, SemanticFault::DivisionByZero, &right.range)?;
                self.product(&dividend, &divisor.reciprocal(self.attempt.digits), range)
            }
            Operation::Power => match value(right)? {
                Value::Exact(Exact { value: exponent, rounded: false }) => self.power(left, &exponent, range),
                _ => Err(fault(SemanticFault::InexactExponent, &right.range)),
            },
        }
    }

    /// Takes the cost of some operations on numbers as long as these from the budget.
    fn charge(&self, operations: u64, values: &[&Value], range: &Range<usize>) -> Result<(), AttemptError> {
        let enclosed = self.enclosed_bits();
        let bits = |value: &&Value| match value {
            Value::Exact(exact) => exact.value.numer().bits().max(exact.value.denom().bits()),
            Value::OfPi(_) | Value::Enclosed(_) => enclosed,
        };
        let bits = values.iter().map(bits).sum::<u64>() + if operations > 1 { enclosed } else { 0 };
        if self.budget.take(operations, bits) { Ok(()) } else { Err(fault(SemanticFault::TooMuchWork, range)) }
    }

    fn sum(&self, a: &Value, b: &Value, range: &Range<usize>) -> Result<Value, AttemptError> {
        self.charge(1, &[a, b], range)?;
        match (a, b) {
            (Value::Exact(a), Value::Exact(b)) => exact(&a.value + &b.value, a.rounded || b.rounded, range),
            (Value::OfPi(a), Value::OfPi(b)) => Ok(self.of_pi(a + b)),
            _ => self.enclosed(
                a.interval(self.attempt.digits).add(&b.interval(self.attempt.digits)).outward(self.attempt.digits),
                range,
            ),
        }
    }

    fn product(&self, a: &Value, b: &Value, range: &Range<usize>) -> Result<Value, AttemptError> {
        self.charge(1, &[a, b], range)?;
        match (a, b) {
            (Value::Exact(a), Value::Exact(b)) => exact(&a.value * &b.value, a.rounded || b.rounded, range),
            (Value::OfPi(multiple), Value::Exact(factor)) | (Value::Exact(factor), Value::OfPi(multiple)) => {
                Ok(self.of_pi(multiple * &factor.value))
            }
            _ => self.enclosed(
                a.interval(self.attempt.digits).multiply(&b.interval(self.attempt.digits)).outward(self.attempt.digits),
                range,
            ),
        }
    }

    /// The base to a rational power p/q: its q-th root, or one over it, to the power |p|.
    fn power(&self, base: &Expression, exponent: &Rational, range: &Range<usize>) -> Result<Value, AttemptError> {
        let value = self.value(base)?;
        if exponent.is_zero() {
            self.not_zero(&value, SemanticFault::ZeroToTheZero, range)?;
        }
        let order = exponent.denom().to_u32().filter(|order| *order <= HIGHEST_ROOT);
        let order = order.ok_or_else(|| fault(SemanticFault::HighRoot(exponent.denom().clone()), range))?;
        let mut root = self.root(value, order, &base.range)?;
        if exponent.is_negative() {
            self.not_zero(&root, SemanticFault::DivisionByZero, &base.range)?;
            root = root.reciprocal(self.attempt.digits);
        }
        let count = exponent.numer().magnitude().to_u32();
        let count = count.ok_or_else(|| fault(SemanticFault::TooLong, range))?;
        match root {
            Value::Exact(Exact { value, rounded }) => {
                let power = rational_power(&value, count).ok_or_else(|| fault(SemanticFault::TooLong, range))?;
                exact(power, rounded, range)
            }
            other => self.enclosed(other.interval(self.attempt.digits).power(count, self.attempt.digits), range),
        }
    }

    /// The real root of a base at `range`.
    fn root(&self, base: Value, order: u32, range: &Range<usize>) -> Result<Value, AttemptError> {
        if order == 1 {
            return Ok(base);
        }
        self.charge(ROOT, &[&base], range)?;
        let mut interval = base.interval(self.attempt.digits);
        if order.is_even() {
            interval = self.attempt.not_negative(interval, range)?;
        }
        if let Value::Exact(Exact { value, rounded }) = base
            && let Some(value) = perfect_root(&value, order)
        {
            return Ok(Value::Exact(Exact { value, rounded }));
        }
        Ok(Value::Enclosed(interval.root(order, self.attempt.digits)))
    }

    /// Rejects zero, and at the last attempt what cannot be distinguished from zero.
    fn not_zero(&self, value: &Value, otherwise: SemanticFault, range: &Range<usize>) -> Result<(), AttemptError> {
        match value {
            Value::Exact(exact) if exact.value.is_zero() => Err(fault(otherwise, range)),
            Value::Exact(_) => Ok(()),
            other => self.attempt.without_zero(&other.interval(self.attempt.digits), otherwise, range),
        }
    }

    fn enclosed(&self, interval: Option<Interval>, range: &Range<usize>) -> Result<Value, AttemptError> {
        let interval = interval.ok_or_else(|| fault(SemanticFault::TooLong, range))?;
        // a single number needs no more digits to be distinguished from zero
        Ok(match interval.is_point() {
            true => Value::Exact(Exact { value: interval.low, rounded: true }),
            false => Value::Enclosed(interval),
        })
    }

    /// A multiple of π, as such unless it is longer than the numbers of this attempt.
    fn of_pi(&self, multiple: Rational) -> Value {
        let bits = multiple.numer().bits().max(multiple.denom().bits());
        match bits <= self.enclosed_bits().min(LONGEST_MULTIPLE) {
            true if multiple.is_zero() => Value::Exact(Exact { value: multiple, rounded: true }),
            true => Value::OfPi(multiple),
            false => Value::Enclosed(pi(self.attempt.digits).times(&multiple)),
        }
    }

    /// The bits of the ends of intervals, about.
    fn enclosed_bits(&self) -> u64 {
        u64::from(self.attempt.digits) * 10 / 3
    }
}

/// An exact value, unless it is too long.
fn exact(value: Rational, rounded: bool, range: &Range<usize>) -> Result<Value, AttemptError> {
    match value.numer().bits().max(value.denom().bits()) <= MOST_BITS {
        true => Ok(Value::Exact(Exact { value, rounded })),
        false => Err(fault(SemanticFault::TooLong, range)),
    }
}
