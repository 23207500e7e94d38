//! A run that is stopped at any moment is resumed from its checkpoint, and its file has the bytes of an undisturbed
//! run.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};

use tempfile::TempDir;

use crate::output_files::wait_until;
use crate::scenes::{folder, names, run};

/// In double precision, without modified energies; too long to complete in a test.
const PLAIN: &str = r#"
[problem]
potential = "-1/sqrt(x^2 + y^2)"
coordinates = ["x", "y"]
[initial]
q = ["0.4", 0]
p = [0, 2]
[run]
scheme = "stormer-verlet"
step = "1/1000"
steps = 100000000
digits = "double"
[output]
energy = { every = 700 }
trajectory = { every = 1100 }
file = "out.csv"
checkpoint = 1000
"#;

/// The same with fewer steps.
fn short(scene: &str) -> String {
    scene.replace("steps = 100000000", "steps = 3000")
}

/// With modified energies, whose estimator needs states on both sides.
const SHADOWED: &str = r#"
[problem]
name = "pendulum"
[run]
scheme = "yoshida4"
step = "1/20"
steps = 15000
digits = 60
[output]
modified_energy = { order = "auto", max_order = 12 }
energy = { every = 7 }
file = "out.jsonl"
checkpoint = 50
"#;

/// Whether a folder has nothing but the scene, its complete file, and what belongs to it: metadata of JSON lines, the
/// last checkpoint.
fn is_complete(folder: &Path, file: &str) -> bool {
    let checkpoint = format!("{file}.checkpoint");
    let names = names(folder).into_iter().filter(|name| !name.ends_with(".jsonl.metadata.json"));
    names.eq([file, &checkpoint, "scene.toml"])
}

/// The file of an undisturbed run.
fn undisturbed(scene: &str, file: &str) -> String {
    let folder = folder(scene);
    assert_eq!(run(folder.path(), "").code, 0);
    assert!(is_complete(folder.path(), file));
    fs::read_to_string(folder.path().join(file)).unwrap()
}

