//! Slow forces, fast forces and the kinetic energy: for multiple time steps.

use serde_json::{Value, json};
use shadowstep::MotionError;
use shadowstep::number::CorrectlyRounded;
use shadowstep::systems::many_parts::{OfKinetic, OfPotential, Part};

use super::{Class, ManyParts, Needs, Split};
use crate::scene::{ClassifiedKinetic, InitialValueProblem, PotentialEnergy};

/// The key of a scene.
pub(crate) const SLOW: &str = "slow";

/// H = U_slow(q) + U(q) + T(p), where U is the potential of the problem.
#[derive(Debug)]
pub struct SlowForces(Box<PotentialEnergy>);

impl Split for SlowForces {
    fn needs(&self, _: &InitialValueProblem) -> Needs {
        Needs { parts: 3, ..Needs::of_class(Class::ManyParts) }
    }

    fn key(&self) -> (&'static str, &'static str) {
        ("problem", SLOW)
    }

    fn metadata(&self) -> Option<(&'static str, Value)> {
        Some((SLOW, json!(self.text())))
    }

    fn many_parts<N: CorrectlyRounded + 'static>(
        &self,
        problem: &InitialValueProblem,
        context: &N::Context,
    ) -> Option<Result<ManyParts<N>, MotionError>> {
        let dimension = problem.coordinates.len();
        let kinetic: Box<dyn Part<N>> = match problem.kinetic(context) {
            ClassifiedKinetic::Quadratic(kinetic) => Box::new(OfKinetic::new(kinetic, dimension, context)),
            ClassifiedKinetic::General(kinetic) => Box::new(OfKinetic::new(kinetic, dimension, context)),
        };
        let [slow, fast] = [&*self.0, &problem.potential].map(|potential| -> Box<dyn Part<N>> {
            Box::new(OfPotential::new(problem.in_numbers(potential, context), context))
        });
        Some(Ok(vec![slow, fast, kinetic]))
    }
}

impl SlowForces {
    /// The parts with this slow potential.
    pub(crate) fn new(slow: PotentialEnergy) -> Self {
        SlowForces(Box::new(slow))
    }

    /// The slow potential.
    pub(crate) fn potential(&self) -> &PotentialEnergy {
        &self.0
    }

    /// The formula of the slow potential.
    pub fn text(&self) -> &str {
        match &*self.0 {
            PotentialEnergy::Formula(formula) => formula.text(),
            PotentialEnergy::Pairs(pairs) => pairs.formula.text(),
            _ => unreachable!("a scene gives it by a formula"),
        }
    }

    /// The slow potential in words.
    pub fn described(&self) -> String {
        match self.0.pairs() {
            Some(_) => format!("the sum over all pairs of {}", self.text()),
            None => self.text().to_owned(),
        }
    }
}
