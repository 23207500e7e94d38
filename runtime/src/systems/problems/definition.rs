//! What the file of a problem provides.

use num_traits::Signed;

use super::initial::Initial;
use crate::Rational;
use crate::number::Number;
use crate::systems::potential::Potential;
use crate::systems::problems::exact_flow::solver::Solver;

/// What the registry needs of a problem; each problem implements it in its own file.
pub(super) trait Definition {
    /// Name, formula, parameters and initial state.
    const DESCRIPTION: Description;

    /// How the exact flow is computed, where a solution is known.
    const EXACT_FLOW: Option<Solver> = None;

    /// Whether U has functions such as exp and sin, which in [lanes](crate::number::Lanes) are not those of the
    /// platform.
    const HAS_FUNCTIONS: bool = false;

    /// In how many dimensions bodies with the masses of the coordinates attract each other by Newton's law with the
    /// constant `g`; `None` of other problems.
    const GRAVITY: Option<usize> = None;

    /// U(q); `number` gives the parameters by their names.
    fn potential<N: Number + 'static>(number: &dyn Fn(&str) -> N) -> Box<dyn Potential<N>>;
}

/// A problem in texts: its formula and, as exact expressions, its parameters and initial state.
#[derive(Clone, Copy, Debug)]
pub struct Description {
    /// Short name, as the command line and scenes spell it.
    pub name: &'static str,
    /// One line for people.
    pub title: &'static str,
    /// H(q, p) as a formula.
    pub hamiltonian: &'static str,
    /// Parameters, ordered so that each default uses earlier ones only.
    pub parameters: &'static [Parameter],
    /// The initial state and the masses, which may use the parameters.
    pub initial: fn() -> Initial,
    /// A step size that a scheme of order 4 can use.
    pub step: &'static str,
    /// The default final time.
    pub until: &'static str,
    /// Where problem and numbers are from.
    pub source: &'static str,
}

/// A parameter of a problem.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// Its default, an exact expression.
    pub default: &'static str,
    /// What it is.
    pub meaning: &'static str,
    /// The allowed values, in words.
    pub range: &'static str,
    /// Whether a value is allowed.
    pub allowed: fn(&Rational) -> bool,
}

impl Parameter {
    /// A parameter that must be positive.
    pub(super) const fn positive(name: &'static str, default: &'static str, meaning: &'static str) -> Self {
        Parameter { name, default, meaning, range: "it must be positive", allowed: |value| value.is_positive() }
    }

    /// A parameter that may have any value.
    pub(super) const fn any(name: &'static str, default: &'static str, meaning: &'static str) -> Self {
        Parameter { name, default, meaning, range: "any number is allowed", allowed: |_| true }
    }
}
