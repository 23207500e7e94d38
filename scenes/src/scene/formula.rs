//! Formulas of a scene: they are read once.

use std::fmt;

use shadowstep::Rational;
use shadowstep::systems::formula::{
    FormulaError, FormulaKinetic, FormulaOfBodies, FormulaPair, FormulaPotential, RelativeTo,
};
use shadowstep::systems::many_parts::{PartError, PartFormula};
use shadowstep::systems::pairs::Separation;
use shadowstep_symbolic::Exact;

use crate::scene::parameters::{borrowed, rounded};

/// A formula with what it means in the names of its scene.
pub struct Formula<M> {
    text: String,
    meaning: M,
}

impl<M> Formula<M> {
    /// The text of the scene.
    pub fn text(&self) -> &str {
        &self.text
    }

    pub(crate) fn meaning(&self) -> &M {
        &self.meaning
    }
}

impl<M> fmt::Debug for Formula<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Formula").field(&self.text).finish()
    }
}

impl Formula<FormulaPotential<f64>> {
    /// U(q) in these coordinates and parameters.
    ///
    /// # Errors
    /// A text that is not a valid formula of these.
    pub fn potential(text: &str, coordinates: &[String], parameters: &[(String, Exact)]) -> Result<Self, FormulaError> {
        let meaning = FormulaPotential::new(text, &borrowed(coordinates), &rounded(parameters, &()))?;
        Ok(Formula { text: text.to_owned(), meaning })
    }
}

impl Formula<FormulaKinetic<f64>> {
    /// T(p) in these momenta and parameters.
    ///
    /// # Errors
    /// A text that is not a valid formula of these.
    pub(crate) fn kinetic(
        text: &str,
        momenta: &[String],
        parameters: &[(String, Exact)],
    ) -> Result<Self, FormulaError> {
        let meaning = FormulaKinetic::new(text, &borrowed(momenta), &rounded(parameters, &()))?;
        Ok(Formula { text: text.to_owned(), meaning })
    }
}

impl Formula<FormulaPair<f64>> {
    /// The energy of a pair of bodies with these properties.
    ///
    /// # Errors
    /// A text that is not a valid formula of these.
    pub(crate) fn pair(
        text: &str,
        separation: Separation,
        properties: &[(String, Vec<Exact>)],
        parameters: &[(String, Exact)],
    ) -> Result<Self, FormulaError> {
        // the values are those of the run
        let properties: Vec<(&str, Vec<f64>)> =
            properties.iter().map(|(name, _)| (name.as_str(), Vec::new())).collect();
        let meaning = FormulaPair::new(text, separation, &properties, &rounded(parameters, &()))?;
        Ok(Formula { text: text.to_owned(), meaning })
    }
}

impl Formula<FormulaOfBodies<f64>> {
    /// An energy of each of some bodies in 1 to 3 dimensions.
    ///
    /// # Errors
    /// A text that is not a valid formula of these.
    pub(crate) fn of_bodies(
        text: &str,
        relative_to: RelativeTo,
        (bodies, dimensions): (usize, usize),
        parameters: &[(String, Exact)],
    ) -> Result<Self, FormulaError> {
        // the masses are those of the run
        let masses = vec![1.0; bodies];
        let meaning = FormulaOfBodies::new(text, relative_to, dimensions, &masses, &rounded(parameters, &()))?;
        Ok(Formula { text: text.to_owned(), meaning })
    }

    /// The key of the scene that gives it.
    pub(crate) fn key(&self) -> &'static str {
        match self.meaning.relative_to() {
            RelativeTo::FirstBody => "central",
            RelativeTo::Origin => "external",
        }
    }
}

impl Formula<PartFormula> {
    /// A part of H in these coordinates and momenta, with the values of parameters.
    ///
    /// # Errors
    /// A text that is not a valid formula of these, or whose flow is not known.
    pub(crate) fn part(
        text: &str,
        (coordinates, momenta): (&[String], &[String]),
        parameters: &[(String, Exact)],
    ) -> Result<Self, PartError> {
        let exact = parameters.iter().map(|(name, exact)| (name.as_str(), exact.value.clone()));
        let exact: Vec<(&str, Rational)> = exact.collect();
        let meaning = PartFormula::new(text, (&borrowed(coordinates), &borrowed(momenta)), &exact)?;
        Ok(Formula { text: text.to_owned(), meaning })
    }
}
