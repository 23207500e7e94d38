//! A scene's text → all that it asks for, or all its faults.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::Duration;

use shadowstep::Rational;
use shadowstep::number::Precision;
use shadowstep::shadow::Stop;
use shadowstep_schemes::First;
use shadowstep_schemes::fault::{Faults, Source};
use shadowstep_symbolic::decimal::to_text;
use shadowstep_symbolic::nearest;
use toml::de::{DeTable, DeValue};

use crate::arithmetic::{Arithmetic, DEFAULT_DIGITS, MOST_DIGITS, OTHER_SCHEME};
use crate::complaint::Complaint;
use crate::library::{self, Named};
use crate::order::{DEFAULT_LARGEST_M, HIGHEST_M, Order};
use crate::scene::keys::{self, SECTIONS};
use crate::scene::reader::{Reader, Section, Text, Value};
use crate::scene::system::System;
use crate::scene::write::Format;
use crate::steps::{self, Blamed, MOST_STEPS};

/// All that a scene asks for.
#[derive(Debug)]
pub(crate) struct Scene {
    pub(crate) source: Source,
    pub(crate) arithmetic: Arithmetic,
    pub(crate) system: System,
    pub(crate) scheme: Named,
    pub(crate) h: Rational,
    pub(crate) until: Rational,
    pub(crate) steps: u64,
    pub(crate) output: Asked,
}

/// What is to be written, and where.
#[derive(Debug)]
pub(crate) struct Asked {
    /// The file, and the place of its name in the scene.
    pub(crate) file: Option<(PathBuf, Range<usize>)>,
    pub(crate) format: Format,
    /// At each n that is a multiple of this.
    pub(crate) energy: Option<u64>,
    pub(crate) modified: Option<(Order, u64)>,
    pub(crate) trajectory: Option<u64>,
    pub(crate) checkpoint: Option<Cadence>,
}

/// How often a checkpoint is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Cadence {
    Steps(u64),
    Time(Duration),
}

impl Scene {
    /// # Errors
    /// All faults of the text.
    pub(crate) fn read(source: Source) -> Result<Scene, Complaint> {
        let (document, errors) = DeTable::parse_recoverable(&source.text);
        if let Some(error) = errors.first() {
            return Err(Complaint::Faults(Faults(vec![shadowstep_schemes::table::toml_fault(&source, error)])));
        }
        let arithmetic = Arithmetic::Double;
        let mut reader = Reader { source: &source, faults: Vec::new(), arithmetic, known: BTreeMap::new() };
        let parts = parts(&mut reader, document.get_ref());
        let arithmetic = reader.arithmetic;
        match (Faults::of(reader.faults), parts) {
            (None, Some((system, Steps { scheme, h, until, steps }, output))) => {
                Ok(Scene { source, arithmetic, system, scheme, h, until, steps, output })
            }
            (Some(faults), _) => Err(Complaint::Faults(faults)),
            (None, None) => unreachable!("what cannot be read is a fault"),
        }
    }

    /// A complaint about a value of the scene, at its place.
    pub(crate) fn at(&self, place: &Range<usize>, complaint: Complaint) -> Complaint {
        match complaint {
            Complaint::Usage { sentence, hint } => {
                Complaint::Faults(Faults(vec![self.source.fault(place, sentence).help(hint)]))
            }
            other => other,
        }
    }
}

fn parts(reader: &mut Reader<'_>, root: &DeTable<'_>) -> Option<(System, Steps, Asked)> {
    refuse_unknown_sections(reader, root);
    let (problem, initial) = (reader.section(root, "problem"), reader.section(root, "initial"));
    let (run, output) = (reader.section(root, "run"), reader.section(root, "output"));
    // the digits come first: values are computed to them
    let arithmetic = arithmetic(reader, &run);
    reader.arithmetic = arithmetic.unwrap_or(Arithmetic::Double);
    let system = System::read(reader, &problem, &initial);
    let steps = Steps::read(reader, &run);
    let asked = Asked::read(reader, &output);
    arithmetic?;
    Some((system?, steps?, asked?))
}

