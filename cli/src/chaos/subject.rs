//! Arguments → the run that is followed: that of a scene, or of a problem with a scheme and a step size.

use std::path::Path;

use clap::Args;
use shadowstep::{Rational, StepSize};
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::chaos::ChaosRequest;
use shadowstep_scenes::ensemble::Ensemble;
use shadowstep_scenes::expression::Condition;
use shadowstep_scenes::library::{self, NamedScheme};
use shadowstep_scenes::posed::Posed;
use shadowstep_scenes::propagator::for_system;
use shadowstep_scenes::readable::{LONGEST_NUMBER, shortened};
use shadowstep_scenes::run::Run;
use shadowstep_scenes::steps::MOST_STEPS;
use shadowstep_scenes::tangent::Vectors;
use shadowstep_scenes::{Error, Scene, System};

use crate::headings::SCHEMES;
use crate::posed::{PosedArguments, PosedProblem, fitted, has_run};
use crate::{quantity, report};

/// What is followed.
#[derive(Debug, Args)]
pub(super) struct SubjectArguments {
    #[command(flatten)]
    posed: PosedArguments,
    /// A shipped or custom scheme [default: that of the scene]
    #[arg(long, value_name = "NAME|FILE", help_heading = SCHEMES)]
    scheme: Option<String>,
    /// The exact step size [default: that of the scene]
    ///
    /// Of a scene with [time], it is a step of the fictitious time s.
    #[arg(long, aliases = ["h", "dt"], value_name = "H", allow_hyphen_values = true, help_heading = SCHEMES)]
    step: Option<String>,
}

/// The run.
pub(super) struct Subject {
    /// The path of the scene, or the name of the problem.
    pub(super) title: String,
    system: System,
    scheme: NamedScheme,
    displaced: bool,
    h: StepSize,
    steps: u64,
    windows: u64,
    arithmetic: Arithmetic,
    /// The physical end, where time is transformed and the steps are not known.
    until: Option<Rational>,
    /// The condition that ends the run of a scene.
    ends: Option<Condition>,
}

impl Subject {
    pub(super) fn read(arguments: &SubjectArguments) -> Result<Self, Error> {
        let scene = arguments.posed.scene().map(|path| scene_with_run(path)).transpose()?.flatten();
        match scene {
            Some(scene) if !arguments.posed.is_changed() && arguments.scheme.is_none() && arguments.step.is_none() => {
                Ok(Subject::of_scene(scene))
            }
            scene => Subject::of_flags(arguments, scene),
        }
    }

    fn of_scene(scene: Scene) -> Self {
        scene.notes.iter().for_each(report::note);
        let (steps, windows) = (scene.most_steps(), scene.output.windows);
        let Scene { system, scheme, displaced, h, arithmetic, until, ends, source, .. } = scene;
        let until = until.filter(|_| system.transformed_time().is_some());
        Subject { title: source.path, system, scheme, displaced, h, steps, windows, arithmetic, until, ends }
    }

    /// What no flag gives is that of the scene.
    fn of_flags(arguments: &SubjectArguments, scene: Option<Scene>) -> Result<Self, Error> {
        let PosedProblem { described, until, arithmetic, first, .. } = PosedProblem::read(&arguments.posed)?;
        let system = described.system;
        let displaced = scene.as_ref().is_some_and(|scene| scene.displaced);
        let windows = scene.as_ref().map_or(Run::WINDOWS, |scene| scene.output.windows);
        let scheme = match (&arguments.scheme, &scene) {
            (Some(word), _) => {
                let named = for_system(library::scheme(word)?, &system)?;
                match first {
                    Some(first) => named.beginning_with(first)?,
                    None => named,
                }
            }
            (None, Some(scene)) => scene.scheme.clone(),
            (None, None) => return Err(Error::usage("--scheme is missing", "give a scheme: --scheme yoshida4")),
        };
        let h = match (&arguments.step, scene) {
            (Some(text), _) => quantity::step_size("--step", text)?,
            (None, Some(scene)) => scene.h,
            (None, None) => return Err(Error::usage("--step is missing", "give a step size: --step 1/10")),
        };
        let scheme = fitted(scheme, arithmetic)?;
        let step = shortened(h.exact(), LONGEST_NUMBER);
        let steps = quantity::steps((&h, &step), &until, &system)?;
        let (steps, until) = (steps.unwrap_or(MOST_STEPS), steps.is_none().then_some(until));
        let (title, ends) = (described.name, None);
        Ok(Subject { title, system, scheme, displaced, h, steps, windows, arithmetic, until, ends })
    }

    /// The run with these vectors, measured every `every` steps.
    pub(super) fn request(&self, vectors: Vectors, every: u64) -> ChaosRequest<'_> {
        let Subject { system, scheme, displaced, h, steps, windows, arithmetic, until, ends, .. } = self;
        let run = Run { propagator: &scheme.name, h, steps: *steps, order: None, windows: *windows };
        let posed = Posed::new(system, &scheme.scheme, run, (*arithmetic, *displaced));
        let posed = Posed { until: until.as_ref(), ends: ends.as_ref(), ..posed };
        ChaosRequest { posed, vectors, every }
    }
}

/// The scene of a file; `None` if it is only a system, without [run].
fn scene_with_run(path: &str) -> Result<Option<Scene>, Error> {
    let source = shadowstep_scenes::source(Path::new(path))?;
    if Ensemble::is_in(&source) {
        Ensemble::read(source)?; // its own faults come first
        let message = format!("{path} is an ensemble, and chaos follows one trajectory");
        return Err(Error::usage(message, "remove [ensemble]; a sweep with keep = [\"megno\"] follows many"));
    }
    if !has_run(path)? {
        return Ok(None);
    }
    Ok(Some(Scene::read_without_output(source)?))
}
