//! `shadowstep run` and `shadowstep scene`: the output that a scene selects is written, and nothing else.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;

use crate::program::{Finished, objects, quietly, shadowstep, text};

/// The scene of the documentation, over a shorter time.
const KEPLER: &str = r#"
[problem]
potential = "-1/sqrt(x^2 + y^2)"       # or  name = "kepler"  with its parameters
coordinates = ["x", "y"]
masses = [1, 1]
[initial]
q = ["1 - 0.6", 0]
p = [0, "sqrt((1 + 0.6)/(1 - 0.6))"]
[run]
scheme = "yoshida4"
step = "1/20"
until = 2
digits = 120
[output]
energy = { every = 10 }
modified_energy = { order = "auto", max_order = 40 }
file = "kepler.csv"
"#;

/// A folder with a scene.
pub(crate) fn folder(scene: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.toml"), scene).unwrap();
    folder
}

/// Runs the scene of a folder without a summary.
pub(crate) fn run(folder: &Path, flags: &str) -> Finished {
    summarised(folder, &format!("--no-summary {flags}"))
}

/// Runs the scene of a folder.
pub(crate) fn summarised(folder: &Path, flags: &str) -> Finished {
    shadowstep(&format!("run {} {flags}", folder.join("scene.toml").display()))
}

/// Runs a scene without a file; it must succeed with nothing on stderr.
pub(crate) fn printed(scene: &str) -> String {
    let folder = folder(scene);
    quietly(&format!("run {} --no-summary", folder.path().join("scene.toml").display()))
}

/// Columns and rows of CSV without its head.
pub(crate) fn table(csv: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(csv.as_bytes());
    let words = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect::<Vec<_>>();
    let header = words(reader.headers().unwrap());
    (header, reader.records().map(|record| words(&record.unwrap())).collect())
}

/// The names in a folder.
pub(crate) fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn the_scene_of_the_documentation_runs() {
    let folder = folder(KEPLER);
    let result = run(folder.path(), "");
    assert_eq!((result.code, result.out.as_str(), result.err.as_str()), (0, "", ""));
    assert_eq!(names(folder.path()), ["kepler.csv", "scene.toml"]);
    let csv = fs::read_to_string(folder.path().join("kepler.csv")).unwrap();
    let (header, rows) = table(&csv);
    assert_eq!(header, ["n", "t", "energy", "modified_energy", "estimate", "order"]);
    assert_eq!((rows.len(), rows[0][2].as_str()), (41, "-0.5"));
    for (n, row) in rows.iter().enumerate() {
        assert_eq!((row[0].parse(), row[1].parse()), (Ok(n), Ok(n as f64 / 20.0)));
        assert_eq!(row[2].is_empty(), n % 10 != 0);
        // all digits are there
        assert!(row[3].starts_with("-0.50029") && row[3].len() > 115, "{row:?}");
    }
    let head: Vec<&str> = csv.lines().map_while(|line| line.strip_prefix("# ")).collect();
    for line in
        "scene: scene.toml\nscheme: yoshida4\ndigits: 120\npotential: -1/sqrt(x^2 + y^2)\nstep: 1/20\nsteps: 40\n\
                 q: [\"2/5\",\"0\"]\np: [\"0\",\"2\"]"
            .lines()
    {
        assert!(head.contains(&line), "{head:?}");
    }
    // a composition has its own table and the one of its base
    let hash = |name: &str| head.iter().find_map(|line| line.strip_prefix(name)).unwrap().len();
    assert_eq!([hash("scene_sha256: "), hash("table_sha256: "), hash("base_table_sha256: ")], [64; 3]);
}

