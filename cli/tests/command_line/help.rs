//! Help: `-h` is a screen, `--help` has everything; neither has lines that are too long or broken twice, and long lists
//! have headings.

use std::process::Stdio;

use assert_cmd::cargo::CommandCargoExt;
use clap::{Arg, Command};

/// Columns of a line, and lines of a screen.
const WIDTH: usize = 80;
const SCREEN: usize = 60;

/// Examples and lists, which are not wrapped.
const EXAMPLE_WIDTH: usize = 78;

/// A line of a paragraph that is shorter was broken twice, unless it is the last one.
const SHORTEST: usize = 50;

/// A list of more arguments needs headings.
const MOST_WITHOUT_HEADINGS: usize = 12;

/// All commands and theirs, each with its words, such as `schemes show`.
fn commands() -> Vec<(String, Command)> {
    fn walk(words: &str, command: &Command, all: &mut Vec<(String, Command)>) {
        all.push((words.to_owned(), command.clone()));
        command.get_subcommands().for_each(|inner| walk(&format!("{words} {}", inner.get_name()), inner, all));
    }
    let mut all = Vec::new();
    walk("", &shadowstep_cli::commands(), &mut all);
    assert!(all.len() > 20, "the program has commands");
    all
}

/// What the program writes, on a wide terminal.
fn help(words: &str, flag: &str) -> String {
    let mut program = std::process::Command::cargo_bin("shadowstep").unwrap();
    program.args(words.split_whitespace()).arg(flag).env("COLUMNS", "200").stdin(Stdio::null());
    let output = program.output().unwrap();
    assert!(output.status.success(), "{words} {flag}");
    String::from_utf8(output.stdout).unwrap()
}

fn width(line: &str) -> usize {
    line.chars().count()
}

/// Lines that are too long, and lines within a paragraph that end early.
fn faults(help: &str) -> Vec<String> {
    let is_text = |line: &str| !line.is_empty() && !line.starts_with(' ');
    let lines: Vec<&str> = help.lines().collect();
    let long = lines.iter().filter(|line| width(line) > WIDTH).map(|line| format!("too long: {line}"));
    let broken = lines.windows(2).filter(|pair| is_text(pair[0]) && is_text(pair[1]) && width(pair[0]) < SHORTEST);
    long.chain(broken.map(|pair| format!("broken: {}", pair[0]))).collect()
}

/// Lines of examples and lists that would be broken.
fn long_examples(text: &str) -> Vec<String> {
    let lines = text.lines().filter(|line| line.starts_with(' ') && width(line) > EXAMPLE_WIDTH);
    lines.map(|line| format!("a long example: {line}")).collect()
}

/// The arguments without a heading.
fn without_heading(command: &Command) -> Vec<&Arg> {
    command.get_arguments().filter(|argument| argument.get_help_heading().is_none()).collect()
}

#[test]
fn short_help_is_a_screen_and_no_line_is_too_long_or_broken() {
    for (words, command) in commands() {
        for flag in ["-h", "--help"] {
            let help = help(&words, flag);
            let (found, length) = (faults(&help), help.lines().count());
            assert!(found.is_empty(), "{words} {flag}: {found:#?}\n{help}");
            assert!(flag == "--help" || length <= SCREEN, "{words} -h has {length} lines:\n{help}");
        }
        for text in [command.get_after_help(), command.get_after_long_help()].into_iter().flatten() {
            let found = long_examples(&text.to_string());
            assert!(found.is_empty(), "{words}: {found:#?}");
        }
    }
}

#[test]
fn faults_of_a_text_are_found() {
    let full = "x".repeat(WIDTH);
    assert!(faults(&format!("{full}\n{full}\nend\n\nHeading:\n  a\n  b\n")).is_empty());
    assert_eq!(faults(&format!("{full}x")), [format!("too long: {full}x")]);
    assert_eq!(faults(&format!("{full}\nstdout\n{full}")), ["broken: stdout"]);
    assert!(long_examples(&format!("{full}\n  a")).is_empty());
    assert_eq!(long_examples(&format!("  {full}")).len(), 1);
}

#[test]
fn long_lists_of_arguments_have_headings() {
    let commands = commands();
    let long = commands.iter().filter(|(_, command)| command.get_arguments().count() > MOST_WITHOUT_HEADINGS);
    let long: Vec<_> = long.collect();
    assert!(long.len() >= 5, "{}", long.len());
    for (words, command) in long {
        let found = without_heading(command);
        assert!(found.is_empty(), "{words}: {found:#?}");
    }
}

/// A heading holds for what follows, too, unless that has its own: none of these is under the one before it.
#[test]
fn an_argument_has_the_same_heading_in_all_commands() {
    const HEADINGS: [(&str, &str, usize); 13] = [
        ("problem", "Problem", 6),
        ("masses", "Problem", 6),
        ("scheme", "Schemes and steps", 3),
        ("schemes", "Schemes and steps", 2),
        ("until", "Schemes and steps", 5),
        ("mpfr", "Numbers", 5),
        ("double-double", "Numbers", 5),
        ("estimator", "Estimator of the modified energy", 2),
        ("accuracy", "Estimator of the modified energy", 2),
        ("control", "Estimator of the modified energy", 1),
        ("plot-of", "Charts", 1),
        ("strict", "Output", 2),
        ("output", "Output", 7),
    ];
    let commands = commands();
    for (name, heading, count) in HEADINGS {
        let all = commands.iter().flat_map(|(_, command)| command.get_arguments());
        let headings = all.filter(|argument| argument.get_long() == Some(name)).filter_map(Arg::get_help_heading);
        assert_eq!(headings.collect::<Vec<_>>(), vec![heading; count], "--{name}");
    }
}
