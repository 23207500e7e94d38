//! Axes of any kind and number in any role.

use shadowstep_schemes::document::{Reader, Source, document};

use super::{Cells, Picture};
use crate::sweeps::axes::Axes;
use crate::sweeps::keep::Column;
use crate::sweeps::record::Record;

/// The name of an axis, its values, and its texts in a picture.
const AXES: [(&str, &str, &[&str]); 6] = [
    ("one", "[7]", &["one = 7"]),
    ("list", "[-1, 0, 5]", &["list = -1", "list = 0", "list = 5"]),
    ("equal", "[1, \"1e400\", 1]", &["equal = 1"]),
    ("range", "\"1 … 100 in 3 values of log\"", &["range = 1", "range = 10", "range = 100"]),
    ("draws", "{ draws = 2, uniform = [0, 1], seed = 1 }", &["draws"]),
    ("words", "[\"a\", \"b\", \"c\", \"d\"]", &["a", "b", "c", "d"]),
];

/// The picture of these axes and of `value`, which each run has; and the axes.
fn drawn(axes: &str, picture: &str, value: impl Fn(&[u64]) -> String) -> (String, Axes) {
    let source = Source { path: "sweep.toml".to_owned(), text: format!("[axes]\n{axes}[picture]\n{picture}") };
    let (document, _) = document(&source);
    let document = document.unwrap();
    let mut reader = Reader::new(&source, Vec::new());
    let axes = Axes::read(&mut reader, &document).unwrap();
    let columns = [Column { name: "value".to_owned(), is_number: true, is_exact: false }];
    let picture = Picture::read(&mut reader, &document, &axes, &columns);
    let picture = picture.unwrap_or_else(|| panic!("{:?}", reader.faults));
    let mut cells = Cells::new(&picture, &axes).unwrap();
    for run in 0..axes.runs() {
        let numbers = axes.numbers(run);
        let values = vec![Some(value(&numbers))];
        cells.include(&picture, &numbers, &Record { run, values, failure: None, rows: None });
    }
    (picture.svg(&cells, &axes, &columns, "sweep.toml").unwrap().unwrap(), axes)
}

/// Each axis as x, with each other one as y or as curves or without any, and each third one in panels or without any.
#[test]
fn axes_of_any_kind_in_any_role() {
    let others = || AXES.iter().map(Some).chain([None]);
    for (x, (second, role), panels) in AXES.iter().flat_map(|x| {
        let seconds = others().flat_map(|second| [(second, "y"), (second, "curves")]);
        seconds.flat_map(move |second| others().map(move |panels| (x, second, panels)))
    }) {
        let given = [Some(("x", x)), second.map(|axis| (role, axis)), panels.map(|axis| ("panels", axis))];
        let given: Vec<_> = given.into_iter().flatten().collect();
        if (1..given.len()).any(|i| given[..i].iter().any(|(_, (name, ..))| *name == given[i].1.0)) {
            continue;
        }
        let axes: String = given.iter().map(|(_, (name, values, _))| format!("{name} = {values}\n")).collect();
        let picture: String = given.iter().map(|(role, (name, ..))| format!("{role} = \"{name}\"\n")).collect();
        let (svg, axes) = drawn(&axes, &picture, |numbers| format!("{}", 1 + numbers.iter().sum::<u64>()));
        let labels =
            given.iter().filter(|(role, _)| ["curves", "panels"].contains(role)).flat_map(|(_, (.., texts))| *texts);
        for text in labels {
            assert!(svg.contains(text), "{picture}: {text}");
        }
        if let (Some((panels, ..)), "curves") = (panels, role) {
            let count = axes.find(panels).unwrap().count() as usize;
            assert_eq!(svg.matches("<svg ").count(), if count == 1 { 1 } else { count + 1 }, "{picture}");
        }
    }
}

/// Each chart of several has the values of its panel, by the ticks that all have.
#[test]
fn charts_of_panels_share_the_range_of_values() {
    let axes = "h = [1, 2]\ne = [0, 1, 2]\ns = [\"left\", \"right\"]\n";
    let value = |numbers: &[u64]| (100 * numbers[2] + 10 * numbers[1] + numbers[0]).to_string();
    let (svg, _) = drawn(axes, "x = \"h\"\ncurves = \"e\"\npanels = \"s\"\nscale = \"linear\"", value);
    let charts: Vec<&str> = svg.split("<svg ").skip(2).collect();
    let [left, right] = charts[..] else { panic!("{} charts", charts.len()) };
    for (chart, title) in [(left, "sweep.toml: left"), (right, "sweep.toml: right")] {
        assert!([title, "e = 0", "e = 1", "e = 2", ">0<", ">100<"].iter().all(|text| chart.contains(text)), "{chart}");
    }
}

/// An axis of words along which curves go: what its numbers mean stands below.
#[test]
fn words_along_curves() {
    let (svg, _) = drawn("s = [\"left\", \"right\"]\n", "", |numbers| numbers[0].to_string());
    assert!(svg.contains("s: 0: left, 1: right"), "{svg}");
}
