//! The range of a map's colours is the written one; values beyond it are counted.

use std::fs;

use shadowstep_studies::sweeps::{Manifest, SweepPlan, TableFormat, collect, compute};

const SWEEP: &str = r#"
[problem]
potential = "q^2"
coordinates = ["q"]
[initial]
q = ["c"]
p = ["d"]
[run]
scheme = "stormer-verlet"
step = "1/10"
steps = 1
digits = "double"
[axes]
c = [1, 2, 3]
d = [1, 2]
[keep]
at_end = { sum = "c + d" }
[picture]
RANGE
"#;

fn picture(range: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let (path, out) = (folder.path().join("sweep.toml"), folder.path().join("out"));
    fs::write(&path, SWEEP.replace("RANGE", range)).unwrap();
    let plan = SweepPlan::open(&path).unwrap();
    let manifest = Manifest::begin(&out, &plan, None).unwrap();
    compute(&plan, &manifest, &out, manifest.all_chunks(), &mut ()).unwrap();
    collect(&out, TableFormat::Csv, &mut ()).unwrap();
    fs::read_to_string(out.join("picture.svg")).unwrap()
}

#[test]
fn ranges_of_colours() {
    let plain = picture("");
    assert!(!plain.contains("1 cell"), "{plain}");
    for scale in ["linear", "log"] {
        // of the sums 2, 3, 4, 3, 4, 5
        let found = picture(&format!("range = [\"5/2\", 4.5]\nscale = \"{scale}\""));
        assert!(found.contains("&lt; 2.5: 1 cell") && found.contains("&gt; 4.5: 1 cell"), "{found}");
    }
}