#[test]
fn the_numbers_are_those_of_trace() {
    let scene = "[problem]\nname = \"kepler\"\nparameters = { eccentricity = \"1/3\" }\n[run]\nscheme = \"ruth3\"\n\
                 step = 0.05\nuntil = 1\ndigits = 30\n\
                 [output]\nformat = \"jsonl\"\nenergy = true\nmodified_energy = { order = 5 }\ntrajectory = true\n";
    let trace =
        "trace --problem kepler --set eccentricity=1/3 --scheme ruth3 --step 1/20 --until 1 --digits 30 --states";
    for (keys, flags, described) in [
        ("order = 4", "--order 4", "products of 5 states, k = 4"),
        ("estimator = \"central\", order = 5", "--estimator central --order 5", "central differences, m = 5"),
        ("estimator = \"central\", order = 1", "--estimator central --order 1", "central differences, m = 1"),
        (
            "estimator = \"central\", max_order = 30, rule = \"robust\", stop = \"early\"",
            "--estimator central --max-order 30 --rule robust --stop early",
            "central differences, the best m of 2–30 by the robust rule before errors rise",
        ),
        ("estimator = \"bilinear\", order = 6", "--estimator bilinear --order 6", "products of 7 states, k = 6"),
        (
            "estimator = \"bilinear\", max_order = 16, accuracy = 1e-12",
            "--estimator bilinear --max-order 16 --accuracy 1e-12",
            "products of states, the best k of 2–16 for an accuracy of 1e-12",
        ),
    ] {
        let folder = folder(&scene.replace("order = 5", keys));
        let result = summarised(folder.path(), "");
        assert_eq!(objects(&result.out), objects(&shadowstep(&format!("{trace} {flags}")).out), "{keys}");
        let object = objects(&result.err).pop().unwrap();
        assert_eq!(text(&object["metadata"], "modified_energy_by"), described);
    }
}

/// In transformed time, whose steps are counted by making them: the same rows up to the same physical time.
#[test]
fn the_rows_and_the_end_are_those_of_trace_and_drift_in_transformed_time() {
    let kepler = "problem.name = \"kepler\"\ntime.transform = \"logarithmic\"\n";
    let run_of = |digits: &str, format: &str| {
        format!(
            "{kepler}run = {{ scheme = \"yoshida4\", step = \"1/20\", until = 10, digits = {digits} \
                }}\n[output]\nformat = \"{format}\"\n\
             energy = true\nmodified_energy = {{ order = 8 }}\ntrajectory = true\n"
        )
    };
    for (digits, flag) in [("\"double\"", "--double"), ("\"compensated\"", "--compensated"), ("30", "--digits 30")] {
        let folder = folder(kepler);
        let flags = format!("--scheme yoshida4 --step 1/20 --until 10 --order 8 --no-summary {flag}");
        let of_system =
            |words: &str| quietly(&format!("{words} {} {flags}", folder.path().join("scene.toml").display()));
        let rows = table(&printed(&run_of(digits, "csv")));
        assert_eq!(table(&of_system("trace --csv --states")), rows, "{digits}");
        assert_eq!(objects(&of_system("trace --states")), objects(&printed(&run_of(digits, "jsonl"))), "{digits}");
        let [.., before, last] = &rows.1[..] else { panic!("{rows:?}") };
        assert!(last[0] == "196" && last[1].parse::<f64>() == Ok(10.0) && last[3..6] == ["", "", ""], "{last:?}");
        let record = &objects(&of_system("drift --json"))[0];
        assert_eq!((&record["steps"], text(record, "until"), text(record, "end")), (&195.into(), "10", &*before[1]));
    }
    let folder = folder(kepler);
    // as of the scene, the step to that time is all there is
    let flags = "--csv --no-summary --scheme yoshida4 --step 1/2 --until 1/100 --order 8";
    let rows = table(&quietly(&format!("trace {} {flags}", folder.path().join("scene.toml").display()))).1;
    let t: f64 = rows[1][1].parse().unwrap();
    assert!(rows.len() == 2 && rows[1][0] == "1" && (t - 0.01).abs() < 1e-17, "{rows:?}");
}

/// A scene with these outputs, in double precision.
fn asking(outputs: &str) -> String {
    format!(
        "[problem]\nname = \"pendulum\"\n[run]\nscheme = \"stormer-verlet\"\nstep = \"1/8\"\nsteps = 4\n\
         digits = \"double\"\n[output]\n{outputs}\n"
    )
}

#[test]
fn only_the_selected_output_is_written() {
    for (outputs, columns) in [
        ("energy = true", "n,t,energy"),
        ("modified_energy = { order = 2 }", "n,t,modified_energy,estimate,order"),
        ("trajectory = true", "n,t,q,p"),
        ("energy = true\ntrajectory = true", "n,t,energy,q,p"),
        ("energy = false\ntrajectory = true", "n,t,q,p"),
    ] {
        let (header, rows) = table(&printed(&asking(outputs)));
        assert_eq!((header.join(","), rows.len()), (columns.to_owned(), 5));
        let lines = objects(&printed(&asking(&format!("format = \"jsonl\"\n{outputs}"))));
        let mut expected: Vec<&str> = columns.split(',').collect();
        expected.sort_unstable();
        assert!(lines[1..].iter().all(|line| line.as_object().unwrap().keys().eq(&expected)), "{lines:?}");
    }
}

