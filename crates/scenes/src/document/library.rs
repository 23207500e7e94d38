//! Schemes by their names: shipped ones, and tables in files.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use sha2::{Digest, Sha256};
use shadowstep::problems::Problem;
use shadowstep::tables::{self, AtRunTime, Faults, Proved, Source, TableScheme, shipped_names};
use shadowstep::{Rational, Scheme, Stepper, shadow::exact_flow};
use shadowstep_analysis::best_for_every_kinetic;
use shadowstep_schemes::document::{LARGEST_TABLE, document, read_text};
use shadowstep_schemes::exact::DIGITS as TABLE_DIGITS;
use shadowstep_schemes::symbolic::decimal::to_text;
use shadowstep_schemes::{First, Map, shipped, shipped_hint};
use thiserror::Error;
use toml::de::DeTable;

use crate::files::outside::{is_allowed, path_of};
use crate::files::whole_file::folder_of;
use crate::run::arithmetic::{Arithmetic, GUARD_DIGITS, MOST_VALUE_DIGITS, OTHER_SCHEME};
use crate::run::note::Note;
use crate::texts::error::Error;
use crate::texts::refusal::{Refusal, Unsupported, refuse};

/// The name of the exact flow in place of a scheme.
pub const EXACT_FLOW: &str = "exact-flow";

/// A scheme with the name by which it was requested.
#[derive(Clone, Debug)]
pub struct NamedScheme {
    /// The name of a shipped scheme or the path of a table, as requested.
    pub name: String,
    /// The scheme with its proof.
    pub scheme: TableScheme<AtRunTime>,
}

