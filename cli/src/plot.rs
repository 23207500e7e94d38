//! Charts of runs: energies in time, orbits, distances of bodies.
//!
//! A [`RunLines`] takes the states of a run one by one and keeps what a picture can show of them; [`Plots`] has those
//! of all runs, and writes the charts.
//!
//! | module | what it is |
//! | --- | --- |
//! | `lines` | the curves of a run |
//! | `thin` | points in time, and orbits, of which a run may have many |
//! | `charts` | curves → charts |
//! | `files` | the files of the charts |
//! | `rows` | the curves of a run from the file that it has written |

mod charts;
mod files;
mod lines;
mod rows;
mod thin;

pub(crate) use files::{PlotFiles, check_ending};
pub(crate) use lines::{RunLines, Values};
pub(crate) use rows::of_rows;

use clap::Args;
use shadowstep::Real;
use shadowstep_scenes::plot::{MOST_CURVES, Picture};
use shadowstep_scenes::{Error, System};
use std::path::PathBuf;

use crate::headings::CHARTS;
use lines::RunOfChart;

/// What can be drawn, for the help.
pub(crate) const KINDS: &str = "\
Charts:
  energies              the changes of H and of the modified energy H̄ in time
  orbit=x:y             a \
coordinate or momentum against another
  orbit=x:px            the same, as a phase \
portrait
  distance              of every two bodies in time, or from the origin
  distance=sun          of this body \
from the others
  distance=sun:jupiter  of these two bodies

The changes are |H - H(0)| and |H̄ - H̄*|, where H̄* is \
the H̄ with the least estimated error. A chart of one run also shows the estimated error of H̄. Without bodies, the \
distance is the one from the origin. Bodies have coordinates such as x_sun, y_sun or x1, y1; orbit=x:y shows all \
bodies.";

/// The charts of `trace`.
#[derive(Debug, Args)]
#[command(next_help_heading = CHARTS)]
pub(crate) struct PlotArguments {
    /// Draws a chart of the runs as SVG, such as trace.svg
    ///
    /// Rows are then written only with --json, --csv, --states or --output.
    #[arg(long, value_name = "FILE.svg", group = "written")]
    plot: Option<PathBuf>,
    /// Its charts: energies,orbit=x:y
    ///
    /// All kinds of charts are listed below. The first has the name FILE.svg, others have names such as
    /// FILE-orbit-x-y.svg.
    #[arg(long, value_name = "CHART,…", value_delimiter = ',', default_value = "energies", requires = "plot")]
    plot_of: Vec<String>,
}

/// The charts of one or several runs.
#[derive(Debug)]
pub(crate) struct Plots {
    title: String,
    pictures: Vec<Picture>,
    runs: Vec<RunOfChart>,
}

impl PlotArguments {
    /// The charts of a number of runs, and their files; `None` without `--plot`.
    pub(crate) fn read(
        &self,
        system: &System,
        title: &str,
        runs: usize,
        force: bool,
    ) -> Result<Option<(Plots, PlotFiles)>, Error> {
        let Some(path) = &self.plot else { return Ok(None) };
        let mut pictures: Vec<Picture> = Vec::new();
        for text in &self.plot_of {
            let picture = Picture::read(text, system)
                .map_err(|error| Error::usage(format!("--plot-of: {}", error.message), error.hint))?;
            if picture.content.curves() * runs > MOST_CURVES {
                let message = format!(
                    "--plot-of {text}: {runs} runs have {} curves; a chart has at most {MOST_CURVES}",
                    picture.content.curves() * runs
                );
                return Err(Error::usage(message, "plot fewer schemes and steps together"));
            }
            if pictures.contains(&picture) {
                return Err(Error::usage(format!("--plot-of {text} is given twice"), "keep one"));
            }
            pictures.push(picture);
        }
        let files = PlotFiles::of_flag(path, &pictures, force)?;
        Ok(Some((Plots::new(title.to_owned(), pictures), files)))
    }

    pub(crate) fn is_given(&self) -> bool {
        self.plot.is_some()
    }
}

impl Plots {
    pub(crate) fn new(title: String, pictures: Vec<Picture>) -> Self {
        Plots { title, pictures, runs: Vec::new() }
    }

    /// Whether a chart shows positions or momenta.
    pub(crate) fn needs_states(&self) -> bool {
        self.pictures.iter().any(|picture| picture.content.needs_states())
    }

    /// The empty lines of a run.
    pub(crate) fn run<N: Real>(&self, name: String, steps: u64) -> RunLines<N> {
        RunLines::new(name, steps, &self.pictures)
    }

    /// Adds the lines of a run.
    pub(crate) fn add<N: Real>(&mut self, run: RunLines<N>) {
        self.runs.push(run.finish());
    }

    /// The charts as SVG.
    pub(crate) fn svgs(&self) -> Vec<String> {
        let charts = self.pictures.iter().enumerate();
        charts.map(|(number, picture)| charts::chart(&self.title, picture, &self.runs, number).svg()).collect()
    }
}
