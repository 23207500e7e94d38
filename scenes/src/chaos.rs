//! Whether a trajectory is chaotic, and whether its step size makes it so.

use std::ops::ControlFlow::{self, Break, Continue};

use serde::Serialize;
use shadowstep::shadow::Estimate;
use shadowstep::shadow::run::RunError;
use shadowstep::steps::integrator::VectorIntegrator;
use shadowstep::tangent::{Exponent, Growth, Regularity};
use shadowstep::{Carried, Rational, StepSize};
use shadowstep_symbolic::decimal::to_text;

use crate::arithmetic::DigitsLabel;
use crate::computation::{Computation, RunNumber};
use crate::error::Error;
use crate::follow::Follower;
use crate::observer::Observer;
use crate::run::Run;
use crate::scene::{PotentialEnergy, Scene, System};
use crate::start::{Begin, Steps};
use crate::tangent::{TangentRun, Vectors};
use crate::watch::summary::Summary;
use crate::watch::{Energies, Watch};

/// Indicators of chaos along a trajectory. Numbers that are not defined, as of too few observations, are `None`.
#[derive(Clone, Debug, Serialize)]
pub struct ChaosRecord {
    /// The name of the scheme.
    pub scheme: String,
    /// The step size.
    pub step: String,
    /// The number of steps.
    pub steps: u64,
    /// The number type.
    pub digits: DigitsLabel,
    /// The length of the trajectory in time; in physical time where time is transformed.
    pub time: f64,
    /// `regular`, `chaotic` or `undecided`: see [`Growth::regularity`].
    pub motion: String,
    /// The largest Lyapunov exponent over the last three quarters of the trajectory.
    pub exponent: Option<f64>,
    /// Twice its standard error.
    pub exponent_error: Option<f64>,
    /// The finite-time exponent L(t)/t of the whole trajectory.
    pub lyapunov: f64,
    /// MEGNO, Y.
    pub megno: f64,
    /// The mean of MEGNO, Ȳ.
    pub mean_megno: f64,
    /// SALI of the first two vectors, if there are two.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sali: Option<f64>,
    /// GALI of all vectors, if there are three or more.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gali: Option<f64>,
    /// The exponents of orthonormal vectors, the largest first, each with twice its standard error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exponents: Option<Vec<[f64; 2]>>,
    /// The error of H and the verdict of the modified energy.
    pub summary: Summary,
}

impl ChaosRecord {
    fn of(scene: &Scene, run: Run<'_>, tangents: &dyn TangentRun, orthonormal: bool, summary: Summary) -> Self {
        let growths = tangents.growths();
        let (growth, exponent) = (growths[0], growths[0].exponent());
        let each = |growth: &&Growth| growth.exponent().map(|Exponent { value, error }| [value, error]);
        ChaosRecord {
            scheme: run.propagator.to_owned(),
            step: to_text(run.h.exact()),
            steps: run.steps,
            digits: scene.arithmetic.label(),
            time: growth.time(),
            motion: growth.regularity().to_string(),
            exponent: exponent.map(|found| found.value),
            exponent_error: exponent.map(|found| found.error),
            lyapunov: growth.lyapunov(),
            megno: growth.megno(),
            mean_megno: growth.mean_megno(),
            sali: tangents.sali(),
            gali: tangents.gali(),
            exponents: orthonormal.then(|| growths.iter().map(each).collect()).flatten(),
            summary,
        }
    }

    /// Whether its indicators say so.
    fn is(&self, regularity: Regularity) -> bool {
        self.motion == regularity.to_string()
    }
}

/// What two runs at h and h/2 say of the problem, in a sentence.
///
/// Exponents of chaotic runs agree if their difference is at most the sum of their errors, or a quarter of the larger one: exponents of finite runs scatter
/// more than their parts do.
pub fn conclusion(whole: &ChaosRecord, half: &ChaosRecord) -> String {
    let both = |regularity| whole.is(regularity) && half.is(regularity);
    let size = |record: &ChaosRecord| record.exponent.unwrap_or(f64::NAN);
    let errors = whole.exponent_error.unwrap_or(f64::NAN) + half.exponent_error.unwrap_or(f64::NAN);
    let (h, half_step) = (&whole.step, &half.step);
    if both(Regularity::Chaotic) {
        let difference = (size(whole) - size(half)).abs();
        return match difference <= errors || difference <= size(whole).max(size(half)) / 4.0 {
            true => "chaotic at both step sizes with the same exponent: of the problem".to_owned(),
            false => {
                "chaotic at both step sizes, with exponents that differ: try smaller steps, or a longer run".to_owned()
            }
        };
    }
    if both(Regularity::Regular) {
        return "regular at both step sizes; slower chaos than the run shows is possible".to_owned();
    }
    if whole.is(Regularity::Chaotic) && half.is(Regularity::Regular) {
        return format!("chaotic at {h} and regular at {half_step}: of the step size");
    }
    if whole.is(Regularity::Regular) && half.is(Regularity::Chaotic) {
        return format!("regular at {h} and chaotic at {half_step}: not decided; try smaller steps");
    }
    "not decided: the run is too short".to_owned()
}

