//! `shadowstep stability`.

use std::fs;

use tempfile::TempDir;

use crate::program::{objects, quietly, text};

#[test]
fn a_report_has_verdicts_and_charts_and_is_not_computed_twice() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().display();
    let command = format!("stability oscillator reversal --schemes stormer-verlet,ruth3 --quick --out {out}");
    let printed = quietly(&command);
    assert!(printed.contains("agrees       stormer-verlet: 4 step sizes bounded"), "{printed}");
    assert!(printed.contains("-h is the inverse") || printed.contains("−h is the inverse, bit for bit"), "{printed}");
    assert!(printed.ends_with("8 agree, 0 differ, 0 not decided\n"), "{printed}");
    let page = fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(page.contains("<svg ") && page.contains("Time reversal") && folder.path().join("oscillator.svg").exists());
    let table = fs::read_to_string(folder.path().join("stability.md")).unwrap();
    assert!(table.contains("| ruth3 | kepler, 10000 steps: "), "{table}");
    let results = fs::read(folder.path().join("results.jsonl")).unwrap();
    assert_eq!(quietly(&command), printed);
    assert_eq!(fs::read(folder.path().join("results.jsonl")).unwrap(), results);
}

#[test]
fn rows_are_objects_and_digits_are_a_choice() {
    let rows = objects(&quietly("stability oscillator --schemes yoshida4 --digits 40 --quick --json"));
    let [row] = &rows[..] else { panic!("{rows:?}") };
    assert_eq!((text(row, "case"), text(row, "subject"), text(row, "verdict")), ("oscillator", "yoshida4", "agrees"));
}
