//! Parameters of formulas as numbers of a run.

use shadowstep::Number;
use shadowstep_symbolic::Exact;

/// Parameters, each rounded once.
pub(crate) fn rounded<'a, N: Number>(parameters: &'a [(String, Exact)], context: &N::Context) -> Vec<(&'a str, N)> {
    parameters.iter().map(|(name, exact)| (name.as_str(), N::from_rational(&exact.value, context))).collect()
}
