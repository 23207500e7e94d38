//! `shadowstep work-precision` and `shadowstep advise`.

use std::collections::HashSet;
use std::fs;

use tempfile::TempDir;

use crate::program::{objects, quietly, shadowstep, text};

#[test]
fn a_study_is_data_charts_and_a_page() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().display();
    let command = format!(
        "work-precision kepler --until 10 --schemes stormer-verlet,yoshida4 --step 1/20,1/40,1/80,1/160 --digits 25 \
            --out {out}"
    );
    let printed = quietly(&command);
    assert!(printed.lines().all(|line| line.chars().count() <= 80 || line.contains("report.html")), "{printed}");
    assert!(printed.contains("Positions are compared with the exact flow."), "{printed}");
    let rows = objects(&fs::read_to_string(folder.path().join("work-precision.jsonl")).unwrap());
    assert_eq!(rows.len(), 8);
    let (first, last) = (&rows[0], &rows[7]);
    assert_eq!(
        (text(first, "scheme"), text(first, "step"), &first["evaluations"]),
        ("stormer-verlet", "1/20", &200.into())
    );
    assert_eq!((text(last, "scheme"), &last["evaluations"]), ("yoshida4", &(3 * 1600).into()));
    // four halvings of the step of order 4, and the next order
    let error = |row| text(row, "position_error").parse::<f64>().unwrap();
    let gain = (error(&rows[4]) / error(last)).log2() / 3.0;
    assert!((gain - 4.0).abs() < 0.4, "{gain}");
    let page = fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert_eq!(page.matches("<svg ").count(), 4);
    for name in ["position-forces.svg", "energy-time-print.svg", "work-precision.csv", "plot.py"] {
        assert!(page.contains(name) && folder.path().join(name).exists(), "{name}");
    }
    // the charts have titles of their own, and one order of their labels
    let of_chart = |name: &str| {
        let chart = fs::read_to_string(folder.path().join(format!("{name}.svg"))).unwrap();
        let texts = chart.split("</text>").filter_map(|text| text.rsplit('>').next().map(str::to_owned));
        let labels: Vec<_> = texts.filter(|text| ["stormer-verlet", "yoshida4"].contains(&text.as_str())).collect();
        (labels, chart.split("</title>").next().unwrap().rsplit('>').next().unwrap().to_owned())
    };
    let charts = ["position-forces", "position-time", "energy-forces", "energy-time"].map(of_chart);
    let titles: HashSet<_> = charts.iter().map(|(_, title)| title).collect();
    assert_eq!(titles.len(), 4, "{titles:?}");
    assert!(charts.iter().all(|(labels, _)| labels == &["stormer-verlet", "yoshida4"]), "{charts:?}");
    // nothing is computed again
    let results = fs::read(folder.path().join("results.jsonl")).unwrap();
    assert_eq!(quietly(&command), printed);
    assert_eq!(fs::read(folder.path().join("results.jsonl")).unwrap(), results);
}

#[test]
fn advice_is_verified() {
    let printed = quietly("advise pendulum --until 20 --tolerance 1e-6 --schemes stormer-verlet,blanes-moan-srkn11b");
    assert!(printed.lines().nth(2).unwrap().starts_with("blanes-moan-srkn11b, step "), "{printed}");
    let verified = printed.lines().find(|line| line.trim_start().starts_with("verified")).unwrap();
    let error: f64 = verified.split_whitespace().nth(1).unwrap().trim_end_matches(',').parse().unwrap();
    assert!(error <= 1e-6 && error > 1e-9, "{printed}");
    // a part of an irrational time has 300 digits
    let printed = quietly("advise pendulum --until 6*pi --tolerance 1e-3 --schemes yoshida4");
    assert!(printed.contains("yoshida4, step until/") && printed.lines().all(|line| line.len() < 100), "{printed}");
}

#[test]
fn what_is_out_of_reach_is_a_negative_answer() {
    let refused = shadowstep("advise pendulum --until 20 --tolerance 1e-30 --schemes blanes-moan-srkn11b");
    assert_eq!(refused.code, 1, "{}", refused.err);
    assert!(refused.out.contains("No scheme meets the tolerance in double precision"), "{}", refused.out);
}

/// Numbers of 16 digits have no such bound.
#[test]
fn problems_that_overflow_have_no_advice() {
    let large = "harmonic-oscillator --set q=1e300 --until 1";
    let precise = quietly(&format!("advise {large} --tolerance 1e290 --digits 16 --schemes yoshida6-a"));
    assert!(precise.contains("  verified "), "{precise}");
    // the motion is infinite after a finite time
    let far =
        shadowstep("advise --potential=-exp(x^2) --q x=1 --p 0 --until 5 --tolerance 1e-6 --seconds 0.2 --of energy");
    assert_eq!(far.code, 1, "{}", far.err);
    assert!(far.out.contains("every run over all of the time") && !far.out.contains("chaotic"), "{}", far.out);
    assert!(!far.out.contains("stormer-verlet"), "{}", far.out);
}

