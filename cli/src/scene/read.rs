//! A scene's text → all that it asks for, or all its faults. Each section has its file.

mod bodies;
mod formula;
mod initial;
mod kinetic;
mod numbers;
mod output;
mod pair;
mod problem;
mod run;
mod shipped;

pub(crate) use output::{Asked, Cadence};

use std::collections::BTreeMap;
use std::ops::Range;

use shadowstep::Rational;
use shadowstep_schemes::fault::{Faults, Source};
use shadowstep_symbolic::nearest;
use toml::de::DeTable;

use crate::arithmetic::Arithmetic;
use crate::complaint::Complaint;
use crate::library::Named;
use crate::scene::keys::{self, SECTIONS};
use crate::scene::reader::Reader;
use crate::scene::system::System;

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
            (None, Some((system, run::Steps { scheme, h, until, steps }, output))) => {
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

fn parts(reader: &mut Reader<'_>, root: &DeTable<'_>) -> Option<(System, run::Steps, Asked)> {
    refuse_unknown_sections(reader, root);
    let (problem, initial) = (reader.section(root, "problem"), reader.section(root, "initial"));
    let (run, output) = (reader.section(root, "run"), reader.section(root, "output"));
    // the digits come first: values are computed to them
    let arithmetic = run::arithmetic(reader, &run);
    reader.arithmetic = arithmetic.unwrap_or(Arithmetic::Double);
    let system = problem::system(reader, &problem, &initial);
    let general = system.as_ref().is_some_and(System::has_general_kinetic);
    let steps = run::Steps::read(reader, &run, general);
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
    let problem = root.get("problem").and_then(|problem| problem.get_ref().as_table());
    let own = problem.and_then(|problem| problem.get("potential").or(problem.get("pair")));
    let needed = ["problem", "run", "output"].into_iter().chain(own.map(|_| "initial"));
    for name in needed {
        let misspelt = |word: &str| !names.contains(&word) && nearest(word, names.iter().copied()) == Some(name);
        if root.get(name).is_none() && !root.keys().any(|word| misspelt(word.get_ref())) {
            let help = "`shadowstep scene kepler` writes a scene with all sections";
            reader.fault(&(0..0), format!("the section [{name}] is missing"), help);
        }
    }
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
}