/// `every` does not change estimates.
#[test]
fn a_row_is_written_where_a_column_is_due() {
    let outputs = "energy = { every = 2 }\ntrajectory = { every = 3 }";
    let (_, rows) = table(&printed(&asking(outputs)));
    let due: Vec<_> = rows.iter().map(|row| (row[0].as_str(), !row[2].is_empty(), !row[3].is_empty())).collect();
    assert_eq!(due, [("0", true, true), ("2", true, false), ("3", false, true), ("4", true, false)]);
    let lines = objects(&printed(&asking(&format!("format = \"jsonl\"\n{outputs}"))));
    assert_eq!((lines.len(), lines[1].get("energy").is_some(), lines[1].get("q").is_some()), (4, true, false));
    let all = table(&printed(&asking("modified_energy = { order = 2 }"))).1;
    let some = table(&printed(&asking("modified_energy = { order = 2, every = 2 }"))).1;
    assert_eq!(some, [all[0].clone(), all[2].clone(), all[4].clone()]);
}

#[test]
fn masses_velocities_and_parameters() {
    // a spring k between the wall and a mass m: the period of q = cos(t) is 2 pi for k = m
    let scene = "[problem]\npotential = \"k*x^2/2\"\ncoordinates = [\"x\"]\nparameters = { m = 3, k = \"m\" }\n\
                 masses = [\"m\"]\n[initial]\nq = [0]\nv = [\"1/m\"]\n[run]\nscheme = \"yoshida4\"\nstep \
                 = \"1/(10*m)\"\n\
                 until = \"m/3\"\ndigits = 20\n[output]\nformat = \"jsonl\"\ntrajectory = true\n";
    let lines = objects(&printed(scene));
    assert_eq!(lines.len(), 31);
    assert_eq!(lines[0]["p"], serde_json::json!(["1.0"]));
    let last: f64 = lines[30]["q"][0].as_str().unwrap().parse().unwrap();
    // the error of order 4 at h = 1/30
    assert!((last - 1.0_f64.sin() / 3.0).abs() < 1e-6, "{last}");
}

#[test]
fn a_table_is_found_beside_the_scene_and_may_begin_with_the_other_map() {
    let scene = asking("trajectory = true").replace("\"stormer-verlet\"", "\"mine.toml\"");
    let euler = "name = \"euler\"\norder = 1\nkinetic = \"any\"\nreference = \"Euler\"\n\
                 [stages]\nkick = [1]\ndrift = [1]\n";
    let rows = |scene: &str| {
        let folder = folder(scene);
        fs::write(folder.path().join("mine.toml"), euler).unwrap();
        table(&quietly(&format!("run {} --no-summary", folder.path().join("scene.toml").display()))).1
    };
    let kick_first = rows(&scene);
    let drift_first = rows(&scene.replace("[output]", "first = \"drift\"\n[output]"));
    assert_eq!(kick_first, rows(&scene.replace("[output]", "first = \"kick\"\n[output]")));
    assert_ne!(kick_first[1], drift_first[1]);
}

#[test]
fn the_file_of_another_scene_is_replaced_only_by_force() {
    for output in ["energy = true\nfile = \"out.csv\"", "energy = true\nfile = \"out.csv\"\ncheckpoint = 2"] {
        let folder = folder(&asking(output));
        let read = || fs::read_to_string(folder.path().join("out.csv")).unwrap();
        fs::write(folder.path().join("out.csv"), "precious").unwrap();
        let result = run(folder.path(), "");
        assert_eq!(result.code, 2, "{}", result.err);
        assert!(result.err.contains("out.csv already exists and is not from this unchanged scene"), "{}", result.err);
        assert!(result.err.contains("replace it with --force"), "{}", result.err);
        assert_eq!(run(folder.path(), "--restart").code, 2);
        assert_eq!(read(), "precious");
        assert_eq!(run(folder.path(), "--force").code, 0);
        let whole = read();
        // the result of this scene is replaced by the same bytes
        assert_eq!(run(folder.path(), "--restart").code, 0);
        assert_eq!(read(), whole);
        fs::write(folder.path().join("scene.toml"), asking(output).replace("steps = 4", "steps = 3")).unwrap();
        assert_eq!(run(folder.path(), "").code, 2);
        assert_eq!(read(), whole);
    }
}

