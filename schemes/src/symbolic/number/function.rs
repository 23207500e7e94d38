//! The elementary functions of a formula.

use std::fmt;

use num_traits::{One, Zero};

use crate::symbolic::number::rational::Rational;

/// An elementary function of one real argument. Square and cube roots are powers, not functions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    /// e^x
    Exp,
    /// the natural logarithm
    Log,
    /// sin x
    Sin,
    /// cos x
    Cos,
    /// tan x
    Tan,
    /// sinh x
    Sinh,
    /// cosh x
    Cosh,
    /// tanh x
    Tanh,
    /// arctan x
    Atan,
    /// arcsin x
    Asin,
    /// arccos x
    Acos,
}

/// What f(−x) is.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Parity {
    /// f(x)
    Even,
    /// −f(x)
    Odd,
    Neither,
}

impl Function {
    /// Every function.
    pub const ALL: [Function; 11] = [
        Function::Exp,
        Function::Log,
        Function::Sin,
        Function::Cos,
        Function::Tan,
        Function::Sinh,
        Function::Cosh,
        Function::Tanh,
        Function::Atan,
        Function::Asin,
        Function::Acos,
    ];

    /// The name in formulas.
    pub fn name(self) -> &'static str {
        match self {
            Function::Exp => "exp",
            Function::Log => "log",
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Tan => "tan",
            Function::Sinh => "sinh",
            Function::Cosh => "cosh",
            Function::Tanh => "tanh",
            Function::Atan => "atan",
            Function::Asin => "asin",
            Function::Acos => "acos",
        }
    }

    /// The function of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|function| function.name() == name)
    }

    pub(crate) fn parity(self) -> Parity {
        match self {
            Function::Cos | Function::Cosh => Parity::Even,
            Function::Sin | Function::Tan | Function::Sinh | Function::Tanh | Function::Atan | Function::Asin => {
                Parity::Odd
            }
            Function::Exp | Function::Log | Function::Acos => Parity::Neither,
        }
    }
}

/// The functions' rational values at rational numbers.
pub(crate) fn exact_value(function: Function, argument: &Rational) -> Option<Rational> {
    let zero = argument.is_zero();
    match function {
        Function::Exp | Function::Cos | Function::Cosh if zero => Some(Rational::one()),
        Function::Log | Function::Acos if argument.is_one() => Some(Rational::zero()),
        _ if zero && function.parity() == Parity::Odd => Some(Rational::zero()),
        _ => None,
    }
}

impl fmt::Display for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
