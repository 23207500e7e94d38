//! The files of charts.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use shadowstep::tables::Faults;
use shadowstep_scenes::plot::{Picture, Plot};
use shadowstep_scenes::{Error, Scene, WholeFile};

/// Refuses a file of `--plot` whose name does not end in .svg.
pub(crate) fn check_ending(path: &Path, example: &str) -> Result<(), Error> {
    match path.extension() {
        Some(ending) if ending == "svg" => Ok(()),
        _ => {
            let message = format!("--plot {} is not the name of an SVG file", path.display());
            Err(Error::usage(message, format!("give a name such as {example}")))
        }
    }
}

/// The files of charts, and what is written into them beside the pictures.
#[derive(Debug)]
pub(crate) struct PlotFiles {
    paths: Vec<PathBuf>,
    /// In messages, what names the file.
    named: &'static str,
    /// A comment in front of the picture, by which a scene recognises its own charts.
    head: String,
    replaces: bool,
}

impl PlotFiles {
    /// The files of `--plot`, none of which may exist without `--force`.
    pub(super) fn of_flag(path: &Path, pictures: &[Picture], force: bool) -> Result<Self, Error> {
        check_ending(path, "trace.svg")?;
        let files = PlotFiles { paths: paths(path, pictures), named: "--plot", head: String::new(), replaces: force };
        files.paths.iter().try_for_each(|path| files.open(path).map(drop))?;
        Ok(files)
    }

    /// The files of a scene's charts; those that exist must be from this unchanged scene, with `--continue` from that
    /// which is prolonged, or are replaced with `--force`.
    pub(crate) fn of_scene(scene: &Scene, plot: &Plot, (force, continues): (bool, bool)) -> Result<Self, Error> {
        let metadata = scene.metadata();
        let hash = metadata["scene_sha256"].as_str().unwrap_or_default();
        let head = format!("<!-- shadowstep {}, scene_sha256: {hash} -->\n", env!("CARGO_PKG_VERSION"));
        let files = PlotFiles { paths: paths(&plot.file, &plot.pictures), named: "plot", head, replaces: true };
        let earlier = continues.then(|| scene.prolonged_sha256()).flatten();
        for path in &files.paths {
            let is_own = |path| {
                let text = fs::read_to_string(path).unwrap_or_default();
                text.lines().next().is_some_and(|line| {
                    line.contains(hash) || earlier.as_ref().is_some_and(|earlier| line.contains(earlier))
                })
            };
            if path.is_file() && !force && !is_own(path) {
                let message = format!("{} already exists and is not from this unchanged scene", path.display());
                let hint =
                    "use another name, move the file, or replace it with --force; --continue prolongs a complete run";
                return Err(at(scene, plot, Error::usage(message, hint)));
            }
        }
        Ok(files)
    }

    /// Shows that a scene's charts can be written, by files under temporary names: signals must be handled, so that
    /// none stays.
    pub(crate) fn can_be_written(&self, scene: &Scene, plot: &Plot) -> Result<(), Error> {
        let mut new = self.paths.iter().filter(|path| !path.is_file());
        new.try_for_each(|path| self.open(path).map(drop).map_err(|error| at(scene, plot, error)))
    }

    /// A file under a temporary name; dropped, it only shows that the chart can be written.
    fn open(&self, path: &Path) -> Result<WholeFile, Error> {
        if self.replaces { WholeFile::create(path, self.named) } else { WholeFile::create_new(path, self.named) }
    }

    /// Whether all charts have been written.
    pub(crate) fn exist(&self) -> bool {
        self.paths.iter().all(|path| path.exists())
    }

    /// Writes the charts.
    pub(crate) fn write(&self, svgs: &[String]) -> Result<(), Error> {
        for (path, svg) in self.paths.iter().zip(svgs) {
            let mut file = self.open(path)?;
            file.write_all(self.head.as_bytes())?;
            file.write_all(svg.as_bytes())?;
            file.finish()?;
        }
        Ok(())
    }
}

/// An error with the place of the scene's key.
fn at(scene: &Scene, plot: &Plot, error: Error) -> Error {
    match error {
        Error::Usage { message, hint } => Faults(vec![scene.source.fault(&plot.at, message).hint(hint)]).into(),
        other => other,
    }
}

/// The file itself for the first chart, with the charts' names for the others.
fn paths(file: &Path, pictures: &[Picture]) -> Vec<PathBuf> {
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    let others = pictures.iter().skip(1).map(|picture| file.with_file_name(format!("{stem}-{}.svg", picture.name())));
    std::iter::once(file.to_owned()).chain(others).collect()
}