#[test]
fn every_problem_and_the_shipped_scenes_of_schemes_run_with_their_files() {
    let problems = objects(&quietly("problems --json"));
    let problems = problems.iter().map(|problem| (text(problem, "name"), text(problem, "until")));
    let of =
        |group: &&(&str, _)| group.0.starts_with("schemes") || ["liquids", "multiple time steps"].contains(&group.0);
    let shipped = shadowstep_scenes::SHIPPED_SCENES.iter().filter(of).flat_map(|(_, scenes)| *scenes);
    for (name, until) in problems.chain(shipped.map(|scene| (scene.name, ""))) {
        let (text, is_problem) = (quietly(&format!("scene {name}")), !until.is_empty());
        let line = text.lines().find(|line| line.starts_with("until")).unwrap();
        assert!(!is_problem || line == format!("until = \"{until}\""), "{text}");
        let scene = text.replace(line, if is_problem { "steps = 20" } else { "steps = 100" });
        let folder = folder(&scene);
        let result = run(folder.path(), "");
        assert_eq!((result.code, result.err.as_str()), (0, ""), "{text}");
        let read = || table(&fs::read_to_string(folder.path().join(format!("{name}.csv"))).unwrap());
        let (header, rows) = read();
        let has =
            |name: &str| header.iter().position(|h| h == name).is_some_and(|c| rows.iter().any(|r| !r[c].is_empty()));
        assert!(has("energy") && has("modified_energy"), "{name}: {rows:?}");
        match is_problem {
            true => assert_eq!((header.len(), rows.len()), (6, 21), "{name}"),
            false => assert!(folder.path().join(format!("{name}.svg")).exists(), "{name}"),
        }
        if name == "kepler" {
            // its state is that of the problem
            let is_state = |line: &&str| line.starts_with("q =") || line.starts_with("p =");
            let stateless: Vec<&str> = scene.lines().filter(|line| !is_state(line)).collect();
            fs::write(folder.path().join("scene.toml"), stateless.join("\n")).unwrap();
            assert_eq!(run(folder.path(), "--force").code, 0);
            assert_eq!(read(), (header, rows));
        }
    }
}

#[test]
fn scene_lists_and_explains() {
    let list = quietly("scene");
    assert!(list.contains("  kepler  ") && list.contains("shadowstep scene kepler > scene.toml"), "{list}");
    let explained = quietly("scene --explain");
    for line in
        ["[problem]", "[output.modified_energy]", "  step = \"1/20\"", "      Required.", "      Default: \"double\"."]
    {
        assert!(explained.lines().any(|l| l == line), "{line}: {explained}");
    }
}

#[test]
fn json_lines_are_rows_with_the_metadata_beside_them() {
    let scene = asking("format = \"jsonl\"\nenergy = true");
    let rows = objects(&printed(&scene));
    assert_eq!(rows.len(), 5);
    assert_eq!(rows[0], serde_json::json!({ "n": 0, "t": "0.0", "energy": text(&rows[0], "energy") }));
    let on_stderr = objects(&summarised(folder(&scene).path(), "").err);
    assert_eq!((on_stderr.len(), text(&on_stderr[0]["metadata"], "problem")), (1, "pendulum"));

    let folder = folder(&format!("{scene}file = \"out.jsonl\"\n"));
    let result = summarised(folder.path(), "");
    assert!(result.err.starts_with("stormer-verlet, step 1/8, 4 steps\n"), "{}", result.err);
    assert_eq!(names(folder.path()), ["out.jsonl", "out.jsonl.metadata.json", "scene.toml"]);
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert_eq!(objects(&read("out.jsonl")), rows);
    let beside: Value = serde_json::from_str(&read("out.jsonl.metadata.json")).unwrap();
    assert_eq!(beside["metadata"]["steps"], 4);
    assert_eq!(beside["summary"]["energy_error"]["initial"], rows[0]["energy"]);
    // the metadata belong to the file: without them it is that of a stranger
    fs::remove_file(folder.path().join("out.jsonl.metadata.json")).unwrap();
    assert_eq!(run(folder.path(), "").code, 2);
}

