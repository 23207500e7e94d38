//! Wrong inputs of all kinds with their messages and exit codes, in one snapshot that people read: each message states
//! what is wrong, where, and what would be right.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use tempfile::TempDir;

const SCENE: &str = r#"[problem]
potential = "k/sqrt(x^2 + y^2)"
coordinates = ["x", "y"]
parameters = { k = -1 }
[initial]
q = [1, 0]
p = [0, 1]
[run]
scheme = "yoshida4"
step = "1/20"
steps = 40
digits = 30
[output]
energy = true
file = "out.csv"
checkpoint = 10
"#;

const TABLE: &str = r#"name = "mine"
order = 4
kinetic = "any"
symmetric = true
reference = "H. Yoshida"
[constants]
g1 = "1/(2 - 2^(1/3))"
[composition]
base = "stormer-verlet"
gamma = ["g1", "1 - 2*g1", "g1"]
"#;

/// Command lines, in a folder with scene.toml and mine.toml, which are valid.
const COMMANDS: &[&str] = &[
    "frobnicate",
    "drift",
    "drift kepler",
    "drift keppler --scheme yoshida4 --step 1/10 --until 2",
    "drift kepler --scheme yoshidda4 --step 1/10 --until 2",
    "drift kepler --scheme other.toml --step 1/10 --until 2",
    "drift kepler --scheme yoshida4 --step 0 --until 2",
    "drift kepler --scheme yoshida4 --step 1/0 --until 2",
    "drift kepler --scheme yoshida4 --step 0,1 --until 2",
    "drift kepler --scheme yoshida4 --step 1e-9223372036854775808 --until 2",
    "drift kepler --scheme yoshida4 --step 1/10 --until -2",
    "drift kepler --scheme yoshida4 --step 1/10 --until tomorrow",
    "drift kepler --scheme yoshida4 --step 5 --until 2",
    "drift kepler --scheme yoshida4 --step 1e-300 --until 2",
    "drift kepler --scheme yoshida4 --step 1/10 --until 2 --digits 0",
    "drift kepler --scheme yoshida4 --step 1/10 --until 2 --digits 5000",
    "drift kepler --scheme yoshida4 --step 1/10 --until 2 --double --digits 30",
    "drift kepler --scheme yoshida4 --step 1/10 --until 2 --order 0",
    "drift kepler --scheme yoshida4 --step 1/10 --until 2 --order 4 --stop early",
    "drift kepler --scheme yoshida4 --step 1/10 --until 2 --estimator bilinear --order 1000",
    "drift kepler --scheme yoshida4 --step 1/10 --until 2 --estimator linear",
    "drift kepler --scheme yoshida4 --step 1/10 --until 2 --estimator central --accuracy 1e-9",
    "drift kepler --scheme yoshida4 --step 1/10 --until 2 --estimator bilinear --accuracy 0",
    "drift kepler --scheme yoshida4 --step 1/10 --until 2 --set eccentricity=1",
    "drift kepler --scheme yoshida4 --step 1/10 --until 2 --set eccentricity=0,5",
    "drift kepler --scheme yoshida4 --step 1/10 --until 2 --set e=1/2",
    "drift kepler --scheme yoshida4 --step 1/10 --until 2 --set x",
    "drift kepler --scheme yoshida4 --step 1/10 --until 2 --set x=2x",
    "drift kepler --scheme yoshida4 --step 1/10 --until 2 --set x=1e160 --double",
    "drift kepler --scheme yoshida4 --step 1/10 --until 2 --set x=0",
    "drift outer-solar-system --scheme yoshida4 --step 1 --until 2 --double --set m_pluto=1e-400",
    "drift kepler --scheme yoshida4 --step 1/10 --until 2 --output no/such/folder.json",
    "drift toda --scheme exact-flow --step 1/10 --until 2",
    "drift --potential x^2/2 --scheme yoshida4 --step 1/10 --until 2",
    "drift --potential x^2/2 --q x=1 --p 0,0 --scheme yoshida4 --step 1/10 --until 2",
    "drift --potential abs(x) --q x=1 --p 0 --scheme yoshida4 --step 1/10 --until 2",
    "drift --potential y^2 --q x=1 --p 0 --scheme yoshida4 --step 1/10 --until 2",
    "drift --potential x**2 --q x=1 --p 0 --scheme yoshida4 --step 1/10 --until 2",
    "drift --potential (x+1 --q x=1 --p 0 --scheme yoshida4 --step 1/10 --until 2",
    "drift --potential 2x --q x=1 --p 0 --scheme yoshida4 --step 1/10 --until 2",
    "drift --potential x^x --q x=1 --p 0 --scheme yoshida4 --step 1/10 --until 2",
    "drift --potential log(x) --q x=-1 --p 0 --scheme yoshida4 --step 1/10 --until 2",
    "drift --potential x^2 --q x=1 --p 0 --masses -1 --scheme yoshida4 --step 1/10 --until 2",
    "drift kepler --q x=1 --p 0 --scheme yoshida4 --step 1/10 --until 2",
    "trace kepler --scheme yoshida4 --step 1/10 --until 2 --plot picture.png",
    "run",
    "run nowhere.toml",
    "run mine.toml",
    "run scene.toml --digits 30",
    "scene keppler",
    "problems keppler",
    "schemes show yoshida5",
    "schemes check nowhere.toml",
    "schemes check scene.toml",
    "schemes check --from scene.toml",
    "schemes check --from nowhere.py",
    "schemes --order 11",
    "schemes --sort beauty",
    "schemes polish mine.toml --digits 5",
    "figures 99",
    "advise kepler --until 10",
    "advise kepler --until 10 --tolerance 0",
    "advise kepler --until 0 --tolerance 1e-6",
    "work-precision kepler --until 10 --scheme nothing",
];

