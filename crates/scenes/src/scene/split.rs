//! How H is split into parts whose flows are exact. Each kind of split has its file and answers the same questions.
//!
//! ```text
//! read/parts.rs: a word of the scene → a kind of split, or why the system has none of this kind
//! needs         → what the reader and the command line ask of schemes, sums and ensembles
//! start         → with (a work on the system and its stepper) → shown, energy: the rows
//! ```

mod formulas;
mod kinetic_and_potential;
mod linear;
mod needs;
mod shown_coordinates;
mod slow_forces;
mod transformed_time;
mod wisdom_holman;

pub use formulas::Formulas;
pub(crate) use kinetic_and_potential::KineticAndPotential;
pub(crate) use linear::LINEAR;
pub use linear::Linear;
pub(crate) use needs::{Class, Needs};
pub use shown_coordinates::ShownCoordinates;
pub(crate) use slow_forces::SLOW;
pub(crate) use slow_forces::SlowForces;
pub use transformed_time::TransformedTime;
pub use wisdom_holman::{CanonicalCoordinates, CloseEncounters, Planets};
pub(crate) use wisdom_holman::{OfPlanets, Positions};

use serde_json::Value;
use shadowstep::number::CorrectlyRounded;
use shadowstep::systems::many_parts::{Part, SystemOfParts};
use shadowstep::systems::transformed_time::TimeTransformation;
use shadowstep::{MotionError, Number};

use crate::run::start::{SceneIntegrator, Steps};
use crate::scene::{EnergyAt, InitialValueProblem, energy_of};

/// Positions and momenta.
pub(crate) type State<N> = (Vec<N>, Vec<N>);

/// Three parts and more.
pub(crate) type ManyParts<N> = Vec<Box<dyn Part<N>>>;

/// What a kind of split answers, of a system whose H is split in this way.
pub(crate) trait Split {
    /// What it needs of a scheme and of a run.
    fn needs(&self, problem: &InitialValueProblem) -> Needs;

    /// The section and the key of a scene that ask for it.
    fn key(&self) -> (&'static str, &'static str) {
        ("problem", "parts")
    }

    /// Its name and value in the head of a file.
    fn metadata(&self) -> Option<(&'static str, Value)>;

    /// The state at t = 0 in the coordinates of the steps, from that of the scene.
    fn start<N: Number + 'static>(&self, _: &InitialValueProblem, state: State<N>, _: &N::Context) -> State<N> {
        state
    }

    /// Converts states from the coordinates of the steps to those that are shown, where these differ.
    fn shown<N: Number + 'static>(&self, _: &InitialValueProblem, _: &N::Context) -> Option<ShownCoordinates<N>> {
        None
    }

    /// The parts of an H of three parts and more; `None` of two.
    fn many_parts<N: CorrectlyRounded + 'static>(
        &self,
        _: &InitialValueProblem,
        _: &N::Context,
    ) -> Option<Result<ManyParts<N>, MotionError>> {
        None
    }

    /// H of any state in the coordinates of the steps.
    fn energy<N: CorrectlyRounded + 'static>(
        &self,
        problem: &InitialValueProblem,
        context: &N::Context,
    ) -> EnergyAt<N> {
        let Some(parts) = self.many_parts(problem, context) else { return problem.plain_energy(context) };
        let (q, p) = problem.initial(context);
        let system = parts.and_then(|parts| SystemOfParts::new(parts, &q, &p));
        energy_of(system.expect("the dimensions were read with the system"))
    }

    /// The system at a state in the coordinates of the steps, with its stepper.
    ///
    /// # Errors
    /// A state of another dimension.
    fn integrator<N: CorrectlyRounded + 'static>(
        &self,
        problem: &InitialValueProblem,
        steps: Steps<'_>,
        (q, p): State<N>,
        context: &N::Context,
    ) -> Result<SceneIntegrator<N>, MotionError> {
        let (coordinates, dimension) = (q.len(), problem.coordinates.len());
        if coordinates != dimension {
            return Err(MotionError::Potential { coordinates, dimension });
        }
        let parts = self.many_parts(problem, context).expect("a split into two parts has its own integrator")?;
        Ok(steps.of_parts(SystemOfParts::new(parts, &q, &p)?, context))
    }

    /// H, where the parts alone give it.
    fn hamiltonian(&self) -> Option<String> {
        None
    }

    /// The function of the transformed time: the last coordinate is then t, its momentum p_t = −H(0), and the steps
    /// conserve another function than H.
    fn transformed_time(&self) -> Option<TimeTransformation> {
        None
    }

    /// Whether one of two parts, the drifts, is much larger than the other: schemes with orders for A + εB have an
    /// advantage.
    fn has_dominant_part(&self) -> bool {
        false
    }

    /// Whether the parts are T(p) and U(q): the fastest oscillation limits the step size, and lanes have flows.
    fn is_kinetic_and_potential(&self) -> bool {
        false
    }
}
