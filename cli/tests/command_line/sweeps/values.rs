//! What is kept of a run is what the other commands give of it, to the last digit.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::Value;

use super::{folder, rows, succeeds};
use crate::program::{objects, quietly};

#[test]
fn values_are_those_of_drift() {
    for (digits, flag) in [
        ("\"double\"", "--double"),
        ("\"compensated\"", "--compensated"),
        ("\"double-double\"", "--double-double"),
        ("30", "--digits 30"),
    ] {
        let sweep = format!(
            r#"
problem.name = "kepler"
problem.parameters.eccentricity = "e"
run = {{ scheme = "yoshida4", step = "1/20", until = 20, digits = {digits} }}
output.modified_energy = {{ estimator = "bilinear", order = 8 }}
axes.e = ["3/10", "1/2"]
[keep]
values = ["verdict", "reason", "energy_error", "relative_energy_error", "last_energy_error", "method_error", "close_encounters",
          "drift", "permanent_change", "permanent_resolution", "force_evaluations"]
"#
        );
        let folder = folder(&sweep);
        succeeds(folder.path(), "sweep sweep.toml --out out");
        for row in rows(folder.path()) {
            let lines = quietly(&format!(
                "drift kepler --scheme yoshida4 --step 1/20 --until 20 {flag} --estimator bilinear --order 8 \
                 --set eccentricity={} --json",
                row["e"]
            ));
            let drift = &objects(&lines)[0];
            for (column, path) in [
                ("verdict", "/summary/verdict"),
                ("reason", "/summary/reason"),
                ("energy_error", "/energy_error/largest"),
                ("relative_energy_error", "/energy_error/largest_relative"),
                ("last_energy_error", "/energy_error/last"),
                ("method_error", "/summary/modified_energy/method"),
                ("close_encounters", "/summary/close_encounters"),
                ("drift", "/drift"),
                ("permanent_change", "/permanent_change/change"),
                ("permanent_resolution", "/permanent_change/resolution"),
                ("force_evaluations", "/force_evaluations"),
            ] {
                let found = drift.pointer(path).unwrap_or_else(|| panic!("{path} is missing in {drift}"));
                let found = found.as_str().map_or_else(|| found.to_string(), str::to_owned);
                assert_eq!(row[column], found, "{digits}: {column}");
            }
        }
    }
}

/// Scenes with a coordinate, and a bound that it falls below on its way.
const SCENES: [(&str, &str, &str); 3] = [
    (
        r#"
problem = { potential = "x^4/4", coordinates = ["x"], kinetic = "sqrt(1 + px^2)" }
initial = { q = [1], p = [0] }
"#,
        "x",
        "1/2",
    ),
    ("problem.name = \"kepler\"\n", "x", "-1/3"),
    (
        r#"
problem = { pair = "-m_i*m_j/sqrt(r2)", dimensions = 2, bodies = { m = [1, 1, 1] }, masses = "m" }
[initial]
q = [0.97000436, -0.24308753, -0.97000436, 0.24308753, 0, 0]
v = [0.466203685, 0.43236573, 0.466203685, 0.43236573, -0.93240737, -0.86473146]
"#,
        "y3",
        "-1/5",
    ),
];

/// The rows of each run by their n.
fn rows_of_runs(folder: &Path) -> BTreeMap<String, Vec<BTreeMap<String, String>>> {
    let text = fs::read_to_string(folder.join("out/rows.csv")).unwrap();
    let mut lines = text.lines().map(|line| line.split(','));
    let names: Vec<&str> = lines.next().unwrap().collect();
    let mut runs: BTreeMap<String, Vec<_>> = BTreeMap::new();
    for line in lines {
        let row: BTreeMap<_, _> = names.iter().map(|name| (*name).to_owned()).zip(line.map(str::to_owned)).collect();
        runs.entry(row["run"].clone()).or_default().push(row);
    }
    runs
}

#[test]
fn conditions_and_ends_are_those_of_the_rows() {
    for (scene, coordinate, bound) in SCENES {
        for digits in ["\"double\"", "\"compensated\"", "\"double-double\"", "30"] {
            let sweep = |stop: &str| {
                format!(
                    r#"{scene}
[run]
scheme = "ruth3"
step = "h"
until = 3
digits = {digits}
[output]
trajectory = true
energy = true
[axes]
h = ["1/10", "1/27"]
[keep]
values = ["steps"]
first_time = {{ below = "{coordinate} < {bound}", never = "{coordinate} > 10" }}
at_end = {{ end = "{coordinate}", time = "t", H = "E" }}
rows = true
{stop}
"#
                )
            };
            for stop in ["", "stop = [\"below\"]"] {
                let folder = folder(&sweep(stop));
                succeeds(folder.path(), "sweep sweep.toml --out out");
                let runs = rows_of_runs(folder.path());
                for row in rows(folder.path()) {
                    let states = &runs[&row["run"]];
                    let value = |text: &str| text.parse::<f64>().unwrap();
                    let (p, q) = bound.split_once('/').unwrap();
                    let first =
                        states.iter().position(|state| value(&state[coordinate]) < value(p) / value(q)).unwrap();
                    assert!(first > 0, "the first state does not meet it");
                    let h: f64 = row["h_double"].parse().unwrap();
                    assert!((value(&row["below_double"]) - first as f64 * h).abs() < 1e-12, "{row:?}");
                    assert_eq!((row["never"].as_str(), row["never_double"].as_str()), ("", ""));
                    let last = if stop.is_empty() { states.len() - 1 } else { first };
                    assert_eq!(row["steps"], last.to_string());
                    assert_eq!((&row["end"], &row["H"]), (&states[last][coordinate], &states[last]["energy"]));
                    assert!((value(&row["time"]) - last as f64 * h).abs() < 1e-12, "{row:?}");
                }
            }
        }
    }
}