impl Scene {
    /// Follows the run with tangent vectors, from t = 0, at the scene's step size divided by `parts`; `None` if the observer stopped it. Vectors are observed every `every`
    /// steps. Nothing is written.
    ///
    /// # Errors
    /// A run that fails; a potential that the caller computes, whose second derivatives are not known.
    pub fn chaos(
        &self,
        parts: u32,
        vectors: Vectors,
        every: u64,
        observer: &mut dyn Observer,
    ) -> Result<Option<ChaosRecord>, Error> {
        refuse_own(&self.system)?;
        let h = StepSize::try_from(self.h.exact() / Rational::from_integer(parts.into())).expect("h is not 0");
        let run = Run { h: &h, steps: self.steps() * u64::from(parts), ..self.as_run() };
        self.arithmetic.compute(Following { scene: self, run, vectors, every: every.max(1), observer })
    }
}

/// Refuses a potential that has no second derivatives.
fn refuse_own(system: &System) -> Result<(), Error> {
    match &system.potential {
        PotentialEnergy::Own(own) => Err(Error::usage(
            format!("tangent vectors need second derivatives, which {} has not", own.name()),
            "give the potential as a formula",
        )),
        _ => Ok(()),
    }
}

/// The run in any number type.
struct Following<'a> {
    scene: &'a Scene,
    run: Run<'a>,
    vectors: Vectors,
    every: u64,
    observer: &'a mut dyn Observer,
}

impl Computation for Following<'_> {
    type Output = Result<Option<ChaosRecord>, Error>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output {
        let Following { scene, run, vectors, every, observer } = self;
        let system = &scene.system;
        let steps = Steps { h: run.h, ..scene.steps_from(Begin::InitialState) };
        let mut integrator = system.integrator::<N>(steps, system.start(context), context)?;
        let tangents = N::tangents(system, steps, vectors, context)?;
        let failed = |error: RunError| run.failed_naming(&error, &system.coordinates, &system.momenta);
        let (q, p) = system.start(context);
        let initial = integrator.system().energy_at(&q, &p);
        let watch = Watch::begin(&mut *integrator, run, (0, initial), Energies::Windows, true).map_err(failed)?;
        let watch = watch.of_system(system, &integrator);
        let mut follower = ChaosFollower { run, system, tangents, every, watch, observer, h: scene_step(run.h) };
        if N::follow(&mut *integrator, (None, run.steps), None, &mut follower)?.is_break() {
            return Ok(None);
        }
        let ChaosFollower { tangents, watch, .. } = follower;
        let summary = watch.summary(run).expect("it was asked for");
        let orthonormal = matches!(vectors, Vectors::Orthonormal(_));
        Ok(Some(ChaosRecord::of(scene, run, &*tangents, orthonormal, summary)))
    }
}

/// Makes a step of the tangent vectors with each step of the run.
struct ChaosFollower<'a, N: RunNumber> {
    run: Run<'a>,
    system: &'a System,
    tangents: Box<dyn TangentRun>,
    every: u64,
    watch: Watch<N>,
    observer: &'a mut dyn Observer,
    h: f64,
}

fn scene_step(h: &StepSize) -> f64 {
    use num_traits::ToPrimitive;
    h.exact().to_f64().unwrap_or(f64::NAN)
}

impl<N: RunNumber> Follower<N> for ChaosFollower<'_, N> {
    fn carried(&self) -> Carried {
        self.watch.carried()
    }

    fn state(&mut self, n: i64, integrator: &mut VectorIntegrator<'_, N>) {
        if n == 0 {
            return;
        }
        self.watch.include(n, integrator);
        self.tangents.step();
        let n = n.unsigned_abs();
        if n.is_multiple_of(self.every) || n == self.run.steps {
            let time = self.tangents.time().unwrap_or(self.h * n as f64);
            self.tangents.observe(time);
        }
    }

    fn output(
        &mut self,
        n: i64,
        _: Option<&Estimate<'_, N>>,
        _: &mut VectorIntegrator<'_, N>,
    ) -> Result<ControlFlow<()>, Error> {
        self.observer.progress(n);
        Ok(if self.observer.stops() { Break(()) } else { Continue(()) })
    }

    fn failed(&mut self, error: RunError) -> Result<(), Error> {
        Err(self.run.failed_naming(&error, &self.system.coordinates, &self.system.momenta))
    }
}
