//! A run with everything that determines its states, and what is computed beside them.

use shadowstep::shadow::EstimatorSettings;
use shadowstep::shadow::run::RunError;
use shadowstep::steps::integrator::VectorIntegrator;
use shadowstep::tables::{AtRunTime, TableScheme};
use shadowstep::{Integrator as _, MotionError, Rational};

use crate::document::expression::Condition;
use crate::motion::tangent::{FollowingVectors, Vectors};
use crate::results::Checkpoint;
use crate::run::Run;
use crate::run::arithmetic::Arithmetic;
use crate::run::start::{Begin, SceneIntegrator, Steps};
use crate::scene::{CheckpointInterval, Scene, SceneNumber, Surface, System};
use crate::texts::error::Error;
use crate::watch::summary::{EnergySummary, Summary};
use crate::watch::{Energies, Watch};

/// A run from t = 0: all that determines its states, and what is computed beside them.
#[derive(Clone, Copy)]
pub struct Posed<'a> {
    /// H and the initial state.
    pub system: &'a System,
    /// The scheme, valid for the [system](crate::motion::propagator::for_system).
    pub scheme: &'a TableScheme<AtRunTime>,
    /// The steps; of a run that something else ends, the most.
    pub run: Run<'a>,
    /// The number type.
    pub arithmetic: Arithmetic,
    /// Whether gradient kicks are by displaced forces, which the scheme must [allow](crate::library::check_displaced).
    pub displaced: bool,
    /// The physical time at which the run ends, where time is transformed: after whole steps up to then it makes one of
    /// the exact remainder.
    pub until: Option<&'a Rational>,
    /// The condition that ends the run before, checked for the system.
    pub ends: Option<&'a Condition>,
    /// The surface whose crossings are shown, [checked](System::section) for the system.
    pub section: Option<&'a Surface>,
    /// The estimator of modified energies, if these are wanted.
    pub estimator: Option<&'a EstimatorSettings>,
    /// The tangent vectors beside the run, with the number of steps after which they are measured.
    pub vectors: Option<(Vectors, u64)>,
    /// At which states H is computed for its error, if that is wanted.
    pub energies: Option<Energies>,
    /// Whether there is a summary.
    pub summarised: bool,
    /// From which moments it can be resumed, and is.
    pub resumed: Resumed<'a>,
}

/// How a run into a file is resumed; other runs are not.
#[derive(Clone, Copy, Default)]
pub struct Resumed<'a> {
    /// How often a moment is kept from which the run can be resumed.
    pub(crate) interval: Option<CheckpointInterval>,
    /// The moment from which it is resumed.
    pub(crate) checkpoint: Option<&'a Checkpoint>,
}

impl Scene {
    /// The run, of which nothing is computed but its states.
    pub fn posed(&self) -> Posed<'_> {
        let Scene { system, scheme, arithmetic, displaced, .. } = self;
        let posed = Posed::new(system, &scheme.scheme, self.as_run(), (*arithmetic, *displaced));
        Posed { until: self.physical_end(), ends: self.ends.as_ref(), ..posed }
    }
}

/// What has become of a run.
pub struct Followed {
    /// The last state.
    pub n: i64,
    /// Whether a condition ended the run.
    pub is_met: bool,
    /// Whether the observer stopped it.
    pub is_stopped: bool,
    /// Evaluations of the gradient, those for states beyond both ends included, which only estimates need.
    pub evaluations: u64,
    /// Those for the steps of the run alone.
    pub own_evaluations: u64,
    /// The error of H, if that is wanted.
    pub energy: Option<EnergySummary>,
    /// What the run has shown, if that is wanted.
    pub summary: Option<Summary>,
    /// The tangent vectors, if there are some.
    pub vectors: Option<FollowingVectors>,
}

impl<'a> Posed<'a> {
    /// A run of which nothing is computed but its states.
    pub fn new(
        system: &'a System,
        scheme: &'a TableScheme<AtRunTime>,
        run: Run<'a>,
        (arithmetic, displaced): (Arithmetic, bool),
    ) -> Self {
        Posed {
            system,
            scheme,
            run,
            arithmetic,
            displaced,
            until: None,
            ends: None,
            section: None,
            estimator: None,
            vectors: None,
            energies: None,
            summarised: false,
            resumed: Resumed::default(),
        }
    }

