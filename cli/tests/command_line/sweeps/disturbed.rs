//! Sweeps that are killed or interrupted, at random moments of a fixed seed, or cannot write.

use std::fs;
use std::path::Path;
use std::process::Child;
use std::thread::sleep;
use std::time::Duration;

use super::{assert_same, files, finished, folder, program, succeeds, undisturbed};
use crate::output_files::{wait_until, with_small_files};
use crate::signals::signal;

/// A second or two of runs, some of which fail.
const LONG: &str = r#"
[problem]
name = "kepler"
parameters.eccentricity = "e"
[run]
scheme = "$scheme"
step = "h"
until = 20
digits = "double"
[output]
energy = { every = 100 }
[axes]
scheme = ["stormer-verlet", "ruth3"]
e = "0 … 1 in 8 steps"
h = "1/20 … 1/200 in 15 steps of 1/h"
[keep]
values = ["energy_error"]
first_time = { far = "x^2 + y^2 > 2" }
state = true
rows = true
"#;

const KILLS: u32 = 50;

/// SplitMix64: a number from 0 to 1.
fn part(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Bytes of records, while files come and go.
fn saved(out: &Path) -> usize {
    let entries = fs::read_dir(out.join("chunks")).into_iter().flatten().flatten();
    entries.filter_map(|entry| entry.metadata().ok()).map(|file| file.len() as usize).sum()
}

/// Most kills come when another random number of records is saved, whatever the speed of the machine; the others come
/// at the start.
#[test]
fn killed_fifty_times_it_comes_to_the_same_bytes() {
    let wanted = undisturbed(LONG);
    let records: usize =
        wanted.iter().filter(|(name, _)| name.starts_with("chunks")).map(|(_, bytes)| bytes.len()).sum();
    let (folder, mut seed) = (folder(LONG), 15);
    let out = folder.path().join("out");
    let mut computed = 0;
    for kill in 0..KILLS {
        let before = saved(&out);
        let threads = [1, 2, 3, 8][(part(&mut seed) * 4.0) as usize];
        let mut command = program(folder.path(), "sweep sweep.toml --out out");
        let mut child = command.env("RAYON_NUM_THREADS", threads.to_string()).spawn().unwrap();
        if part(&mut seed) > 0.2 {
            let more = (part(&mut seed) * records as f64 * 1.5 / f64::from(KILLS)) as usize;
            wait_until("a record", || saved(&out) > before + more || out.join("results.csv").exists());
        }
        sleep(Duration::from_millis(10).mul_f64(part(&mut seed)));
        child.kill().unwrap();
        child.wait().unwrap();
        computed += u32::from(saved(&out) > before && !out.join("results.csv").exists());
        // no file has its name before it is complete
        for (name, bytes) in files(&out).iter().filter(|(name, _)| wanted.contains_key(*name)) {
            assert!(*bytes == wanted[name], "after kill {kill}: {name} has other bytes");
        }
    }
    assert!(computed >= KILLS / 2, "{computed} kills came while runs were computed");
    succeeds(folder.path(), "sweep sweep.toml --out out");
    assert_same(&out, &wanted, "after all kills");
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

#[test]
fn after_signals_it_is_resumed() {
    let wanted = undisturbed(LONG);
    let (folder, mut seed) = (folder(LONG), 3);
    let out = folder.path().join("out");
    for name in ["-INT", "-TERM", "-INT"] {
        let before = saved(&out);
        let child = begin(folder.path(), "sweep sweep.toml --out out");
        let some = before + 2000 + (part(&mut seed) * 10_000.0) as usize;
        wait_until("records", || saved(&out) > some);
        interrupted(child, name);
        assert!(saved(&out) > before && !out.join("results.csv").exists());
    }
    succeeds(folder.path(), "sweep sweep.toml --out out");
    assert_same(&out, &wanted, "after signals");
}

/// A file that cannot grow is as a full disk, for everybody and everywhere.
#[test]
fn a_full_disk_is_one_sentence() {
    let wanted = undisturbed(super::SWEEP);
    // the plan, a chunk with its records, the table
    for blocks in [1, 4, 12] {
        let folder = folder(super::SWEEP);
        let out = folder.path().join("out");
        let words =
            |flags: &str| format!("sweep {}/sweep.toml --out {} {flags}", folder.path().display(), out.display());
        let output = with_small_files(blocks, &words(""));
        let err = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(3), "{blocks}: {err}");
        assert!(err.contains(" cannot be written: File too large") && err.contains("ulimit -f"), "{blocks}: {err}");
        assert_eq!(err.lines().count(), 2, "{blocks}: {err}");
        succeeds(folder.path(), "sweep sweep.toml --out out");
        let found = files(&out);
        for (name, bytes) in wanted.iter().filter(|(name, _)| *name != "plan.json") {
            assert!(found.get(name) == Some(bytes), "{blocks}: {name}");
        }
        assert_eq!(found.len(), wanted.len(), "{:?}", found.keys());
    }
}

#[test]
fn folders_that_cannot_be_written_are_named() {
    let folder = folder(super::SWEEP);
    fs::write(folder.path().join("file"), "").unwrap();
    for out in ["file", "file/deeper", "/dev/null", "/proc/sweep"] {
        let result = super::run(folder.path(), &format!("sweep sweep.toml --out {out}"));
        assert_eq!(result.code, 2, "{out}: {}", result.err);
        assert!(result.err.contains(out) && result.err.contains("hint: give "), "{}", result.err);
        assert_eq!(result.err.lines().count(), 2, "{}", result.err);
        let result = super::run(folder.path(), &format!("collect {out}"));
        assert_eq!(result.code, 2, "{out}: {}", result.err);
        assert!(result.err.contains("hint: give the folder of `shadowstep sweep FILE --out DIR`"), "{}", result.err);
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
