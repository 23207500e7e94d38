//! Tests and notebooks that read a clock, each with why: none asserts a time, or a ratio of times, which other work on
//! the machine changes.

use std::fs;
use std::path::Path;

use crate::language::files;

/// What reads a clock in Rust and in Python.
const CLOCKS: [&str; 7] =
    ["Instant::now", "SystemTime::now", "CpuTime::begin", "perf_counter", "monotonic()", "time.time()", "process_time"];

const KNOWN: [(&str, &str); 9] = [
    ("cli/tests/command_line/output_files.rs", "a limit of minutes, which ends a test that hangs"),
    ("cli/tests/documents/main.rs", "how long new documents are drawn by `make fuzz`"),
    (
        "cli/tests/documents/run.rs",
        "the CPU time after which a command is interrupted, and a limit of minutes, which tells a hang",
    ),
    ("cli/tests/faults/main.rs", "a limit of minutes, and a seed, which is printed"),
    ("cli/tests/faults/work.rs", "the moments at which a command is disturbed"),
    ("python/notebooks/drift-of-the-modified-energy.ipynb", "a time that is printed"),
    ("python/notebooks/outer-planets.ipynb", "times that are drawn"),
    ("python/notebooks/precision.ipynb", "times that are drawn"),
    ("tests/tests/clocks.rs", "the words of this list"),
];

/// The tests of a file: all of a file of tests and of a notebook, what follows `#[cfg(test)]` of another one.
fn tests<'a>(name: &str, text: &'a str) -> &'a str {
    let is_test = name.contains("tests/") || name.ends_with("tests.rs") || name.starts_with("python/notebooks/");
    let of_module = || text.split_once("#[cfg(test)]").map_or("", |(_, tests)| tests);
    if is_test { text } else { of_module() }
}

/// Tests on clusters and of emitted code are programs, which show how long they take.
fn is_program(name: &str) -> bool {
    name.starts_with("tests/cluster/") || name.starts_with("tests/emit/")
}

#[test]
fn no_test_reads_a_clock_but_for_a_stated_reason() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the tests are in a folder of the project");
    let mut all = Vec::new();
    files(root, &mut all).unwrap();
    let mut found = Vec::new();
    for path in all {
        let name = path.strip_prefix(root).unwrap_or(&path).display().to_string();
        let text = fs::read_to_string(&path).unwrap();
        if !is_program(&name) && CLOCKS.iter().any(|clock| tests(&name, &text).contains(clock)) {
            found.push(name);
        }
    }
    found.sort();
    assert_eq!(found, KNOWN.map(|(name, _)| name), "a file reads a clock, or does no more: what for?");
}
