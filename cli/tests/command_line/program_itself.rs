//! What the program reports of itself: its version, completions of shells, pages of man.

use std::fs;
use std::process::{Command, Stdio};

use crate::program::{quietly, shadowstep};

/// The names of all commands, of the help.
fn commands() -> Vec<String> {
    let help = quietly("--help");
    let list = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    let names = list.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    names.filter_map(|line| line.split_whitespace().next()).map(str::to_owned).collect()
}

#[test]
fn the_version_has_a_commit_or_stands_alone() {
    let version = quietly("--version");
    let after = version.strip_prefix(concat!("shadowstep ", env!("CARGO_PKG_VERSION"))).unwrap().trim_end();
    let commit = after.strip_prefix(" (").and_then(|after| after.strip_suffix(')'));
    let is_commit = |text: &str| text.len() == 12 && text.bytes().all(|byte| byte.is_ascii_hexdigit());
    assert!(after.is_empty() || commit.is_some_and(is_commit), "{version}");
}

#[test]
fn completions_are_syntax_of_their_shells() {
    for shell in ["bash", "zsh", "fish"] {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("script");
        fs::write(&file, quietly(&format!("completions {shell}"))).unwrap();
        // a shell that is not installed cannot judge
        if let Ok(status) = Command::new(shell).arg("-n").arg(&file).stderr(Stdio::inherit()).status() {
            assert!(status.success(), "{shell}");
        }
    }
    let other = shadowstep("completions tcsh");
    assert_eq!(other.code, 2);
    assert!(other.err.contains("possible values: bash"), "{}", other.err);
}

/// What bash completes after these words, the last of which is incomplete.
#[cfg(unix)]
fn completed(words: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("script"), quietly("completions bash")).unwrap();
    fs::write(folder.path().join("keep.toml"), "").unwrap();
    let program = assert_cmd::cargo::cargo_bin("shadowstep");
    let path = format!("{}:{}", program.parent().unwrap().display(), std::env::var("PATH").unwrap());
    let ask = format!(
        "source ./script; COMP_WORDS=({words}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); COMP_TYPE=9; \
         _clap_complete_shadowstep shadowstep \"${{COMP_WORDS[COMP_CWORD]}}\"; IFS=$'\\v'; echo \"${{COMPREPLY[*]}}\""
    );
    let output = Command::new("bash").args(["-c", &ask]).env("PATH", path).current_dir(folder.path()).output().unwrap();
    String::from_utf8(output.stdout).unwrap().trim().replace('\u{b}', " ")
}

#[cfg(unix)]
#[test]
fn bash_completes_commands_flags_and_names() {
    assert_eq!(completed("shadowstep tra"), "trace");
    assert_eq!(completed("shadowstep trace --max-o"), "--max-order");
    assert_eq!(completed("shadowstep trace ke"), "kepler keep.toml");
    assert!(completed("shadowstep trace kepler --scheme yosh").starts_with("yoshida4 yoshida6"));
    assert_eq!(completed("shadowstep trace kepler --plot-of orb"), "orbit=x:y");
    assert_eq!(completed("shadowstep trace kepler --plot-of ener"), "energies");
    assert!(completed("shadowstep scene eight").starts_with("eight-planets"));
}

#[test]
fn every_command_has_a_page_of_man() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("share/man1");
    quietly(&format!("man --out {}", out.display()));
    let first = fs::read_to_string(out.join("shadowstep.1")).unwrap();
    assert!(first.contains(".TH shadowstep 1") && first.contains("Exit codes"), "{first}");
    for command in commands().iter().filter(|&command| command != "help") {
        let page = fs::read_to_string(out.join(format!("shadowstep-{command}.1"))).unwrap();
        assert!(page.contains(".SH SYNOPSIS"), "{page}");
    }
    let taken = shadowstep(&format!("man --out {}", out.join("shadowstep.1").display()));
    assert_eq!(taken.code, 3, "{}", taken.err);
    assert!(taken.err.contains("shadowstep.1"), "{}", taken.err);
}

#[test]
fn help_shows_exit_codes_and_examples() {
    let help = quietly("--help");
    for code in ["0  success", "1  negative answer", "2  usage error", "3  a run failed"] {
        assert!(help.contains(code), "{help}");
    }
    let example = quietly("drift --help");
    assert!(example.contains("Examples:\n  shadowstep drift --problem kepler"), "{example}");
}

/// In pipes there are no colours, unless they are asked for.
#[test]
fn messages_have_colours_on_a_terminal() {
    let run = |name: &str, value: &str| {
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_shadowstep"))
            .args(["problems", "keppler"])
            .env(name, value)
            .output()
            .unwrap();
        String::from_utf8(output.stderr).unwrap()
    };
    let plain = "error: there is no problem `keppler`\n  hint: did you mean `kepler`?\n";
    assert_eq!((run("TERM", "xterm").as_str(), run("NO_COLOR", "1").as_str()), (plain, plain));
    let coloured = run("CLICOLOR_FORCE", "1");
    assert!(coloured.contains("\u{1b}[31m") && coloured.contains("\u{1b}[36m"), "{coloured:?}");
}
