//! `shadowstep run`: a run that a file describes.

use std::io::{self, IsTerminal};
use std::time::Instant;

use clap::Args;
use shadowstep_scenes::{Error, Note, Observer, Outcome, Scene};

use crate::interrupt::Interrupt;
use crate::output::Output;
use crate::progress::Progress;
use crate::report::{self, Status};

const EXAMPLE: &str = "\
Example:
  shadowstep scene kepler > scene.toml
  shadowstep run scene.toml

If a run is stopped, running its scene again resumes it from the last checkpoint.";

/// Runs a scene: a file that describes a run and its output.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Arguments {
    /// The scene's file, such as scene.toml
    #[arg(value_name = "FILE")]
    scene: String,
    /// Begins again at t = 0 even if there is a checkpoint
    #[arg(long)]
    restart: bool,
}

/// Runs a scene.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let scene = Scene::open(&arguments.scene)?;
    scene.notes.iter().for_each(report::note);
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
                report::note(format_args!(
                    "{steps} steps, {force_evaluations} force evaluations, {seconds:.3} seconds"
                ));
            }
            Ok(Status::Success)
        }
        Outcome::Stopped { n } => {
            let hint = match scene.output.checkpoint {
                Some(_) => "run the scene again to resume it",
                None => "with `checkpoint = \"1 min\"` in [output] it could be resumed",
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
        self.progress.suspend(|| report::note(note));
    }

    fn stops(&mut self) -> bool {
        self.interrupt.asked()
    }
}