/// Why a scheme cannot be found or read.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum LibraryError {
    /// An unknown name, or a file that is missing or cannot be read.
    #[error(transparent)]
    NotFound(#[from] Refusal),
    /// The table has faults.
    #[error(transparent)]
    Faults(#[from] Faults),
}

impl NamedScheme {
    /// Its steps for systems with quadratic T.
    ///
    /// # Panics
    /// If it was read for three parts and more.
    pub fn quadratic(&self) -> TableScheme {
        self.scheme.clone().for_quadratic().expect("the scheme was read for two parts")
    }

    /// Its name with a hash of its weights: a table that is changed is another scheme.
    pub fn identity(&self) -> String {
        format!("{} {}", self.name, weights_fingerprint(self.scheme.proved()))
    }

    /// The same with weights that have the digits of a run; a note where its order holds to fewer digits.
    ///
    /// # Errors
    /// Irrational weights of these digits cannot be computed.
    pub fn fitted(self, arithmetic: Arithmetic) -> Result<(NamedScheme, Option<Note>), Refusal> {
        const MOST: u32 = MOST_VALUE_DIGITS - GUARD_DIGITS;
        let NamedScheme { name, scheme } = self;
        let digits = arithmetic.digits();
        let closed_forms = scheme.proved().lacks_digits(u32::MAX);
        let too_many = || {
            let most = format!("{name} has irrational weights, computed to at most {MOST} digits");
            Refusal::new(
                format!("{most}; the run has {digits}"),
                format!("use at most {MOST} digits, or {OTHER_SCHEME}"),
            )
        };
        let scheme = if (TABLE_DIGITS + 1..=MOST).contains(&digits) {
            scheme.to_digits(digits + GUARD_DIGITS).map_err(|_| too_many())?
        } else if closed_forms && digits > MOST {
            return Err(too_many());
        } else {
            scheme
        };
        let order = scheme.proved().order();
        let held = order.digits.filter(|held| !closed_forms && *held < digits);
        let note = held.map(|digits| Note::OrderHoldsTo { scheme: name.clone(), order: order.order, digits });
        Ok((NamedScheme { name, scheme }, note))
    }

    /// The same scheme with steps that begin with this map.
    ///
    /// # Errors
    /// A table whose maps cannot be exchanged.
    pub fn beginning_with(&self, first: First) -> Result<NamedScheme, LibraryError> {
        let source = &self.scheme.proved().scheme.table.source;
        let scheme = tables::read(source, &beside_or_shipped, Some(first))?;
        Ok(NamedScheme { name: self.name.clone(), scheme: scheme.at_run_time() })
    }

    /// A remark on a table in a file that has the name of a shipped scheme with other weights.
    pub fn note(&self) -> Option<Note> {
        let own = self.scheme.proved();
        let scheme = self.scheme.summary().name;
        let shipped = tables::shipped(scheme).filter(|_| self.name != scheme)?;
        let (own, shipped) = (own.scheme.maps_of_both(), shipped.proved().scheme.maps_of_both());
        // the same table with more or fewer digits has these weights, too
        let rounding = Rational::new(1.into(), 1_000_000_000_000_i64.into());
        let is_near = |a: &Rational, b: &Rational| a - b < rounding && b - a < rounding;
        let alike = |(a, b): (&Map, &Map)| a.kind == b.kind && is_near(&a.weight, &b.weight);
        let differs = own.len() != shipped.len() || !own.iter().zip(&shipped).all(alike);
        differs.then(|| Note::NameOfShipped { path: self.name.clone(), scheme: scheme.to_owned() })
    }
}

/// The first digits of a hash of the weights of a scheme, with those of its processor.
pub fn weights_fingerprint(proved: &Proved) -> String {
    let text = |maps: &[Map]| {
        let weights = maps.iter().map(|map| format!("{:?} {}", map.kind, to_text(&map.weight)));
        weights.collect::<Vec<_>>().join(",")
    };
    let step = text(&proved.scheme.maps_of_both());
    fingerprint(&match &proved.scheme.processor {
        None => step,
        Some(processor) => format!("{step};{}", text(&processor.post)),
    })
}

/// The first digits of a hash.
pub fn fingerprint(text: &str) -> String {
    Sha256::digest(text.as_bytes()).iter().take(8).map(|byte| format!("{byte:02x}")).collect()
}

impl From<LibraryError> for Error {
    fn from(error: LibraryError) -> Self {
        match error {
            LibraryError::NotFound(Refusal { message, hint }) => Error::Usage { message, hint },
            LibraryError::Faults(faults) => Error::Faults(faults),
        }
    }
}

/// The scheme that a word means: a shipped one, or a file if the word ends in `.toml` or has a separator of folders.
///
/// ```
/// use shadowstep_scenes::library::scheme;
///
/// assert_eq!(scheme("yoshida4").unwrap().scheme.proved().order().order, 4);
/// assert!(scheme("yoshida5").unwrap_err().to_string().contains("did you mean"));
/// ```
///
/// # Errors
/// An unknown name, a file that cannot be read, a table with faults.
pub fn scheme(word: &str) -> Result<NamedScheme, LibraryError> {
    scheme_from(word, Path::new(""), None)
}

/// The same, with files as seen from a folder and steps that may begin with the other map.
///
/// # Errors
/// As [`scheme`].
pub fn scheme_from(word: &str, folder: &Path, first: Option<First>) -> Result<NamedScheme, LibraryError> {
    let source = source_from(word, folder)?;
    let scheme = tables::read(&source, &beside_or_shipped, first)?;
    Ok(NamedScheme { name: word.to_owned(), scheme: scheme.at_run_time() })
}

/// The scheme of a table's text, with the name of the scheme.
///
/// # Errors
/// A table with faults.
pub fn scheme_of(source: &Source) -> Result<NamedScheme, LibraryError> {
    let scheme = tables::read(source, &beside_or_shipped, None)?;
    Ok(NamedScheme { name: scheme.summary().name.to_owned(), scheme: scheme.at_run_time() })
}

/// Schemes that have been read: each is read and proved once.
#[derive(Debug, Default)]
pub struct Schemes {
    read: Known<Wanted, NamedScheme>,
    /// Those for many parts, by the identities of those for two.
    for_many_parts: Known<String, NamedScheme>,
    /// Those whose weights have many digits, by these and the identities of those with fewer.
    fitted: Known<(u32, String), Fitted>,
}

/// What was made once, by what it is made from.
type Known<K, V> = Mutex<Vec<(K, V)>>;

/// What is known of a key, or is made now.
fn known_or<K: PartialEq, V: Clone, E>(all: &Known<K, V>, key: K, make: impl FnOnce() -> Result<V, E>) -> Result<V, E> {
    let all = || all.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, value)) = all().iter().find(|(own, _)| *own == key) {
        return Ok(value.clone());
    }
    let value = make()?;
    all().push((key, value.clone()));
    Ok(value)
}

