//! A usage error has one message with a hint, and the exit code is 2.

use crate::program::{quietly, shadowstep};

/// Flags that replace or complete a valid command line; parts of the message and of the hint.
const WRONG: &[(&str, &str, &str)] = &[
    ("--problem keppler", "there is no problem `keppler`", "did you mean `kepler`?"),
    ("--set ecentricity=0.1", "kepler has no parameter or initial value `ecentricity`", "`eccentricity`"),
    ("--set eccentricity=1", "--set eccentricity=1 is out of range", "less than 1"),
    ("--set eccentricity=1/0", "--set eccentricity=1/0: division by zero", "1/10"),
    ("--set eccentricity=1+", "`1+`, character 3: unexpected end", "1/10"),
    ("--set x=y", "--set x=y: unknown name `y`", "1/10"),
    ("--set eccentricity", "--set eccentricity has no `=`", "--set x=1/2"),
    ("--set x=1 --set x=2", "`x` is set twice", "keep one"),
    ("--scheme stormer-velet", "there is no scheme `stormer-velet`", "did you mean `stormer-verlet`?"),
    ("--scheme aba1046", "there is no scheme `aba1046`", "did you mean `aba1064`?"),
    ("--scheme verlett", "there is no scheme `verlett`", "did you mean `stormer-verlet`?"),
    ("--scheme yoshida8", "there is no scheme `yoshida8`", "did you mean `yoshida8-a`, `yoshida8-b`, "),
    ("--scheme zzzzzzzzzzzz", "there is no scheme `zzzzzzzzzzzz`", "no shipped table has a name like that (`"),
    ("--scheme yoshida4.toml", "there is no file yoshida4.toml", "is `yoshida4`, without `.toml`"),
    ("--scheme nowhere/mine.toml", "there is no file nowhere/mine.toml", "give the path of a table"),
    ("--scheme ,", "--scheme , has an empty value", "--scheme yoshida4,ruth3"),
    ("--scheme ruth3,", "--scheme ruth3, has an empty value", "--scheme yoshida4,ruth3"),
    ("--step 1/10,", "--step 1/10, has an empty value", "--step 1/10,1/20"),
    ("--step 0.1x", "--step `0.1x`, character 1: an operator is missing", "1/10"),
    ("--step 1/10,*2", "--step `*2`, character 1", "1/10"),
    ("--step 0", "--step 0: the step size must be nonzero", "such as 1/10"),
    ("--step -1/10", "steps of -1/10 never reach the time 2: the signs differ", "positive values for both"),
    ("--step 3", "a step of 3 is longer than the run until 2", "smaller step size"),
    ("--step 1e-9223372036854775808", "the exponent of this number is out of range: -10000 to 10000", "1e-3"),
    ("--step 1e-20", "steps of 1e-20 until 2 are 2e20 steps", "the limit is 1e10"),
    ("--until 0", "--until 0: the time must be nonzero", "--until 100"),
    ("--until 2..", "--until `2..`, character 3", "1/10"),
    (
        "--digits 5001 --scheme yoshida4",
        "yoshida4 has irrational weights, computed to at most 4980 digits; the run has 5001",
        "use at most 4980 digits",
    ),
    ("--digits 6000 --set py=sqrt(2)", "py is irrational and computed to 5000 digits", "--digits 4980"),
    (
        "--problem outer-solar-system --set m_pluto=1e-310 --double",
        "a mass of 1e-310 or its inverse overflows or underflows in double precision",
        "--digits 16",
    ),
    ("--order 4 --max-order 8", "--max-order requires --order auto, not --order 4", "remove it"),
    ("--order 4 --stop early", "--stop requires --order auto, not --order 4", "write --order auto"),
    ("--order 4 --rule robust", "--rule requires --order auto, not --order 4", "remove it"),
    ("--order 4 --estimator bilinear --accuracy 1e-9", "--accuracy requires --order auto, not --order 4", "remove it"),
    (
        "--estimator central --accuracy 1e-9 --order auto",
        "--accuracy requires --estimator bilinear, not --estimator central",
        "write --estimator bilinear",
    ),
    (
        "--estimator bilinear --order auto --stop early",
        "--stop requires --estimator central, not --estimator bilinear",
        "write --estimator central",
    ),
    ("--estimator bilinear --order auto --rule least", "--rule requires --estimator central, not", "remove it"),
    (
        "--estimator bilinear --order 1000",
        "--order 1000 is above 256, the largest order of --estimator bilinear",
        "write --order 256 or less",
    ),
    (
        "--estimator bilinear --order auto --max-order 257",
        "--max-order 257 is above 256, the largest order of --estimator bilinear",
        "write --max-order 256 or less",
    ),
    ("--estimator bilinear --order auto --accuracy 0", "--accuracy 0 is not a valid target error", "such as 1e-20"),
    (
        "--estimator bilinear --order auto --accuracy -1e-9",
        "--accuracy -1e-9 is not a valid target error",
        "such as 1e-20",
    ),
    ("--estimator bilinear --order auto --accuracy 1e400", "--accuracy 1e400 is above 1e100", "such as 1e-20"),
    ("--estimator bilinear --order auto --accuracy 1e-9x", "--accuracy `1e-9x`, character", "1/10"),
    ("--output nowhere/out.json", "--output nowhere/out.json cannot be written", "folder that exists"),
    ("--output /", "--output / is not a file", "name of a file"),
];

