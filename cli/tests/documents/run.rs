//! Runs documents, each command in a process of its own that is interrupted after some CPU time, and judges how they
//! end.

use std::fs::{self, File};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::document::Document;

/// After this CPU time in seconds a command is interrupted.
const CPU_SECONDS: u64 = 10;

/// A command hangs that has not ended this number of seconds after it began.
const HANGS_AFTER: Duration = Duration::from_secs(600);

/// How often a command is looked at.
const TICK: Duration = Duration::from_millis(5);

/// What a command says that was interrupted between two states, runs or trajectories. One that says nothing of that
/// hung.
const INTERRUPTED: [&str; 3] = ["interrupted at n = ", "the same command computes", "the ensemble was interrupted"];

/// Where the output of a command goes.
const STDOUT: &str = "stdout.of-command";
const STDERR: &str = "stderr.of-command";

/// What no message may have: texts of the language, not of the program.
const INTERNAL: [&str; 8] = ["panicked", "RUST_BACKTRACE", ".rs:", "Some(", "Ok(", "Err(", "internal error", "unwrap"];

/// How a document ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// All commands ran, also one that found a state that is not finite, or a verdict that is not good.
    Ran,
    /// One of them was interrupted, as it makes many states, runs or trajectories.
    Interrupted,
    /// One of them was refused by a sentence.
    Refused(String),
    /// A fault of the program: its kind, and what the program said.
    Fault { kind: String, message: String },
}

/// Runs the commands of a document until one is not successful.
pub(crate) fn run(document: &Document) -> End {
    let folder = TempDir::new().unwrap();
    document.write(folder.path());
    for command in &document.commands {
        let output = shadowstep(command, folder.path());
        match judged(&output, folder.path()) {
            End::Ran => {}
            end => return end,
        }
    }
    End::Ran
}

/// Runs a command, which is interrupted after some CPU time.
fn shadowstep(words: &str, folder: &Path) -> Output {
    let output = |name: &str| File::create(folder.join(name)).unwrap();
    let mut command = Command::new(assert_cmd::cargo::cargo_bin("shadowstep"));
    command.args(words.split(' ')).current_dir(folder).env("RAYON_NUM_THREADS", "1");
    let mut child = command.stdin(Stdio::null()).stdout(output(STDOUT)).stderr(output(STDERR)).spawn().unwrap();
    let (begin, mut was_interrupted) = (Instant::now(), false);
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if begin.elapsed() > HANGS_AFTER {
            child.kill().unwrap();
        } else if !was_interrupted && cpu_time(child.id()) > CPU_SECONDS {
            was_interrupted = true;
            // a program in the background of a shell ignores SIGINT
            Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap();
        }
        thread::sleep(TICK);
    };
    let [stdout, stderr] = [STDOUT, STDERR].map(|name| {
        let path = folder.join(name);
        let content = fs::read(&path).unwrap();
        fs::remove_file(path).unwrap();
        content
    });
    Output { status, stdout, stderr }
}

/// The CPU time of a process, in seconds; 0 of one that has ended.
fn cpu_time(process: u32) -> u64 {
    const TICKS_PER_SECOND: u64 = 100;
    let text = fs::read_to_string(format!("/proc/{process}/stat")).unwrap_or_default();
    // behind the name in parentheses: user time and system time are the 12th and 13th
    let fields = text.rsplit(") ").next().unwrap_or_default().split(' ').skip(11);
    fields.take(2).filter_map(|ticks| ticks.parse::<u64>().ok()).sum::<u64>() / TICKS_PER_SECOND
}

fn judged(output: &Output, folder: &Path) -> End {
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    let fault = |kind: String| End::Fault { kind, message: message.clone() };
    let place =
        message.lines().find_map(|line| line.split_once("panicked at ")).map(|(_, place)| place.trim_end_matches(':'));
    if let Some(place) = place {
        // another column or line of the same file is the same fault for a shorter document
        return fault(format!("a panic at {}", place.rsplit_once(':').map_or(place, |(line, _)| line)));
    }
    let sentence = message.lines().find(|line| !line.starts_with("note: ") && !line.trim().is_empty());
    match (output.status.code(), sentence) {
        (None, _) if output.status.signal() == Some(9) => fault("a hang".to_owned()),
        (None, _) => fault(format!("signal {:?}", output.status.signal())),
        _ if INTERRUPTED.iter().any(|text| message.contains(text)) => End::Interrupted,
        _ if message.contains("interrupted") => fault(format!("more than {CPU_SECONDS} s of CPU time")),
        (Some(0..=3), _) if INTERNAL.iter().any(|text| message.contains(text)) => fault("an internal text".to_owned()),
        (Some(0), _) => not_finite(output, folder).map_or(End::Ran, fault),
        (Some(2 | 3), None) => fault("a refusal without a sentence".to_owned()),
        (Some(1 | 3), _) => End::Ran,
        (Some(2), sentence) => End::Refused(sentence.unwrap_or_default().to_owned()),
        (Some(code), _) => fault(format!("exit code {code}")),
    }
}

