//! Numbers with operators, for formulas that are not in a loop of steps: each result is a new number.

use std::ops::{Add, AddAssign, Deref, Div, Mul, Neg, Sub, SubAssign};

use super::Number;
use crate::Rational;

/// A number whose operations give new numbers, each rounded once.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
pub(crate) struct Value<N>(pub(crate) N);

impl<N> Deref for Value<N> {
    type Target = N;

    fn deref(&self) -> &N {
        &self.0
    }
}

impl<N: Number> Value<N> {
    pub(crate) fn zero(context: &N::Context) -> Self {
        Value(N::zero(context))
    }

    pub(crate) fn is_zero(&self) -> bool
    where
        N: PartialEq,
    {
        self.0 == N::zero(&self.0.context())
    }

    /// An integer with the precision of this number.
    pub(crate) fn integer(&self, n: i64) -> Self {
        Value(N::from_rational(&Rational::from_integer(n.into()), &self.0.context()))
    }

    pub(crate) fn square(self) -> Self {
        self.with(N::assign_square)
    }

    pub(crate) fn sqrt(self) -> Self {
        self.with(N::assign_sqrt)
    }

    pub(crate) fn recip(self) -> Self {
        1 / self
    }

    pub(crate) fn atan(self) -> Self {
        self.with(N::assign_atan)
    }

    pub(crate) fn cos(self) -> Self {
        self.with(N::assign_cos)
    }

    /// Sine and cosine.
    pub(crate) fn sin_cos(&self) -> (Self, Self) {
        let (mut sin, mut cos) = (self.0.clone(), self.0.clone());
        N::assign_sin_cos(&mut sin, &mut cos, &self.0);
        (Value(sin), Value(cos))
    }

    fn with(self, assign: fn(&mut N, &N)) -> Self {
        let mut result = self.0.clone();
        assign(&mut result, &self.0);
        Value(result)
    }
}

/// Operators from operations in place: with a number or a reference on the right, and with integers.
macro_rules! operators {
    ($($Operator:ident, $operator:ident, $operation:ident;)+) => {$(
        impl<N: Number> $Operator<&Value<N>> for Value<N> {
            type Output = Self;

            fn $operator(mut self, other: &Value<N>) -> Self {
                self.0.$operation(&other.0);
                self
            }
        }

        impl<N: Number> $Operator for Value<N> {
            type Output = Self;

            fn $operator(self, other: Value<N>) -> Self {
                self.$operator(&other)
            }
        }

        impl<N: Number> $Operator<Value<N>> for i32 {
            type Output = Value<N>;

            fn $operator(self, other: Value<N>) -> Value<N> {
                other.integer(self.into()).$operator(other)
            }
        }
    )+};
}

operators! {
    Add, add, add;
    Sub, sub, subtract;
    Mul, mul, multiply;
    Div, div, divide;
}

/// Integers on the right.
macro_rules! integers {
    ($($Operator:ident, $operator:ident, |$x:ident, $n:ident| $operation:expr;)+) => {$(
        impl<N: Number> $Operator<i32> for Value<N> {
            type Output = Self;

            fn $operator(mut self, $n: i32) -> Self {
                let $x = &mut self;
                $operation;
                self
            }
        }
    )+};
}

integers! {
    Add, add, |x, n| { let n = x.integer(n.into()); x.0.add(&n.0) };
    Sub, sub, |x, n| { let n = x.integer(n.into()); x.0.subtract(&n.0) };
    Mul, mul, |x, n| x.0.multiply_integer(n);
    Div, div, |x, n| x.0.divide_integer(n);
}

impl<N: Number> Neg for Value<N> {
    type Output = Self;

    fn neg(mut self) -> Self {
        self.0.negate();
        self
    }
}

impl<N: Number> AddAssign<&Value<N>> for Value<N> {
    fn add_assign(&mut self, other: &Value<N>) {
        self.0.add(&other.0);
    }
}

impl<N: Number> SubAssign for Value<N> {
    fn sub_assign(&mut self, other: Value<N>) {
        self.0.subtract(&other.0);
    }
}
