//! `shadowstep run` and `shadowstep scene`: runs that a file describes.

use std::io::{self, IsTerminal, Write};
use std::time::Instant;

use shadowstep::problems::{Description, PROBLEMS, problem};
use shadowstep_scenes::{Error, Note, Observer, Outcome, Scene};

use crate::arguments::SceneRunArguments;
use crate::complaint::{Ending, of_problem, remark};
use crate::interrupt::Interrupt;
use crate::output::Output;
use crate::progress::Progress;

/// Runs a scene.
pub(crate) fn run(arguments: &SceneRunArguments) -> Result<Ending, Error> {
    let scene = Scene::open(&arguments.scene)?;
    scene.notes.iter().for_each(remark);
    let begin = Instant::now();
    let progress = Progress::new(scene.output.file.is_some(), scene.as_run().name(), scene.steps);
    let mut terminal = Terminal { progress, interrupt: Interrupt::listen() };
    let outcome = match scene.output.file {
        Some(_) => scene.run_to_file(arguments.restart, &mut terminal)?,
        None => scene.run_into(&mut Output::open(None, "")?, &mut terminal)?,
    };
    drop(terminal);
    match outcome {
        Outcome::Complete { force_evaluations } => {
            if io::stderr().is_terminal() {
                let (steps, seconds) = (scene.steps, begin.elapsed().as_secs_f64());
                remark(format_args!("{steps} steps, {force_evaluations} force evaluations, {seconds:.3} seconds"));
            }
            Ok(Ending::Done)
        }
        Outcome::Stopped { n } => {
            let hint = match scene.output.checkpoint {
                Some(_) => "run the scene again to go on from there",
                None => "with `checkpoint = \"1 min\"` in [output] it could go on from there",
            };
            Err(Error::run(format!("{}: interrupted at n = {n}", scene.source.path), hint))
        }
    }
}

/// Watches a run for the user: a bar and notes on stderr, and Ctrl-C.
struct Terminal {
    progress: Progress,
    interrupt: Interrupt,
}

impl Observer for Terminal {
    fn progress(&mut self, n: i64) {
        self.progress.reach(n);
    }

    fn note(&mut self, note: &Note) {
        self.progress.suspend(|| remark(note));
    }

    fn stops(&mut self) -> bool {
        self.interrupt.asked()
    }
}

/// Prints the scene of a problem, or the names of all.
pub(crate) fn template(name: Option<&str>) -> Result<Ending, Error> {
    print(&match name {
        Some(name) => shadowstep_scenes::template(problem(name).map_err(of_problem)?.description()),
        None => list(),
    })
}

/// Prints what every key of a scene means.
pub(crate) fn explain() -> Result<Ending, Error> {
    print(&shadowstep_scenes::explain())
}

fn print(text: &str) -> Result<Ending, Error> {
    let mut output = Output::open(None, "")?;
    write!(output, "{text}")?;
    output.finish()?;
    Ok(Ending::Done)
}

fn list() -> String {
    let line = |problem: &Description| format!("  {:<20}  {}\n", problem.name, problem.title);
    let names: String = PROBLEMS.iter().map(|problem| line(problem.description())).collect();
    format!(
        "There is a scene for each of these problems:\n{names}\
         `shadowstep scene kepler > scene.toml` writes one, `shadowstep run scene.toml` runs it, and \
         `shadowstep scene --explain` says what all keys mean.\n"
    )
}
