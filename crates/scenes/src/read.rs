//! The text of a scene → the scene, or all its faults.
//!
//! | module | what it is |
//! | --- | --- |
//! | `reader`, `units` | values of their kinds, in the units of the scene |
//! | `problem`, `given`, `shipped`, `formula`, `pair`, `planets`, `doubled`, `many_parts`, `magnetic` | the ways to give a system |
//! | `bodies`, `elements`, `horizons`, `of_bodies`, `cutoff`, `encounters` | bodies, their states and energies |
//! | `kinetic`, `slow`, `parts`, `explicit_time`, `time` | T(p), how H is split, and how time runs |
//! | `initial`, `run`, `output`, `values`, `plot`, `modified_hamiltonian` | the other sections |
//! | `names`, `numbers`, `variables`, `unused` | names in formulas |
//! | [`family`] | scenes that differ in the values of some names |

mod bodies;
mod cutoff;
mod doubled;
mod elements;
mod encounters;
mod explicit_time;
pub mod family;
mod formula;
mod given;
mod horizons;
mod initial;
mod kinetic;
mod magnetic;
mod many_parts;
mod modified_hamiltonian;
mod names;
mod numbers;
mod of_bodies;
mod output;
mod pair;
mod parts;
mod planets;
mod plot;
mod problem;
mod reader;
mod run;
mod shipped;
mod slow;
mod time;
mod units;
mod unused;
mod values;
mod variables;

use std::io::ErrorKind;
use std::mem::take;
use std::path::Path;

use num_traits::Zero as _;
use shadowstep::tables::{Faults, First, Source};
use shadowstep_schemes::document::{self, read_text, valid_document};
use shadowstep_schemes::symbolic::{Exact, nearest};
use toml::de::DeTable;

use crate::document::keys::{ENSEMBLE, INITIAL, OF_SYSTEM, OUTPUT, RUN, SECTIONS, TIME, section_with};
use crate::document::library::Schemes;
use crate::document::schema::{Table, has_form, refuse_unknown};
use crate::document::shipped::scene_names;
use crate::execution::crossings::NEEDS_PARTS_OF_STEPS;
use crate::read::reader::Reader;
use crate::run::arithmetic::Arithmetic;
use crate::run::note::Note;
use crate::scene::{InitialValueProblem, Outputs, PotentialEnergy, Scene, System};
use crate::texts::error::Error;

/// The most bytes of a scene, which may have the initial values of many bodies.
const LARGEST_SCENE: u64 = 16 << 20;

impl Scene {
    /// Reads a scene from its file.
    ///
    /// # Errors
    /// A file that cannot be read; all faults of its text.
    pub fn open(path: impl AsRef<Path>) -> Result<Scene, Error> {
        Ok(Scene::read(source(path.as_ref())?)?)
    }

    /// Reads a scene from its text; paths in it are relative to the folder of its own path.
    ///
    /// ```
    /// use shadowstep::tables::Source;
    /// use shadowstep_scenes::Scene;
    ///
    /// let text = "[problem]\nname = \"keppler\"".to_owned();
    /// let faults = Scene::read(Source { path: "scene.toml".to_owned(), text }).unwrap_err();
    /// let fault = faults.0.iter().find(|fault| fault.line == 2).unwrap();
    /// assert_eq!((fault.column, fault.message.as_str()), (8, "there is no problem `keppler`"));
    /// assert_eq!(fault.hint.as_deref(), Some("did you mean `kepler`?"));
    /// ```
    ///
    /// # Errors
    /// All faults of the text, each with its place.
    pub fn read(source: Source) -> Result<Scene, Faults> {
        Scene::read_with(source, &[])
    }

    /// As [`read`](Scene::read) for what writes no rows: \[output\] can be left out.
    ///
    /// # Errors
    /// As [`read`](Scene::read).
    pub fn read_without_output(source: Source) -> Result<Scene, Faults> {
        Scene::read_with(source, &["output"])
    }

