//! A plan: the scene, the axes and what is kept, read from a file.

mod check;
mod digests;

use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use shadowstep::tables::{Faults, Source};
use shadowstep_scenes::cpu_time::CpuTime;
use shadowstep_scenes::family::Family;
use shadowstep_scenes::outside::path_within;
use shadowstep_scenes::{Error, Scene, elementary_functions, source};
use shadowstep_schemes::document::{Fault, Reader, document};
use toml::de::{DeTable, DeValue};

use crate::sweeps::axes::Axes;
use crate::sweeps::keep::{Column, Keep};
use crate::sweeps::keys;
use crate::sweeps::picture::Picture;
use crate::sweeps::record::{Record, measured};
pub(crate) use digests::Digests;
pub(crate) use digests::hash;

/// The sections and keys of a sweep that are not of its scene.
const OTHERS: &[&str] = &["scene", "axes", "zip", "keep", "picture"];

/// The sections of a scene.
const OF_SCENE: [&str; 7] = ["problem", "body", "initial", "time", "run", "output", "ensemble"];

/// Many runs of a scene: its text, the axes, and what is kept of each run.
///
/// ```
/// use std::sync::atomic::AtomicBool;
///
/// use shadowstep::tables::Source;
/// use shadowstep_studies::sweeps::SweepPlan;
///
/// let text = r#"
/// [problem]
/// name = "kepler"
/// parameters.eccentricity = "e"
/// [run]
/// scheme = "stormer-verlet"
/// step = "h"
/// until = 10
/// digits = "double"
/// [axes]
/// e = "0 … 9/10 in 9 steps"
/// h = "1/10 … 1/100 in 9 steps of 1/h"
/// [keep]
/// values = ["energy_error"]
/// "#;
/// let plan = SweepPlan::of(&Source { path: "sweep.toml".to_owned(), text: text.to_owned() })?;
/// assert_eq!(plan.axes().runs(), 100);
/// assert_eq!(plan.axes().described(18), "e = 1/10, h = 1/90");
/// let record = plan.run(18, &AtomicBool::new(false)).unwrap();
/// let error: f64 = record.values[0].as_ref().unwrap().parse()?;
/// assert!((1e-7..1e-4).contains(&error), "{error}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SweepPlan {
    /// The text of the plan with its path.
    pub(crate) source: Source,
    /// The scenes of all runs.
    pub(crate) family: Family,
    axes: Axes,
    pub(crate) keep: Keep,
    pub(crate) columns: Vec<Column>,
    picture: Option<Picture>,
    /// Whether numbers have more digits than double precision.
    pub(crate) long_numbers: bool,
    pub(crate) digests: Digests,
}

impl SweepPlan {
    /// Reads a plan from its file.
    ///
    /// # Errors
    /// A file that cannot be read; all faults of its text, or of that of the scene.
    pub fn open(path: impl AsRef<Path>) -> Result<SweepPlan, Error> {
        let read = source(path.as_ref()).map_err(|error| match error {
            Error::Usage { message, .. } => {
                Error::usage(message, "give the path of a sweep, see `shadowstep sweep --explain`")
            }
            other => other,
        });
        SweepPlan::of(&read?)
    }

    /// Reads a plan from its text; paths in it are relative to the folder of its own path.
    ///
    /// # Errors
    /// As [`open`](SweepPlan::open).
    pub fn of(source: &Source) -> Result<SweepPlan, Error> {
        let document = document_of(source)?;
        let mut reader = Reader::new(source, Vec::new());
        let has_form = keys::have_form(&mut reader, &document);
        let separate = separate_scene(&mut reader, &document)?;
        let read = has_form.then(|| (Axes::read(&mut reader, &document), Keep::read(&mut reader, &document)));
        refuse(reader.faults)?;
        let Some((Some(axes), Some(keep))) = read else { unreachable!("what cannot be read is a fault") };
        let others: &[&str] = if separate.is_some() { &["picture"] } else { OTHERS };
        let family = Family::new(separate.unwrap_or_else(|| without_lists(source, &document)), others);
        let mut reader = Reader::new(source, Vec::new());
        check::axes(&mut reader, &document, &family, &axes)?;
        refuse(std::mem::take(&mut reader.faults))?;
        let first = first_scene(&family, &axes)?;
        check::scene(&mut reader, &document, &keep, &first);
        let state: Vec<String> = first.system.coordinates.iter().chain(&first.system.momenta).cloned().collect();
        let columns = keep.columns(&state);
        check::columns(&mut reader, &document, &axes, &keep, &columns);
        refuse(std::mem::take(&mut reader.faults))?;
        let picture = Picture::read(&mut reader, &document, &axes, &columns);
        refuse(reader.faults)?;
        let digests = digests::of(&document, (&family, &first), &axes)?;
        let long_numbers = first.arithmetic.is_longer_than_double() || axes.find("digits").is_some();
        Ok(SweepPlan { family, axes, keep, columns, picture, long_numbers, digests, source: source.clone() })
    }