#[test]
#[cfg(feature = "mpfr")]
fn each_wrong_flag_has_its_message_and_hint() {
    for (flags, sentence, hint) in WRONG {
        let result = shadowstep(&completed(flags));
        assert_eq!((result.code, result.out.as_str()), (2, ""), "{flags}: {}", result.err);
        let lines: Vec<&str> = result.err.lines().collect();
        let [error, help] = lines[..] else { panic!("{flags}: {}", result.err) };
        assert!(error.strip_prefix("error: ").is_some_and(|error| error.contains(sentence)), "{flags}: {error}");
        assert!(help.strip_prefix("  hint: ").is_some_and(|help| help.contains(hint)), "{flags}: {help}");
    }
}

#[test]
fn invalid_values_of_flags_are_refused() {
    for (flags, sentence) in [
        ("--digits 0", "0 is out of range: write a whole number from 1 to 100000"),
        ("--digits 3.5", "write a whole number from 1 to 100000"),
        ("--digits many", "write a whole number from 1 to 100000"),
        ("--digits 100001", "100001 is out of range: write a whole number from 1 to 100000"),
        ("--digits 50 --double", "'--digits <DIGITS>' cannot be used with '--double'"),
        ("--order 0", "write a number from 1 to 1000, or auto"),
        ("--order best", "write a number from 1 to 1000, or auto"),
        ("--max-order 1", "1 is out of range: write a whole number from 2 to 1000"),
        ("--stop soon", "invalid value 'soon'"),
        ("--rule best", "invalid value 'best'"),
        ("--frobnicate", "unexpected argument '--frobnicate'"),
    ] {
        let result = shadowstep(&completed(flags));
        assert_eq!((result.code, result.out.as_str()), (2, ""), "{flags}");
        assert!(result.err.contains(sentence), "{flags}: {}", result.err);
    }
    assert_eq!(shadowstep("frobnicate").code, 2);
    assert_eq!(shadowstep("drift").code, 2);
}

/// Of a formula and of other commands: what is wrong is named by its flag.
#[test]
fn each_wrong_word_has_its_message_and_hint() {
    let trace = |flags: &str| format!("trace --scheme yoshida4 --step 1/10 --until 1 {flags}");
    for (command, sentence, hint) in [
        (
            trace("--potential c*x*y --q x=1,y=2 --p 0,0"),
            "--potential \"c*x*y\": unknown name `c`",
            "with values, such as c = 1",
        ),
        (trace("--potential x*px --q x=1 --p 0"), "unknown name `px`", "U(q) has no momenta in it"),
        (trace("--potential x^2 --q x=two --p 0"), "--q: unknown name `two`", "write an exact number"),
        (trace("--potential x^2 --q x=1 --p 0 --masses 1,2"), "--masses: this list needs a number", "compare --q, --p"),
        (trace("--potential x^2/k --set k=0 --q x=1 --p 0"), "the energy is inf", "or other parameters"),
        (
            "advise kepler --until 9 --tolerance -1".to_owned(),
            "--tolerance -1: the tolerance must be",
            "--tolerance 1e-8",
        ),
        ("schemes show pefrl --plot a.png".to_owned(), "--plot a.png is not the name of an SVG file", "scheme.svg"),
        ("schemes chek mine.toml".to_owned(), "`chek` is not the file of a table", "`shadowstep schemes check`?"),
        (
            "work-precision kepler --until 9 --out nowhere --schemes near-integrabel".to_owned(),
            "there is no scheme `near-integrabel`",
            "did you mean the group `near-integrable`?",
        ),
    ] {
        let result = shadowstep(&command);
        assert!(matches!(result.code, 2 | 3), "{command}: {}", result.err);
        assert!(result.err.contains(sentence) && result.err.contains(hint), "{command}: {}", result.err);
    }
}

/// A command line that is valid except for these flags.
fn completed(flags: &str) -> String {
    let good = ["--problem kepler", "--scheme stormer-verlet", "--step 1/10", "--until 2"];
    let kept = good.into_iter().filter(|flag| !flags.contains(flag.split_once(' ').unwrap().0));
    format!("drift {} {flags}", kept.collect::<Vec<_>>().join(" "))
}

#[test]
fn the_valid_command_line_is_accepted() {
    assert_eq!(quietly(&completed("--double --order 2 --json")).lines().count(), 1);
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

#[test]
fn names_of_problems_ignore_case() {
    let words = "--scheme Stormer-Verlet --double --order 2 --no-control --no-summary";
    let drift = |problem: &str| quietly(&completed(&format!("--problem {problem} {words} --step 1/10")));
    let table = |text: String| text.lines().take(8).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(table(drift("Kepler")), table(drift("kepler")));
}

#[test]
fn one_digit_is_singular() {
    let table = quietly(&completed("--digits 1 --order 2 --no-control --no-summary"));
    assert!(table.contains(", 1 digit; ") && !table.contains("1 digits"), "{table}");
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
