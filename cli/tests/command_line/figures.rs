//! `shadowstep figures`.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use tempfile::TempDir;

use crate::program::shadowstep;

/// Two figures, of which one requests results that depend on others.
const FAST: [&str; 2] = ["double-precision", "scattering"];

/// Runs the command; returns its stdout.
fn figures(folder: &Path, names: &[&str], threads: &str) -> String {
    let mut program = Command::cargo_bin("shadowstep").unwrap();
    let program = program.arg("figures").args(names).args(["--quick", "--out"]).arg(folder);
    let output = program.env("RAYON_NUM_THREADS", threads).assert().success().stderr("");
    String::from_utf8(output.get_output().stdout.clone()).unwrap()
}

/// Names and contents of all files but the results, whose order depends on the threads.
fn files(folder: &Path) -> Vec<(String, String)> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<_> = entries.filter(|name| name != "results.jsonl").collect();
    names.sort();
    names.into_iter().map(|name| (name.clone(), fs::read_to_string(folder.join(name)).unwrap())).collect()
}

#[test]
fn a_figure_is_charts_data_and_a_section_of_the_report() {
    let folder = TempDir::new().unwrap();
    let output = figures(folder.path(), &FAST, "2");
    let counts = "statements of the paper: 1 agrees, 1 differs, 0 not decided; additional statements: 1 agrees, 0 \
        differ, 2 not decided";
    assert_eq!(output, format!("{}\n{counts}\n", folder.path().join("report.html").display()));
    let files = files(folder.path());
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(
        names,
        [
            "double-precision-1.svg",
            "double-precision-2.svg",
            "double-precision-blocks.csv",
            "report.html",
            "scattering-1.svg",
            "scattering-2.svg",
            "scattering-values.csv",
            "scattering.csv",
        ]
    );
    let of = |wanted: &str| &files.iter().find(|(name, _)| name == wanted).unwrap().1;
    let report = of("report.html");
    assert_eq!(report.matches("<svg").count(), 4);
    for part in ["The paper states", "zero error", "increments of β", "scattering.csv", "--quick", "A quick report"] {
        assert!(report.contains(part), "{part}");
    }
    // what is not decided has a reason in its row
    assert_eq!(
        (report.matches(">not decided</span></td>").count(), report.matches("class=\"reason\"").count()),
        (2, 2)
    );
    assert!(!report.contains('`'), "backticks are set as code");
    let drifts = of("scattering.csv");
    assert_eq!(
        drifts.lines().take(3).collect::<Vec<_>>(),
        [
            concat!("# shadowstep: ", env!("CARGO_PKG_VERSION")),
            "# command: shadowstep figures scattering --quick",
            "problem,set,scheme,step,until,digits,estimator,order,drift,permanent_change,largest_jump,resolution,order_least,order_most"
        ]
    );
    // every digit: the change of H of each start
    let values = of("scattering-values.csv");
    assert!(values.lines().skip(3).all(|line| line.rsplit(',').next().unwrap().len() > 40), "{values}");
}

/// That interrupted ones are resumed is shown by `faults` and by the tests of the store.
#[test]
fn results_do_not_depend_on_threads() {
    let [one, two] = ["1", "2"].map(|threads| {
        let folder = TempDir::new().unwrap();
        figures(folder.path(), &FAST, threads);
        let path = folder.path().display().to_string();
        let files = files(folder.path()).into_iter().map(|(name, text)| (name, text.replace(&path, "FOLDER")));
        let results = fs::read_to_string(folder.path().join("results.jsonl")).unwrap();
        let mut lines: Vec<_> =
            results.lines().map(|line| line.split(",\"seconds\"").next().unwrap().to_owned()).collect();
        lines.sort();
        (files.collect::<Vec<_>>(), lines)
    });
    assert_eq!(one, two);
}

#[test]
fn a_report_keeps_the_figures_whose_results_are_there() {
    let folder = TempDir::new().unwrap();
    let path = folder.path();
    figures(path, &["scattering"], "2");
    let before = files(path);
    let output = figures(path, &["double-precision"], "2");
    let of_paper = "statements of the paper: 1 agrees, 1 differs, 0 not decided";
    assert!(output.contains(of_paper), "{output}");
    let now = files(path);
    let of = |name: &str| &now.iter().find(|(other, _)| other == name).unwrap().1;
    for (name, text) in before.iter().filter(|(name, _)| name != "report.html") {
        assert_eq!(of(name), text, "{name}");
    }
    let report = of("report.html");
    assert!(report.contains("<dt>from earlier runs</dt><dd>scattering --quick</dd>"));
    // in the order of the list, whichever are requested
    let places = ["id=\"figure-1\"><h2>Scattering", "id=\"figure-2\"><h2>The noise"].map(|part| report.find(part));
    assert!(places.iter().all(Option::is_some) && places.is_sorted(), "{places:?}");
    // without one result, nothing is computed for a figure that is not requested
    let store = path.join("results.jsonl");
    let text = fs::read_to_string(&store).unwrap();
    let lost = text.lines().find(|line| line.contains("transit")).unwrap();
    let fewer = text.replace(&format!("{lost}\n"), "");
    fs::write(&store, &fewer).unwrap();
    let output = figures(path, &["double-precision"], "2");
    let additional = "report.html\nadditional statements: 1 agrees, 0 differ, 2 not decided\n";
    assert!(output.ends_with(additional), "{output}");
    assert_eq!(fs::read_to_string(&store).unwrap(), fewer);
}

/// The contour needs no results.
#[test]
fn a_report_keeps_a_figure_without_results() {
    let folder = TempDir::new().unwrap();
    let page = || fs::read_to_string(folder.path().join("report.html")).unwrap();
    figures(folder.path(), &["scattering"], "2");
    assert!(!page().contains("The contour"), "it was not asked for");
    figures(folder.path(), &["contour"], "2");
    figures(folder.path(), &["scattering"], "2");
    assert!(page().contains("<h2>Scattering") && page().contains("<h2>The contour"));
}

#[test]
fn files_of_another_program_are_replaced_only_by_force() {
    for name in ["report.html", "double-precision.svg", "kepler-step.csv"] {
        let folder = TempDir::new().unwrap();
        let file = folder.path().join(name);
        fs::write(&file, "mine").unwrap();
        let words = format!("figures double-precision --quick --out {}", folder.path().display());
        let output = shadowstep(&words);
        assert_eq!((output.code, output.out.as_str()), (2, ""));
        let expected = format!("error: {} exists, without results of this program beside it\n", file.display());
        assert!(output.err.starts_with(&expected) && output.err.contains("with --force"), "{}", output.err);
        assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        if name == "report.html" {
            assert_eq!(shadowstep(&format!("{words} --force")).code, 0);
            assert_ne!(fs::read_to_string(&file).unwrap(), "mine");
        }
    }
}
