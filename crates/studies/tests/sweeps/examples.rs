//! Protects the examples of the documentation: their plans are read, and their runs are made.

use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use shadowstep::tables::Source;
use shadowstep_studies::sweeps::SweepPlan;

/// Maps of chaos follow long orbits, of which this test makes the beginnings.
const SHORTER: [(&str, &str); 2] = [("until = 10000", "until = 100"), ("steps = 100000", "steps = 500")];

#[test]
fn the_examples_of_the_documentation_can_be_run() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/sweeps");
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text =
            SHORTER.iter().fold(fs::read_to_string(&path).unwrap(), |text, (long, short)| text.replace(long, short));
        let plan = SweepPlan::of(&Source { path: path.display().to_string(), text });
        let plan = plan.unwrap_or_else(|error| panic!("{error}"));
        let runs = plan.axes().runs();
        assert!(runs >= 10_000, "{}", path.display());
        assert!(plan.picture().is_some());
        // few of all, spread by the golden ratio: most of them are complete
        let spread = |k: u64| ((k as f64 * 0.618_033_988_749_895).fract() * runs as f64) as u64;
        let records: Vec<_> = (0..20).map(|k| plan.run(spread(k), &AtomicBool::new(false)).unwrap()).collect();
        let complete = records.iter().filter(|record| record.failure.is_none()).count();
        assert!(complete >= 12, "{}: {records:?}", path.display());
        names.push(path.file_name().unwrap().to_string_lossy().into_owned());
    }
    names.sort();
    let expected = ["henon-heiles-chaos.toml", "henon-heiles-escape.toml", "kepler-map.toml", "planet-between.toml"];
    assert_eq!(names, expected);
}