#[test]
fn schemes_for_near_integrable_systems_are_a_group() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().display();
    let command = "work-precision outer-solar-system --until 2000 --steps 20,40 --schemes near-integrable,+yoshida4";
    quietly(&format!("{command} --out {out}"));
    let rows = objects(&fs::read_to_string(folder.path().join("work-precision.jsonl")).unwrap());
    let mut names: Vec<_> = rows.iter().map(|row| text(row, "scheme")).collect();
    names.dedup();
    assert!(names.contains(&"aba864") && names.contains(&"saba3") && !names.contains(&"pefrl"), "{names:?}");
    assert_eq!(names.last(), Some(&"yoshida4"));
}

/// A scene of an eccentric orbit in transformed time, with its steps.
fn transformed(step: &str) -> String {
    format!(
        "problem = {{ name = 'kepler', parameters = {{ eccentricity = 0.9 }} }}\ntime.transform = 'logarithmic'\n\
         run = {{ scheme = 'sofroniou-spaletta6-13', first = 'drift', step = '{step}', until = 20, digits = 'double' }}\n\
         output = {{ trajectory = true, format = 'jsonl' }}"
    )
}

/// Errors are those of the run of a scene, which ends at the physical time.
#[test]
fn advice_in_transformed_time_is_for_the_run_of_the_scene() {
    let folder = TempDir::new().unwrap();
    let scene = folder.path().join("scene.toml");
    let written = |text: &str| fs::write(&scene, text).unwrap();
    written(&transformed("1/10"));
    let scheme = format!("advise {} --tolerance 1e-7 --schemes sofroniou-spaletta6-13", scene.display());
    let printed = quietly(&scheme);
    let after = |word: &str| printed.split(word).nth(1).unwrap().split([' ', ',', '\n']).find(|word| !word.is_empty());
    let (step, verified): (_, f64) = (after(", step ").unwrap(), after("verified").unwrap().parse().unwrap());
    assert!(printed.contains("t = 0 to 20") && verified <= 1e-7, "{printed}");
    let last = |step: &str| {
        written(&transformed(step));
        let rows = objects(&quietly(&format!("run {} --no-summary", scene.display())));
        let row = rows.last().unwrap();
        [0, 1].map(|i| row["q"][i].as_str().unwrap().parse::<f64>().unwrap())
    };
    let ([x, y], [x0, y0]) = (last(step), last("1/200"));
    let error = (x - x0).hypot(y - y0);
    assert!((error / verified - 1.0).abs() < 0.1, "{error:e} {printed}");
}

/// Steps begin as those of the scene's run, whose error that of the diagram is, also where the time and the number type
/// are given.
#[test]
fn steps_begin_with_the_map_of_the_scene() {
    let folder = TempDir::new().unwrap();
    let (scene, out) = (folder.path().join("scene.toml"), folder.path().join("out"));
    let written = |first: &str, step: &str| {
        let text = format!(
            "problem.name = 'kepler'\nrun = {{ scheme = 'stormer-verlet', first = '{first}', step = '{step}', until = \
                1, digits = 'double' }}\n\
             output = {{ trajectory = true, format = 'jsonl' }}"
        );
        fs::write(&scene, text).unwrap();
    };
    let last = |first: &str, step: &str| {
        written(first, step);
        let rows = objects(&quietly(&format!("run {} --no-summary", scene.display())));
        [0, 1].map(|i| rows.last().unwrap()["q"][i].as_str().unwrap().parse::<f64>().unwrap())
    };
    let [x0, y0] = last("kick", "1/10000");
    let mut errors = Vec::new();
    for (first, flags) in [("drift", ""), ("kick", ""), ("drift", " --until 1 --double")] {
        let [x, y] = last(first, "1/10");
        let words = format!("{}{flags} --step 1/10 --schemes stormer-verlet", scene.display());
        let printed = quietly(&format!("work-precision {words} --out {} --force", out.display()));
        let rows = objects(&fs::read_to_string(out.join("work-precision.jsonl")).unwrap());
        let found = text(&rows[0], "position_error").parse::<f64>().unwrap();
        assert!((found / (x - x0).hypot(y - y0) - 1.0).abs() < 1e-3, "{first}: {found}");
        assert!(printed.contains(&format!("{first}s first")), "{printed}");
        errors.push(found);
    }
    assert!(errors[0] / errors[1] > 1.5 || errors[1] / errors[0] > 1.5, "{errors:?}");
    // the order of a Nyström scheme does not survive the exchange of its maps
    let default = quietly(&format!("work-precision {} --step 1/10 --out {} --force", scene.display(), out.display()));
    assert!(default.contains("blanes-moan-s6") && !default.contains("srkn11b"), "{default}");
    let refused = shadowstep(&format!("advise {} --tolerance 1e-2 --schemes blanes-moan-srkn11b", scene.display()));
    assert_eq!(refused.code, 2, "{}", refused.err);
    assert!(refused.err.contains("order"), "{}", refused.err);
}

#[test]
fn advice_names_what_it_did_not_try() {
    let ended = shadowstep("advise henon-heiles --until 1e6 --tolerance 1e-30 --of energy --seconds 0.002");
    assert_eq!(ended.code, 1, "{} {}", ended.out, ended.err);
    assert!(ended.out.contains("of --seconds 0.002 for all: "), "{}", ended.out);
}
