//! Ctrl-C and SIGTERM where no state comes for a long time: the program ends all the same, and leaves nothing
//! incomplete.

use std::process::{Child, Command, Stdio};

use crate::output_files::wait_until;
use crate::scenes::{folder, names};

/// Its first modified energy comes after some minutes.
const SLOW: &str = r#"
[problem]
name = "pendulum"
[run]
scheme = "stormer-verlet"
step = "1/20"
steps = 1000
digits = 20000
[output]
modified_energy = { order = "auto", max_order = 200 }
file = "out.csv"
"#;

fn begin(words: &str) -> Child {
    let program = Command::new(env!("CARGO_BIN_EXE_shadowstep"))
        .args(words.split(' '))
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn();
    program.unwrap()
}

pub(crate) fn signal(child: &Child, name: &str) {
    assert!(Command::new("kill").args([name, &child.id().to_string()]).status().unwrap().success());
}

/// The program ends without having reached a state.
fn ends(child: Child, hint: &str) {
    let output = child.wait_with_output().unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(3), "{err}");
    assert!(err.contains(": interrupted\n") && err.contains(hint), "{err}");
}

#[test]
#[cfg(feature = "mpfr")]
fn a_run_ends_before_its_first_modified_energy() {
    for (name, checkpoint, hint) in [
        ("-TERM", "", "with `checkpoint = \"1 min\"` in [output] it could be resumed"),
        ("-INT", "checkpoint = 10", "run the scene again to resume it"),
    ] {
        let folder = folder(&format!("{SLOW}{checkpoint}"));
        let child = begin(&format!("run {}", folder.path().join("scene.toml").display()));
        wait_until("a file", || names(folder.path()).len() == 2);
        signal(&child, name);
        ends(child, hint);
        assert_eq!(names(folder.path()), ["scene.toml"]);
    }
}

#[test]
#[cfg(feature = "mpfr")]
fn a_trace_or_drift_ends_before_its_first_modified_energy() {
    for command in ["trace", "drift"] {
        let folder = tempfile::tempdir().unwrap();
        let child = begin(&format!(
            "{command} pendulum --scheme stormer-verlet --step 1/20 --until 50 --digits 20000 --output {}",
            folder.path().join("out").display()
        ));
        wait_until("a file", || names(folder.path()).len() == 1);
        signal(&child, "-TERM");
        ends(child, "hint: ");
        assert!(names(folder.path()).is_empty(), "{command}");
    }
}
