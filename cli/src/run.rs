//! `shadowstep run`: a run that a file describes.

use std::io::{self, IsTerminal};
use std::path::Path;
use std::time::Instant;

use clap::Args;
use shadowstep::tables::Source;
use shadowstep_scenes::ensemble::Ensemble;
use shadowstep_scenes::{Error, FileOptions, Format, Note, Observer, Outcome, Scene, Summary};

use crate::interrupt::Interrupt;
use crate::output::Output;
use crate::plot::{PlotFiles, Plots, of_rows};
use crate::progress::Progress;
use crate::report::{self, Status};

const EXAMPLE: &str = "\
Example:
  shadowstep scene kepler > scene.toml
  shadowstep run scene.toml";

const MORE: &str = "\
If a run is stopped, running its scene again resumes it from the last checkpoint. If its file is complete, nothing is \
done.

The summary is written to stderr: the error of H, the modified energy, close encounters, and a verdict on the \
step size. If rows of JSON are written to stdout, the summary on stderr is one object with the metadata. Beside a \
file of JSON lines, FILE.metadata.json has both.";

/// Runs a scene: a file that describes a run and its output.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE, after_long_help = format!("{EXAMPLE}\n\n{MORE}"))]
pub(crate) struct Arguments {
    /// The scene's file, such as scene.toml
    #[arg(value_name = "FILE")]
    scene: String,
    /// Begins again at t = 0
    ///
    /// It does so even if there is a checkpoint or the file is complete.
    #[arg(long)]
    restart: bool,
    /// Replaces a file that is not from this scene
    #[arg(long)]
    force: bool,
    /// Prolongs a complete run and its charts
    ///
    /// The scene may differ in its end only, `until` or `steps`, and must have checkpoints. The rows that are there
    /// stay; its charts are drawn again.
    #[arg(long = "continue", conflicts_with_all = ["restart", "force"])]
    continues: bool,
    /// No summary of the run
    ///
    /// Only what the scene asks for is computed.
    #[arg(long)]
    no_summary: bool,
    /// Exit code 1 unless bounded or round-off
    #[arg(long, conflicts_with = "no_summary")]
    strict: bool,
}

/// Runs a scene.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let source = shadowstep_scenes::source(Path::new(&arguments.scene))?;
    if Ensemble::is_in(&source) {
        return ensemble(source, arguments);
    }
    let scene = Scene::read(source)?;
    if !scene.output.summary {
        arguments.refuse_strict("[output] of the scene has `summary = false`", "remove that line, or --strict")?;
    }
    scene.notes.iter().for_each(report::note);
    let plot = scene.output.plot.as_ref();
    let files =
        plot.map(|plot| PlotFiles::of_scene(&scene, plot, (arguments.force, arguments.continues))).transpose()?;
    let interrupt = Interrupt::listen(&scene.source.path, again(&scene));
    if let (Some(files), Some(plot)) = (&files, plot) {
        files.can_be_written(&scene, plot)?;
    }
    let begin = Instant::now();
    let progress = Progress::of_run(scene.output.file.is_some(), scene.as_run().name(), scene.posed().expected_steps());
    let mut terminal = Terminal { progress, interrupt: &interrupt, summarises: !arguments.no_summary, summary: None };
    let outcome = match scene.output.file {
        Some(_) => scene.run_to_file(arguments.options(), &mut terminal)?,
        None => scene.run_into(&mut Output::stdout(), &mut terminal)?,
    };
    let summary = terminal.summary.take();
    drop(terminal);
    if let Some(files) = &files {
        let is_new = matches!(outcome, Outcome::Complete { .. });
        let is_missing = outcome == Outcome::AlreadyComplete && !files.exist();
        if is_new || is_missing {
            draw(&scene, files)?;
        }
    }
    ended((&scene, outcome, begin), summary.as_ref(), arguments.strict)
}