    fn read_with(source: Source, others: &'static [&'static str]) -> Result<Scene, Faults> {
        let names = Names { numbers: Vec::new(), others, schemes: &Schemes::default() };
        let scene = read(&source, &valid_document(&source)?, &names)?;
        Ok(Scene { source, ..scene })
    }
}

/// What the text of a scene may contain besides a scene.
pub(crate) struct Names<'a> {
    /// Names that its numbers can contain, with their values.
    pub(crate) numbers: Vec<(String, Exact)>,
    /// Sections that need not be there, or are not of the scene; with them, [output] can be left out.
    pub(crate) others: &'static [&'static str],
    /// The schemes that have been read.
    pub(crate) schemes: &'a Schemes,
}

/// The scene of a document.
pub(crate) fn read(source: &Source, document: &DeTable<'_>, names: &Names<'_>) -> Result<Scene, Faults> {
    refuse_ensemble(source, document, names.others)?;
    let read = |is_cursory| {
        let mut reader = Reader::new(source, names.numbers.clone(), Arithmetic::DOUBLE);
        reader.is_cursory = is_cursory;
        let scene = scene(&mut reader, document, names);
        (reader.toml.faults, scene)
    };
    // a fault in another key is found before that
    if takes_long(document)
        && let Some(faults) = Faults::of(read(true).0)
    {
        return Err(faults);
    }
    let (faults, scene) = read(false);
    Faults::or(faults, scene)
}

/// Whether a scene has what takes long to read: formulas of a modified Hamiltonian, a file of particles, the proof of a
/// table.
fn takes_long(document: &DeTable<'_>) -> bool {
    let value = |section: &str, key: &str| document.get(section)?.get_ref().as_table()?.get(key);
    let has_table = value("run", "scheme").and_then(|word| word.get_ref().as_str()).is_some_and(run::is_table);
    has_table || value("output", modified_hamiltonian::KEY).is_some() || value("problem", "particles").is_some()
}

/// The map that the steps of a scene begin with, whatever else it contains; `None` if \[run\] has no `first`.
///
/// # Errors
/// A text that is not TOML; a word that is not a map.
pub fn first_map(source: &Source) -> Result<Option<First>, Faults> {
    let document = valid_document(source)?;
    let run = document.get("run").and_then(|run| run.get_ref().as_table());
    let mut reader = document::Reader::new(source, Vec::new());
    let first = run.and_then(|run| run.get("first")).and_then(|value| reader.word(value, &run::FIRST));
    Faults::of(reader.faults).map_or(Ok(first.map(|first| first.value)), Err)
}

/// The text of a scene's file.
///
/// # Errors
/// A file that cannot be read.
pub fn source(path: &Path) -> Result<Source, Error> {
    let shown = path.display().to_string();
    let example = "give the path of a scene; `shadowstep scene kepler > scene.toml` writes one";
    let refuse = |message: String| Error::usage(message, example);
    match read_text(path, LARGEST_SCENE) {
        Ok(text) if text.trim().is_empty() => Err(refuse(format!("{shown} is empty"))),
        Ok(text) => Ok(Source { path: shown, text }),
        Err(error) if error.kind() == ErrorKind::NotFound => {
            let known = match shown.strip_suffix(".toml") {
                Some(name) => scene_names().find(|known| *known == name),
                None => nearest(&shown, scene_names()),
            };
            let hint = known.map(|name| {
                format!("`shadowstep scene {name} > {name}.toml` writes a scene, `shadowstep run {name}.toml` runs it")
            });
            Err(Error::usage(format!("there is no file {shown}"), hint.unwrap_or_else(|| example.to_owned())))
        }
        Err(error) if error.kind() == ErrorKind::InvalidData => Err(refuse(format!("{shown} is not a text in UTF-8"))),
        Err(error) => Err(refuse(format!("{shown} cannot be read: {error}"))),
    }
}