fn refuse_unknown_sections(reader: &mut Reader<'_>, root: &DeTable<'_>) {
    let names: Vec<&str> = SECTIONS.iter().map(|section| section.name).filter(|name| !name.contains('.')).collect();
    for key in root.keys().filter(|key| !names.contains(&key.get_ref().as_ref())) {
        let word: &str = key.get_ref();
        let help = match (keys::KEYS.iter().find(|key| key.name == word), nearest(word, names.iter().copied())) {
            (Some(known), _) => format!("`{word}` is a key of [{}]", known.section),
            (None, Some(near)) => format!("did you mean [{near}]?"),
            (None, None) => format!("the sections of a scene are [{}]", names.join("], [")),
        };
        reader.fault(&key.span(), format!("unknown section `{word}`"), help);
    }
    // a shipped problem has a state of its own
    let potential = root.get("problem").and_then(|problem| problem.get_ref().as_table()?.get("potential"));
    let needed = ["problem", "run", "output"].into_iter().chain(potential.map(|_| "initial"));
    for name in needed {
        let misspelt = |word: &str| !names.contains(&word) && nearest(word, names.iter().copied()) == Some(name);
        if root.get(name).is_none() && !root.keys().any(|word| misspelt(word.get_ref())) {
            let help = "`shadowstep scene kepler` writes a scene with all sections";
            reader.fault(&(0..0), format!("the section [{name}] is missing"), help);
        }
    }
}

fn arithmetic(reader: &mut Reader<'_>, run: &Section<'_, '_>) -> Option<Arithmetic> {
    let digits = match reader.get(run, "digits") {
        None => DEFAULT_DIGITS,
        Some(value) if matches!(value.get_ref(), DeValue::String(_)) => {
            return reader.word(value, &[("double", Arithmetic::Double)]);
        }
        Some(value) => u32::try_from(reader.whole(value, 1..=MOST_DIGITS.into())?).ok()?,
    };
    match Precision::digits(digits) {
        Ok(precision) => Some(Arithmetic::Digits(digits, precision)),
        Err(error) => reader.wrong(&run.at, error.to_string(), "write digits = 120"),
    }
}

/// The section [run].
struct Steps {
    scheme: Named,
    h: Rational,
    until: Rational,
    steps: u64,
}

impl Steps {
    fn read(reader: &mut Reader<'_>, run: &Section<'_, '_>) -> Option<Steps> {
        let first =
            reader.get(run, "first").map(|value| reader.word(value, &[("kick", First::Kick), ("drift", First::Drift)]));
        let scheme = match reader.get(run, "scheme") {
            Some(value) => reader.text(value).and_then(|text| scheme(reader, &text, first.flatten())),
            None => {
                reader.missing(run, "scheme");
                None
            }
        };
        let times = times(reader, run);
        if matches!(first, Some(None)) {
            return None;
        }
        let (h, until, steps) = times?;
        Some(Steps { scheme: scheme?, h, until, steps })
    }
}

fn scheme(reader: &mut Reader<'_>, word: &Text, first: Option<First>) -> Option<Named> {
    let folder = Path::new(&reader.source.path).parent().unwrap_or(Path::new(""));
    let named = match library::scheme_from(&word.value, folder, first) {
        Ok(named) => named,
        Err(Complaint::Usage { sentence, hint }) => return reader.wrong(&word.at, sentence, hint),
        Err(Complaint::Faults(faults)) => {
            reader.faults.extend(faults.0);
            return None;
        }
        Err(Complaint::Run { .. } | Complaint::Output(_)) => unreachable!("a table is only read"),
    };
    match reader.arithmetic.suits(&named) {
        Ok(()) => Some(named),
        Err((sentence, most)) => {
            reader.wrong(&word.at, sentence, format!("write digits = {most}, or use {OTHER_SCHEME}"))
        }
    }
}

/// h, the end and the number of steps.
fn times(reader: &mut Reader<'_>, run: &Section<'_, '_>) -> Option<(Rational, Rational, u64)> {
    let value = |reader: &mut Reader<'_>, key| {
        let text = reader.get(run, key).and_then(|value| reader.number(value))?;
        let exact = reader.evaluate(&text)?;
        Some((text, exact.value))
    };
    let step = value(reader, "step");
    let until = value(reader, "until");
    let steps = reader.get(run, "steps").map(|value| (value.span(), reader.whole(value, 1..=MOST_STEPS)));
    if reader.get(run, "step").is_none() {
        reader.missing(run, "step");
    }
    if reader.get(run, "until").is_none() && steps.is_none() {
        reader.missing(run, "until");
    }
    if let (Some(_), Some((at, _))) = (reader.get(run, "until"), &steps) {
        return reader.wrong(at, "until and steps are both given", "keep one of the two");
    }
    let (step, h) = step?;
    if let Some((_, steps)) = steps {
        let steps = steps?;
        // only a step of 0 is not within its own time
        return match steps::count((&h, &step.value), (&h, &step.value), "") {
            Err(none) => reader.wrong(&step.at, none.sentence, none.hint),
            Ok(_) => Some((h.clone(), h * Rational::from_integer(steps.into()), steps)),
        };
    }
    let (end, until) = until?;
    match steps::count((&h, &step.value), (&until, &to_text(&until)), "") {
        Ok(count) => Some((h, until, count)),
        Err(none) => {
            let at = if none.blamed == Blamed::Step { &step.at } else { &end.at };
            reader.wrong(at, none.sentence, none.hint)
        }
    }
}