/// Changes of SCENE: a part and its replacement.
const SCENES: &[(&str, &str)] = &[
    ("scheme =", "shceme ="),
    ("[initial]", "[intial]"),
    ("\"yoshida4\"", "\"yoshida5\""),
    ("\"yoshida4\"", "yoshida4"),
    ("step = \"1/20\"", "step = 1/20"),
    ("step = \"1/20\"", "step = \"1/2O\""),
    ("step = \"1/20\"", "step = 1e-400\nuntil = 1"),
    ("steps = 40", "steps = 40.5"),
    ("steps = 40", "steps = -40"),
    ("steps = 40\n", ""),
    ("digits = 30", "digits = \"single\""),
    ("digits = 30", "digits = 1000000"),
    ("q = [1, 0]", "q = [1]"),
    ("q = [1, 0]", "q = [1, nan]"),
    ("q = [1, 0]", "q = [1, \"z\"]"),
    ("q = [1, 0]", "q = [1, 1e99999]"),
    ("q = [1, 0]", "q = [0, 0]"),
    ("digits = 30", "digits = \"double\"\n[initial.q]"),
    ("x^2 + y^2)", "x^2 + z^2)"),
    ("x^2 + y^2)", "x^2 + y^2"),
    ("x^2 + y^2)", "x² + y²)"),
    ("k = -1", "k = \"1/0\""),
    ("k = -1", "pi2 = -1"),
    ("[\"x\", \"y\"]", "[\"x\", \"x\"]"),
    ("[\"x\", \"y\"]", "[\"x\", \"t\"]"),
    ("[initial]", "masses = [1, 0]\n[initial]"),
    ("[initial]", "kinetic = \"px^2 + x\"\n[initial]"),
    ("energy = true", "energy = false"),
    ("energy = true", "modified_energy = { order = 2000 }"),
    ("\"out.csv\"", "\"out.txt\""),
    ("\"out.csv\"", "\"no/such/folder/out.csv\""),
    ("checkpoint = 10", "checkpoint = \"10 days\""),
    ("[output]", "[output"),
    ("q = [1, 0]", "q = [1, -1e160]\nv = [1, 1]"),
    ("digits = 30", "digits = \"double\"\nfirst = \"kik\""),
    ("potential = \"k/sqrt(x^2 + y^2)\"", "pair = \"1/sqrt(r2)\"\nbodies = 1"),
    ("potential = \"k/sqrt(x^2 + y^2)\"", "name = \"keplr\""),
];