/// The monitor makes some steps with increments, which have the same bits.
#[test]
fn a_summary_leaves_the_rows_as_they_are() {
    for output in ["trajectory = true", "energy = { every = 3 }\nmodified_energy = { order = 4, every = 2 }"] {
        let scene = asking(output).replace("steps = 4", "steps = 9000").replace("\"stormer-verlet\"", "\"yoshida4\"");
        let with = summarised(folder(&scene).path(), "");
        assert_eq!(with.out, printed(&scene));
        assert!(with.err.contains("\n  verdict           bounded: the energy error is"), "{}", with.err);
    }
}

/// Nothing is computed where the file is complete: no verdict, so no success.
#[test]
fn a_complete_file_of_ruin_is_no_success() {
    let kept = folder(
        "[problem]\nname = \"pythagorean\"\n[run]\nscheme = \"stormer-verlet\"\nstep = \"1/50\"\nuntil = 10\n\
         digits = \"double\"\n[output]\nenergy = { every = 100 }\nfile = \"out.csv\"\n",
    );
    let result = summarised(kept.path(), "");
    assert!(result.code == 0 && result.err.contains("steps per passage at t = 1.8"), "{}", result.err);
    let again = summarised(kept.path(), "--strict");
    assert!(again.code == 2 && again.err.contains("its file is complete") && again.err.contains("--restart"));
    assert_eq!(summarised(kept.path(), "--strict --restart").code, 1);
}

#[test]
fn a_scene_may_leave_the_summary_out() {
    let scene = asking("energy = true\nsummary = false");
    let result = summarised(folder(&scene).path(), "");
    assert_eq!((result.code, result.err.as_str(), result.out), (0, "", printed(&scene)));
    let with = summarised(folder(&scene.replace("false", "true")).path(), "--strict");
    assert!(with.err.contains("\n  verdict  "), "{}", with.err);
}

/// H is computed at each 100th state, of which there are 201, and in the windows of the monitor, of which 253 are at
/// other states; all states of a short run are known.
#[test]
fn an_error_of_some_states_is_not_called_the_largest_of_all() {
    let kepler = |steps: u32| {
        let scene = format!(
            "[problem]\nname = \"kepler\"\n[run]\nscheme = \"stormer-verlet\"\nstep = \"1/20\"\nsteps = {steps}\n\
             digits = \"double\"\n[output]\nenergy = {{ every = 100 }}\n"
        );
        summarised(folder(&scene).path(), "").err.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let (long, short) = (kepler(20_000), kepler(60));
    assert!(long.contains("error of H 0.0188 of |H(0)| (t = 742) is the largest of 1480 states,"), "{long}");
    assert!(!long.contains("at most 0.0188"), "{long}");
    assert!(short.contains("error of H at most 0.0") && !short.contains("the largest of"), "{short}");
}

/// Three trajectories; at the second one the force is infinite.
const ENSEMBLE: &str = r#"
[problem]
potential = "-depth/sqrt(x^2 + y^2)"
coordinates = ["x", "y"]
parameters = { depth = "1 + d" }
[initial]
q = ["x0", 0]
p = [0, 1]
[run]
scheme = "yoshida4"
step = "1/20"
steps = 40
digits = "double"
[output]
modified_energy = { estimator = "bilinear", order = 4, every = 10 }
file = "out.csv"
"#;

/// The rows of an ensemble, cell by cell, without the head.
fn rows(text: &str) -> Vec<Vec<String>> {
    text.lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.split(',').map(str::to_owned).collect())
        .collect()
}