/// A scheme with the digits of a run, and what is to be noted of it.
type Fitted = (NamedScheme, Option<Note>);

/// A word, the folder for its file, and the map that steps begin with.
type Wanted = (String, PathBuf, Option<First>);

impl Schemes {
    /// The scheme that a word of a text means, whose files are as seen from its folder.
    ///
    /// # Errors
    /// As [`scheme`]; a file outside of the folder; a file that is not a table, of which no line is shown.
    pub fn scheme_of(&self, word: &str, text: &Source, first: Option<First>) -> Result<NamedScheme, LibraryError> {
        let folder = text.folder();
        known_or(&self.read, (word.to_owned(), folder.to_owned(), first), || {
            if is_file(word) {
                path_of(text, word)?;
                refuse_other(&source_from(word, folder)?)?;
            }
            scheme_from(word, folder, first)
        })
    }

    /// As [`NamedScheme::fitted`]; what is proved again is kept.
    ///
    /// # Errors
    /// As [`NamedScheme::fitted`].
    pub(crate) fn fitted(&self, arithmetic: Arithmetic, named: NamedScheme) -> Result<Fitted, Refusal> {
        let digits = arithmetic.digits();
        if !named.scheme.proved().lacks_digits(digits) {
            return named.fitted(arithmetic);
        }
        known_or(&self.fitted, (digits, named.identity()), || named.fitted(arithmetic))
    }

    /// As [`for_many_parts`].
    ///
    /// # Errors
    /// As [`for_many_parts`].
    pub(crate) fn for_many_parts(&self, named: &NamedScheme) -> Result<NamedScheme, Refusal> {
        known_or(&self.for_many_parts, named.identity(), || for_many_parts(named))
    }
}

/// Whether a scheme is valid for every T(p).
///
/// # Errors
/// A scheme for quadratic T only.
pub(crate) fn check_every_kinetic(named: &NamedScheme) -> Result<(), Refusal> {
    let scheme = named.scheme.clone().for_quadratic();
    let Some(Err(error)) = scheme.map(TableScheme::for_every_kinetic) else { return Ok(()) };
    let claimed = named.scheme.proved().scheme.table.order.value;
    let better = best_for_every_kinetic(claimed).expect("there are shipped schemes for every T(p)");
    let (name, order) = (&better.scheme.table.name.value, better.proof.general.order);
    refuse(error.to_string(), format!("use a scheme such as {name}, which has order {order} for every T(p)"))
}

/// Whether the gradient kicks of a scheme can be made by displaced forces.
///
/// # Errors
/// A scheme without gradient kicks, or whose gradient kicks have no kick beside them.
pub fn check_displaced(named: &NamedScheme) -> Result<(), Refusal> {
    // with any step size
    let stepper = Stepper::<_, f64>::new(named.scheme.clone(), "1").expect("it is not 0");
    let hint = "leave `gradient_kicks` out, or use a scheme such as chin-4a";
    stepper.displacements().map(drop).map_err(|error| Refusal::new(error.to_string(), hint))
}

/// The scheme with steps for H of three parts and more.
///
/// # Errors
/// A scheme for two parts only.
fn for_many_parts(named: &NamedScheme) -> Result<NamedScheme, Refusal> {
    let hint = "use a composition of the leapfrog, such as suzuki4 or blanes-moan-s6";
    let scheme = named.scheme.clone().for_many_parts().map_err(|error| Refusal::new(error.to_string(), hint))?;
    Ok(NamedScheme { name: named.name.clone(), scheme: scheme.at_run_time() })
}

/// Refuses a scheme that `has` something where a system has none of it.
///
/// # Errors
/// Such a scheme.
pub(crate) fn check_supported(
    named: &NamedScheme,
    none: Option<Unsupported>,
    (has, what): (bool, &str),
) -> Result<(), Refusal> {
    match none.filter(|_| has) {
        None => Ok(()),
        Some(none) => refuse(format!("{} {what} {}", named.name, none.reason), none.hint),
    }
}