/// What is kept of rows is CSV, in which format the scene ever writes them.
#[test]
fn rows_are_csv_whatever_the_format() {
    let kept = |file: &str| {
        let text = format!(
            "problem.name = \"pendulum\"\nrun = {{ scheme = \"yoshida4\", step = \"h\", steps = 20 }}\n\
             output = {{ file = \"{file}\", energy = true, trajectory = true }}\naxes.h = \
             [\"1/10\", \"1/5\"]\nkeep.rows = true\n"
        );
        let folder = folder(&text);
        succeeds(folder.path(), "sweep sweep.toml --out out");
        fs::read_to_string(folder.path().join("out/rows.csv")).unwrap()
    };
    let csv = kept("rows.csv");
    assert!(csv.starts_with("run,n,t,energy,") && csv.lines().count() == 43, "{csv}");
    assert_eq!([kept("rows.jsonl"), kept("rows.npy")], [csv.clone(), csv]);
}

/// A run of a sweep is the run of a scene with the values in place of the names.
#[test]
fn rows_are_those_of_run() {
    for (scene, ..) in SCENES {
        let text = |step: &str, digits: &str| {
            format!(
                "{scene}\n[run]\nscheme = \"yoshida4\"\nstep = \"{step}\"\nsteps = 7\ndigits = \
                    {digits}\n[output]\ntrajectory = true\n"
            )
        };
        let keep = "[axes]\nd = [\"double\", \"compensated\", 40]\nh = [\"1/10\", \"1/7\"]\n[keep]\nrows = \
            true\nstate = true\n";
        let folder = folder(&format!("{}{keep}", text("h", "\"$d\"")));
        succeeds(folder.path(), "sweep sweep.toml --out out");
        let runs = rows_of_runs(folder.path());
        for row in rows(folder.path()) {
            let digits = if row["d"] == "40" { "40".to_owned() } else { format!("\"{}\"", row["d"]) };
            let alone = crate::scenes::printed(&text(&row["h"], &digits));
            let alone: Vec<&str> = alone.lines().filter(|line| !line.starts_with('#')).collect();
            let names: Vec<&str> = alone[0].split(',').collect();
            for (line, state) in alone[1..].iter().zip(&runs[&row["run"]]) {
                let fields: Vec<&str> = line.split(',').collect();
                for (name, field) in names.iter().zip(&fields) {
                    assert_eq!(state[*name], *field, "{row:?}");
                }
            }
            assert_eq!(alone.len(), 9);
            let last: Vec<&str> = alone[8].split(',').collect();
            for (name, field) in names.iter().zip(last).filter(|(name, _)| !["n", "t"].contains(name)) {
                assert_eq!(row[*name], field, "the last state");
            }
        }
    }
}

#[test]
fn a_manifest_describes_its_columns() {
    let folder = folder(super::SWEEP);
    succeeds(folder.path(), "sweep sweep.toml --out out --chunk 1/2");
    let plan: Value = serde_json::from_slice(&fs::read(folder.path().join("out/plan.json")).unwrap()).unwrap();
    let names: Vec<&str> = plan["columns"].as_array().unwrap().iter().filter_map(|c| c["name"].as_str()).collect();
    assert_eq!(names, ["energy_error", "steps", "near", "L"]);
    assert_eq!((&plan["runs"], &plan["chunks"]), (&Value::from(60), &Value::from(2)));
}

/// A table's file may have any name, and so may what else is a text.
#[test]
fn texts_that_a_spreadsheet_would_compute_are_marked() {
    let folder = folder(
        "problem.name = \"pendulum\"\nrun = { scheme = \"$scheme\", step = \"h\", steps = 4, digits = \"double\" }\n\
         axes = { scheme = [\"=1+1.toml\", \"yoshida4\"], h = [\"-1/3\", \"1/10\"] }\nkeep.values = \
         [\"energy_error\"]\n",
    );
    let table = "name = \"mine\"\norder = 2\nkinetic = \"any\"\n[stages]\nkick = [\"1/2\", \"1/2\"]\ndrift = [1, 0]\n";
    fs::write(folder.path().join("=1+1.toml"), table).unwrap();
    succeeds(folder.path(), "sweep sweep.toml --out out");
    let cells: Vec<_> = rows(folder.path()).iter().map(|row| [row["scheme"].clone(), row["h"].clone()]).collect();
    let (own, shipped) = ("'=1+1.toml", "yoshida4");
    assert_eq!(cells, [[own, "-1/3"], [own, "1/10"], [shipped, "-1/3"], [shipped, "1/10"]]);
    let traced =
        succeeds(folder.path(), "trace pendulum --scheme =1+1.toml,yoshida4 --step 1/10 --until 1 --csv --order 2");
    assert!(traced.out.lines().any(|line| line.starts_with("'=1+1.toml,1/10,")), "{}", traced.out);
    assert!(!traced.out.lines().any(|line| line.starts_with('=')), "{}", traced.out);
}