/// Rows are those of the scenes of their own, read through the post-map.
#[test]
fn an_ensemble_has_a_row_for_each_trajectory() {
    for (scheme, step, every) in [("yoshida4", "1/20", 10), ("bcm6-11", "1/3", 4)] {
        let scene = ENSEMBLE.replace("yoshida4", scheme).replace("1/20", step).replace("10 }", &format!("{every} }}"));
        let lists = format!("{scene}[ensemble]\ncolumns = {{ d = [0, 0.25, \"1/3\"], x0 = [1, 0, 1.5] }}\n");
        let of_lists = folder(&lists);
        assert_eq!(run(of_lists.path(), "").code, 0);
        let table = rows(&fs::read_to_string(of_lists.path().join("out.csv")).unwrap());
        assert_eq!(
            table[0].join(","),
            "trajectory,d,x0,x,y,px,py,energy_error,energy_start,energy_end,modified_drift,modified_start,modified_end,\
             not_finite"
        );
        // lost at the start
        assert_eq!([&table[2][9], &table[2][11]], ["", ""]);
        assert_eq!(table.iter().skip(1).map(|row| row[13].as_str()).collect::<Vec<_>>(), ["", "0", ""]);
        for (row, d) in [(1, "0"), (3, "1/3")] {
            let own = scene.replace("1 + d", &format!("1 + {d}")).replace("x0", &table[row][2]);
            let (modified, file) = (own.find("modified_energy").unwrap(), own.find("file = ").unwrap());
            let output = format!("energy = {{ every = {every} }}\ntrajectory = {{ every = {every} }}\n");
            let own = rows(&printed(
                &(own[..modified].to_owned() + &output + &own[file..].replace("file = \"out.csv\"", "")),
            ));
            let last = own.last().unwrap();
            assert_eq!(table[row][3..7], last[last.len() - 4..], "{last:?}");
            let energies: Vec<f64> = own[1..].iter().map(|row| row[2].parse().unwrap()).collect();
            let largest = energies.iter().map(|e| (e - energies[0]).abs() / energies[0].abs()).fold(0.0, f64::max);
            let [error, start, end, drift, first, newest]: [f64; 6] =
                [7, 8, 9, 10, 11, 12].map(|cell| table[row][cell].parse().unwrap());
            // H of lanes is summed in another order
            assert!((error - largest).abs() < 1e-14 && 0.0 < error && error < 1e-2, "{error} {largest}");
            assert!(0.0 < drift && (scheme != "yoshida4" || drift < error), "{drift} {error}");
            assert!((end / start - 1.0).abs() <= error && (newest - first).abs() <= drift, "{:?}", table[row]);
        }
        let of_file = folder(&format!("{scene}[ensemble]\nfile = \"starts.csv\"\n"));
        fs::write(of_file.path().join("starts.csv"), "# made by hand\nd, x0\n0, 1\n0.25, 0\n1/3, 1.5\n").unwrap();
        assert_eq!(run(of_file.path(), "").code, 0);
        assert_eq!(rows(&fs::read_to_string(of_file.path().join("out.csv")).unwrap()), table);
    }
}

/// As a complete run that is run again.
#[test]
fn a_complete_ensemble_is_done() {
    let folder = folder(&format!("{ENSEMBLE}[ensemble]\nfile = \"starts.csv\"\n"));
    let path = |name: &str| folder.path().join(name);
    let starts = |text: &str| fs::write(path("starts.csv"), text).unwrap();
    starts("d,x0\n0,1\n1/3,1.5\n");
    assert_eq!(run(folder.path(), "").code, 0);
    let whole = fs::read_to_string(path("out.csv")).unwrap();
    let made = || fs::metadata(path("out.csv")).unwrap().modified().unwrap();
    let first = made();
    for flags in ["", "--force"] {
        let again = run(folder.path(), flags);
        assert!(again.err.contains("is done: its file is complete; --restart runs it again"), "{}", again.err);
        assert_eq!((again.code, made()), (0, first));
    }
    let restarted = run(folder.path(), "--restart");
    assert_eq!((restarted.code, restarted.err.as_str()), (0, ""));
    assert!(made() > first && fs::read_to_string(path("out.csv")).unwrap() == whole);
    // of other columns, or of somebody else, it is another file
    for other in ["d,x0\n0,1\n1/3,1.6\n", "d,x0\n0,1\n1/3,1.5\n1,1\n"] {
        starts(other);
        for flags in ["", "--restart"] {
            let refused = run(folder.path(), flags);
            assert_eq!(refused.code, 2);
            assert!(refused.err.contains("already exists and was made with different columns"), "{}", refused.err);
        }
    }
    assert_eq!(fs::read_to_string(path("out.csv")).unwrap(), whole);
    assert_eq!(run(folder.path(), "--force").code, 0);
    assert_eq!(rows(&fs::read_to_string(path("out.csv")).unwrap()).len(), 4);
}
