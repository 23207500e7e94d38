//! Random documents: scenes and sweeps of all keys in all combinations, each of which runs or is refused by a sentence.
//! No command panics, hangs, ends with another exit code than 0 to 3, or writes a number that is not finite.
//!
//! A document has a number, which is its seed:
//! `DOCUMENT=17 cargo test -p shadowstep-cli --features mpfr --test documents` runs that one, and
//! `make fuzz READERS=documents` new ones for SECONDS.
#![cfg(target_os = "linux")]

mod bodies;
mod document;
mod json_schema;
mod maker;
mod outputs;
mod pairs;
#[path = "../faults/random.rs"]
mod random;
mod run;
mod runs;
mod schema;
mod sweeps;
mod systems;

use std::collections::{BTreeMap, BTreeSet};
use std::env;
use std::ops::Range;
use std::path::Path;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use rayon::prelude::*;

use document::{Document, File};
use maker::Maker;
use run::{End, run};

/// The documents that `make test` runs: 51 s of CPU time in the dev profile.
const TESTED: Range<u64> = 0..400;

/// The documents that have all keys and words, also rare ones.
const DRAWN: Range<u64> = 0..4000;

/// How many faults are shown.
const SHOWN: usize = 8;

fn document(number: u64) -> Document {
    let mut maker = Maker::of_seed(number);
    if number.is_multiple_of(5) {
        maker.sweep()
    } else {
        maker.scene()
    }
    maker.document
}

fn fault(document: &Document) -> Option<(String, String)> {
    match run(document) {
        End::Fault { kind, message } => Some((kind, message)),
        _ => None,
    }
}

/// Runs documents; how many ran to their end, and how many were interrupted. Faults are shown with the shortest
/// document of each kind.
fn try_all(numbers: Range<u64>) -> [u64; 2] {
    let all: Vec<(u64, End)> = numbers.into_par_iter().map(|number| (number, run(&document(number)))).collect();
    let mut kinds = BTreeMap::<String, Vec<u64>>::new();
    for (number, end) in &all {
        if let End::Fault { kind, .. } = end {
            kinds.entry(kind.clone()).or_default().push(*number);
        }
    }
    let shown: Vec<String> = kinds.into_par_iter().map(|(kind, numbers)| shown(&kind, &numbers)).collect();
    assert!(shown.is_empty(), "{} kinds of faults:\n\n{}", shown.len(), shown[..shown.len().min(SHOWN)].join("\n\n"));
    [End::Ran, End::Interrupted].map(|end| all.iter().filter(|(_, own)| *own == end).count() as u64)
}

/// A kind of faults with the documents that have it, the first of which is made short.
fn shown(kind: &str, numbers: &[u64]) -> String {
    let number = numbers[0];
    let fails = |document: &Document| fault(document).is_some_and(|(other, _)| other == kind);
    let long = document(number);
    // to see a document fail by its time takes that time
    let short = if kind.contains("CPU time") { long } else { long.minimised(fails) };
    let message =
        fault(&short).map_or_else(|| "it was no fault when it was tried again".to_owned(), |(_, message)| message);
    format!(
        "{kind}: {} documents, {numbers:?}\nDOCUMENT={number}, without what it does not need:\n{short}\n{message}",
        numbers.len()
    )
}

#[test]
fn documents_run_or_are_refused_by_a_sentence() {
    let chosen = env::var("DOCUMENT").ok().map(|number| number.parse().expect("DOCUMENT is a number"));
    if let Some(number) = chosen {
        println!("{}", document(number));
        println!("{:?}", run(&document(number)));
        try_all(number..number + 1);
        return;
    }
    let ([ran, interrupted], all) = (try_all(TESTED), TESTED.end - TESTED.start);
    println!("{ran} of {all} documents ran to their end, {interrupted} were interrupted");
    assert!(2 * ran > all, "{ran} of {all} documents ran to their end: the others were refused");
}

/// New documents for a time, by `make fuzz`.
#[test]
#[ignore = "it takes the time that it is given"]
fn new_documents_for_a_time() {
    let seconds = env::var("SECONDS_EACH").map_or(60, |seconds| seconds.parse().unwrap());
    let end = Instant::now() + Duration::from_secs(seconds);
    let first = SystemTime::now().duration_since(UNIX_EPOCH).unwrap().as_nanos() as u64 % (1 << 50);
    let (mut next, mut ran, mut interrupted) = (first, 0, 0);
    while Instant::now() < end {
        let [now_ran, now_interrupted] = try_all(next..next + 200);
        (next, ran, interrupted) = (next + 200, ran + now_ran, interrupted + now_interrupted);
    }
    println!("{ran} of {} documents ran to their end, {interrupted} were interrupted", next - first);
}

#[test]
fn every_key_and_every_word_is_drawn() {
    let drawn: BTreeSet<_> = DRAWN.flat_map(|number| document(number).keys()).collect();
    let is_word = |word: &str| drawn.iter().any(|(.., value)| value.contains(&format!("\"{word}\"")));
    let missing: Vec<String> = schema::keys()
        .iter()
        .flat_map(|key| {
            let name = format!("{} of [{}]", key.name, key.section);
            let is_drawn = drawn.iter().any(|(section, name, _)| *section == key.section && *name == key.name);
            let words =
                key.words().into_iter().filter(|word| !is_word(word)).map(|word| format!("{name} = \"{word}\""));
            words.chain((!is_drawn).then(|| name.clone())).collect::<Vec<_>>()
        })
        .collect();
    assert!(missing.is_empty(), "no document has\n{}", missing.join("\n"));
}

#[test]
fn a_document_is_made_short() {
    let files = vec![File::new(document::NAME, "a\nb\nc\nd"), File::new("other", "e")];
    let long = Document { files, commands: vec!["one".to_owned(), "two".to_owned()] };
    let has = |document: &Document, line: &str| document.files[0].lines.iter().any(|known| known == line);
    let short = long.minimised(|document| {
        has(document, "b") && has(document, "d") && document.commands.contains(&"two".to_owned())
    });
    assert_eq!(short, Document { files: vec![File::new(document::NAME, "b\nd")], commands: vec!["two".to_owned()] });
}

/// Documents that were found, with their commands in the first lines.
#[test]
fn what_was_found_stays_mended() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/documents/found");
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let failed: Vec<String> = paths
        .par_iter()
        .filter_map(|path| {
            let text = std::fs::read_to_string(path).unwrap();
            let commands =
                text.lines().map_while(|line| line.strip_prefix("# shadowstep ")).map(str::to_owned).collect();
            let found = Document { files: vec![File::new(document::NAME, &text)], commands };
            assert!(!found.commands.is_empty(), "{} has no command", path.display());
            fault(&found).map(|(kind, message)| format!("{}: {kind}\n{message}", path.display()))
        })
        .collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}
