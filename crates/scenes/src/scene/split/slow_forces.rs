//! Slow forces, fast forces and the kinetic energy: for multiple time steps.

use serde_json::{Value, json};
use shadowstep::MotionError;
use shadowstep::number::CorrectlyRounded;
use shadowstep::systems::many_parts::{OfKinetic, OfPotential, Part, SystemOfParts};

use super::{Class, Needs, Split, State};
use crate::scene::{ClassifiedKinetic, EnergyAt, InitialValueProblem, PotentialEnergy, energy_of};
use crate::start::{SceneIntegrator, Steps};

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

    fn energy<N: CorrectlyRounded + 'static>(
        &self,
        problem: &InitialValueProblem,
        context: &N::Context,
    ) -> EnergyAt<N> {
        let state = problem.initial(context);
        energy_of(self.system(problem, &state, context).expect("the dimensions were read with the system"))
    }

    fn integrator<N: CorrectlyRounded + 'static>(
        &self,
        problem: &InitialValueProblem,
        steps: Steps<'_>,
        state: State<N>,
        context: &N::Context,
    ) -> Result<SceneIntegrator<N>, MotionError> {
        Ok(steps.of_parts(self.system(problem, &state, context)?, context))
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
        match &*self.0 {
            PotentialEnergy::Pairs(_) => format!("the sum over all pairs of {}", self.text()),
            _ => self.text().to_owned(),
        }
    }

    /// The system of the three parts at a state.
    fn system<N: CorrectlyRounded + 'static>(
        &self,
        problem: &InitialValueProblem,
        (q, p): &State<N>,
        context: &N::Context,
    ) -> Result<SystemOfParts<N>, MotionError> {
        let (slow, fast) = (problem.in_numbers(&self.0, context), problem.potential(context));
        let dimension = fast.dimension();
        if q.len() != dimension {
            return Err(MotionError::Potential { coordinates: q.len(), dimension });
        }
        let kinetic: Box<dyn Part<N>> = match problem.kinetic(context) {
            ClassifiedKinetic::Quadratic(kinetic) => Box::new(OfKinetic::new(kinetic, dimension, context)),
            ClassifiedKinetic::General(kinetic) => Box::new(OfKinetic::new(kinetic, dimension, context)),
        };
        let of_potential = |potential| Box::new(OfPotential::new(potential, context)) as Box<dyn Part<N>>;
        SystemOfParts::new(vec![of_potential(slow), of_potential(fast), kinetic], q, p)
    }
}
