//! Exact formulas: text, to a syntax tree with byte ranges, to an exact rational number, or to derivatives and programs.
//!
//! * [`parse`] reads a formula such as `1/(2 - 2^(1/3))` into an [`Expression`].
//! * [`evaluate`] computes it. Rational arithmetic stays exact; a formula with an irrational root, a
//!   function such as exp or sin, or `pi` is rounded once, correctly, to the digits that were asked for.
//! * [`Graph::build`] simplifies it into a graph without repetitions, where [`Graph::derivative`] and [`Graph::rate`]
//!   (qᵀU_q − 2U) find formulas, and [`Graph::program`] computes them with few operations in place.
//! * [`decimal`] writes rationals as text and reads them back.
//! * [`nearest`](nearest()) finds the word that was probably meant by a misspelt one.
//!
//! ```
//! use shadowstep_symbolic::{Exact, Rational, decimal, evaluate, exact, parse};
//! use std::collections::BTreeMap;
//!
//! assert_eq!(exact("1/6 + .5")?, Rational::new(2.into(), 3.into()));
//!
//! let formula = parse("1/(2 - cbrt(2))")?;
//! let g1 = evaluate(&formula, &BTreeMap::new(), 50)?;
//! assert!(g1.rounded);
//! assert_eq!(decimal::to_significant(&g1.value, 12), "1.35120719196");
//!
//! // A name stands for a number; from there on the arithmetic is exact again.
//! let names = BTreeMap::from([("g1".to_string(), g1.clone())]);
//! let g0 = evaluate(&parse("1 - 2*g1")?, &names, 50)?;
//! let two = Rational::from_integer(2.into());
//! assert_eq!(g0.value + two * g1.value, Rational::from_integer(1.into()));
//!
//! // Errors know the place they are about.
//! let error = exact("2 * (1 - 1/1)^-1").unwrap_err();
//! assert_eq!(error.to_string(), "division by zero");
//! assert_eq!(error.range(), 4..13);
//! # Ok::<(), shadowstep_symbolic::Error>(())
//! ```

mod ball;
mod build;
mod cost;
pub mod decimal;
mod derivative;
mod elementary;
mod exact;
mod factor;
mod fault;
mod function;
mod graph;
mod interval;
mod literal;
mod lower;
mod nearest;
mod potential;
mod program;
mod quadratic;
mod rate;
mod rounding;
mod series;
mod simplify;
mod syntax;
mod token;

use std::collections::BTreeMap;
use std::ops::Range;

pub use build::{GraphError, GraphFault, is_symmetric};
pub use cost::Cost;
pub use exact::{Exact, evaluate};
pub use fault::{EvaluationError, Fault};
pub use function::Function;
pub use graph::{Form, Graph, Node};
pub use nearest::{meant, nearest, nearest_few};
pub use num_rational::BigRational as Rational;
pub use potential::{PotentialPrograms, Separation};
pub use program::{Instruction, Place, Program};
pub use rounding::compare;
pub use syntax::{Expression, Kind, Operation, SyntaxError, parse};

/// What keeps a text from having a value.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// The text is not a formula.
    #[error(transparent)]
    Syntax(#[from] SyntaxError),
    /// The formula has no value.
    #[error(transparent)]
    Evaluation(#[from] EvaluationError),
}

impl Error {
    /// The bytes of the text that the error is about.
    pub fn range(&self) -> Range<usize> {
        match self {
            Error::Syntax(error) => error.range.clone(),
            Error::Evaluation(error) => error.range.clone(),
        }
    }
}

/// Computes a formula without names; an irrational value is rounded to 300 significant digits.
///
/// # Errors
/// As [`parse`] and [`evaluate`].
pub fn exact(text: &str) -> Result<Rational, Error> {
    let expression = parse(text)?;
    Ok(evaluate(&expression, &BTreeMap::new(), 300)?.value)
}