    fn steps(&self, begin: Begin) -> Steps<'a> {
        let Posed { scheme, run, displaced, arithmetic, .. } = *self;
        Steps { scheme, h: run.h, compensated: arithmetic.is_compensated(), displaced, begin }
    }

    /// The system with its stepper, at t = 0 or at the state of the checkpoint, and the n of that.
    pub(crate) fn begin<N: SceneNumber>(
        &self,
        context: &N::Context,
    ) -> Result<(SceneIntegrator<N>, Option<i64>), Error> {
        let Some(saved) = self.resumed.checkpoint.and_then(|checkpoint| checkpoint.state.as_ref()) else {
            let start = self.system.start(context);
            return Ok((self.system.integrator(self.steps(Begin::InitialState), start, context)?, None));
        };
        let (state, remainders) = saved.numbers(context).ok_or_else(|| unreadable(saved.n))?;
        // the states of checkpoints are those of the steps
        let integrator = self.system.integrator(self.steps(Begin::Step), state, context);
        let mut integrator = integrator.map_err(|error| inconsistent(&error))?;
        integrator.system().state_mut().set_remainders(&remainders);
        Ok((integrator, Some(saved.n)))
    }

    /// The tangent vectors, at t = 0 or at the state of the checkpoint.
    pub(crate) fn tangents(&self) -> Result<Option<FollowingVectors>, Error> {
        let Some(vectors) = self.vectors else { return Ok(None) };
        let mut vectors =
            FollowingVectors::new(self.arithmetic, self.system, self.steps(Begin::InitialState), vectors)?;
        match self.resumed.checkpoint {
            Some(Checkpoint { n, vectors: saved, .. }) if !vectors.restore(*n, saved) => Err(unreadable(*n)),
            _ => Ok(Some(vectors)),
        }
    }

    /// Follows the run for the error of H and a summary, where these are wanted.
    /// `from` is the n of its state, with whether rows have another function than the steps conserve.
    pub(crate) fn watch<N: SceneNumber>(
        &self,
        integrator: &mut VectorIntegrator<'_, N>,
        (from, has_other_energy): (i64, bool),
        context: &N::Context,
    ) -> Result<Option<Watch<N>>, Error> {
        let Posed { system, run, energies, summarised, .. } = *self;
        if energies.is_none() && !summarised {
            return Ok(None);
        }
        let energies = match energies {
            Some(Energies::Given(_)) if has_other_energy => Energies::Windows,
            energies => energies.unwrap_or(Energies::Windows),
        };
        let (q, p) = system.start(context);
        let initial = integrator.energy_at(&q, &p);
        let watch = Watch::begin(integrator, run, (from, initial), energies, (summarised, self.is_open()));
        let watch = watch.map_err(|error| self.named(run, &error))?;
        Ok(Some(watch.of_system(system, integrator)))
    }

    /// Whether something else than the number of steps may end the run.
    pub(crate) fn is_open(&self) -> bool {
        self.until.is_some() || self.ends.is_some()
    }

    /// About how many steps there will be, or at most.
    pub fn expected_steps(&self) -> u64 {
        self.system.expected_steps(self.run, self.until)
    }

    /// The error of the run, with the names of coordinates and momenta.
    pub(crate) fn named(&self, run: Run<'_>, error: &RunError) -> Error {
        let failed = run.failed_naming(error, &self.system.coordinates, &self.system.momenta);
        match (failed, self.system.transformed_time()) {
            (Error::Run { message, .. }, Some(_)) if matches!(error, RunError::NotFinite { .. }) => Error::run(
                format!("{message}; time is transformed, which requires U < 0 and T + p_t > 0"),
                "remove [time] if U changes its sign on the orbit; otherwise try a smaller step size",
            ),
            (failed, _) => failed,
        }
    }
}

/// Dimensions that do not agree, such as those of the state in a checkpoint.
fn inconsistent(error: &MotionError) -> Error {
    Error::usage(error.to_string(), "begin again with `restart`")
}

pub(crate) fn unreadable(n: i64) -> Error {
    Error::usage(format!("the state n = {n} of the checkpoint cannot be read"), "begin again with `restart`")
}
