//! H as a sum of parts by their formulas.

use serde_json::{Value, json};
use shadowstep::MotionError;
use shadowstep::number::CorrectlyRounded;
use shadowstep::systems::many_parts::{Part, PartError, PartFormula};
use shadowstep_schemes::symbolic::Exact;

use super::{Class, ManyParts, Needs, Split};
use crate::scene::{Formula, InitialValueProblem};

/// H is the sum of these formulas.
#[derive(Debug)]
pub struct Formulas(pub(crate) Vec<Formula<PartFormula>>);

impl Split for Formulas {
    fn needs(&self, _: &InitialValueProblem) -> Needs {
        Needs { parts: self.0.len(), ..Needs::of_class(Class::ManyParts) }
    }

    fn metadata(&self) -> Option<(&'static str, Value)> {
        Some(("parts", json!(self.0.iter().map(Formula::text).collect::<Vec<_>>())))
    }

    fn many_parts<N: CorrectlyRounded + 'static>(
        &self,
        _: &InitialValueProblem,
        context: &N::Context,
    ) -> Option<Result<ManyParts<N>, MotionError>> {
        let parts = self.0.iter().map(|formula| formula.meaning().in_numbers(context));
        let parts = parts.map(|part| Ok(Box::new(part.map_err(|_| MotionError::Digits)?) as Box<dyn Part<N>>));
        Some(parts.collect())
    }

    fn hamiltonian(&self) -> Option<String> {
        Some(self.0.iter().map(|formula| format!("({})", formula.text())).collect::<Vec<_>>().join(" + "))
    }
}

impl Formulas {
    /// Two parts or more, in these coordinates and their momenta, with the values of parameters.
    ///
    /// # Errors
    /// A text that is not a valid formula of these, or whose flow is not known.
    pub fn new(
        formulas: &[&str],
        names: (&[String], &[String]),
        parameters: &[(String, Exact)],
    ) -> Result<Self, PartError> {
        formulas.iter().map(|text| Formula::part(text, names, parameters)).collect::<Result<_, _>>().map(Formulas)
    }
}