/// A number that is not finite, in rows, metadata or the summary. Trajectories of ensembles and runs of sweeps may say
/// that they failed.
fn not_finite(output: &Output, folder: &Path) -> Option<String> {
    let files = fs::read_dir(folder).unwrap().chain(fs::read_dir(folder.join("out")).into_iter().flatten());
    let is_text = |path: &Path| {
        ["csv", "jsonl", "json", "svg"].iter().any(|known| path.extension().is_some_and(|ending| ending == *known))
    };
    let written = files.map(|entry| entry.unwrap().path()).filter(|path| is_text(path));
    let written =
        written.filter_map(|path| Some((path.file_name()?.to_string_lossy().into_owned(), fs::read(path).ok()?)));
    let summary =
        if output.stderr.windows(6).any(|word| word == b"failed") { Vec::new() } else { output.stderr.clone() };
    let said = [("stdout".to_owned(), output.stdout.clone()), ("stderr".to_owned(), summary)];
    let found = said
        .into_iter()
        .chain(written)
        .find_map(|(name, text)| Some((of_text(&String::from_utf8_lossy(&text))?, name)));
    found.map(|(what, name)| format!("{what} in {name}"))
}

fn of_text(text: &str) -> Option<String> {
    let is_wrong =
        |word: &str| ["nan", "inf", "infinity"].contains(&word.trim_start_matches('-').to_ascii_lowercase().as_str());
    let names: Vec<&str> = text.lines().find(|line| !line.starts_with('#')).unwrap_or_default().split(',').collect();
    text.lines().filter(|line| !line.starts_with('#')).find_map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        let says_so = names.last() == Some(&"not_finite") && cells.last().is_some_and(|cell| !cell.is_empty());
        let column = cells.iter().position(|cell| is_wrong(cell)).filter(|_| !says_so);
        let word = line.split([',', ':', '"', '[', ']', '{', '}', ' ', '|']).find(|word| is_wrong(word));
        let is_failure = names.last() == Some(&"failure") || says_so;
        match (column, word) {
            (Some(column), _) => Some(format!("{} of {}", cells[column], names.get(column).unwrap_or(&"a value"))),
            (None, Some(word)) if !is_failure => Some(format!("{word} of a value")),
            _ => None,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(status: i32, err: &str) -> End {
        let output =
            Output { status: ExitStatusExt::from_raw(status), stdout: Vec::new(), stderr: err.as_bytes().to_vec() };
        judged(&output, TempDir::new().unwrap().path())
    }

    #[test]
    fn faults_are_told_from_refusals() {
        let is_fault = |end| matches!(end, End::Fault { .. });
        assert_eq!(of(0, "all is well"), End::Ran);
        assert_eq!(of(2 << 8, "note: n\nerror: no"), End::Refused("error: no".to_owned()));
        assert!(
            is_fault(of(2 << 8, ""))
                && is_fault(of(101 << 8, ""))
                && is_fault(of(9, ""))
                && is_fault(of(1 << 8, "error: a: interrupted"))
                && is_fault(of(4 << 8, "no"))
        );
        assert!(is_fault(of(2 << 8, "error: Some(3)")));
        assert_eq!(of(1 << 8, "error: a: interrupted at n = 3"), End::Interrupted);
        let panic = of(101 << 8, "\nthread 'main' panicked at a/b.rs:3:7:\nno\n");
        assert!(matches!(panic, End::Fault { kind, .. } if kind == "a panic at a/b.rs:3"));
        assert_eq!(of_text("# nan\nn,a\n0,1\n1,NaN\n").unwrap(), "NaN of a");
        assert_eq!(of_text("x,not_finite\nnan,\n").unwrap(), "nan of x");
        assert_eq!(of_text("x,not_finite\nnan,3\n"), None);
        assert_eq!(of_text("x,failure\n,x = NaN\n"), None);
        assert_eq!(of_text("{\"inf\": 1}").unwrap(), "inf of a value");
        assert_eq!(of_text("n,information\n0,1e300\n"), None);
    }
}
