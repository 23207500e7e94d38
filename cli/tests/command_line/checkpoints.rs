//! A run that was stopped is resumed from its checkpoint, unless something does not belong to it. That a resumed run has
//! the bytes of an undisturbed one, whatever it is and wherever it is killed, is shown by `crosses` and `faults`.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};

use shadowstep_scenes::{FileOptions, Observer, Outcome, Scene};
use tempfile::TempDir;

use crate::output_files::wait_until;
use crate::scenes::{folder, names, run};
#[cfg(unix)]
use crate::signals::signal;

/// In double precision, without modified energies.
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
steps = 3000
digits = "double"
[output]
energy = { every = 700 }
trajectory = { every = 1100 }
file = "out.csv"
checkpoint = 1000
"#;

/// Whether a folder has nothing but the scene, its complete file, and its last checkpoint.
fn is_complete(folder: &Path) -> bool {
    names(folder) == ["out.csv", "out.csv.checkpoint", "scene.toml"]
}

fn rows(folder: &Path) -> String {
    fs::read_to_string(folder.join("out.csv")).unwrap()
}

/// The file of an undisturbed run.
fn undisturbed(scene: &str) -> String {
    let folder = folder(scene);
    assert_eq!(run(folder.path(), "").code, 0);
    assert!(is_complete(folder.path()));
    rows(folder.path())
}

/// Stops a run at the first state from this one on that it looks at.
struct StopAt(i64, bool);

impl Observer for StopAt {
    fn progress(&mut self, n: i64) {
        self.1 = n >= self.0;
    }

    fn stops(&mut self) -> bool {
        self.1
    }
}

/// Runs the scene of a folder to a state after 2000 steps, where it leaves a checkpoint.
fn stop(folder: &Path) {
    let scene = Scene::open(folder.join("scene.toml")).unwrap();
    let outcome = scene.run_to_file(FileOptions::default(), &mut StopAt(2000, false)).unwrap();
    assert!(matches!(outcome, Outcome::Stopped { .. }), "{outcome:?}");
}

fn stopped(scene: &str) -> TempDir {
    let folder = folder(scene);
    stop(folder.path());
    folder
}