impl System {
    /// Reads the sections \[problem\] and \[initial\] of a scene, whatever the others are; values are exact, and
    /// computed to the digits of a run in this arithmetic. The notes are what the user should know of it.
    ///
    /// # Errors
    /// All faults of these sections, each with its place.
    pub fn read(source: &Source, arithmetic: Arithmetic) -> Result<(System, Vec<Note>), Faults> {
        let document = valid_document(source)?;
        refuse_ensemble(source, &document, &[])?;
        let mut reader = Reader::new(source, Vec::new(), arithmetic);
        refuse_unknown(&mut reader.toml, &document, &SECTIONS, (&["problem"], &[]), section_with);
        let system = system_of_form(&mut reader, &document);
        Ok((Faults::or(reader.toml.faults, system)?, reader.notes))
    }

    /// The system of a document whose sections are known, with these names in its numbers.
    ///
    /// # Errors
    /// All faults of its sections.
    pub(crate) fn read_of(
        source: &Source,
        document: &DeTable<'_>,
        names: Vec<(String, Exact)>,
        arithmetic: Arithmetic,
    ) -> Result<System, Faults> {
        let mut reader = Reader::new(source, names, arithmetic);
        let system = system(&mut reader, document);
        Faults::or(reader.toml.faults, system)
    }
}

impl InitialValueProblem {
    /// q and p at t = 0 of a document that has the problem of this one, with these names in the numbers of \[initial\];
    /// `None` if they have a fault, or depend on more than the problem.
    pub(crate) fn read_state(
        &self,
        source: &Source,
        document: &DeTable<'_>,
        names: Vec<(String, Exact)>,
        arithmetic: Arithmetic,
    ) -> Option<(Vec<Exact>, Vec<Exact>)> {
        let mut reader = Reader::new(source, Vec::new(), arithmetic);
        reader.known.extend(self.parameters.iter().cloned());
        reader.known.extend(names);
        let initial = Table::of(reader.toml.source, document, &INITIAL);
        // p = m v + A(q) in a magnetic field
        if matches!(self.potential, PotentialEnergy::OfParts) && initial.get("v").is_some() {
            return None;
        }
        let state = initial::state_of(&mut reader, &initial, self);
        let is_at_start = !self.explicit_time || state.0.last().is_none_or(|t| t.value.is_zero());
        (reader.toml.faults.is_empty() && is_at_start).then_some(state)
    }
}

/// The system in the parts that its steps have.
fn system(reader: &mut Reader<'_>, root: &DeTable<'_>) -> Option<System> {
    let bodies = planets::given(reader, root);
    let system = problem::system(reader, root, &bodies);
    time::transformed(reader, &Table::of(reader.toml.source, root, &TIME), system)
}

/// The system, if its sections have the form that their keys have.
fn system_of_form(reader: &mut Reader<'_>, root: &DeTable<'_>) -> Option<System> {
    if !has_form(&mut reader.toml, root, &OF_SYSTEM, section_with) {
        return None;
    }
    let system = system(reader, root);
    unused::refuse_unused_parameters(reader, root);
    system
}

fn scene(reader: &mut Reader<'_>, root: &DeTable<'_>, names: &Names<'_>) -> Option<Scene> {
    let required: &[&str] = if names.others.is_empty() { &["problem", "run", "output"] } else { &["problem", "run"] };
    refuse_unknown(&mut reader.toml, root, &SECTIONS, (required, names.others), section_with);
    let [has_run, has_output] =
        [&RUN, &OUTPUT].map(|section| has_form(&mut reader.toml, root, &[section], section_with));
    let [run, output] = [&RUN, &OUTPUT].map(|section| Table::of(reader.toml.source, root, section));
    // the digits come first: values are computed to them
    let known = reader.toml.faults.len();
    let arithmetic = run::arithmetic(reader, &run);
    reader.arithmetic = arithmetic.unwrap_or(Arithmetic::DOUBLE);
    if !has_run {
        reader.toml.faults.truncate(known);
    }
    let system = system_of_form(reader, root);
    let (of_system, is_transformed) = (system.as_ref(), root.contains_key(TIME.name()));
    let steps = if has_run { run::Steps::read(reader, &run, (of_system, is_transformed), names.schemes) } else { None };
    let output = if has_output { output::read(reader, &output, of_system, steps.as_ref()) } else { None };
    if let (Some(run::Steps { displaced: true, .. }), Some(Outputs { section: Some(_), .. })) = (&steps, &output) {
        let help = "write gradient_kicks = \"exact\", or write states with `every`";
        reader.toml.fault(&run.at, NEEDS_PARTS_OF_STEPS, help);
    }
    let run::Steps { scheme, displaced, h, until, steps, end_at, ends } = steps?;
    Some(Scene {
        source: reader.toml.source.clone(),
        arithmetic: arithmetic?,
        system: system?,
        scheme,
        displaced,
        h,
        until,
        end_at,
        ends,
        steps,
        output: output?,
        files: take(&mut reader.files),
        notes: take(&mut reader.notes),
    })
}