/// Reports how a run ended, with its summary.
fn ended(
    (scene, outcome, begin): (&Scene, Outcome, Instant),
    summary: Option<&Summary>,
    strict: bool,
) -> Result<Status, Error> {
    match outcome {
        Outcome::Complete { steps, force_evaluations } => {
            if io::stderr().is_terminal() {
                let seconds = begin.elapsed().as_secs_f64();
                report::note(format_args!(
                    "{steps} steps, {force_evaluations} force evaluations, {seconds:.3} seconds"
                ));
            }
            Ok(concluded(scene, summary, strict))
        }
        Outcome::AlreadyComplete if strict => {
            let message =
                format!("--strict needs the verdict of a run, and {} is done: its file is complete", scene.source.path);
            Err(Error::usage(message, "add --restart to run it again"))
        }
        Outcome::AlreadyComplete => {
            is_done(scene);
            Ok(Status::Success)
        }
        Outcome::Stopped { n } => {
            Err(Error::run(format!("{}: interrupted at n = {n}", scene.source.path), again(scene)))
        }
    }
}

/// Computes an ensemble: a row for each trajectory, to the file of the scene or to stdout.
fn ensemble(source: Source, arguments: &Arguments) -> Result<Status, Error> {
    arguments.refuse_strict("an ensemble has none", "remove --strict")?;
    let ensemble = Ensemble::read(source)?;
    let scene = ensemble.first();
    scene.notes.iter().for_each(report::note);
    let _interrupt = Interrupt::listen(&scene.source.path, "run the scene again");
    if scene.output.file.is_none() {
        ensemble.run_into(&mut Output::stdout(), || true)?;
    } else if ensemble.run_to_file(arguments.options(), || true)? {
        is_done(scene);
    }
    Ok(Status::Success)
}

/// Reports that nothing was computed.
fn is_done(scene: &Scene) {
    report::note(format_args!("{} is done: its file is complete; --restart runs it again", scene.source.path));
}

impl Arguments {
    /// Refuses --strict where there is no summary.
    fn refuse_strict(&self, why: &str, hint: &str) -> Result<(), Error> {
        let message = || format!("--strict needs the verdict of a summary, and {why}");
        if self.strict { Err(Error::usage(message(), hint)) } else { Ok(()) }
    }

    fn options(&self) -> FileOptions {
        FileOptions { restart: self.restart, force: self.force }
    }
}

/// What can be done after an interruption.
fn again(scene: &Scene) -> &'static str {
    match scene.output.checkpoint {
        Some(_) => "run the scene again to resume it",
        None => "with `checkpoint = \"1 min\"` in [output] it could be resumed",
    }
}

/// Draws the charts from the rows of the complete file: those of a resumed run show all of it.
fn draw(scene: &Scene, files: &PlotFiles) -> Result<(), Error> {
    let (Some(plot), Some((rows, _))) = (&scene.output.plot, &scene.output.file) else { return Ok(()) };
    let title = Path::new(&scene.source.path).file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut plots = Plots::new(title, plot.pictures.clone());
    of_rows(&mut plots, scene, rows, scene.as_run().name())?;
    files.write(&plots.svgs())
}

/// Writes the summary, and gives the status that it means.
fn concluded(scene: &Scene, summary: Option<&Summary>, strict: bool) -> Status {
    match (scene.output.format, &scene.output.file, summary) {
        (Format::JsonLines, None, Some(summary)) => {
            report::write(serde_json::json!({ "metadata": scene.metadata(), "summary": summary }));
        }
        (_, _, Some(summary)) => report::summary(summary, false),
        _ => {}
    }
    let fine = !strict || summary.is_none_or(|summary| summary.is_bounded() && summary.is_of_whole_run());
    if fine { Status::Success } else { Status::NegativeAnswer }
}

/// Watches a run for the user: a bar and notes on stderr, and Ctrl-C.
pub(crate) struct Terminal<'a> {
    pub(crate) progress: Progress,
    pub(crate) interrupt: &'a Interrupt,
    pub(crate) summarises: bool,
    pub(crate) summary: Option<Summary>,
}

impl Observer for Terminal<'_> {
    fn progress(&mut self, n: i64) {
        self.progress.reach(n);
    }

    fn note(&mut self, note: &Note) {
        self.progress.suspend(|| report::note(note));
    }

    fn summarises(&self) -> bool {
        self.summarises
    }

    fn summary(&mut self, summary: &Summary) {
        self.summary = Some(summary.clone());
    }

    fn stops(&mut self) -> bool {
        self.interrupt.ends()
    }
}
