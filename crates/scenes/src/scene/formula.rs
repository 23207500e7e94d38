//! Formulas of a scene: they are read once.

use std::fmt;

use shadowstep::systems::formula::{
    FormulaError, FormulaKinetic, FormulaOfBodies, FormulaPair, FormulaPotential, RelativeTo,
};
use shadowstep::systems::many_parts::{PartError, PartFormula};
use shadowstep::systems::pairs::Separation;
use shadowstep::{Potential as _, Rational};
use shadowstep_schemes::symbolic::Exact;

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
        (bodies, particles, dimensions): (usize, usize, usize),
        parameters: &[(String, Exact)],
    ) -> Result<Self, FormulaError> {
        // the masses are those of the run
        let masses = vec![1.0; bodies];
        let meaning = FormulaOfBodies::new(text, relative_to, dimensions, &masses, &rounded(parameters, &()))?;
        Ok(Formula { text: text.to_owned(), meaning: meaning.with_particles(particles) })
    }

    /// Whether it is proportional to the mass of the body, as far as its values at the place of a body show.
    pub(crate) fn is_proportional_to_mass(
        &self,
        place: &[f64],
        central_mass: f64,
        parameters: &[(String, Exact)],
    ) -> bool {
        let [half, one, two] = [0.5, 1.0, 2.0].map(|mass| {
            let dimensions = place.len();
            let parameters = rounded(parameters, &());
            let masses = [central_mass, mass];
            let of =
                FormulaOfBodies::<f64>::new(&self.text, self.meaning.relative_to(), dimensions, &masses, &parameters);
            let Ok(of) = of else { return f64::NAN };
            let mut scratch = vec![0.0; of.scratch()];
            of.prepare(&mut scratch, &());
            let mut gradient = vec![0.0; 2 * dimensions];
            of.gradient(&[&vec![0.0; dimensions], place].concat(), &mut gradient, &mut scratch);
            gradient[dimensions..].iter().enumerate().map(|(axis, slope)| slope * (1.7 + axis as f64)).sum::<f64>()
        });
        let is_close = |a: f64, b: f64| (a - b).abs() <= 1e-9 * (a.abs() + b.abs());
        is_close(half, one / 2.0) && is_close(two, 2.0 * one)
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