/// Changes of TABLE, which `schemes check` reads.
const TABLES: &[(&str, &str)] = &[
    ("order = 4", "order = 6"),
    ("order = 4", "order = 12"),
    ("order = 4", "oder = 4"),
    ("\"mine\"", "\"My Scheme\""),
    ("\"any\"", "\"all\""),
    ("2^(1/3)", "2^(1/2)"),
    ("2^(1/3)", "2^1/3"),
    ("2 - 2^(1/3)", "2 - 2^(1/3"),
    ("g1 = \"1/(2", "g1 = \"1/(2 - 2"),
    ("g1 = \"1/(2 - 2^(1/3))\"", "g1 = 1.351207"),
    ("g1 = \"1/(2 - 2^(1/3))\"", "g1 = 1.3512071919596576\n[digits]"),
    ("\"1 - 2*g1\"", "\"1 - 2*g2\""),
    ("\"1 - 2*g1\"", "\"-g1\""),
    ("\"1 - 2*g1\"", "1e5"),
    ("\"g1\"]", "\"g1\", 0.1]"),
    ("\"stormer-verlet\"", "\"stormer-velet\""),
    ("\"stormer-verlet\"", "\"./mine.toml\""),
    ("[composition]", "[stages]"),
    ("symmetric = true", "symmetric = \"yes\""),
    ("symmetric = true", "symmetric = true\ndigits = 400"),
];

/// Changes of the checkpoint of SCENE at n = 20.
const CHECKPOINTS: &[(&str, &str)] =
    &[("\"checkpoint\"", "\"chekpoint\""), ("\"n\": 20", "\"n\": 21"), ("}", ""), ("{", "null {")];

#[test]
#[cfg(feature = "mpfr")]
fn messages_and_exit_codes() {
    let valid = valid_folder();
    for words in [&["run", "scene.toml", "--no-summary"], &["schemes", "check", "mine.toml"][..]] {
        assert!(run(valid.path(), "valid", words).contains("exit code 0"), "{words:?}");
    }
    let mut all = Vec::new();
    for words in COMMANDS {
        let words: Vec<&str> = words.split_whitespace().collect();
        all.push(run(valid_folder().path(), &format!("shadowstep {}", words.join(" ")), &words));
    }
    for (part, replacement) in SCENES {
        let folder = valid_folder();
        fs::write(folder.path().join("scene.toml"), changed(SCENE, part, replacement)).unwrap();
        all.push(run(folder.path(), &title("scene", part, replacement), &["run", "scene.toml", "--no-summary"]));
    }
    for (part, replacement) in TABLES {
        let folder = valid_folder();
        fs::write(folder.path().join("mine.toml"), changed(TABLE, part, replacement)).unwrap();
        all.push(run(folder.path(), &title("table", part, replacement), &["schemes", "check", "mine.toml"]));
    }
    for (part, replacement) in CHECKPOINTS {
        let folder = stopped_run();
        let path = folder.path().join("out.csv.checkpoint");
        let text = fs::read_to_string(&path).unwrap();
        fs::write(&path, changed(&text, part, replacement)).unwrap();
        all.push(run(folder.path(), &title("checkpoint", part, replacement), &["run", "scene.toml", "--no-summary"]));
    }
    assert!(all.iter().all(|answer| !answer.contains("exit code 0")), "all are wrong");
    insta::assert_snapshot!(all.join("\n"));
}

/// A folder with the valid scene and table.
fn valid_folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    fs::write(folder.path().join("mine.toml"), TABLE).unwrap();
    folder
}

/// The same, with the checkpoint of a run of which 20 steps are made.
fn stopped_run() -> TempDir {
    use shadowstep_scenes::{FileOptions, Observer, Outcome, Scene};

    struct StopAt(i64);

    impl Observer for StopAt {
        fn progress(&mut self, n: i64) {
            self.0 -= i64::from(n > 0);
        }
        fn stops(&mut self) -> bool {
            self.0 == 0
        }
    }

    let folder = valid_folder();
    let text = SCENE.to_owned();
    let path = folder.path().join("scene.toml").display().to_string();
    let scene = Scene::read(shadowstep::tables::Source { path, text }).unwrap();
    let outcome = scene.run_to_file(FileOptions::default(), &mut StopAt(20)).unwrap();
    assert_eq!(outcome, Outcome::Stopped { n: 20 });
    folder
}

fn changed(text: &str, part: &str, replacement: &str) -> String {
    assert!(text.contains(part), "{part}");
    text.replacen(part, replacement, 1)
}

fn title(what: &str, part: &str, replacement: &str) -> String {
    format!("{what}: {} → {}", part.replace('\n', "⏎"), replacement.replace('\n', "⏎"))
}

/// What the program writes to stderr, or in answer to a check to stdout, with its exit code.
fn run(folder: &Path, title: &str, words: &[&str]) -> String {
    let output = Command::cargo_bin("shadowstep").unwrap().args(words).current_dir(folder).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap().replace(&*folder.to_string_lossy(), "FOLDER");
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    let message = if err.is_empty() { out } else { err };
    format!("▶ {title}\nexit code {}\n{message}", output.status.code().unwrap())
}
