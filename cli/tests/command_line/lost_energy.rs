//! Runs that lose their energy end with a report that the step size is too large: of every command, as text and as
//! JSON.

use crate::program::{objects, shadowstep};
use crate::scenes::{folder, summarised};

const TOO_LARGE: &str = "the step size is too large";

/// Problem, scheme, step, until and number type.
const LOST: [[&str; 5]; 9] = [
    // beyond the limit 2 of Störmer–Verlet, where the modified energy is constant and H grows without limit
    ["harmonic-oscillator", "stormer-verlet", "2.01", "2000", "--digits 120"],
    ["harmonic-oscillator", "stormer-verlet", "2.01", "2000", "--double"],
    ["harmonic-oscillator", "stormer-verlet", "2.01", "200", "--digits 120"],
    // where round-off grows, too, and x no longer turns as at the start
    ["harmonic-oscillator", "stormer-verlet", "2.1", "105", "--double"],
    // too short for the monitor
    ["harmonic-oscillator", "stormer-verlet", "2.01", "40", "--digits 120"],
    // escapes
    ["kepler --set eccentricity=0.9", "stormer-verlet", "1/20", "100", "--digits 60"],
    ["kepler --set eccentricity=0.9", "yoshida4", "1/20", "100", "--double"],
    // an encounter throws the bodies apart
    ["pythagorean", "yoshida4", "1/10", "70", "--double"],
    ["pythagorean", "yoshida4", "1/100", "20", "--double"],
];

fn words([problem, scheme, step, until, numbers]: [&str; 5]) -> String {
    format!("{problem} --scheme {scheme} --step {step} --until {until} {numbers} --order 8")
}

#[test]
fn a_drift_reports_it() {
    for case in LOST {
        let text = shadowstep(&format!("drift {} --no-control", words(case)));
        assert_eq!(text.code, 0, "{}", text.err);
        assert!(text.out.contains(TOO_LARGE), "{case:?}: {}", text.out);
        let json = shadowstep(&format!("drift {} --no-control --json --strict", words(case)));
        assert_eq!(json.code, 1, "{case:?}");
        let summary = &objects(&json.out)[0]["summary"];
        assert_eq!(summary["verdict"], TOO_LARGE, "{case:?}");
        assert_eq!((&summary["bounded"], &summary["modified_energy"]["permanent_bound"]), (&false.into(), &().into()));
    }
}

#[test]
fn a_trace_reports_it() {
    for case in LOST {
        let text = shadowstep(&format!("trace {} --csv --strict", words(case)));
        assert_eq!(text.code, 1, "{}", text.err);
        let report = text.err.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(report.contains(TOO_LARGE) && !report.contains("is excluded"), "{case:?}: {report}");
        assert!(!report.contains("H(0) is round-off") && !report.contains("no longer does"), "{case:?}: {report}");
        let json = shadowstep(&format!("trace {}", words(case)));
        let last = json.err.lines().last().unwrap();
        assert_eq!(objects(last)[0]["summary"]["verdict"], TOO_LARGE, "{case:?}");
    }
}

#[test]
fn a_run_reports_it() {
    for [problem, scheme, step, until, numbers] in LOST {
        let name = problem.split(' ').next().unwrap();
        let parameters = if problem.contains('=') { "parameters = { eccentricity = 0.9 }" } else { "" };
        let digits = numbers.strip_prefix("--digits ").unwrap_or("\"double\"");
        // also without energies among the rows
        for (output, file) in [("trajectory = true", "out.csv"), ("energy = true", "out.jsonl")] {
            let folder = folder(&format!(
                "[problem]\nname = \"{name}\"\n{parameters}\n[run]\nscheme = \"{scheme}\"\nstep = \"{step}\"\nuntil = {until}\n\
                 digits = {digits}\n[output]\n{output}\nfile = \"{file}\"\n"
            ));
            let result = summarised(folder.path(), "--strict");
            let report = result.err.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(result.code == 1 && report.contains(TOO_LARGE), "{problem}, {output}: {report}");
            if file == "out.jsonl" {
                let metadata = std::fs::read_to_string(folder.path().join("out.jsonl.metadata.json")).unwrap();
                let metadata: serde_json::Value = serde_json::from_str(&metadata).unwrap();
                assert_eq!(metadata["summary"]["verdict"], TOO_LARGE, "{problem}");
            }
        }
    }
}

/// Short runs with a small error of H stay undecided.
#[test]
fn a_short_run_is_not_condemned() {
    for case in [
        ["harmonic-oscillator", "stormer-verlet", "1/10", "1", "--double"],
        ["kepler", "yoshida4", "1/20", "1", "--double"],
        ["pythagorean", "yoshida4", "1/1000", "1/50", "--double"],
        ["henon-heiles", "stormer-verlet", "1/4", "5", "--double"],
    ] {
        let result = shadowstep(&format!("drift {} --json", words(case)));
        assert_eq!(objects(&result.out)[0]["summary"]["verdict"], "undecided", "{case:?}");
    }
}

/// A body at rest without forces.
#[test]
fn no_change_at_all_is_0() {
    let free = "drift --potential 0*x --q x=1 --p 0 --scheme stormer-verlet --step 1/10 --until 10 --digits 30";
    let out = shadowstep(free).out;
    assert!(!out.contains("< 0") && out.contains("bounded"), "{out}");
    let row = out.lines().find(|line| line.trim_start().starts_with("1/10")).unwrap();
    assert_eq!(row.split_whitespace().collect::<Vec<_>>()[..5], ["1/10", "0", "abs.", "0", "0"], "{out}");
}