/// What is changed in a folder where a run was stopped; what the refusal says.
type Change = (fn(&Path), &'static str);

fn edit(path: &Path, change: impl Fn(&str) -> String) {
    fs::write(path, change(&fs::read_to_string(path).unwrap())).unwrap();
}

const CHANGES: &[Change] = &[
    (
        |folder| edit(&folder.join("scene.toml"), |text| text.replace("0.4", "0.5")),
        "out.csv.checkpoint was made with a different text of the scene, so the run cannot be resumed from it",
    ),
    (
        |folder| edit(&folder.join("mine.toml"), |text| format!("{text}\n# a word more")),
        "was made with a different table ",
    ),
    (
        |folder| edit(&folder.join("out.csv.checkpoint"), |text| text[..text.len() / 2].to_owned()),
        "out.csv.checkpoint is damaged",
    ),
    (
        |folder| edit(&folder.join("out.csv.checkpoint"), |text| text.replacen("\"n\": ", "\"n\": 1", 1)),
        "out.csv.checkpoint was changed after it was written",
    ),
    (
        |folder| edit(&folder.join("out.csv.partial"), |text| text.replacen("-0.5", "-0.6", 1)),
        "out.csv.partial was changed after its checkpoint was written",
    ),
    (
        |folder| edit(&folder.join("out.csv.partial"), |text| text[..9].to_owned()),
        "out.csv.partial is shorter than its checkpoint states",
    ),
    #[cfg(unix)]
    (
        |folder| {
            fs::remove_file(folder.join("out.csv.checkpoint")).unwrap();
            std::os::unix::fs::symlink("/dev/zero", folder.join("out.csv.checkpoint")).unwrap();
        },
        "out.csv.checkpoint is longer than 256 MiB",
    ),
];

#[test]
fn a_checkpoint_of_something_else_is_refused_and_discarded_by_restart() {
    let scene = PLAIN.replace("stormer-verlet", "mine.toml");
    let euler =
        "name = \"euler\"\norder = 1\nkinetic = \"any\"\nreference = \"Euler\"\n[stages]\nkick = [1]\ndrift = [1]\n";
    for (change, sentence) in CHANGES {
        let folder = folder(&scene);
        let path = folder.path();
        fs::write(path.join("mine.toml"), euler).unwrap();
        stop(path);
        change(path);
        let result = run(path, "");
        let is_refused = result.code == 2 && result.err.contains(sentence);
        assert!(is_refused && result.err.contains("hint: discard it and begin again with --restart"), "{}", result.err);
        let result = run(path, "--restart");
        assert_eq!((result.code, result.err.as_str()), (0, ""), "{sentence}");
        assert_eq!(names(path), ["mine.toml", "out.csv", "out.csv.checkpoint", "scene.toml"]);
        assert!(!sentence.contains("text of the scene") || rows(path).contains("# q: [\"1/2\",\"0\"]"));
    }
}

/// In double precision functions have other last bits where a C library does not use what the processor has.
#[cfg(target_os = "linux")]
#[test]
fn a_checkpoint_of_other_elementary_functions_is_refused() {
    const TUNABLES: &str = "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F";
    // the bits of rows differ after some ten thousand steps
    let morse = |digits: &str| {
        let scene = PLAIN.replace("-1/sqrt(x^2 + y^2)", "exp(-x) + x + y^2/2").replace("\"double\"", digits);
        let steps = if digits == "30" { "steps = 3000" } else { "steps = 200000" };
        scene.replace("\"1/1000\"", "\"1/20\"").replace("steps = 3000", steps)
    };
    let other = |folder: &Path| {
        let mut program = Command::new(env!("CARGO_BIN_EXE_shadowstep"));
        let scene = folder.join("scene.toml");
        program.args(["run", "--no-summary"]).arg(scene).env("GLIBC_TUNABLES", TUNABLES).output().unwrap()
    };
    let (scene, elsewhere) = (morse("\"double\""), folder(&morse("\"double\"")));
    assert!(other(elsewhere.path()).status.success());
    let differs = rows(elsewhere.path()) != undisturbed(&scene);
    let stopped_here = stopped(&scene);
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
    assert!(rows(stopped_here.path()) == undisturbed(&scene), "other bytes");
    // at 30 digits they are MPFR's
    let stopped_here = stopped(&morse("30"));
    assert!(other(stopped_here.path()).status.success());
    assert!(rows(stopped_here.path()) == undisturbed(&morse("30")), "other bytes");
}

/// Of a run that was killed before its first checkpoint.
#[test]
fn rows_without_a_checkpoint_are_replaced() {
    let whole = undisturbed(PLAIN);
    for (file, left) in [("out.csv", &whole[..500]), ("out.jsonl", "{\"n\":0,\"t\":0.0,")] {
        let folder = folder(&PLAIN.replace("out.csv", file));
        fs::write(folder.path().join(format!("{file}.partial")), left).unwrap();
        let result = run(folder.path(), "");
        assert_eq!((result.code, result.err.as_str()), (0, ""));
        let rows = fs::read_to_string(folder.path().join(file)).unwrap();
        assert!(if file == "out.csv" { rows == whole } else { rows.starts_with("{\"n\":0,") }, "{}", &rows[..40]);
        assert!(!names(folder.path()).contains(&format!("{file}.partial")));
    }
}

#[test]
fn a_file_of_someone_else_with_the_name_of_a_partial_file_is_kept() {
    for name in ["out.csv.partial", "out.csv.checkpoint.new"] {
        let folder = folder(PLAIN);
        let strange = folder.path().join(name);
        fs::write(&strange, "notes").unwrap();
        for flags in ["", "--restart"] {
            let result = run(folder.path(), flags);
            assert_eq!(result.code, 2, "{name} {flags}: {}", result.err);
            assert!(result.err.contains(&format!("{name} already exists and is not")), "{}", result.err);
            assert_eq!(fs::read_to_string(&strange).unwrap(), "notes");
        }
        if name == "out.csv.partial" {
            assert_eq!(run(folder.path(), "--force").code, 0);
            assert!(is_complete(folder.path()));
        }
    }
}

#[test]
fn a_checkpoint_left_by_a_complete_run_is_ignored() {
    let folder = stopped(PLAIN);
    // its partial file was renamed, and the result removed
    fs::remove_file(folder.path().join("out.csv.partial")).unwrap();
    let result = run(folder.path(), "");
    assert_eq!(result.code, 0, "{}", result.err);
    assert!(result.err.contains("has no partial file: the run begins again"), "{}", result.err);
    assert!(is_complete(folder.path()));
}

/// It may be an earlier one than the last, where that could not be written. The complete run is prolonged with the
/// bytes of one run.
#[test]
fn a_checkpoint_beside_a_complete_file_changes_nothing() {
    let folder = stopped(PLAIN);
    let path = |name: &str| folder.path().join(name);
    let checkpoint = fs::read_to_string(path("out.csv.checkpoint")).unwrap();
    assert_eq!(run(folder.path(), "").code, 0);
    let (last, made) =
        (fs::read(path("out.csv.checkpoint")).unwrap(), || path("out.csv").metadata().unwrap().modified());
    let before = made().unwrap();
    fs::write(path("out.csv.checkpoint"), checkpoint).unwrap();
    let result = run(folder.path(), "");
    assert!(result.code == 0 && result.err.contains("is done: its file is complete; --restart runs it again"));
    assert_eq!(made().unwrap(), before);
    assert!(is_complete(folder.path()));
    fs::write(path("out.csv.checkpoint"), last).unwrap();
    let longer = PLAIN.replace("steps = 3000", "steps = 5000");
    fs::write(path("scene.toml"), &longer).unwrap();
    let result = run(folder.path(), "");
    let note = "note: the file is that of an earlier end: the run goes on from its last state, n = 3000 of 5000";
    assert!(result.code == 0 && result.err.starts_with(note), "{}", result.err);
    assert!(is_complete(folder.path()) && rows(folder.path()) == undisturbed(&longer));
}

#[cfg(unix)]
fn begin(words: &[&str], folder: &Path) -> Child {
    let file = |name: &str| fs::File::create(folder.join(name)).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_shadowstep"));
    command.args(words).stdin(Stdio::null()).stdout(file("out")).stderr(file("err")).spawn().unwrap()
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_ends_with_a_checkpoint() {
    // no checkpoint would come before the signal
    let scene = "[problem]\nname = \"pendulum\"\n[run]\nscheme = \"yoshida4\"\nstep = \"1/20\"\nsteps = 15000\n\
                 digits = 60\n[output]\nmodified_energy = { order = \"auto\", max_order = 12 }\nenergy = { every = 7 }\n\
                 file = \"out.csv\"\ncheckpoint = \"1 h\"\n";
    let (folder, outputs) = (folder(scene), tempfile::tempdir().unwrap());
    let (mut checkpoint, mut length) = (String::new(), 0);
    let path = |name: &str| folder.path().join(name);
    for name in ["-INT", "-TERM"] {
        let mut child = begin(&["run", path("scene.toml").to_str().unwrap()], outputs.path());
        // it listens before it writes
        wait_until("a row", || fs::metadata(path("out.csv.partial")).map_or(0, |file| file.len()) > length);
        signal(&child, name);
        assert_eq!(child.wait().unwrap().code(), Some(3));
        let before = checkpoint;
        checkpoint = fs::read_to_string(path("out.csv.checkpoint")).unwrap();
        assert_ne!(checkpoint, before);
        length = fs::metadata(path("out.csv.partial")).unwrap().len();
    }
    assert_eq!(run(folder.path(), "").code, 0);
    assert!(rows(folder.path()) == undisturbed(scene), "other bytes");
}

/// The first run is complete when the signal comes in the second one.
#[cfg(unix)]
#[test]
fn an_interrupted_drift_writes_the_runs_that_are_complete() {
    let folder = tempfile::tempdir().unwrap();
    let words =
        "drift --problem kepler --scheme stormer-verlet --step 1/10,1/1000000 --until 10 --double --order 2 --json";
    let mut child = begin(&words.split(' ').collect::<Vec<_>>(), folder.path());
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    wait_until("a complete run", || !read("out").is_empty());
    signal(&child, "-INT");
    assert_eq!(child.wait().unwrap().code(), Some(3));
    assert_eq!(read("out").lines().count(), 1);
    let err = read("err");
    assert!(err.contains("interrupted at n = ") && err.contains("hint: the runs before it are complete"), "{err}");
}