impl Asked {
    fn read(reader: &mut Reader<'_>, output: &Section<'_, '_>) -> Option<Asked> {
        let before = reader.faults.len();
        let file = reader.get(output, "file").and_then(|value| reader.text(value));
        let format = reader
            .get(output, "format")
            .map(|value| reader.word(value, &[("csv", Format::Csv), ("jsonl", Format::JsonLines)]));
        let energy = every(reader, output, "energy", "output.energy");
        let modified = modified(reader, output);
        let trajectory = every(reader, output, "trajectory", "output.trajectory");
        let checkpoint = reader.get(output, "checkpoint").map(|value| (value.span(), cadence(reader, value)));
        if let (Some((at, _)), None) = (&checkpoint, reader.get(output, "file")) {
            reader.fault(at, "a checkpoint needs a file to go on with", "add `file = \"out.csv\"`");
        }
        let silent = energy.is_none() && modified.is_none() && trajectory.is_none();
        if silent && reader.faults.len() == before && output.is_there() {
            let help = "add `energy = true`, `modified_energy = true` or `trajectory = true`";
            reader.fault(&output.at, "nothing is asked for", help);
        }
        let format = match (format, &file) {
            (Some(format), _) => format,
            (None, None) => Some(Format::Csv),
            (None, Some(name)) => Format::of(&name.value).or_else(|| {
                let message = format!("`{}` says no format by its name", name.value);
                reader.wrong(&name.at, message, "end it with .csv or .jsonl, or add `format = \"csv\"`")
            }),
        };
        let folder = Path::new(&reader.source.path).parent().unwrap_or(Path::new(""));
        let file = file.map(|name| (folder.join(&name.value), name.at));
        let checkpoint = checkpoint.and_then(|(_, cadence)| cadence);
        Some(Asked { file, format: format?, energy, modified, trajectory, checkpoint })
    }
}

/// `true`, `false`, or a table with a section's name: when something is written, and the table.
fn when<'t, 'i>(
    reader: &mut Reader<'_>,
    output: &Section<'t, 'i>,
    key: &'static str,
    section: &'static str,
) -> Option<(u64, Option<Section<'t, 'i>>)> {
    let value = reader.get(output, key)?;
    match value.get_ref() {
        DeValue::Boolean(true) => Some((1, None)),
        DeValue::Boolean(false) => None,
        DeValue::Table(table) => {
            let table = reader.table(table, value.span(), section);
            let every = match reader.get(&table, "every") {
                Some(value) => reader.whole(value, 1..=MOST_STEPS)?,
                None => 1,
            };
            Some((every, Some(table)))
        }
        _ => reader.wrong_kind(value, "true, or a table: { every = 10 }"),
    }
}

fn every(reader: &mut Reader<'_>, output: &Section<'_, '_>, key: &'static str, section: &'static str) -> Option<u64> {
    when(reader, output, key, section).map(|(every, _)| every)
}

fn modified(reader: &mut Reader<'_>, output: &Section<'_, '_>) -> Option<(Order, u64)> {
    let (every, table) = when(reader, output, "modified_energy", "output.modified_energy")?;
    let automatic = Order::Best(DEFAULT_LARGEST_M, Stop::Full);
    let Some(table) = table else { return Some((automatic, every)) };
    let largest = reader.get(&table, "max_order").map(|value| (value.span(), m(reader, value, 2)));
    let stop = reader.get(&table, "stop");
    let stop = stop.map(|value| (value.span(), reader.word(value, &[("full", Stop::Full), ("early", Stop::Early)])));
    let fixed = match reader.get(&table, "order") {
        Some(value) if matches!(value.get_ref(), DeValue::Integer(_)) => Some(m(reader, value, 1)?),
        Some(value) => {
            reader.word(value, &[("auto", ())])?;
            None
        }
        None => None,
    };
    match (fixed, largest, stop) {
        (Some(m), None, None) => Some((Order::Fixed(m), every)),
        (Some(m), Some((at, _)), _) | (Some(m), None, Some((at, _))) => {
            let message = format!("max_order and stop are for order = \"auto\", not for order = {m}");
            reader.wrong(&at, message, "leave them out, or write order = \"auto\"")
        }
        (None, largest, stop) => {
            let largest = largest.map_or(Some(DEFAULT_LARGEST_M), |(_, m)| m)?;
            let stop = stop.map_or(Some(Stop::Full), |(_, stop)| stop)?;
            Some((Order::Best(largest, stop), every))
        }
    }
}