/// Refuses the section of an ensemble where there is to be one scene, and nothing else: its numbers contain names
/// without values.
fn refuse_ensemble(source: &Source, root: &DeTable<'_>, others: &[&str]) -> Result<(), Faults> {
    match root.get_key_value(ENSEMBLE.name()).filter(|_| !others.contains(&ENSEMBLE.name())) {
        Some((key, _)) => {
            let fault = source.fault(&key.span(), "an ensemble is computed by `shadowstep run` only");
            Err(Faults(vec![fault.hint("remove [ensemble], or give one trajectory's values")]))
        }
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::schema::{Key, Section};

    /// The faults of a scene, each as `line:column: sentence`.
    fn faults(text: &str) -> Vec<String> {
        match Scene::read(Source { path: "test.toml".to_owned(), text: text.to_owned() }) {
            Err(Faults(faults)) => {
                faults.iter().map(|fault| format!("{}:{}: {}", fault.line, fault.column, fault.message)).collect()
            }
            other => panic!("{other:?}"),
        }
    }

    /// All keys with their sections.
    fn rows() -> impl Iterator<Item = (&'static Section, &'static Key)> {
        let sections = SECTIONS.into_iter().take(6).flat_map(|section| [section].into_iter().chain(section.tables()));
        sections.flat_map(|section| section.keys.iter().map(move |key| (section, key)))
    }

    #[test]
    fn every_key_that_is_explained_is_read() {
        // a date is a value of no key
        for (section, key) in rows() {
            let text = format!("{}\n{} = 2001-01-01", section.heading, key.name);
            let wrong = format!("2:{}: this value is of the wrong kind", key.name.len() + 4);
            assert!(faults(&text).contains(&wrong), "{text}: {:?}", faults(&text));
        }
    }

    #[test]
    fn keys_that_are_not_explained_are_refused() {
        for section in SECTIONS[..6].iter().flat_map(|section| [*section].into_iter().chain(section.tables())) {
            if section.names.is_some() {
                continue;
            }
            let text = format!("{}\nfrobnicate = 1", section.heading);
            assert!(faults(&text).contains(&"2:1: unknown key `frobnicate`".to_owned()), "{text}: {:?}", faults(&text));
        }
    }

    #[test]
    fn words_of_other_programs_are_translated() {
        for (section, word, key) in
            [("run", "dt", "step"), ("body", "inc", "i"), ("problem", "mass", "masses"), ("body", "m", "mass")]
        {
            let heading = if section == "body" { "[[body]]" } else { &format!("[{section}]") };
            let source = Source { path: "test.toml".to_owned(), text: format!("{heading}\n{word} = 1") };
            let Faults(faults) = Scene::read(source).unwrap_err();
            let hint = Some(format!("did you mean `{key}`?"));
            assert!(
                faults.iter().any(|fault| fault.message.contains(word) && fault.hint == hint),
                "{word}: {faults:?}"
            );
        }
    }

    #[test]
    fn every_section_is_explained() {
        for (_, key) in rows() {
            assert!(!key.meaning.is_empty() && !key.example.is_empty(), "{}", key.name);
        }
    }

    #[test]
    fn the_examples_are_readable_values() {
        for (section, key) in rows() {
            let text = format!("{}\n{} = {}", section.heading, key.name, key.example);
            let faults = faults(&text);
            assert!(!faults.iter().any(|fault| fault.contains("wrong kind")), "{text}: {faults:?}");
        }
    }
}
