//! Protects the way of a run: the files from a table to a verdict, which ARCHITECTURE.md lists in the order in which
//! they are read.

use std::fs;
use std::path::Path;

/// What can be read in about half an hour.
const MOST_LINES: usize = 2500;

/// The stations on the way, each by a word of the name of a file.
const STATIONS: [&str; 9] = ["table", "order", "plan", "stepper", "systems", "state", "bilinear", "column", "verdict"];

/// The paths of the numbered list below the heading.
fn listed(page: &str) -> Vec<&str> {
    let (_, section) = page.split_once("\n## The way of a run\n").expect("the page has the section");
    let (section, _) = section.split_once("\n## ").expect("another section follows");
    let items = (1..).map_while(|number| {
        let line = section.lines().find(|line| line.starts_with(&format!("{number}. ")))?;
        line.split('`').nth(1)
    });
    items.collect()
}

/// The lines of a file without comments, empty lines and its tests.
fn code(text: &str) -> usize {
    let end = text.find("\n#[cfg(test)]\nmod ").unwrap_or(text.len());
    let lines = text[..end].lines().map(str::trim_start);
    lines.filter(|line| !line.is_empty() && !line.starts_with("//")).count()
}

#[test]
fn the_way_of_a_run_can_be_read_in_half_an_hour() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the tests are in a folder of the project");
    let page = fs::read_to_string(root.join("ARCHITECTURE.md")).unwrap();
    let files = listed(&page);
    let mut rest = files.iter();
    for station in STATIONS {
        assert!(rest.any(|file| file.contains(station)), "{station} is not on the way, or out of order: {files:?}");
    }
    let lines: usize = files.iter().map(|file| code(&fs::read_to_string(root.join(file)).expect(file))).sum();
    assert!((1000..=MOST_LINES).contains(&lines), "{lines} lines of code in {files:?}");
}
