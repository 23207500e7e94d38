//! Files that commands write: complete or absent, of one process at a time, with messages that name them.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use crate::program::shadowstep;
use crate::scenes::{folder, names, run};

/// Too long to complete in a test.
const LONG: &str = r#"
[problem]
name = "kepler"
[run]
scheme = "stormer-verlet"
step = "1/1000"
steps = 100000000
digits = "double"
[output]
trajectory = { every = 1000 }
file = "out.csv"
"#;

fn short() -> String {
    LONG.replace("steps = 100000000", "steps = 3000")
}

fn program() -> Command {
    let mut program = Command::new(env!("CARGO_BIN_EXE_shadowstep"));
    program.stdout(Stdio::null()).stderr(Stdio::null());
    program
}

/// Waits for something that the child does. The limit only ends a test that hangs.
pub(crate) fn wait_until(what: &str, mut happens: impl FnMut() -> bool) {
    let begun = Instant::now();
    while !happens() {
        assert!(begun.elapsed() < Duration::from_secs(600), "{what} does not come");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// A run that has begun to write.
fn begin(folder: &Path, scene: &str) -> Child {
    let child = program().arg("run").arg(folder.join(scene)).spawn().unwrap();
    let partial = folder.join("out.csv.partial");
    wait_until("a file with rows", || fs::metadata(&partial).is_ok_and(|file| file.len() > 0));
    child
}

fn kill(mut child: Child) {
    child.kill().unwrap();
    child.wait().unwrap();
}

const TRACE: &str = "trace kepler --scheme stormer-verlet --step 1/1000 --double --order 2 --csv --no-summary --force";

fn trace(until: &str, file: &Path) -> String {
    format!("{TRACE} --until {until} --output {}", file.display())
}

#[test]
fn two_commands_do_not_write_one_file() {
    for checkpoint in ["", "checkpoint = 1000"] {
        let folder = folder(&format!("{LONG}{checkpoint}"));
        fs::write(folder.path().join("other.toml"), short()).unwrap();
        let child = begin(folder.path(), "scene.toml");
        let others = ["scene.toml", "scene.toml --restart", "other.toml --force"]
            .map(|other| shadowstep(&format!("run {}/{other}", folder.path().display())));
        kill(child);
        for refused in others {
            assert!(refused.code == 2 && refused.err.contains("another run is writing"), "{}", refused.err);
        }
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("out.csv");
    let child = program().args(trace("1000000", &file).split(' ')).spawn().unwrap();
    wait_until("a file", || !names(folder.path()).is_empty());
    let result = shadowstep(&trace("1", &file));
    kill(child);
    assert!(result.code == 2 && result.err.contains("another process is writing --output"), "{}", result.err);
}

/// Rows with a checkpoint beside them are kept, to be looked at.
#[test]
fn a_run_that_fails_leaves_the_old_file_and_none_of_its_own() {
    let fails = "[problem]\nname = \"harmonic-oscillator\"\n[run]\nscheme = \"stormer-verlet\"\nstep = 10\nuntil = 10000\n\
                 digits = \"double\"\n[output]\ntrajectory = true\nfile = \"out.csv\"\n";
    for (more, left, sentence) in [
        ("", "out.csv scene.toml", "the run stopped at n = "),
        ("checkpoint = 10\n", "out.csv out.csv.partial scene.toml", "out.csv.partial"),
    ] {
        let folder = folder(&format!("{fails}{more}"));
        fs::write(folder.path().join("out.csv"), "old").unwrap();
        let result = run(folder.path(), "--force");
        assert!(result.code == 3 && result.err.contains(sentence), "{}", result.err);
        assert_eq!(names(folder.path()).join(" "), left);
        assert_eq!(fs::read_to_string(folder.path().join("out.csv")).unwrap(), "old");
    }
    let folder = tempfile::tempdir().unwrap();
    let words = "trace harmonic-oscillator --scheme stormer-verlet --step 10 --until 10000 --double --order 2";
    let result = shadowstep(&format!("{words} --output {0}/out.csv --plot {0}/out.svg", folder.path().display()));
    assert_eq!((result.code, names(folder.path()).len()), (3, 0), "{}", result.err);
}

#[test]
fn what_a_killed_program_leaves_is_replaced() {
    let folder = folder(LONG);
    kill(begin(folder.path(), "scene.toml"));
    assert_eq!(names(folder.path()), ["out.csv.partial", "scene.toml"]);
    // also by a run of a changed scene
    fs::write(folder.path().join("scene.toml"), short()).unwrap();
    assert_eq!(run(folder.path(), "").code, 0);
    assert_eq!(names(folder.path()), ["out.csv", "scene.toml"]);

    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("out.csv");
    let child = program().args(trace("1000000", &file).split(' ')).spawn().unwrap();
    wait_until("a file", || !names(folder.path()).is_empty());
    kill(child);
    let [left] = &names(folder.path())[..] else { panic!("{:?}", names(folder.path())) };
    let number = left.strip_prefix("out.csv.").and_then(|rest| rest.strip_suffix(".shadowstep-partial")).unwrap();
    assert!(number.len() == 16 && u64::from_str_radix(number, 16).is_ok(), "{number}");
    assert_eq!(shadowstep(&trace("1", &file)).code, 0);
    assert_eq!(names(folder.path()), ["out.csv"]);
    assert_eq!(fs::read_to_string(&file).unwrap().lines().count(), 1002);
}

#[cfg(unix)]
#[test]
fn symbolic_links_are_followed() {
    use std::os::unix::fs::symlink;
    let is_link = |path: &Path| path.symlink_metadata().unwrap().is_symlink();
    for checkpoint in ["", "checkpoint = 1000"] {
        let folder = folder(&format!("{}{checkpoint}", short()));
        let path = |name: &str| folder.path().join(name);
        fs::create_dir(path("data")).unwrap();
        symlink("data/second", path("out.csv")).unwrap();
        symlink("rows.csv", path("data/second")).unwrap();
        for _ in 0..2 {
            assert_eq!(run(folder.path(), "").code, 0);
            assert!(is_link(&path("out.csv")) && is_link(&path("data/second")));
            let rows = names(&path("data")).into_iter().filter(|name| !name.ends_with(".checkpoint"));
            assert!(rows.eq(["rows.csv", "second"]));
            assert_eq!(names(folder.path()), ["data", "out.csv", "scene.toml"]);
        }
        assert_eq!(
            fs::read_to_string(path("data/rows.csv")).unwrap().lines().last().map(|row| &row[..4]),
            Some("3000")
        );
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("out.csv");
    symlink("rows.csv", &file).unwrap();
    assert_eq!(shadowstep(&trace("1", &file)).code, 0);
    assert!(is_link(&file) && folder.path().join("rows.csv").is_file());
    let circle = folder.path().join("circle.csv");
    symlink("circle.csv", &circle).unwrap();
    let result = shadowstep(&trace("1", &circle));
    assert!(result.code == 2 && result.err.contains("is a circle of symbolic links"), "{}", result.err);
}

#[cfg(unix)]
#[test]
fn named_pipes_are_refused() {
    for (format, pipe) in [
        ("csv", "out.csv"),
        ("csv", "out.csv.checkpoint"),
        ("csv", "out.csv.checkpoint.new"),
        ("jsonl", "out.jsonl"),
        ("jsonl", "out.jsonl.metadata.json"),
    ] {
        let scene = short().replace("out.csv", &format!("out.{format}")) + "checkpoint = 1000";
        let folder = folder(&scene);
        let path = folder.path().join(pipe);
        assert!(Command::new("mkfifo").arg(&path).status().unwrap().success());
        let result = run(folder.path(), "--force");
        assert_eq!(result.code, 2, "{pipe}: {}", result.err);
        assert!(result.err.contains(&format!("{pipe} is not a file")), "{}", result.err);
    }
}

/// To open one waits for its other end: the commands would wait for ever.
#[cfg(unix)]
#[test]
fn named_pipes_as_inputs_are_refused() {
    let folder = folder(&short().replace("stormer-verlet", "pipe.toml"));
    let path = |name: &str| folder.path().join(name).display().to_string();
    for name in ["pipe.toml", "plan.json", "results.jsonl", "trace.csv"] {
        assert!(Command::new("mkfifo").arg(path(name)).status().unwrap().success());
    }
    let scene = short().split("[output]").next().unwrap().to_owned();
    fs::write(path("columns.toml"), format!("{scene}[ensemble]\nfile = \"pipe.toml\"\n")).unwrap();
    fs::write(path("sweep.toml"), "scene = \"pipe.toml\"\naxes.e = [0, 1]\nkeep.values = [\"steps\"]\n").unwrap();
    let (pipe, here) = (path("pipe.toml"), folder.path().display());
    for words in [
        format!("run {pipe}"),
        format!("run {}", path("scene.toml")),
        format!("run {}", path("columns.toml")),
        format!("sweep {pipe} --out {}", path("out")),
        format!("sweep {} --out {}", path("sweep.toml"), path("out")),
        format!("collect {here}"),
        format!("drift {pipe} --scheme yoshida4 --step 1/10 --until 1"),
        format!("drift kepler --scheme {pipe} --step 1/10 --until 1"),
        format!("schemes check {pipe}"),
        format!("schemes polish {pipe} --digits 30"),
        format!("emit {pipe} --to c"),
        format!("figures scattering --quick --out {here}"),
    ] {
        let mut child = program().args(words.split(' ')).stderr(Stdio::piped()).spawn().unwrap();
        wait_until(&words, || child.try_wait().unwrap().is_some());
        let output = child.wait_with_output().unwrap();
        let err = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(2) && err.contains("it is a pipe, not a file"), "{words}: {err}");
    }
    let refused = shadowstep(&format!("{TRACE} --until 1 --output {}", path("trace.csv")));
    assert!(refused.code == 2 && refused.err.contains("trace.csv is not a file"), "{}", refused.err);
}

/// What the shell has opened is read: `shadowstep run <(…)`, and a pipe as stdin.
#[cfg(unix)]
#[test]
fn open_descriptors_are_read() {
    let scene = short().split("[output]").next().unwrap().replace("3000", "3") + "[output]\nenergy = true\n";
    let mut program = assert_cmd::Command::cargo_bin("shadowstep").unwrap();
    let output = program.args(["run", "/dev/stdin", "--no-summary"]).write_stdin(scene).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(String::from_utf8(output.stdout).unwrap().lines().last().map(|row| &row[..2]), Some("3,"));
}

/// Runs the program where files may have this number of blocks of 512 bytes.
#[cfg(unix)]
pub(crate) fn with_small_files(blocks: u32, words: &str) -> Output {
    let program = env!("CARGO_BIN_EXE_shadowstep");
    let command = format!("trap '' XFSZ; ulimit -f {blocks}; exec {program} {words}");
    Command::new("sh").args(["-c", &command]).output().unwrap()
}

#[cfg(unix)]
fn failed(output: &Output, parts: &[&str]) {
    let err = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{err}");
    for part in parts {
        assert!(err.contains(part), "{part}: {err}");
    }
}

/// A file that cannot grow is as a full disk, for everybody and everywhere.
#[cfg(unix)]
#[test]
fn a_file_that_cannot_grow_is_named() {
    let rows = |folder: &Path| fs::read_to_string(folder.join("out.csv")).unwrap();
    let plain = short().replace("every = 1000", "every = 10");
    let undisturbed = folder(&plain);
    assert_eq!(run(undisturbed.path(), "").code, 0);
    for (checkpoint, then, left) in [
        (
            "checkpoint = 100",
            "run the scene again: it is resumed from its last checkpoint",
            &["out.csv.checkpoint", "out.csv.partial", "scene.toml"][..],
        ),
        ("", "run the scene again\n", &["scene.toml"][..]),
    ] {
        let folder = folder(&format!("{plain}{checkpoint}"));
        let scene = folder.path().join("scene.toml");
        let output = with_small_files(20, &format!("run --no-summary {}", scene.display()));
        failed(&output, &["out.csv.partial cannot be written: File too large", "ulimit -f", then]);
        assert_eq!(names(folder.path()), left);
        assert_eq!(run(folder.path(), "").code, 0);
        let without_head =
            |rows: String| rows.lines().filter(|line| !line.starts_with('#')).map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(without_head(rows(folder.path())), without_head(rows(undisturbed.path())));
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("out.csv");
    let output = with_small_files(20, &trace("10", &file));
    failed(&output, &["out.csv cannot be written: File too large", "then run the command again"]);
    assert!(names(folder.path()).is_empty());
    let output = with_small_files(1, &format!("figures scattering --quick --out {}", folder.path().display()));
    failed(&output, &["results.jsonl cannot be written: File too large", "it computes what is not saved yet"]);
}
