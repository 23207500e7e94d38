//! Arguments → what schemes are compared on: a system, the end of the runs, a number type.

use std::path::Path;

use clap::Args;
use shadowstep::Rational;
use shadowstep::tables::First;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::library::NamedScheme;
use shadowstep_scenes::readable::shortened;
use shadowstep_scenes::{Error, Scene, first_map, source};
use shadowstep_schemes::document::document;
use shadowstep_studies::work_precision::length::length_of;
use shadowstep_studies::work_precision::problem::Problem;

use crate::headings::SCHEMES;
use crate::quantity;
use crate::run_arguments::{NumberArguments, SystemArguments};
use crate::system::{Described, is_file};

/// The system, the end of the runs and the number type.
#[derive(Debug, Args)]
pub(crate) struct PosedArguments {
    #[command(flatten)]
    system: SystemArguments,
    /// The time at which runs end [default: that of the scene]
    ///
    /// It is exact, such as 100. Of a scene with [time], it is a physical time as well.
    #[arg(long, value_name = "T", allow_hyphen_values = true, help_heading = SCHEMES)]
    until: Option<String>,
    #[command(flatten)]
    numbers: NumberArguments,
}

impl PosedArguments {
    /// The path of a scene.
    pub(crate) fn scene(&self) -> Option<&String> {
        self.system.problem().filter(|word| is_file(word))
    }

    /// Whether there is anything besides the problem.
    pub(crate) fn is_changed(&self) -> bool {
        let PosedArguments { system, until, numbers } = self;
        until.is_some() || !matches!(numbers.arithmetic(), Ok(None)) || !system.set.is_empty()
    }
}

/// Whether the scene has a section [run], whose number type is that of the runs.
pub(crate) fn has_run(path: &str) -> Result<bool, Error> {
    Ok(document(&source(Path::new(path))?).0.is_some_and(|document| document.contains_key("run")))
}

/// A system with the end of the runs and the number type.
#[derive(Debug)]
pub(crate) struct PosedProblem {
    pub(crate) described: Described,
    pub(crate) until: Rational,
    /// About the length of the runs in s, where time is transformed.
    pub(crate) length: Option<Rational>,
    pub(crate) arithmetic: Arithmetic,
    /// The map that steps begin with, where the scene has one.
    pub(crate) first: Option<First>,
}

impl PosedProblem {
    pub(crate) fn read(arguments: &PosedArguments) -> Result<Self, Error> {
        let path = arguments.scene();
        let given = arguments.numbers.arithmetic()?;
        let is_complete = arguments.until.is_some() && given.is_some();
        let scene = match path.filter(|_| !is_complete) {
            Some(path) if arguments.until.is_none() || has_run(path)? => {
                Some(Scene::read_without_output(source(Path::new(path))?)?)
            }
            // without [run], a scene is only a system
            _ => None,
        };
        let of_scene = scene.as_ref().map_or(Arithmetic::DOUBLE, |scene| scene.arithmetic);
        let arithmetic = given.unwrap_or(of_scene);
        let until = match (&arguments.until, &scene) {
            (Some(text), _) => quantity::number("--until", text)?,
            (None, Some(Scene { until: Some(until), .. })) => until.clone(),
            (None, Some(_)) => {
                let message = "--until is missing: [run] has a number of steps, whose physical time is not known";
                return Err(Error::usage(message, "give the end of the runs: --until 100"));
            }
            (None, None) => return Err(Error::usage("--until is missing", "give the end of the runs: --until 100")),
        };
        if until == Rational::from_integer(0.into()) {
            return Err(Error::usage("--until 0: the runs must have a length", "write --until 100"));
        }
        let described = Described::read(&arguments.system, arithmetic)?;
        let length = length_of(&described.system, &until)?;
        let first = path.map(|path| Ok::<_, Error>(first_map(&source(Path::new(path))?)?)).transpose()?.flatten();
        Ok(PosedProblem { described, until, length, arithmetic, first })
    }

    pub(crate) fn problem(&self) -> Problem<'_> {
        let PosedProblem { described, until, length, arithmetic, .. } = self;
        Problem { system: &described.system, until, arithmetic: *arithmetic, length: length.as_ref() }
    }

    /// The problem, the time, the number type and what steps begin with in a line.
    pub(crate) fn title(&self) -> String {
        let PosedProblem { described, until, arithmetic, first, .. } = self;
        let first = first.map_or_else(String::new, |first| format!(", {first}s first"));
        format!("{}, t = 0 to {}, {}{first}", described.title, shortened(until, 20), arithmetic.described())
    }
}

/// The scheme with weights that have the digits of the runs.
pub(crate) fn fitted(scheme: NamedScheme, arithmetic: Arithmetic) -> Result<NamedScheme, Error> {
    Ok(scheme.fitted(arithmetic)?.0)
}
