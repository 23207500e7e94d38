//! The content of a scene: plain data, all of it exact.
//!
//! | module | what it is |
//! | --- | --- |
//! | `system`, `problem`, `bodies`, `pairs`, `formula`, `own`, `parameters` | what moves |
//! | `split` | how H is split into parts: each kind of split has its file |
//! | `number` | the number types in which systems are compiled |
//! | `output`, `format` | what is written |
//! | [`plot`] | what charts of a run show |

pub(crate) mod bodies;
mod format;
mod formula;
mod number;
mod output;
mod own;
mod pairs;
mod parameters;
pub mod plot;
mod problem;
pub(crate) mod split;
mod system;

pub use format::Format;
pub use formula::Formula;
pub use number::SceneNumber;
pub(crate) use number::springs;
pub use output::NamedExpression;
pub(crate) use output::ValueColumns;
pub use output::{CheckpointInterval, Direction, Outputs, Surface};
pub use own::OwnPotential;
pub(crate) use pairs::{EnergyOfBodies, PairEnergy};
pub(crate) use pairs::{GRAVITY, PairCutoff, SmoothEnd};
pub(crate) use problem::{ClassifiedKinetic, energy_of};
pub use problem::{EnergyAt, InitialValueProblem, KineticEnergy, PotentialEnergy};
pub use system::{Parts, System};

use std::ops::Range;

use shadowstep::tables::Source;
use shadowstep::{MotionError, Rational, StepSize};

use crate::document::expression::Condition;
use crate::document::library::NamedScheme;
use crate::run::arithmetic::Arithmetic;
use crate::run::estimator::order_setting;
use crate::run::note::Note;
use crate::run::start::{Begin, SceneIntegrator, Steps};
use crate::run::steps::MOST_STEPS;
use crate::run::{OrderSetting, Run};

/// A scene: the system, the scheme with its steps, and the output.
#[derive(Debug)]
pub struct Scene {
    /// The text of the scene and its path; paths in the scene are relative to its folder.
    pub source: Source,
    /// The number type.
    pub arithmetic: Arithmetic,
    /// H = T(p) + U(q) and the state at t = 0.
    pub system: System,
    /// The scheme.
    pub scheme: NamedScheme,
    /// Whether gradient kicks are by displaced forces: see [`shadowstep::systems::displaced`].
    pub displaced: bool,
    /// The step size h.
    pub h: StepSize,
    /// The time at which the run ends, at the latest; `None` where time is transformed and the number of steps is
    /// given.
    pub until: Option<Rational>,
    /// The place of the value of `until` or `steps` in the text.
    pub(crate) end_at: Range<usize>,
    /// The condition on which the run ends before, if there is one.
    pub ends: Option<Condition>,
    /// The most steps; `None` where only the steps themselves have their times.
    pub(crate) steps: Option<u64>,
    /// What is written, and where.
    pub output: Outputs,
    /// Other files that have states, with the names that the text has for them.
    pub(crate) files: Vec<Source>,
    /// What the user should know of this scene.
    pub notes: Vec<Note>,
}

impl Scene {
    /// The system at t = 0 with the stepper of the run.
    ///
    /// # Errors
    /// A state of another dimension.
    pub fn integrator<N: SceneNumber>(&self, context: &N::Context) -> Result<SceneIntegrator<N>, MotionError> {
        self.system.integrator(self.steps_from(Begin::InitialState), self.system.start(context), context)
    }

    /// The steps of the run from this state on.
    pub fn steps_from(&self, begin: Begin) -> Steps<'_> {
        let (compensated, displaced) = (self.arithmetic.is_compensated(), self.displaced);
        Steps { scheme: &self.scheme.scheme, h: &self.h, compensated, displaced, begin }
    }

    /// The steps of the run, with the order of the estimator as the scene sets it.
    pub fn as_run(&self) -> Run<'_> {
        let setting = self.output.modified_energy.as_ref().and_then(|(settings, _)| order_setting(settings));
        let order = setting.map(|(name, value)| OrderSetting { name, value });
        Run { propagator: &self.scheme.name, h: &self.h, steps: self.most_steps(), order, windows: self.output.windows }
    }

    /// The number of steps; `None` where a condition or, in transformed time, a physical time ends the run.
    pub fn steps(&self) -> Option<u64> {
        self.steps.filter(|_| self.ends.is_none())
    }

    /// The most steps, which are those of a run that nothing else ends.
    pub fn most_steps(&self) -> u64 {
        self.steps.unwrap_or(MOST_STEPS)
    }

    /// The physical time at which the run ends, where time is transformed.
    pub(crate) fn physical_end(&self) -> Option<&Rational> {
        self.until.as_ref().filter(|_| self.system.transformed_time().is_some())
    }
}
