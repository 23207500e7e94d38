//! Sweeps whose processes end in the middle; that any moment will do is shown by `faults`.

use std::fs;
use std::path::Path;
use std::process::Child;

use super::{assert_same, finished, folder, program, succeeds, undisturbed};
use crate::output_files::wait_until;
use crate::signals::signal;

/// Bytes of records, while files come and go.
fn saved(out: &Path) -> usize {
    let entries = fs::read_dir(out.join("chunks")).into_iter().flatten().flatten();
    entries.filter_map(|entry| entry.metadata().ok()).map(|file| file.len() as usize).sum()
}

/// What processes leave that were killed in the middle of writing has other names each time.
#[test]
fn what_killed_processes_leave_is_removed() {
    let wanted = undisturbed(super::SWEEP);
    let folder = folder(super::SWEEP);
    let out = folder.path().join("out");
    succeeds(folder.path(), "sweep sweep.toml --out out --chunk 2/16");
    for name in ["plan.json.new-a", "chunks/00001-of-00016.new-b", "chunks/00002-of-00016.new-c"] {
        fs::write(out.join(name), "{").unwrap();
    }
    for name in [
        "chunks/00002-of-00016.partial-d",
        "chunks/00003-of-00016.partial-e",
        "results.csv.0123456789abcdef.shadowstep-partial",
    ] {
        fs::write(out.join(name), "{}\n0123456789abcdef {\"run\":7}\n").unwrap();
    }
    succeeds(folder.path(), "sweep sweep.toml --out out");
    assert_same(&out, &wanted, "with what was left");
}

/// One run that takes hours, and one whose first modified energy takes minutes.
const ENDLESS: [&str; 2] = [
    r#"
problem.name = "kepler"
run = { scheme = "stormer-verlet", step = "h", steps = 10000000000, digits = "double" }
axes.h = ["1/100"]
keep.values = ["energy_error"]
"#,
    r#"
problem.name = "pendulum"
run = { scheme = "stormer-verlet", step = "h", steps = 1000, digits = 20000 }
output.modified_energy = { order = "auto", max_order = 200 }
axes.h = ["1/20", "1/30"]
keep.values = ["drift"]
"#,
];

fn is_begun(out: &Path) -> bool {
    let mut entries = fs::read_dir(out.join("chunks")).into_iter().flatten().flatten();
    entries.any(|entry| entry.file_name().to_string_lossy().contains("partial"))
}

fn begin(folder: &Path, words: &str) -> Child {
    let child = program(folder, words).spawn().unwrap();
    wait_until("a chunk", || is_begun(&folder.join("out")));
    child
}

fn interrupted(child: Child, name: &str) {
    signal(&child, name);
    let result = finished(&child.wait_with_output().unwrap());
    assert_eq!(result.code, 3, "{}", result.err);
    assert!(result.err.contains("interrupted"), "{}", result.err);
    assert!(result.err.contains("hint: the same command computes"), "{}", result.err);
}

#[test]
#[cfg(feature = "mpfr")]
fn a_signal_ends_it_within_a_long_run() {
    for (sweep, name) in ENDLESS.into_iter().zip(["-INT", "-TERM"]) {
        for flags in ["", " --chunk 1/1"] {
            let folder = folder(sweep);
            interrupted(begin(folder.path(), &format!("sweep sweep.toml --out out{flags}")), name);
        }
    }
}

/// 10⁹ runs, of which no list would fit into 32 MiB: what is computed of them is one chunk, or what can be done until a
/// signal.
#[cfg(target_os = "linux")]
#[test]
fn a_billion_runs_are_never_listed() {
    const HUGE: &str = r#"
problem = { potential = "q^2/2", coordinates = ["q"] }
initial = { q = ["a"], p = ["b"] }
run = { scheme = "stormer-verlet", step = "h", steps = 1, digits = "double" }
[axes]
a = "0 … 1 in 1000 values"
b = { draws = 1000, uniform = [0, 1], seed = 1 }
h = "1/10 … 1/1000 in 1000 values of log"
[keep]
values = ["steps"]
"#;
    let limited = |folder: &Path, words: &str| {
        let program = env!("CARGO_BIN_EXE_shadowstep");
        let shell = format!("ulimit -d 32768; exec {program} {words}");
        let mut command = std::process::Command::new("sh");
        command.args(["-c", &shell]).current_dir(folder).env("RAYON_NUM_THREADS", "2");
        command.stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
        command
    };
    let folder = folder(HUGE);
    let words = "sweep sweep.toml --out out --chunk 5000000/10000000";
    let result = finished(&limited(folder.path(), words).output().unwrap());
    assert_eq!((result.code, result.err.as_str()), (0, ""));
    let chunk = fs::read_to_string(folder.path().join("out/chunks/5000000-of-10000000")).unwrap();
    assert_eq!(chunk.lines().count(), 102);
    assert!(chunk.lines().nth(1).unwrap().starts_with("{\"run\":499999900,"), "{chunk}");

    let folder = super::folder(HUGE);
    let child = limited(folder.path(), "sweep sweep.toml --out out").spawn().unwrap();
    wait_until("records", || saved(&folder.path().join("out")) > 5000);
    interrupted(child, "-TERM");
}
