//! T(p) and U(q): drifts and kicks.

use serde_json::Value;
use shadowstep::number::CorrectlyRounded;
use shadowstep::{Motion, MotionError};

use super::{Class, Needs, Split, State};
use crate::run::start::{SceneIntegrator, Steps};
use crate::scene::{ClassifiedKinetic, InitialValueProblem, PotentialEnergy};
use crate::texts::refusal::Unsupported;

/// T(p) and U(q).
#[derive(Clone, Copy, Debug)]
pub struct KineticAndPotential;

impl Split for KineticAndPotential {
    fn needs(&self, problem: &InitialValueProblem) -> Needs {
        let own = matches!(problem.potential, PotentialEnergy::Own(_));
        let class = if problem.has_quadratic_kinetic() { Class::Quadratic } else { Class::EveryKinetic };
        Needs {
            no_gradient_kicks: own.then_some(Unsupported {
                reason: "and a function that computes forces has no second derivatives",
                hint: "use a scheme without gradient kicks, such as blanes-moan-srkn6b, or write the potential as a formula",
            }),
            ..Needs::of_class(class)
        }
    }

    fn metadata(&self) -> Option<(&'static str, Value)> {
        None
    }

    fn integrator<N: CorrectlyRounded + 'static>(
        &self,
        problem: &InitialValueProblem,
        steps: Steps<'_>,
        (q, p): State<N>,
        context: &N::Context,
    ) -> Result<SceneIntegrator<N>, MotionError> {
        let (potential, displacements) = (problem.potential(context), steps.displacements(context));
        Ok(match problem.kinetic(context) {
            ClassifiedKinetic::Quadratic(kinetic) => {
                let mut motion = Motion::of_any_energy(potential, kinetic, q, p)?;
                if let Some(displacements) = displacements {
                    motion = motion.displaced(displacements);
                }
                steps.integrator(steps.quadratic(), motion.compensated_if(steps.compensated), context)
            }
            ClassifiedKinetic::General(kinetic) => {
                let motion = Motion::of_any_energy(potential, kinetic, q, p)?.compensated_if(steps.compensated);
                steps.integrator(steps.for_every_kinetic(), motion, context)
            }
        })
    }

    fn is_kinetic_and_potential(&self) -> bool {
        true
    }
}