/// Whether a scheme can advance H of this number of parts.
///
/// # Errors
/// A scheme with an inner scheme for H of other than three parts.
pub(crate) fn check_inner(named: &NamedScheme, parts: usize) -> Result<(), Refusal> {
    if parts == 3 || named.scheme.proved().scheme.inner.is_none() {
        return Ok(());
    }
    let message =
        format!("{} has multiple time steps, for slow forces, fast forces and T; here H has {parts} parts", named.name);
    let hint = match parts {
        2 => "split the potential: write its slow part as `slow`, or H as three `parts`, of which T is the last",
        _ => "write three parts: the slow forces first, then the fast ones, then T",
    };
    refuse(message, hint)
}

/// The text of the table that a word means: a shipped one, or a file.
///
/// # Errors
/// An unknown name, a file that cannot be read.
pub fn source(word: &str) -> Result<Source, LibraryError> {
    source_from(word, Path::new(""))
}

fn source_from(word: &str, folder: &Path) -> Result<Source, LibraryError> {
    if !is_file(word) {
        return shipped(word).ok_or_else(|| unknown(word).into());
    }
    let path = folder.join(word).to_string_lossy().into_owned();
    match read_text(&path, LARGEST_TABLE) {
        Ok(text) => Ok(Source { path, text }),
        Err(error) => Err(unreadable(&path, &error).into()),
    }
}

fn unreadable(path: &str, error: &io::Error) -> Refusal {
    let shipped = path.strip_suffix(".toml").filter(|name| shipped_names().contains(name));
    let (message, hint) = match (error.kind(), shipped) {
        (ErrorKind::NotFound, Some(name)) => {
            (format!("there is no file {path}"), format!("the shipped scheme is `{name}`, without `.toml`"))
        }
        (ErrorKind::NotFound, None) => {
            let hint = "give the path of a table, or a name that `shadowstep schemes` lists";
            (format!("there is no file {path}"), hint.to_owned())
        }
        (ErrorKind::InvalidData, _) => (format!("{path} is not a text in UTF-8"), "a table is a TOML file".to_owned()),
        _ => (format!("{path} cannot be read: {error}"), "give the path of a table".to_owned()),
    };
    Refusal { message, hint }
}

/// Refuses a file that has nothing of a table: the faults of a table show its lines.
fn refuse_other(source: &Source) -> Result<(), Refusal> {
    let (document, faults) = document(source);
    let is_table = |document: &DeTable<'_>| OF_TABLES.iter().any(|key| document.contains_key(*key));
    if document.as_ref().is_some_and(is_table) && faults.is_empty() {
        return Ok(());
    }
    let path = &source.path;
    let what = if faults.is_empty() { "is not a table of a scheme" } else { "is not TOML" };
    refuse(format!("{path} {what}"), format!("`shadowstep schemes check {path}` shows its faults"))
}

/// Keys of which a table has one.
const OF_TABLES: [&str; 4] = ["order", "kinetic", "composition", "stages"];

/// The base table of a composition: a file beside the table that names it, else shipped. A shipped table has shipped
/// bases only.
pub fn beside_or_shipped(base: &str, from: &Source) -> Option<Source> {
    shadowstep_schemes::library::beside_or_shipped(base, from, |path| {
        let text = read_text(path, LARGEST_TABLE).ok().filter(|_| is_allowed(path, folder_of(path)))?;
        Some(Source { path: path.to_str()?.to_owned(), text })
    })
}

fn is_file(word: &str) -> bool {
    word.ends_with(".toml") || word.contains(std::path::is_separator)
}

fn unknown(word: &str) -> Refusal {
    if word == EXACT_FLOW {
        let known: Vec<_> = exact_flow::problems().map(Problem::name).collect();
        return Refusal::new(
            "exact-flow is not a scheme, but the solution itself, on which an estimator shows its own error",
            format!("`shadowstep drift` and `trace` take it in place of a scheme, for {}", known.join(", ")),
        );
    }
    let near = shipped_hint(word);
    let hint = format!("{near} (`shadowstep schemes` lists all; the name of a custom table ends in .toml)");
    Refusal::new(format!("there is no scheme `{word}`"), hint)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_processor_of_the_same_kernel_is_another_scheme() {
        let [third, fifth] = ["wisdom-corrector-3", "wisdom-corrector-5"].map(|name| tables::shipped(name).unwrap());
        assert_eq!(third.proved().scheme.maps(), fifth.proved().scheme.maps());
        assert_ne!(weights_fingerprint(third.proved()), weights_fingerprint(fifth.proved()));
    }
}