/// The m of a central difference.
fn m(reader: &mut Reader<'_>, value: &Value<'_>, least: u64) -> Option<u32> {
    reader.whole(value, least..=HIGHEST_M.into()).and_then(|m| u32::try_from(m).ok())
}

/// A number of steps, or a time such as `1 min`.
fn cadence(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<Cadence> {
    if matches!(value.get_ref(), DeValue::Integer(_)) {
        return reader.whole(value, 1..=MOST_STEPS).map(Cadence::Steps);
    }
    if !matches!(value.get_ref(), DeValue::String(_)) {
        return reader.wrong_kind(value, "a time such as \"1 min\", or a number of steps");
    }
    let text = reader.text(value)?;
    let found = duration(text.value.trim());
    if found.is_none() {
        let message = format!("`{}` is no time between checkpoints", text.value);
        reader.fault(&text.at, message, "write a time in s, min or h such as \"1 min\", or a number of steps");
    }
    found.map(Cadence::Time)
}

fn duration(text: &str) -> Option<Duration> {
    let (number, unit) = text.split_at(text.find(|c: char| c.is_ascii_alphabetic())?);
    let seconds = match unit {
        "s" => 1.0,
        "min" => 60.0,
        "h" => 3600.0,
        _ => return None,
    };
    let number: f64 = number.trim().parse().ok()?;
    Duration::try_from_secs_f64(number * seconds).ok().filter(|time| !time.is_zero())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::keys::KEYS;

    /// The faults of a scene, each as `line:column: sentence`.
    fn faults(text: &str) -> Vec<String> {
        match Scene::read(Source { path: "test.toml".to_owned(), text: text.to_owned() }) {
            Err(Complaint::Faults(Faults(faults))) => {
                faults.iter().map(|fault| format!("{}:{}: {}", fault.line, fault.column, fault.message)).collect()
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn every_key_that_is_explained_is_read() {
        // a date is a value of no key
        for key in &KEYS {
            let text = format!("[{}]\n{} = 2001-01-01", key.section, key.name);
            let wrong = format!("2:{}: this value is of the wrong kind", key.name.len() + 4);
            assert!(faults(&text).contains(&wrong), "{text}: {:?}", faults(&text));
        }
    }

    #[test]
    fn what_is_not_explained_is_refused() {
        for section in &SECTIONS {
            let text = format!("[{}]\nfrobnicate = 1", section.name);
            assert!(faults(&text).contains(&"2:1: unknown key `frobnicate`".to_owned()), "{text}: {:?}", faults(&text));
        }
    }

    #[test]
    fn every_section_is_explained() {
        for key in &KEYS {
            assert!(SECTIONS.iter().any(|section| section.name == key.section), "{}", key.section);
            assert!(!key.meaning.is_empty() && !key.example.is_empty(), "{}", key.name);
        }
    }

    #[test]
    fn the_examples_are_values_that_can_be_read() {
        for key in &KEYS {
            let text = format!("[{}]\n{} = {}", key.section, key.name, key.example);
            let faults = faults(&text);
            assert!(!faults.iter().any(|fault| fault.contains("wrong kind")), "{text}: {faults:?}");
        }
    }

    #[test]
    fn durations() {
        for (text, seconds) in [("1 min", 60.0), ("30 s", 30.0), ("2h", 7200.0), ("0.5 min", 30.0)] {
            assert_eq!(duration(text), Some(Duration::from_secs_f64(seconds)), "{text}");
        }
        for wrong in ["", "1", "min", "1 m", "0 s", "-1 s", "1e99 h", "1 min 3"] {
            assert_eq!(duration(wrong), None, "{wrong}");
        }
    }
}
