//! Hashes of what determines the results: of the values in the text, not of its letters.

use std::fmt::Write;

use sha2::{Digest, Sha256};
use shadowstep::tables::Faults;
use shadowstep_scenes::family::Family;
use shadowstep_scenes::{Error, Scene, hexadecimal};
use shadowstep_schemes::document::document;
use toml::de::{DeTable, DeValue};

use crate::sweeps::axes::Axes;
use crate::sweeps::axis::Axis;

/// What determines the results of a sweep.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Digests {
    /// The version of the program, on which the last digits may depend.
    pub shadowstep: String,
    /// The hash of the scene, the axes and what is kept; comments and the picture are left out.
    pub sweep: String,
    /// That of the weights of all schemes, and of other files that the scene reads.
    pub tables: String,
}

/// Of a sweep's document, of its scene, of which `first` is one, and of the tables of its schemes.
pub(super) fn of(sweep: &DeTable<'_>, (family, first): (&Family, &Scene), axes: &Axes) -> Result<Digests, Error> {
    let (scene, faults) = document(family.source());
    let Some(scene) = scene else { return Err(Faults(faults).into()) };
    let mut text = String::new();
    // the name of the scene's file and the picture change no result
    for document in [sweep, &scene] {
        let mut parts: Vec<_> = document.iter().collect();
        parts.retain(|(key, _)| !["picture", "scene"].contains(&key.get_ref().as_ref()));
        parts.sort_by_key(|(key, _)| key.get_ref().clone());
        for (key, value) in parts {
            // runs are numbered in the order of the axes
            let in_order = key.get_ref() == "axes";
            let _ = write!(text, "{:?}=", key.get_ref());
            write_value(&mut text, value.get_ref(), in_order);
        }
        text.push(';');
    }
    let inputs = [tables(&scene, family, axes)?].into_iter().chain(first.file_hashes()).collect::<Vec<_>>();
    let shadowstep = env!("CARGO_PKG_VERSION").to_owned();
    Ok(Digests { shadowstep, sweep: hash(&text), tables: hash(&inputs.join("\n")) })
}

impl Digests {
    /// That of these sentences which says what differs first from others: the version, the sweep, the tables.
    pub(crate) fn difference(&self, other: &Digests, sentences: [String; 3]) -> Option<String> {
        let differ = [self.shadowstep != other.shadowstep, self.sweep != other.sweep, self.tables != other.tables];
        sentences.into_iter().zip(differ).find_map(|(sentence, differs)| differs.then_some(sentence))
    }
}

/// The hash of a text in hexadecimal digits.
pub(crate) fn hash(text: &str) -> String {
    hexadecimal(&Sha256::digest(text.as_bytes()))
}

fn write_value(text: &mut String, value: &DeValue<'_>, in_order: bool) {
    let _ = match value {
        DeValue::String(string) => write!(text, "{string:?}"),
        DeValue::Integer(number) => write!(text, "{}", number.as_str()),
        DeValue::Float(number) => write!(text, "{}", number.as_str()),
        DeValue::Boolean(truth) => write!(text, "{truth}"),
        DeValue::Datetime(date) => write!(text, "{date}"),
        DeValue::Array(members) => {
            text.push('[');
            for member in members.iter() {
                write_value(text, member.get_ref(), false);
                text.push(',');
            }
            write!(text, "]")
        }
        DeValue::Table(table) => {
            let mut entries: Vec<_> = table.iter().collect();
            match in_order {
                true => entries.sort_by_key(|(key, _)| key.span().start),
                false => entries.sort_by_key(|(key, _)| key.get_ref().clone()),
            }
            text.push('{');
            for (key, value) in entries {
                let _ = write!(text, "{:?}=", key.get_ref());
                write_value(text, value.get_ref(), false);
                text.push(',');
            }
            write!(text, "}}")
        }
    };
}

/// The identities of all schemes that the runs may have.
fn tables(scene: &DeTable<'_>, family: &Family, axes: &Axes) -> Result<String, Error> {
    let words: Vec<String> = match (scheme_axis(scene, axes), scheme(scene)) {
        (Some(axis), _) => (0..axis.count()).map(|number| axis.value(number).text()).collect(),
        (None, Some(word)) => vec![word.to_owned()],
        (None, None) => Vec::new(),
    };
    let identity = |word: &String| Ok(family.schemes().scheme_of(word, family.source(), None)?.identity());
    Ok(words.iter().map(identity).collect::<Result<Vec<_>, Error>>()?.join("\n"))
}

/// The axis whose values are the schemes of the runs.
pub(super) fn scheme_axis<'a>(scene: &DeTable<'_>, axes: &'a Axes) -> Option<&'a Axis> {
    axes.find(scheme(scene)?.strip_prefix('$')?)
}

fn scheme<'a>(scene: &'a DeTable<'_>) -> Option<&'a str> {
    scene.get("run")?.get_ref().get("scheme")?.get_ref().as_str()
}
