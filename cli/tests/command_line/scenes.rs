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
    let (header, rows) = table(&fs::read_to_string(folder.path().join("kepler.csv")).unwrap());
    assert_eq!(header, ["n", "t", "energy", "modified_energy", "estimate", "order"]);
    assert_eq!(rows.len(), 41);
    for (n, row) in rows.iter().enumerate() {
        assert_eq!((row[0].parse(), row[1].parse()), (Ok(n), Ok(n as f64 / 20.0)));
        assert_eq!(row[2].is_empty(), n % 10 != 0);
        // all digits are there
        assert!(row[3].starts_with("-0.50029") && row[3].len() > 115, "{row:?}");
    }
    assert_eq!(rows[0][2], "-0.5");
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
    let refused = shadowstep(&format!(
        "drift {} --scheme yoshida4 --step 1/2 --until 1/100",
        folder.path().join("scene.toml").display()
    ));
    assert!(
        refused.code == 2 && refused.err.contains("a step of 1/2 is longer than the run until 1/100"),
        "{}",
        refused.err
    );
    // as of the scene, the step to that time is all there is
    let flags = "--csv --no-summary --scheme yoshida4 --step 1/2 --until 1/100 --order 8";
    let rows = table(&quietly(&format!("trace {} {flags}", folder.path().join("scene.toml").display()))).1;
    let t: f64 = rows[1][1].parse().unwrap();
    assert!(rows.len() == 2 && rows[1][0] == "1" && (t - 0.01).abs() < 1e-17, "{rows:?}");
}

#[test]
fn a_formula_has_the_numbers_of_the_shipped_problem() {
    let formula = KEPLER.replace("file = \"kepler.csv\"", "trajectory = true");
    let problem = formula
        .replace("potential = \"-1/sqrt(x^2 + y^2)\"", "name = \"kepler\"")
        .replace("coordinates = [\"x\", \"y\"]\nmasses = [1, 1]\n", "");
    assert_eq!(table(&printed(&formula)), table(&printed(&problem)));
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
        assert_eq!(header.join(","), columns);
        assert_eq!(rows.len(), 5);
        let lines = objects(&printed(&asking(&format!("format = \"jsonl\"\n{outputs}"))));
        for line in &lines[1..] {
            let names: Vec<&str> = line.as_object().unwrap().keys().map(String::as_str).collect();
            let mut expected: Vec<&str> = columns.split(',').collect();
            expected.sort_unstable();
            assert_eq!(names, expected);
        }
    }
}

#[test]
fn a_row_is_written_where_a_column_is_due() {
    let outputs = "energy = { every = 2 }\ntrajectory = { every = 3 }";
    let (_, rows) = table(&printed(&asking(outputs)));
    let due: Vec<_> = rows.iter().map(|row| (row[0].as_str(), !row[2].is_empty(), !row[3].is_empty())).collect();
    assert_eq!(due, [("0", true, true), ("2", true, false), ("3", false, true), ("4", true, false)]);
    let lines = objects(&printed(&asking(&format!("format = \"jsonl\"\n{outputs}"))));
    assert_eq!((&lines[1].get("energy").is_some(), &lines[1].get("q").is_some()), (&true, &false));
    assert_eq!(lines.len(), 4);
}

#[test]
fn every_selects_the_rows_and_does_not_change_the_estimates() {
    let all = table(&printed(&asking("modified_energy = { order = 2 }"))).1;
    let some = table(&printed(&asking("modified_energy = { order = 2, every = 2 }"))).1;
    assert_eq!(some, [all[0].clone(), all[2].clone(), all[4].clone()]);
}

#[test]
fn the_metadata_contain_the_run() {
    let csv = printed(&KEPLER.replace("file = \"kepler.csv\"", ""));
    let head: Vec<&str> = csv.lines().map_while(|line| line.strip_prefix("# ")).collect();
    for line in [
        "scene: scene.toml",
        "scheme: yoshida4",
        "digits: 120",
        "potential: -1/sqrt(x^2 + y^2)",
        "step: 1/20",
        "steps: 40",
    ] {
        assert!(head.contains(&line), "{head:?}");
    }
    assert!(head.contains(&"q: [\"2/5\",\"0\"]") && head.contains(&"p: [\"0\",\"2\"]"), "{head:?}");
    // a composition has its own table and the one of its base
    let hash = |name: &str| head.iter().find_map(|line| line.strip_prefix(name)).unwrap().len();
    assert_eq!([hash("scene_sha256: "), hash("table_sha256: "), hash("base_table_sha256: ")], [64; 3]);
}

