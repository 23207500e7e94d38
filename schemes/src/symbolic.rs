//! Exact formulas: from text to a syntax tree with places, and from there to exact rationals, derivatives and programs.
//!
//! * [`parse`] reads a formula such as `1/(2 - 2^(1/3))` into an [`Expression`].
//! * [`evaluate`] computes it. Rational arithmetic stays exact; a formula with an irrational root, a
//!   function such as exp or sin, or `pi` is rounded once, correctly, to the requested digits.
//! * [`Graph::build`] simplifies it into a graph without repetitions, where [`Graph::derivative`] and [`Graph::rate`]
//!   (qᵀU_q − 2U) find formulas, and [`Graph::program`] computes them with few operations in place.
//! * [`decimal`] writes rationals as text and reads them back.
//! * [`nearest`](nearest()) corrects a misspelt word.
//!
//! ```
//! use shadowstep_schemes::symbolic::{Exact, Rational, decimal, evaluate, exact, parse};
//! use std::collections::BTreeMap;
//!
//! assert_eq!(exact("1/6 + .5")?, Rational::new(2.into(), 3.into()));
//!
//! let formula = parse("1/(2 - cbrt(2))")?;
//! let g1 = evaluate(&formula, &BTreeMap::new(), 50)?;
//! assert!(g1.rounded);
//! assert_eq!(decimal::to_significant(&g1.value, 12), "1.35120719196");
//!
//! // A name stands for a number; the arithmetic with it is exact.
//! let names = BTreeMap::from([("g1".to_string(), g1.clone())]);
//! let g0 = evaluate(&parse("1 - 2*g1")?, &names, 50)?;
//! let two = Rational::from_integer(2.into());
//! assert_eq!(g0.value + two * g1.value, Rational::from_integer(1.into()));
//!
//! // Errors have a place in the text.
//! let error = exact("2 * (1 - 1/1)^-1").unwrap_err();
//! assert_eq!(error.to_string(), "division by zero");
//! assert_eq!(error.range(), 4..13);
//! # Ok::<(), shadowstep_schemes::symbolic::Error>(())
//! ```
//!
//! The files, each folder's from the ground up:
//!
//! | module | what it is |
//! | --- | --- |
//! | `number` | **exact numbers** |
//! | `number/divisor` | greatest common divisors of long numbers |
//! | `number/ratio`, `number/rational`, `number/fraction` | ratios, in lowest terms or not, and their order |
//! | `number/rounding` | a rational → the decimals next to it |
//! | `number/power` | rational powers and roots, and the largest size of numbers |
//! | `number/function` | the elementary functions: their names, parity, rational values |
//! | `number/interval` | rational bounds of a real number |
//! | `number/ball` | fixed-point numbers with error bounds |
//! | `number/series` | power series of the functions, π, log 2 |
//! | `number/elementary` | enclosures of the functions' values |
//! | `text` | **text in and out** |
//! | `text/literal` | decimal literals, `2.5e-7` |
//! | [`decimal`] | rationals → text → rationals |
//! | `text/near_names` | the known word that is nearest to a misspelt one |
//! | `text/error` | errors of formulas |
//! | `text/token`, `text/syntax` | text → tokens → syntax tree |
//! | `text/names` | the names in a formula: functions, π, unknown names |
//! | `evaluation` | **syntax tree → value** |
//! | `evaluation/budget` | how much computing formulas may take |
//! | `evaluation/value` | exact or enclosed values |
//! | `evaluation/domain` | the domains of roots, quotients and functions |
//! | `evaluation/evaluator` | one computation with a given number of digits |
//! | `debug_as_text` | errors whose `Debug` is their text |
//! | `separation` | the variable in formulas of pairs of bodies |
//! | `graph` | **syntax tree → formulas without repetitions**, with the feature `graph` |
//! | `graph/simplify` | construction of simplified nodes |
//! | `graph/build` | syntax tree → nodes |
//! | `graph/pair` | formulas of a pair of bodies |
//! | `graph/degree`, `graph/derivative`, `graph/rate`, `graph/quadratic` | homogeneity, ∂/∂q, qᵀU_q − 2U, quadratic forms |
//! | `graph/expand`, `graph/substitute` | sums multiplied out; formulas with parts replaced |
//! | `graph/bracket` | brackets of functions of positions and momenta |
//! | `graph/notation` | formulas as text, for LaTeX, Rust and NumPy |
//! | `graph/flow` | Hamiltonians whose flow has a formula |
//! | `program` | **formulas → straight-line programs**, with the feature `graph` |
//! | `program/instruction`, `program/operations` | one operation in place, numbers of operations |
//! | `program/lower/…` | nodes → operations, with common parts shared → places and instructions |
//! | `program/factor` | the search for a form of the formulas with fewer operations |
//! | `program/potential` | the programs of a potential |

mod debug_as_text;
mod evaluation;
#[cfg(feature = "graph")]
mod graph;
mod number;
#[cfg(feature = "graph")]
mod program;
mod separation;
mod text;

use std::collections::BTreeMap;

pub use evaluation::{MOST_EVALUATED_DIGITS, budget::Budget, evaluate, evaluate_within, value::Exact};
#[cfg(feature = "graph")]
pub use graph::flow::{ExplicitFlow, NoFlow};
#[cfg(feature = "graph")]
pub use graph::notation::Notation;
#[cfg(feature = "graph")]
pub use graph::pair::is_symmetric;
#[cfg(feature = "graph")]
pub use graph::{Form, Graph, Node};
pub use number::fraction::Fraction;
pub use number::function::Function;
pub use number::ratio::Ratio;
pub use number::rational::Rational;
#[cfg(feature = "graph")]
pub use program::Program;
#[cfg(feature = "graph")]
pub use program::instruction::{Instruction, Place};
#[cfg(feature = "graph")]
pub use program::operations::Operations;
#[cfg(feature = "graph")]
pub use program::potential::PotentialPrograms;
pub use separation::{Separation, Summand};
pub use text::decimal;
pub use text::error::{Error, SemanticError, SemanticFault, SyntaxError};
pub use text::near_names::{nearest, nearest_few, suggestion};
pub use text::syntax::{Expression, ExpressionKind, Operation, parse};

/// Computes a formula without names; an irrational value is rounded to 300 significant digits.
///
/// # Errors
/// As `parse` and `evaluate`.
pub fn exact(text: &str) -> Result<Rational, Error> {
    let expression = parse(text)?;
    Ok(evaluate(&expression, &BTreeMap::new(), 300)?.value)
}