    /// The hash of the elementary functions that double precision has on this machine.
    pub(crate) fn functions(&self) -> Option<&'static str> {
        (!self.long_numbers).then(elementary_functions)
    }

    /// The axes, and with them the number of runs.
    pub fn axes(&self) -> &Axes {
        &self.axes
    }

    /// What the values of a record are.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The picture; `None` where nothing can be drawn.
    pub fn picture(&self) -> Option<&Picture> {
        self.picture.as_ref()
    }

    /// What determines the results.
    pub fn digests(&self) -> &Digests {
        &self.digests
    }

    /// The scene of a run.
    ///
    /// # Errors
    /// Faults of the scene's text with the values of the run.
    pub fn scene(&self, run: u64) -> Result<Scene, Faults> {
        self.family.scene(&self.axes.values(run))
    }

    /// Makes a run; `None` if it was stopped. A run that fails is a record, too.
    pub fn run(&self, run: u64, stops: &AtomicBool) -> Option<Record> {
        match self.scene(run) {
            Ok(scene) => measured(run, &scene, &self.keep, stops),
            Err(faults) => Some(Record::failed(run, faults.0[0].message.clone())),
        }
    }
}

/// The axes and the picture of a sweep's text, with which its results are collected.
pub(crate) fn axes_and_picture(source: &Source, columns: &[Column]) -> Result<(Axes, Option<Picture>), Error> {
    let document = document_of(source)?;
    let mut reader = Reader::new(source, Vec::new());
    let axes = keys::have_form(&mut reader, &document).then(|| Axes::read(&mut reader, &document)).flatten();
    let picture = axes.as_ref().and_then(|axes| Picture::read(&mut reader, &document, axes, columns));
    refuse(reader.faults)?;
    Ok((axes.expect("what cannot be read is a fault"), picture))
}

/// The tables of a text, which has no faults as TOML.
fn document_of(source: &Source) -> Result<DeTable<'_>, Faults> {
    let (document, faults) = document(source);
    document.filter(|_| faults.is_empty()).ok_or(Faults(faults))
}

fn refuse(faults: Vec<Fault>) -> Result<(), Error> {
    Faults::of(faults).map_or(Ok(()), |faults| Err(faults.into()))
}

/// The text with blanks in place of the lists of the axes, which may be long, and are not read again for each run.
fn without_lists(source: &Source, document: &DeTable<'_>) -> Source {
    let mut bytes = source.text.clone().into_bytes();
    if let Some(DeValue::Table(axes)) = document.get("axes").map(|axes| axes.get_ref()) {
        for list in axes.values().filter(|value| matches!(value.get_ref(), DeValue::Array(_))) {
            let inside = list.span().start + 1..list.span().end - 1;
            bytes[inside].iter_mut().filter(|byte| **byte != b'\n').for_each(|byte| *byte = b' ');
        }
    }
    let text = String::from_utf8(bytes).expect("whole characters were replaced");
    Source { path: source.path.clone(), text }
}

/// The text of the scene if `scene` names its file.
fn separate_scene(reader: &mut Reader<'_>, root: &DeTable<'_>) -> Result<Option<Source>, Error> {
    let Some(value) = root.get("scene") else {
        let is_known = |key: &str| OTHERS.contains(&key) || OF_SCENE.contains(&key);
        for (key, _) in root.iter().filter(|(key, _)| !is_known(key.get_ref())) {
            let hint = format!("the sections of a sweep are those of a scene, and {}", OTHERS[1..].join(", "));
            reader.fault(&key.span(), format!("unknown section `{}`", key.get_ref()), hint);
        }
        return Ok(None);
    };
    for (key, _) in root.iter().filter(|(key, _)| !OTHERS.contains(&key.get_ref().as_ref())) {
        let message = format!("`{}` and a scene's file are both given", key.get_ref());
        reader.fault(&key.span(), message, "write the section in the scene, or remove `scene`");
    }
    let Some(path) = reader.text(value) else { return Ok(None) };
    match path_within(reader.source, &path).map_err(Error::from).and_then(|path| source(&path)) {
        // of a file that is no scene, no line is shown
        Ok(source) if !document(&source).1.is_empty() => {
            let hint = format!("`shadowstep run {}` shows its faults", source.path);
            Ok(reader.wrong(&path.at, format!("{} is not TOML", source.path), hint))
        }
        Ok(source) => Ok(Some(source)),
        Err(Error::Usage { message, hint }) => Ok(reader.wrong(&path.at, message, hint)),
        Err(Error::Faults(faults)) => {
            reader.faults.extend(faults.0);
            Ok(None)
        }
        Err(other) => Err(other),
    }
}

/// How many scenes are tried.
const TRIED: u64 = 64;

/// The CPU time for which others are tried: a scene with a fault may have formulas that take long.
const PATIENCE: Duration = Duration::from_secs(1);

/// A scene of the sweep with the number of its run. Where the first run has faults, as one at the corner of a map may
/// have, others are tried, spread over all.
fn first_scene(family: &Family, axes: &Axes) -> Result<Scene, Faults> {
    let scene = |run| family.scene(&axes.values(run));
    // all of few; of many, the multiples of the golden ratio are spread evenly
    let spread = |k: u64| match axes.runs() {
        runs if runs <= TRIED => k,
        runs => ((k as f64 * 0.618_033_988_749_895).fract() * runs as f64) as u64,
    };
    let begun = CpuTime::begin();
    let mut others = (1..TRIED.min(axes.runs())).take_while(|_| begun.elapsed() < PATIENCE);
    let mut other = || others.find_map(|k| scene(spread(k).min(axes.runs() - 1)).ok());
    scene(0).or_else(|faults| other().ok_or(faults)).map_err(|faults| check::with_axes(faults, axes))
}
