//! Parameters of formulas as numbers of a run.

use shadowstep::Number;
use shadowstep_schemes::symbolic::Exact;

/// Parameters with their names, each rounded once.
pub(crate) fn rounded<'a, N: Number>(parameters: &'a [(String, Exact)], context: &N::Context) -> Vec<(&'a str, N)> {
    parameters.iter().map(|(name, exact)| (name.as_str(), N::from_rational(&exact.value, context))).collect()
}

/// The values of parameters, each rounded once.
pub(crate) fn values<N: Number>(parameters: &[(String, Exact)], context: &N::Context) -> Vec<N> {
    parameters.iter().map(|(_, exact)| N::from_rational(&exact.value, context)).collect()
}

pub(crate) fn borrowed(names: &[String]) -> Vec<&str> {
    names.iter().map(String::as_str).collect()
}
