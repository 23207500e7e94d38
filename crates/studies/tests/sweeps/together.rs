//! Runs that are computed together give the files of runs one by one.

use std::fs;
use std::sync::atomic::AtomicBool;

use shadowstep::tables::Source;
use shadowstep_studies::sweeps::{Collected, Manifest, SweepPlan, TableFormat, collect, compute};

/// 300 runs: with the square root of a negative number, with a potential that is infinite at the start, with orbits
/// that leave, with two schemes and step sizes.
const SWEEP: &str = r#"
problem = { potential = "(x^2 + y^2)/2 + x^2*y - y^3/3 + c/x", coordinates = ["x", "y"] }
initial = { q = ["c", "y0"], p = ["sqrt(1/2 - y0^2)", "1/5"] }
run = { scheme = "$scheme", step = "h", until = 20, digits = "double" }
[axes]
scheme = ["stormer-verlet", "yoshida4"]
h = ["1/10", "1/20", "1/30"]
c = ["0", "1/10"]
y0 = "-1 … 1 in 25 values"
[keep]
values = ["energy_error", "force_evaluations"]
state = true
first_time = { escape = "x^2 + y^2 > 9" }
stop = ["escape"]
"#;

#[test]
fn the_files_of_a_sweep_have_the_records_of_its_runs_alone() {
    let plan = SweepPlan::of(&Source { path: "sweep.toml".to_owned(), text: SWEEP.to_owned() }).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let manifest = Manifest::begin(folder.path(), &plan, Some(2)).unwrap();
    let computed = compute(&plan, &manifest, folder.path(), manifest.all_chunks(), &mut ()).unwrap();
    let alone: Vec<_> = (0..300).map(|run| plan.run(run, &AtomicBool::new(false)).unwrap()).collect();
    assert_eq!(computed.failed, alone.iter().filter(|record| record.failure.is_some()).count() as u64);
    assert!((1..250).contains(&computed.failed), "{}", computed.failed);
    let Collected::Complete { .. } = collect(folder.path(), TableFormat::Csv, &mut ()).unwrap() else { panic!() };
    let text = fs::read_to_string(folder.path().join("results.csv")).unwrap();
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    let head = reader.headers().unwrap().clone();
    let place = |name: &str| head.iter().position(|own| own == name).unwrap();
    for (row, record) in reader.records().zip(&alone) {
        let row = row.unwrap();
        assert_eq!(row[place("failure")], *record.failure.as_deref().unwrap_or_default(), "{}", record.run);
        for (column, value) in plan.columns().iter().zip(&record.values) {
            assert_eq!(
                row[place(&column.name)],
                *value.as_deref().unwrap_or_default(),
                "{} {}",
                record.run,
                column.name
            );
        }
    }
}
