//! `shadowstep chaos`: chaos that the step size makes, exponents in pairs, refusals; the same values in a sweep.

use std::collections::BTreeMap;
use std::fs;

use serde_json::Value;
use tempfile::TempDir;

use crate::program::{objects, quietly, shadowstep, text};

/// The steps are the standard map with K = 1.
const PENDULUM: &str = r#"
[problem]
name = "pendulum"
[initial]
q = [3]
p = [0]
[run]
scheme = "stormer-verlet"
step = 1
until = 5000
digits = "double"
[output]
energy = true
"#;

fn in_folder(text: &str) -> (TempDir, String) {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("scene.toml");
    fs::write(&path, text).unwrap();
    let name = path.display().to_string();
    (folder, name)
}

fn number(record: &Value, name: &str) -> f64 {
    record[name].as_f64().unwrap_or_else(|| panic!("{name}: {record}"))
}

#[test]
fn chaos_of_the_step_size_is_told_from_that_of_the_problem() {
    let (_folder, scene) = in_folder(PENDULUM);
    let printed = quietly(&format!("chaos {scene}"));
    assert!(printed.ends_with("\nchaotic at 1 and regular at 1/2: of the step size\n"), "{printed}");
    let records = objects(&quietly(&format!("chaos {scene} --exponents 2 --json")));
    let [whole, half] = &records[..] else { panic!("{records:?}") };
    assert_eq!((text(whole, "motion"), text(half, "motion")), ("chaotic", "regular"));
    let pair = whole["exponents"].as_array().unwrap();
    let [largest, smallest] = [0, 1].map(|i| pair[i][0].as_f64().unwrap());
    // a step is symplectic
    assert!(largest > 0.1 && (largest + smallest).abs() < 1e-12, "{pair:?}");
    assert!((number(half, "mean_megno") - 2.0).abs() < 0.1, "{half}");
    assert_eq!(text(&whole["summary"], "verdict"), "the step size is too large");
    // where the energy is lost at both step sizes, they say nothing of the problem
    let (_folder, coarser) = in_folder(&PENDULUM.replace("step = 1", "step = 3"));
    let printed = quietly(&format!("chaos {coarser}"));
    assert!(
        printed.ends_with("\nchaotic at both step sizes, which are too large: not decided; try smaller steps\n"),
        "{printed}"
    );
}

/// A hill until t = 60, and then a well: vectors grow like e^t at first, which is no short run.
#[test]
fn growth_that_ends_is_not_called_a_short_run() {
    let hill = "[problem]\npotential = \"x^2/2*tanh(t - 60)\"\ncoordinates = [\"x\"]\n[initial]\nq = [1e-30]\np = [0]\n\
                [run]\nscheme = \"yoshida4\"\nstep = \"1/10\"\nuntil = 120\ndigits = \"double\"\n[output]\nenergy = true\n";
    let end = |until: &str| {
        let (_folder, scene) = in_folder(&hill.replace("until = 120", until));
        quietly(&format!("chaos {scene}")).replace('\n', " ")
    };
    let (grown, short) = (end("until = 120"), end("until = 4"));
    assert!(grown.contains("vectors grew more than along a regular orbit, but not at all times"), "{grown}");
    assert!(short.contains("not decided: the run is too short"), "{short}");
}

#[test]
fn a_sweep_keeps_the_values_of_the_command() {
    let (folder, scene) = in_folder(PENDULUM);
    let alone = objects(&quietly(&format!("chaos {scene} --one --json")));
    let sweep = folder.path().join("sweep.toml");
    let keep = "[keep]\nvalues = [\"motion\", \"lyapunov\", \"lyapunov_error\", \"megno\", \"sali\"]\n";
    fs::write(&sweep, PENDULUM.replace("step = 1", "step = \"h0\"") + "[axes]\nh0 = [1]\n" + keep).unwrap();
    let out = folder.path().join("out");
    let made = shadowstep(&format!("sweep {} --out {}", sweep.display(), out.display()));
    assert_eq!(made.code, 0, "{}", made.err);
    let table = fs::read_to_string(out.join("results.csv")).unwrap();
    let mut lines = table.lines().filter(|line| !line.starts_with('#')).map(|line| line.split(','));
    let row: BTreeMap<&str, &str> = lines.next().unwrap().zip(lines.next().unwrap()).collect();
    assert_eq!(row["motion"], "chaotic");
    let pairs =
        [("lyapunov", "exponent"), ("lyapunov_error", "exponent_error"), ("megno", "mean_megno"), ("sali", "sali")];
    for (column, name) in pairs {
        assert_eq!(row[column].parse::<f64>().unwrap(), number(&alone[0], name), "{name}");
    }
}

#[test]
fn a_problem_with_flags_is_followed_as_a_scene_is() {
    let (folder, scene) = in_folder(&PENDULUM.replace("q = [3]\np = [0]", "q = [0]\np = [1]"));
    let of_scene = quietly(&format!("chaos {scene} --json"));
    assert_eq!(quietly("chaos pendulum --scheme stormer-verlet --step 1 --until 5000 --json"), of_scene);
    // what no flag gives is that of the scene; without [run] it is only a system
    let half = objects(&of_scene)[1].clone();
    assert_eq!(objects(&quietly(&format!("chaos {scene} --step 1/2 --one --json")))[0], half);
    fs::write(&scene, fs::read_to_string(&scene).unwrap().replace("[output]\nenergy = true\n", "")).unwrap();
    assert_eq!(quietly(&format!("chaos {scene} --json")), of_scene);
    let system = folder.path().join("system.toml");
    fs::write(&system, "problem.name = \"pendulum\"\ninitial = { q = [0], p = [1] }\n").unwrap();
    let flags = "--scheme stormer-verlet --step 1/2 --until 5000 --one --json";
    assert_eq!(objects(&quietly(&format!("chaos {} {flags}", system.display())))[0], half);
}