#[test]
fn the_same_scene_gives_the_same_bytes() {
    assert_eq!(printed(&asking("energy = true")), printed(&asking("energy = true")));
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
fn a_run_that_fails_leaves_the_old_file() {
    let folder = folder(
        "[problem]\nname = \"harmonic-oscillator\"\n[run]\nscheme = \"stormer-verlet\"\nstep = 10\nuntil = 10000\n\
         digits = \"double\"\n[output]\ntrajectory = true\nfile = \"out.csv\"\n",
    );
    fs::write(folder.path().join("out.csv"), "old").unwrap();
    let result = run(folder.path(), "--force");
    assert_eq!(result.code, 3);
    assert!(result.err.contains("the run stopped at n = "), "{}", result.err);
    assert_eq!(fs::read_to_string(folder.path().join("out.csv")).unwrap(), "old");
    assert_eq!(names(folder.path()), ["out.csv", "scene.toml"]);
}

#[test]
fn where_only_the_estimators_states_fail_a_lower_order_is_the_hint() {
    let scene = |modified: &str| {
        format!(
            "[problem]\nname = \"henon-heiles\"\n[initial]\nq = [0, 1.1]\np = [0.1, 0]\n[run]\nscheme \
                = \"stormer-verlet\"\n\
             step = 0.1\nuntil = 3\ndigits = 120\n[output]\nmodified_energy = {modified}\n"
        )
    };
    for (modified, hint) in [
        ("{ estimator = \"central\" }", "a lower max_order (here 200) "),
        ("{ order = 150 }", "a lower order (here 150) "),
    ] {
        let result = run(folder(&scene(modified)).path(), "");
        assert_eq!(result.code, 3);
        assert!(result.err.contains(&format!("\n  hint: {hint}needs fewer of them; ")), "{}", result.err);
    }
    assert_eq!(run(folder(&scene("{ order = 8 }")).path(), "").code, 0);
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
fn a_run_that_left_the_domain_of_the_potential_is_not_complete() {
    // the gradient 1/x has values where log(x) has none
    let scene = |output: &str| {
        format!(
            "[problem]\npotential = \"log(x)\"\ncoordinates = [\"x\"]\n[initial]\nq = [1]\np = [-1]\n\
             [run]\nscheme = \"stormer-verlet\"\nstep = \"1/10\"\nsteps = 20\ndigits = 30\n[output]\n{output}\n"
        )
    };
    for output in ["energy = true", "energy = { every = 100 }", "trajectory = true"] {
        let result = run(folder(&scene(output)).path(), "");
        assert_eq!(result.code, 3, "{output}: {}", result.err);
        assert!(result.err.contains("the energy at "), "{}", result.err);
    }
}

#[test]
fn an_end_that_is_not_a_multiple_of_the_step_is_noted() {
    let folder = folder(&asking("energy = true").replace("steps = 4", "until = \"1/3\""));
    let result = run(folder.path(), "");
    assert_eq!(result.code, 0);
    assert_eq!(result.err, "note: 1/3 is not a multiple of 1/8: the run ends at n = 2, t = 0.25\n");
}

#[test]
fn every_shipped_problem_has_a_scene_that_runs() {
    let problems = objects(&quietly("problems --json"));
    assert!(problems.len() >= 5);
    for problem in &problems {
        let name = text(problem, "name");
        let until = format!("until = \"{}\"", text(problem, "until"));
        let scene = quietly(&format!("scene {name}"));
        assert!(scene.contains(&until), "{scene}");
        let scene = scene.replace(&until, "steps = 20");
        let folder = folder(&scene);
        let result = run(folder.path(), "");
        assert_eq!((result.code, result.err.as_str()), (0, ""), "{scene}");
        let file = format!("{name}.csv");
        assert_eq!(names(folder.path()).iter().filter(|found| **found == file).count(), 1);
        let (header, rows) = table(&fs::read_to_string(folder.path().join(file)).unwrap());
        assert_eq!((header.len(), rows.len()), (6, 21), "{name}");
    }
}

#[test]
fn every_shipped_scene_of_a_scheme_a_liquid_or_multiple_steps_runs_with_its_picture() {
    let of =
        |group: &&(&str, _)| group.0.starts_with("schemes") || ["liquids", "multiple time steps"].contains(&group.0);
    for scene in shadowstep_scenes::SHIPPED_SCENES.iter().filter(of).flat_map(|(_, scenes)| *scenes) {
        let text = quietly(&format!("scene {}", scene.name));
        let until = text.lines().find(|line| line.starts_with("until")).unwrap();
        let folder = folder(&text.replace(until, "steps = 100"));
        let result = run(folder.path(), "");
        assert_eq!((result.code, result.err.as_str()), (0, ""), "{text}");
        let (header, rows) = table(&fs::read_to_string(folder.path().join(format!("{}.csv", scene.name))).unwrap());
        let [energy, modified] =
            ["energy", "modified_energy"].map(|name| header.iter().position(|h| h == name).unwrap());
        assert!(rows.len() > 1 && rows.iter().all(|row| !row[energy].is_empty()), "{rows:?}");
        assert!(rows.iter().any(|row| !row[modified].is_empty()), "{rows:?}");
        assert!(folder.path().join(format!("{}.svg", scene.name)).exists(), "{}", scene.name);
    }
}

#[test]
fn the_state_of_a_scene_is_that_of_its_problem() {
    let scene = quietly("scene kepler").replace("until = \"100\"", "until = 1").replace("\"1 min\"", "9");
    let stateless: String = scene
        .lines()
        .filter(|line| !line.starts_with("q =") && !line.starts_with("p ="))
        .map(|l| format!("{l}\n"))
        .collect();
    let state = |scene: &str| {
        let folder = folder(scene);
        assert_eq!(run(folder.path(), "").code, 0);
        table(&fs::read_to_string(folder.path().join("kepler.csv")).unwrap())
    };
    assert_eq!(state(&scene), state(&stateless));
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
    let result = shadowstep("scene keppler");
    assert_eq!(result.code, 2);
    assert!(result.err.contains("did you mean `kepler`?"), "{}", result.err);
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

/// Three bodies at h = 1/50: H goes from −12.8 to thousands.
#[test]
fn ruin_is_in_the_summary_and_with_strict_in_the_exit_code() {
    let scene = |step: &str| {
        format!(
            "[problem]\nname = \"pythagorean\"\n[run]\nscheme = \"stormer-verlet\"\nstep = \"{step}\"\nuntil = 10\n\
             digits = \"double\"\n[output]\nenergy = {{ every = 100 }}\n"
        )
    };
    let ruined = folder(&scene("1/50"));
    let result = summarised(ruined.path(), "");
    assert_eq!(result.code, 0);
    assert!(result.err.contains("the step size is too large") && result.err.contains("error of H"), "{}", result.err);
    assert!(result.err.contains("steps per passage at t = 1.8"), "{}", result.err);
    assert_eq!(summarised(ruined.path(), "--strict").code, 1);
    // nothing is computed where the file is complete: no verdict, so no success
    let kept = folder(&format!("{}file = \"out.csv\"\n", scene("1/50")));
    assert_eq!(summarised(kept.path(), "").code, 0);
    let again = summarised(kept.path(), "--strict");
    assert!(
        again.code == 2 && again.err.contains("its file is complete") && again.err.contains("--restart"),
        "{}",
        again.err
    );
    assert_eq!(summarised(kept.path(), "--strict --restart").code, 1);
    let fine = "[problem]\nname = \"kepler\"\n[run]\nscheme = \"stormer-verlet\"\nstep = \"1/20\"\nuntil = 100\n\
                digits = \"double\"\n[output]\nenergy = { every = 100 }\n";
    let result = summarised(folder(fine).path(), "--strict");
    assert_eq!(result.code, 0, "{}", result.err);
    assert!(result.err.contains("bounded: the energy error is"), "{}", result.err);
}

#[test]
fn a_scene_may_leave_the_summary_out() {
    let scene = asking("energy = true\nsummary = false");
    let without = folder(&scene);
    let result = summarised(without.path(), "");
    assert_eq!((result.code, result.err.as_str()), (0, ""));
    assert_eq!(result.out, printed(&scene));
    let refused = summarised(without.path(), "--strict");
    assert_eq!(refused.code, 2);
    assert!(
        refused.err.contains("--strict needs the verdict of a summary") && refused.err.contains("remove that line"),
        "{}",
        refused.err
    );
    let with = summarised(folder(&scene.replace("false", "true")).path(), "");
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

#[test]
fn a_complete_run_is_not_made_again() {
    let folder = folder(&asking("energy = true\nfile = \"out.csv\"\ncheckpoint = 2"));
    assert_eq!(run(folder.path(), "").code, 0);
    let file = folder.path().join("out.csv");
    let time = |file: &Path| fs::metadata(file).unwrap().modified().unwrap();
    let made = time(&file);
    let again = run(folder.path(), "");
    assert_eq!(again.code, 0);
    assert!(again.err.contains("is done: its file is complete; --restart runs it again"), "{}", again.err);
    assert_eq!(time(&file), made);
    assert_eq!((run(folder.path(), "--restart").code, time(&file) > made), (0, true));
}

#[test]
fn numbers_of_a_formula_that_overflow_in_double_precision_are_refused() {
    let scene = |potential: &str, digits: &str| {
        format!(
            "[problem]\npotential = \"{potential}\"\ncoordinates = [\"x\"]\nparameters = {{ k = 1e300 }}\n\
             [initial]\nq = [\"k*1e-200\"]\np = [0]\n[run]\nscheme = \"stormer-verlet\"\nstep = \"1/10\"\nsteps = 2\n\
             digits = {digits}\n[output]\nenergy = true\n"
        )
    };
    // each factor is a double; their product overflows
    for potential in ["k*1e-300*1e-100*x", "1e-400*x + x^2", "1e400*x"] {
        let result = run(folder(&scene(potential, "\"double\"")).path(), "");
        assert_eq!(result.code, 2, "{potential}: {}", result.err);
        assert!(result.err.contains("scene.toml:2:13: the number 1e"), "{}", result.err);
        assert!(result.err.contains("in the formula overflows or underflows in double precision"), "{}", result.err);
        assert_eq!(run(folder(&scene(potential, "17")).path(), "").code, 0, "{potential}");
    }
}

#[test]
fn a_failure_has_the_names_of_the_scene() {
    let scene = "[problem]\npotential = \"-x^4\"\ncoordinates = [\"x\"]\n[initial]\nq = [1]\np = [1]\n[run]\n\
                 scheme = \"stormer-verlet\"\nstep = \"1/10\"\nsteps = 100\ndigits = \"double\"\n[output]\n\
                 trajectory = true\n";
    let result = run(folder(scene).path(), "");
    assert_eq!(result.code, 3);
    assert!(result.err.contains(": px = ") || result.err.contains(": x = "), "{}", result.err);
}

#[test]
fn a_folder_is_refused_as_a_file() {
    let result = run(folder(&asking("energy = true\nfile = \"bad/\"\nformat = \"csv\"")).path(), "");
    assert_eq!(result.code, 2);
    assert!(result.err.contains("`bad/` is a folder"), "{}", result.err);
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

#[test]
fn an_ensemble_has_a_row_for_each_trajectory() {
    let lists = format!("{ENSEMBLE}[ensemble]\ncolumns = {{ d = [0, 0.25, \"1/3\"], x0 = [1, 0, 1.5] }}\n");
    let of_lists = folder(&lists);
    assert_eq!(run(of_lists.path(), "").code, 0);
    let text = fs::read_to_string(of_lists.path().join("out.csv")).unwrap();
    let table = rows(&text);
    assert_eq!(
        table[0].join(","),
        "trajectory,d,x0,x,y,px,py,energy_error,energy_start,energy_end,modified_drift,modified_start,modified_end,not_finite"
    );
    assert_eq!(table.len(), 4);
    // lost at the start
    assert_eq!([&table[2][9], &table[2][11]], ["", ""]);
    assert_eq!(table.iter().skip(1).map(|row| row[13].as_str()).collect::<Vec<_>>(), ["", "0", ""]);
    // each is the run of its own scene
    for (row, d) in [(1, "0"), (3, "1/3")] {
        let own = ENSEMBLE.replace("1 + d", &format!("1 + {d}")).replace("x0", &table[row][2]);
        let own = folder(&own.replace(
            "modified_energy = { estimator = \"bilinear\", order = 4, every = 10 }",
            "trajectory = { every = 40 }",
        ));
        assert_eq!(run(own.path(), "").code, 0);
        let last = fs::read_to_string(own.path().join("out.csv")).unwrap();
        let last = rows(last.lines().last().unwrap()).remove(0);
        assert_eq!(table[row][3..7], last[last.len() - 4..], "{last:?}");
        let [error, start, end, drift, first, newest]: [f64; 6] =
            [7, 8, 9, 10, 11, 12].map(|cell| table[row][cell].parse().unwrap());
        assert!(0.0 < drift && drift < error && error < 1e-2, "{error} {drift}");
        assert!((end / start - 1.0).abs() <= error && (newest - first).abs() <= drift, "{:?}", table[row]);
    }
    // the same from a file
    let of_file = folder(&format!("{ENSEMBLE}[ensemble]\nfile = \"starts.csv\"\n"));
    fs::write(of_file.path().join("starts.csv"), "# made by hand\nd, x0\n0, 1\n0.25, 0\n1/3, 1.5\n").unwrap();
    assert_eq!(run(of_file.path(), "").code, 0);
    assert_eq!(rows(&fs::read_to_string(of_file.path().join("out.csv")).unwrap()), table);
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

#[test]
fn names_of_scenes_are_suggested() {
    let mistyped = shadowstep("scene eight-planet");
    assert_eq!(mistyped.code, 2);
    assert!(mistyped.err.contains("`eight-planet`\n  hint: did you mean `eight-planets`?"), "{}", mistyped.err);
    for (word, name) in
        [("kepler", "kepler"), ("keppler", "kepler"), ("kepler.toml", "kepler"), ("resonance", "resonance")]
    {
        let refused = shadowstep(&format!("run {word}"));
        let hint = format!(
            "error: there is no file {word}\n  hint: `shadowstep scene {name} > {name}.toml` writes a scene, \
             `shadowstep run {name}.toml` runs it\n"
        );
        assert_eq!((refused.code, refused.err), (2, hint));
    }
    let refused = shadowstep("run mine.toml");
    assert!(refused.err.contains("hint: give the path of a scene; "), "{}", refused.err);
}

#[test]
fn an_ensemble_of_a_processed_scheme_is_read_through_the_post_map() {
    let scene = ENSEMBLE.replace("yoshida4", "bcm6-11").replace("1/20", "1/3");
    let scene = scene.replace("order = 4, every = 10", "order = 4, every = 4");
    let ensemble = folder(&format!("{scene}[ensemble]\ncolumns = {{ d = [0, \"1/3\"], x0 = [1, 1.5] }}\n"));
    let result = run(ensemble.path(), "");
    assert_eq!(result.code, 0, "{}", result.err);
    let table = rows(&fs::read_to_string(ensemble.path().join("out.csv")).unwrap());
    for (row, d) in [(1, "0"), (2, "1/3")] {
        let own = scene.replace("1 + d", &format!("1 + {d}")).replace("x0", &table[row][2]);
        let own = folder(&own.replace(
            "modified_energy = { estimator = \"bilinear\", order = 4, every = 4 }",
            "energy = { every = 4 }\ntrajectory = { every = 4 }",
        ));
        assert_eq!(run(own.path(), "").code, 0);
        let text = fs::read_to_string(own.path().join("out.csv")).unwrap();
        let own: Vec<_> = text.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit())).collect();
        let own = rows(&own.join("\n"));
        let last = own.last().unwrap();
        assert_eq!(table[row][3..7], last[last.len() - 4..], "{last:?}");
        let energies: Vec<f64> = own.iter().map(|row| row[2].parse().unwrap()).collect();
        let error = energies.iter().map(|energy| (energy - energies[0]).abs() / energies[0].abs()).fold(0.0, f64::max);
        let found: f64 = table[row][7].parse().unwrap();
        // H of lanes is summed in another order
        assert!((found - error).abs() < 1e-14 && (row == 1 || error > 1e-10), "{found} {error}");
    }
}

#[test]
fn masses_and_parameters_of_shipped_problems_differ_in_the_trajectories_of_an_ensemble() {
    let run_of = "[run]\nscheme = \"yoshida4\"\nstep = \"1/20\"\nsteps = 40\ndigits = \"double\"\n[output]\nfile \
        = \"out.csv\"\n";
    let masses = "[problem]\npotential = \"x^2*y^2/2\"\ncoordinates = [\"x\", \"y\"]\nmasses = [1, \"a\"]\n\
                  [initial]\nq = [1, \"1/2\"]\np = [0, 1]\n";
    let oscillator = "[problem]\nname = \"harmonic-oscillator\"\nparameters.omega = \"a\"\n";
    let three = "[problem]\nname = \"figure-eight\"\nparameters.m_2 = \"a\"\n";
    for problem in [masses, oscillator, three] {
        let ensemble =
            folder(&format!("{problem}{run_of}energy = true\n[ensemble]\ncolumns = {{ a = [1, \"1/3\", 2] }}\n"));
        assert_eq!(run(ensemble.path(), "").code, 0, "{}", run(ensemble.path(), "").err);
        let table = rows(&fs::read_to_string(ensemble.path().join("out.csv")).unwrap());
        for (row, a) in [(1, "1"), (2, "1/3"), (3, "2")] {
            let own = folder(
                &format!("{problem}{run_of}trajectory = {{ every = 40 }}\n").replace("\"a\"", &format!("\"{a}\"")),
            );
            assert_eq!(run(own.path(), "").code, 0);
            let last = fs::read_to_string(own.path().join("out.csv")).unwrap();
            let last = rows(last.lines().last().unwrap()).remove(0);
            assert_eq!(table[row][2..last.len()], last[2..], "{problem}");
        }
    }
}

#[test]
fn wrong_ensembles_have_a_sentence_each() {
    let columns = "[ensemble]\ncolumns = { d = [0, 1], x0 = [1, 2] }\n";
    for (scene, sentence) in [
        (format!("{ENSEMBLE}[ensemble]\n"), "scene.toml:17:1: one of the keys `columns`, `file` is needed"),
        (
            format!("{ENSEMBLE}[ensemble]\ncolumns = {{ d = [0, 1], x0 = [1] }}\n"),
            "scene.toml:18:30: columns need the same number of values",
        ),
        (format!("{ENSEMBLE}[ensemble]\ncolumns = {{ d = [0, \"a\"], x0 = [1, 2] }}\n"), "scene.toml:18:22: "),
        (format!("{ENSEMBLE}[ensemble]\nfile = \"none.csv\"\n"), "none.csv cannot be read"),
        (format!("{ENSEMBLE}[ensemble]\ncolums = {{}}\n"), "unknown key `colums`"),
        (
            format!("{ENSEMBLE}{columns}").replace("order = 4", "order = \"auto\""),
            "scene.toml:15:19: the modified energy of an ensemble is E_k of a fixed k",
        ),
        (
            format!("{ENSEMBLE}{columns}").replace("\"double\"", "30"),
            "scene.toml:13:10: an ensemble is computed in double",
        ),
        (format!("{ENSEMBLE}trajectory = true\n{columns}"), "scene.toml:17:14: an ensemble has no `trajectory`"),
        (format!("{ENSEMBLE}windows = 500\n{columns}"), "scene.toml:17:11: an ensemble has no `windows`"),
        (format!("{ENSEMBLE}{columns}").replace("1/20", "1/20 + x0"), "trajectory 1 has another step size"),
        (
            format!("{ENSEMBLE}{columns}").replace("q = [\"x0\", 0]", "q = [\"1/(2 - x0)\", 0]"),
            "division by zero (trajectory 1: d = 1, x0 = 2)",
        ),
        (format!("{ENSEMBLE}{columns}").replace("x0 = [1, 2]", "x1 = [1, 2]"), "x0"),
    ] {
        let finished = run(folder(&scene).path(), "");
        assert!(finished.code != 0 && finished.err.contains(sentence), "{scene}\n{}", finished.err);
    }
    // other commands say which one computes it
    let scene = folder(&format!("{ENSEMBLE}{columns}"));
    let finished = shadowstep(&format!("advise {} --tolerance 1e-6", scene.path().join("scene.toml").display()));
    let sentence = "scene.toml:17:2: an ensemble is computed by `shadowstep run` only";
    assert!(finished.code != 0 && finished.err.contains(sentence), "{}", finished.err);
}