fn begin(folder: &Path) -> Child {
    Command::new(env!("CARGO_BIN_EXE_shadowstep"))
        .args(["run", folder.join("scene.toml").to_str().unwrap()])
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// Waits until there is a checkpoint other than `before`, and ends the run without a chance to clean up.
fn kill_after_checkpoint(folder: &Path, file: &str, before: &str) -> String {
    let checkpoint = folder.join(format!("{file}.checkpoint"));
    let mut child = begin(folder);
    let mut found = String::new();
    wait_until("a checkpoint", || {
        found = fs::read_to_string(&checkpoint).unwrap_or_default();
        !found.is_empty() && found != before
    });
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(!folder.join(file).exists(), "the run was over before it could be killed");
    assert!(folder.join(format!("{file}.partial")).exists());
    found
}

fn survives_kills(scene: &str, file: &str) {
    let folder = folder(scene);
    let mut checkpoint = String::new();
    for _ in 0..3 {
        checkpoint = kill_after_checkpoint(folder.path(), file, &checkpoint);
    }
    let result = run(folder.path(), "");
    assert_eq!(result.code, 0, "{}", result.err);
    assert!(result.err.starts_with("note: resumed at n = "), "{}", result.err);
    assert!(is_complete(folder.path(), file));
    assert!(fs::read_to_string(folder.path().join(file)).unwrap() == undisturbed(scene, file), "other bytes");
}

#[test]
fn a_killed_run_in_double_precision_is_resumed_with_the_same_bytes() {
    survives_kills(&PLAIN.replace("steps = 100000000", "steps = 1000000"), "out.csv");
}

#[test]
fn a_killed_run_with_modified_energies_is_resumed_with_the_same_bytes() {
    survives_kills(SHADOWED, "out.jsonl");
}

#[test]
fn a_killed_run_with_the_best_k_is_resumed_with_the_same_bytes() {
    let keys = "estimator = \"bilinear\", max_order = 12, accuracy = 1e-15";
    survives_kills(&SHADOWED.replace("order = \"auto\", max_order = 12", keys), "out.jsonl");
}

#[test]
fn the_plot_of_a_resumed_run_shows_the_whole_run() {
    let scene = SHADOWED.replace("steps = 15000", "steps = 5000");
    let scene = scene.replace("checkpoint = 50", "checkpoint = 50\nplot = \"out.svg\"");
    let svg = |folder: &Path| fs::read_to_string(folder.join("out.svg")).unwrap();
    let stopped = stopped(&scene, "out.jsonl");
    assert!(!stopped.path().join("out.svg").exists());
    let result = run(stopped.path(), "");
    assert!(result.code == 0 && result.err.starts_with("note: resumed at n = "), "{}", result.err);
    let undisturbed = folder(&scene);
    assert_eq!(run(undisturbed.path(), "").code, 0);
    assert!(svg(stopped.path()) == svg(undisturbed.path()), "other pictures");
}

/// A folder where a run was killed.
fn stopped(scene: &str, file: &str) -> TempDir {
    let folder = folder(scene);
    kill_after_checkpoint(folder.path(), file, "");
    folder
}

/// Whether the run of a folder is refused with this sentence, and begins again with --restart.
fn refused(folder: &TempDir, sentence: &str) {
    let result = run(folder.path(), "");
    assert_eq!(result.code, 2, "{}", result.err);
    assert!(
        result.err.contains(sentence) && result.err.contains("hint: discard it and begin again with --restart"),
        "{}",
        result.err
    );
    // --restart also discards a checkpoint of another scene
    let scene = fs::read_to_string(folder.path().join("scene.toml")).unwrap();
    fs::write(folder.path().join("scene.toml"), short(&scene)).unwrap();
    let result = run(folder.path(), "--restart");
    assert_eq!((result.code, result.err.as_str()), (0, ""));
    assert!(is_complete(folder.path(), "out.csv"));
}

#[test]
fn a_checkpoint_of_another_scene_is_refused() {
    let folder = stopped(PLAIN, "out.csv");
    fs::write(folder.path().join("scene.toml"), PLAIN.replace("0.4", "0.5")).unwrap();
    refused(
        &folder,
        "out.csv.checkpoint was made with a different text of the scene, so the run cannot be resumed from it",
    );
    let file = fs::read_to_string(folder.path().join("out.csv")).unwrap();
    assert!(file.contains("# q: [\"1/2\",\"0\"]"));
}

#[test]
fn a_checkpoint_of_another_table_is_refused() {
    let scene = PLAIN.replace("stormer-verlet", "mine.toml");
    let euler =
        "name = \"euler\"\norder = 1\nkinetic = \"any\"\nreference = \"Euler\"\n[stages]\nkick = [1]\ndrift = [1]\n";
    let folder = folder(&scene);
    fs::write(folder.path().join("mine.toml"), euler).unwrap();
    kill_after_checkpoint(folder.path(), "out.csv", "");
    fs::write(folder.path().join("mine.toml"), format!("{euler}\n# a word more")).unwrap();
    let result = run(folder.path(), "");
    assert_eq!(result.code, 2);
    assert!(result.err.contains("was made with a different table "), "{}", result.err);
}

/// In double precision functions have other last bits where a C library does not use what the processor has.
#[cfg(target_os = "linux")]
#[test]
fn a_checkpoint_of_other_elementary_functions_is_refused() {
    const TUNABLES: &str = "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F";
    let morse = |steps: &str, digits: &str| {
        let scene = PLAIN.replace("-1/sqrt(x^2 + y^2)", "exp(-x) + x + y^2/2").replace("\"double\"", digits);
        scene.replace("steps = 100000000", steps).replace("\"1/1000\"", "\"1/20\"")
    };
    let other = |folder: &Path| {
        let mut program = Command::new(env!("CARGO_BIN_EXE_shadowstep"));
        let scene = folder.join("scene.toml");
        program.args(["run", "--no-summary"]).arg(scene).env("GLIBC_TUNABLES", TUNABLES).output().unwrap()
    };
    let rows = |folder: &Path| fs::read_to_string(folder.join("out.csv")).unwrap();
    let (scene, elsewhere) = (morse("steps = 200000", "\"double\""), folder(&morse("steps = 200000", "\"double\"")));
    assert!(other(elsewhere.path()).status.success());
    let differs = rows(elsewhere.path()) != undisturbed(&scene, "out.csv");
    let stopped_here = stopped(&scene, "out.csv");
    let output = other(stopped_here.path());
    let err = String::from_utf8_lossy(&output.stderr);
    println!("the bytes differ: {differs}");
    if differs {
        assert_eq!(output.status.code(), Some(2), "{err}");
        assert!(err.contains("was made with elementary functions of double precision with other last bits"), "{err}");
        assert!(run(stopped_here.path(), "").err.starts_with("note: resumed at n = "));
    } else {
        // this machine has one kind of functions only
        assert!(output.status.success(), "{err}");
    }
    assert!(rows(stopped_here.path()) == undisturbed(&scene, "out.csv"), "other bytes");
    // at 30 digits they are MPFR's
    let scene = morse("steps = 30000", "30");
    let stopped_here = stopped(&scene, "out.csv");
    assert!(other(stopped_here.path()).status.success());
    assert!(rows(stopped_here.path()) == undisturbed(&scene, "out.csv"), "other bytes");
}

#[test]
fn a_damaged_checkpoint_is_refused() {
    let folder = stopped(PLAIN, "out.csv");
    let checkpoint = folder.path().join("out.csv.checkpoint");
    let text = fs::read_to_string(&checkpoint).unwrap();
    fs::write(&checkpoint, &text[..text.len() / 2]).unwrap();
    refused(&folder, "out.csv.checkpoint is damaged");
}

#[test]
fn a_changed_checkpoint_is_refused() {
    let folder = stopped(PLAIN, "out.csv");
    let checkpoint = folder.path().join("out.csv.checkpoint");
    let text = fs::read_to_string(&checkpoint).unwrap();
    let position = text.find("\"q\": [").unwrap();
    let digit = position + text[position..].find(|c: char| ('1'..='8').contains(&c)).unwrap();
    let changed = format!("{}9{}", &text[..digit], &text[digit + 1..]);
    fs::write(&checkpoint, changed).unwrap();
    refused(&folder, "out.csv.checkpoint was changed after it was written");
}

#[test]
fn changed_rows_are_refused() {
    let folder = stopped(PLAIN, "out.csv");
    let partial = folder.path().join("out.csv.partial");
    let rows = fs::read_to_string(&partial).unwrap();
    fs::write(&partial, rows.replacen("-0.5", "-0.6", 1)).unwrap();
    refused(&folder, "out.csv.partial was changed after its checkpoint was written");
    let folder = stopped(PLAIN, "out.csv");
    fs::OpenOptions::new().write(true).open(folder.path().join("out.csv.partial")).unwrap().set_len(9).unwrap();
    refused(&folder, "out.csv.partial is shorter than its checkpoint states");
}

#[test]
fn rows_without_a_checkpoint_are_replaced() {
    let scene = short(PLAIN);
    let rows = undisturbed(&scene, "out.csv");
    let folder = folder(&scene);
    // of a run that was killed before its first checkpoint
    fs::write(folder.path().join("out.csv.partial"), &rows[..500]).unwrap();
    let result = run(folder.path(), "");
    assert_eq!((result.code, result.err.as_str()), (0, ""));
    assert!(fs::read_to_string(folder.path().join("out.csv")).unwrap() == rows);
    assert!(is_complete(folder.path(), "out.csv"));
    let folder = self::folder(&scene.replace("out.csv", "out.jsonl"));
    fs::write(folder.path().join("out.jsonl.partial"), "{\"n\":0,\"t\":0.0,").unwrap();
    let result = run(folder.path(), "");
    assert_eq!((result.code, result.err.as_str()), (0, ""));
    let rows = fs::read_to_string(folder.path().join("out.jsonl")).unwrap();
    assert!(rows.starts_with("{\"n\":0,"), "{}", &rows[..40]);
}

#[test]
fn a_file_of_someone_else_with_the_name_of_a_partial_file_is_kept() {
    let scene = short(PLAIN);
    for name in ["out.csv.partial", "out.csv.checkpoint.new"] {
        let folder = folder(&scene);
        let strange = folder.path().join(name);
        fs::write(&strange, "notes").unwrap();
        for flags in ["", "--restart"] {
            let result = run(folder.path(), flags);
            assert_eq!(result.code, 2, "{name} {flags}: {}", result.err);
            assert!(result.err.contains(&format!("{name} already exists and is not")), "{}", result.err);
            assert_eq!(fs::read_to_string(&strange).unwrap(), "notes");
        }
    }
    let folder = folder(&scene);
    fs::write(folder.path().join("out.csv.partial"), "notes").unwrap();
    assert_eq!(run(folder.path(), "--force").code, 0);
    assert!(is_complete(folder.path(), "out.csv"));
}

#[cfg(unix)]
#[test]
fn a_checkpoint_is_read_up_to_its_largest_size() {
    let folder = stopped(PLAIN, "out.csv");
    let checkpoint = folder.path().join("out.csv.checkpoint");
    fs::remove_file(&checkpoint).unwrap();
    std::os::unix::fs::symlink("/dev/zero", &checkpoint).unwrap();
    refused(&folder, "out.csv.checkpoint is longer than 256 MiB");
}

#[test]
fn a_checkpoint_left_by_a_complete_run_is_ignored() {
    let folder = stopped(PLAIN, "out.csv");
    // its partial file was renamed, and the result removed
    fs::remove_file(folder.path().join("out.csv.partial")).unwrap();
    fs::write(folder.path().join("scene.toml"), short(PLAIN)).unwrap();
    let result = run(folder.path(), "");
    assert_eq!(result.code, 0, "{}", result.err);
    assert!(result.err.contains("has no partial file: the run begins again"), "{}", result.err);
    assert!(is_complete(folder.path(), "out.csv"));
}

/// It may be an earlier one than the last, where that could not be written.
#[test]
fn a_checkpoint_beside_a_complete_file_changes_nothing() {
    let scene = PLAIN.replace("steps = 100000000", "steps = 200000");
    let folder = stopped(&scene, "out.csv");
    let path = |name: &str| folder.path().join(name);
    let checkpoint = fs::read_to_string(path("out.csv.checkpoint")).unwrap();
    assert_eq!(run(folder.path(), "").code, 0);
    let rows = fs::metadata(path("out.csv")).unwrap().modified().unwrap();
    fs::write(path("out.csv.checkpoint"), checkpoint).unwrap();
    let result = run(folder.path(), "");
    assert!(result.code == 0 && result.err.contains("its file is complete"), "{}", result.err);
    assert_eq!(fs::metadata(path("out.csv")).unwrap().modified().unwrap(), rows);
    assert!(is_complete(folder.path(), "out.csv"));
}

#[test]
fn a_complete_run_is_prolonged_with_the_bytes_of_one_run() {
    let text = |steps: u32| PLAIN.replace("steps = 100000000", &format!("steps = {steps}"));
    let folder = folder(&text(100_000));
    assert_eq!(run(folder.path(), "").code, 0);
    fs::write(folder.path().join("scene.toml"), text(200_000)).unwrap();
    let result = run(folder.path(), "");
    let note = "note: the file is that of an earlier end: the run goes on from its last state, n = 100000 of 200000";
    assert!(result.code == 0 && result.err.starts_with(note), "{}", result.err);
    assert!(is_complete(folder.path(), "out.csv"));
    assert!(fs::read_to_string(folder.path().join("out.csv")).unwrap() == undisturbed(&text(200_000), "out.csv"));
}

#[test]
fn two_runs_do_not_write_one_file() {
    let folder = folder(PLAIN);
    let mut child = begin(folder.path());
    wait_until("a checkpoint", || folder.path().join("out.csv.checkpoint").exists());
    let result = run(folder.path(), "");
    let restarted = run(folder.path(), "--restart");
    child.kill().unwrap();
    child.wait().unwrap();
    for result in [result, restarted] {
        assert_eq!(result.code, 2);
        assert!(result.err.contains("another run is writing"), "{}", result.err);
    }
}

#[test]
fn a_run_that_fails_keeps_its_rows_and_no_checkpoint() {
    let folder = folder(
        "[problem]\nname = \"harmonic-oscillator\"\n[run]\nscheme = \"stormer-verlet\"\nstep = 10\nuntil = 10000\n\
         digits = \"double\"\n[output]\ntrajectory = true\nfile = \"out.csv\"\ncheckpoint = 10\n",
    );
    let result = run(folder.path(), "");
    assert_eq!(result.code, 3);
    assert!(result.err.contains("out.csv.partial") && result.err.contains("the run stopped at n = "), "{}", result.err);
    assert_eq!(names(folder.path()), ["out.csv.partial", "scene.toml"]);
}

/// Sends a signal, as Ctrl-C and `kill` do.
#[cfg(unix)]
fn signal(child: &Child, name: &str) {
    assert!(Command::new("kill").args([name, &child.id().to_string()]).status().unwrap().success());
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_ends_with_a_checkpoint() {
    // no checkpoint would come before the signal
    let scene = SHADOWED.replace("checkpoint = 50", "checkpoint = \"1 h\"");
    let folder = folder(&scene);
    let (mut checkpoint, mut length) = (String::new(), 0);
    let partial = folder.path().join("out.jsonl.partial");
    for name in ["-INT", "-TERM"] {
        let mut child = begin(folder.path());
        // it listens before it writes
        wait_until("a row", || fs::metadata(&partial).map_or(0, |file| file.len()) > length);
        signal(&child, name);
        assert_eq!(child.wait().unwrap().code(), Some(3));
        let before = checkpoint;
        checkpoint = fs::read_to_string(folder.path().join("out.jsonl.checkpoint")).unwrap();
        assert_ne!(checkpoint, before);
        length = fs::metadata(&partial).unwrap().len();
    }
    assert_eq!(run(folder.path(), "").code, 0);
    let whole = undisturbed(&scene, "out.jsonl");
    assert!(fs::read_to_string(folder.path().join("out.jsonl")).unwrap() == whole, "other bytes");
}

/// The first run is complete when the signal comes in the second one.
#[cfg(unix)]
#[test]
fn an_interrupted_drift_writes_the_runs_that_are_complete() {
    let folder = tempfile::tempdir().unwrap();
    let words =
        "drift --problem kepler --scheme stormer-verlet --step 1/10,1/1000000 --until 10 --double --order 2 --json";
    let mut child = Command::new(env!("CARGO_BIN_EXE_shadowstep"))
        .args(words.split(' '))
        .stdout(fs::File::create(folder.path().join("out")).unwrap())
        .stderr(fs::File::create(folder.path().join("err")).unwrap())
        .spawn()
        .unwrap();
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    wait_until("a complete run", || !read("out").is_empty());
    signal(&child, "-INT");
    assert_eq!(child.wait().unwrap().code(), Some(3));
    assert_eq!(read("out").lines().count(), 1);
    let err = read("err");
    assert!(err.contains("interrupted at n = ") && err.contains("hint: the runs before it are complete"), "{err}");
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_without_checkpoints_leaves_nothing() {
    let folder = folder(&PLAIN.replace("checkpoint = 1000", ""));
    let mut child = begin(folder.path());
    wait_until("a file", || names(folder.path()).len() >= 2);
    signal(&child, "-INT");
    assert_eq!(child.wait().unwrap().code(), Some(3));
    assert_eq!(names(folder.path()), ["scene.toml"]);
}
