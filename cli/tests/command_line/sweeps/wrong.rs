//! Wrong sweeps with their messages and exit codes, in one snapshot that people read: each message states what is
//! wrong, where, and what would be right.

use std::fs;

use super::{folder, run};

const SWEEP: &str = r#"[problem]
name = "kepler"
parameters.eccentricity = "e"
[run]
scheme = "$scheme"
step = "h"
until = 3
digits = "double"
[axes]
scheme = ["stormer-verlet", "yoshida4"]
e = [0, "1/2"]
h = "1/10 … 1/40 in 3 steps of 1/h"
[keep]
values = ["energy_error"]
first_time = { near = "x^2 + y^2 < 1/2" }
stop = ["near"]
at_end = { L = "x*py - y*px" }
[picture]
x = "h"
"#;

/// A range in place of that of h.
const RANGE: &str = "1/10 … 1/40 in 3 steps of 1/h";

/// Changes of SWEEP: a part and its replacement.
const CHANGES: &[(&str, &str)] = &[
    // sections and keys
    ("[axes]", "[axis]"),
    ("[keep]", "[kept]"),
    ("[picture]", "[pictures]"),
    ("[problem]", "scene = \"nowhere.toml\"\n[problem]"),
    ("values =", "value ="),
    ("first_time", "first_times"),
    ("x = \"h\"", "xx = \"h\""),
    ("step =", "stepp ="),
    ("[axes]", "[axes"),
    ("[axes]", "[axes]\nh = [1]"),
    ("[axes]", "[axes.h]"),
    ("[keep]", "[keep.values]\n[keep]"),
    ("[picture]", "[[picture]]"),
    ("[picture]", "[zip]"),
    // axes
    ("e = [0, \"1/2\"]", "e = []"),
    ("e = [0, \"1/2\"]", "e = 0"),
    ("e = [0, \"1/2\"]", "e = true"),
    ("e = [0, \"1/2\"]", "e = [0, true]"),
    ("e = [0, \"1/2\"]", "e = [0, [1]]"),
    ("e = [0, \"1/2\"]", "e = [0, nan]"),
    ("e = [0, \"1/2\"]", "e = [0, \"1/2O\"]"),
    ("e = [0, \"1/2\"]", "e = [0, \"\"]"),
    ("e = [0, \"1/2\"]", "e = [0, \"1/0\"]"),
    ("e = [0, \"1/2\"]", "e = [0, 1/2]"),
    ("e = [0, \"1/2\"]", "e = [0, \"half\"]"),
    ("e = [0, \"1/2\"]", "e = [0, 0x10]"),
    ("e = [0, \"1/2\"]", "e = [2, 3]"),
    ("e = [0, \"1/2\"]", "e = [0, \"1e99999999999\"]"),
    ("e = [0, \"1/2\"]", "e = [0, \"9^9^9^9\"]"),
    ("e = [0, \"1/2\"]", "e = { draws = 0, uniform = [0, 1], seed = 1 }"),
    ("e = [0, \"1/2\"]", "e = { draws = -3, uniform = [0, 1], seed = 1 }"),
    ("e = [0, \"1/2\"]", "e = { draws = 1e3, uniform = [0, 1], seed = 1 }"),
    ("e = [0, \"1/2\"]", "e = { draws = 3, uniform = [0, 1] }"),
    ("e = [0, \"1/2\"]", "e = { draws = 3, seed = 1 }"),
    ("e = [0, \"1/2\"]", "e = { draws = 3, unifrom = [0, 1], seed = 1 }"),
    ("e = [0, \"1/2\"]", "e = { draws = 3, uniform = [0, 1], seed = -1 }"),
    ("e = [0, \"1/2\"]", "e = { draws = 3, uniform = [1, 0], seed = 1 }"),
    ("e = [0, \"1/2\"]", "e = { draws = 3, uniform = [0], seed = 1 }"),
    ("e = [0, \"1/2\"]", "e = { draws = 3, uniform = [0, \"one\"], seed = 1 }"),
    ("e = [0, \"1/2\"]", "e = { draws = 3, log = [0, 1], seed = 1 }"),
    ("e = [0, \"1/2\"]", "e = { draws = 3, normal = [0, -1], seed = 1 }"),
    ("e = [0, \"1/2\"]", "e = { draws = 3, normal = [0, 1], uniform = [0, 1], seed = 1 }"),
    ("e = [0, \"1/2\"]", "e = { draws = 1000000000001, uniform = [0, 1], seed = 1 }"),
    ("e = [0, \"1/2\"]", "e = {}"),
    ("e = [0, \"1/2\"]", "e = \"0 … 1/2\""),
    // names
    ("e = [0, \"1/2\"]", "ε = [0, \"1/2\"]"),
    ("e = [0, \"1/2\"]", "\"e f\" = [0, \"1/2\"]"),
    ("e = [0, \"1/2\"]", "e = [0]\nx = [1]"),
    ("e = [0, \"1/2\"]", "e = [0]\nt = [1]"),
    ("e = [0, \"1/2\"]", "e = [0]\npi = [1]"),
    ("e = [0, \"1/2\"]", "e = [0]\nsin = [1]"),
    ("e = [0, \"1/2\"]", "e = [0]\neccentricity = [1]"),
    ("e = [0, \"1/2\"]", "e = [0]\nf = [1]"),
    ("e = [0, \"1/2\"]", "e = [0]\nenergy_error = [1]"),
    ("e = [0, \"1/2\"]", "e = [0]\nfile = [\"a\", \"b\"]"),
    ("e = [0, \"1/2\"]", "f = [0, \"1/2\"]"),
    ("parameters.eccentricity = \"e\"", "parameters.gm = \"e\""),
    ("[axes]", "[initial]\nq = [\"eccentricity\", 0]\n[axes]\neccentricity = [0.1]"),
    ("[axes]", "[initial]\nq = [\"x\", 0]\n[axes]\nx = [1]"),
    ("[axes]", "[initial]\nq = [\"h_double\", 0]\n[axes]\nh_double = [1]"),
    // ranges
    (RANGE, ""),
    (RANGE, "1/10"),
    (RANGE, "1/10 - 1/40 in 3 steps"),
    (RANGE, "1/10 .. 1/40 in 3 steps"),
    (RANGE, "1/10 to 1/40 in 3 steps"),
    (RANGE, "1/10 … 1/40"),
    (RANGE, "1/10 … 1/40 in 3"),
    (RANGE, "1/10 … 1/40 in steps"),
    (RANGE, "1/10 … 1/40 in three steps"),
    (RANGE, "1/10 … 1/40 in 0 steps"),
    (RANGE, "1/10 … 1/40 in -3 steps"),
    (RANGE, "1/10 … 1/40 in 3.5 steps"),
    (RANGE, "1/10 … 1/40 in 1 values"),
    (RANGE, "1/10 … 1/40 in 3 stpes"),
    (RANGE, "1/10 … 1/40 in 3 steps of 1/e"),
    (RANGE, "1/10 … 1/40 in 3 steps of h^2"),
    (RANGE, "1/10 … 1/40 in 3 steps 1/h"),
    (RANGE, "1/10 … 1/40 in 3 log steps"),
    (RANGE, "1/10 … 1/10 in 3 steps"),
    (RANGE, "1/10 … 0 in 3 steps of 1/h"),
    (RANGE, "-1 … 1 in 3 steps of log"),
    (RANGE, "1/1O … 1/40 in 3 steps"),
    (RANGE, "… 1/40 in 3 steps"),
    (RANGE, "1/10 … in 3 steps"),
    (RANGE, "1/0 … 1/40 in 3 steps"),
    (RANGE, "1/10 … 1/40 in 99999999999999999999999 steps"),
    (RANGE, "1/10 … 1e-99999999999 in 3 steps"),
    (RANGE, "1e-400 … 1e-300 in 3 steps of log"),
    ("h = \"1/10 … 1/40 in 3 steps of 1/h\"", "h = 1/10 … 1/40 in 3 steps"),
    ("h = \"1/10 … 1/40 in 3 steps of 1/h\"", "h = [\"1/10 … 1/40 in 3 steps of 1/h\"]"),
    ("e = [0, \"1/2\"]", "e = \"0 … 1/2 in 999999999999 steps\"\nk = \"0 … 1/2 in 1000 values\""),
    // zip
    ("[problem]", "zip = \"h\"\n[problem]"),
    ("[problem]", "zip = [\"h\", \"e\"]\n[problem]"),
    ("[problem]", "zip = []\n[problem]"),
    ("[problem]", "zip = [[]]\n[problem]"),
    ("[problem]", "zip = [[\"h\", \"e\"]]\n[problem]"),
    ("[problem]", "zip = [[\"e\", \"f\"]]\n[problem]"),
    ("[problem]", "zip = [[\"e\", \"scheme\"], [\"e\"]]\n[problem]"),
    // values in the scene
    ("\"$scheme\"", "\"scheme\""),
    ("\"$scheme\"", "\"$schem\""),
    ("\"$scheme\"", "\"$\""),
    ("\"$scheme\"", "\"$e\""),
    ("yoshida4", "yoshida5"),
    ("yoshida4", "nowhere.toml"),
    ("step = \"h\"", "step = h"),
    ("step = \"h\"", "step = \"H\""),
    ("step = \"h\"", "step = \"scheme\""),
    ("until = 3", "steps = \"h\""),
    ("until = 3", "steps = \"$h\""),
    ("until = 3", "steps = \"n\""),
    ("until = 3", "until = \"$until\""),
    // what is kept
    ("[\"energy_error\"]", "[]"),
    ("[\"energy_error\"]", "\"energy_error\""),
    ("[\"energy_error\"]", "[\"energy_eror\"]"),
    ("[\"energy_error\"]", "[\"temperature\"]"),
    ("[\"energy_error\"]", "[\"energy_error\", \"energy_error\"]"),
    ("[\"energy_error\"]", "[\"drift\"]"),
    ("[\"energy_error\"]", "[\"energy_error\"]\nrows = true"),
    ("[\"energy_error\"]", "[\"energy_error\"]\nstate = \"yes\""),
    ("stop = [\"near\"]", "stop = [\"far\"]"),
    ("stop = [\"near\"]", "stop = \"near\""),
    ("x^2 + y^2 < 1/2", "x^2 + y^2"),
    ("x^2 + y^2 < 1/2", "x^2 + y^2 = 1/2"),
    ("x^2 + y^2 < 1/2", "0 < x < 1/2"),
    ("x^2 + y^2 < 1/2", "x^2 + z^2 < 1/2"),
    ("x^2 + y^2 < 1/2", "x^2 + y^2 <"),
    ("x^2 + y^2 < 1/2", "x) < (1/2"),
    ("x^2 + y^2 < 1/2", "(x^2 + y^2 < 1/2"),
    ("x*py - y*px", "x*vy - y*vx"),
    ("x*py - y*px", "x*py - "),
    ("x*py - y*px", "abs(x)"),
    ("x*py - y*px", "x > 0"),
    ("x^2 + y^2 < 1/2", "x) + (y < 1"),
    ("{ L = ", "{ near = "),
    ("{ L = ", "{ run = "),
    ("{ L = ", "{ h = "),
    ("{ L = ", "{ energy_error = "),
    ("{ L = \"x*py - y*px\" }", "\"x*py - y*px\""),
    ("{ L = \"x*py - y*px\" }", "{ x = \"x\" }\nstate = true"),
    // the picture
    ("x = \"h\"", "x = \"step\""),
    ("x = \"h\"", "x = 1"),
    ("x = \"h\"", "x = \"h\"\ny = \"e\"\ncurves = \"scheme\""),
    ("x = \"h\"", "x = \"h\"\ny = \"h\""),
    ("x = \"h\"", "value = \"energy\""),
    ("x = \"h\"", "scale = \"logarithmic\""),
    ("x = \"h\"", "of_several = \"median\""),
    ("x = \"h\"", "range = 1"),
    ("x = \"h\"", "range = [1]"),
    ("x = \"h\"", "range = [\"1/2\", 0.5]"),
    ("x = \"h\"", "scale = \"log\"\nrange = [0, 1]"),
    ("x = \"h\"", "curves = \"scheme\"\nrange = [1, 2]"),
];

#[test]
fn messages_and_exit_codes() {
    let valid = folder(SWEEP);
    assert_eq!(run(valid.path(), "sweep sweep.toml --out out").code, 0);
    let mut all = Vec::new();
    for (part, replacement) in CHANGES {
        assert!(SWEEP.contains(part), "{part}");
        let title = format!("{} → {}", part, replacement).replace('\n', "⏎");
        all.push(answer(&title, SWEEP.replacen(part, replacement, 1).as_bytes()));
    }
    for (title, sweep) in large() {
        all.push(answer(title, &sweep));
    }
    let accepted: Vec<_> = all.iter().filter(|answer| !answer.contains("\nexit code 2\n")).collect();
    insta::assert_snapshot!(all.join("\n"));
    assert!(accepted.is_empty(), "{accepted:#?}");
}

/// Texts that are none, or large: none of them may need much time or memory.
fn large() -> Vec<(&'static str, Vec<u8>)> {
    const E: &str = "e = [0, \"1/2\"]";
    let with = |part: &str, replacement: String| SWEEP.replacen(part, &replacement, 1).into_bytes();
    let repeated = |part: &str, count: usize| part.repeat(count);
    vec![
        ("an empty file", Vec::new()),
        ("not UTF-8", vec![0xff, 0xfe, 0]),
        ("a zero", vec![0]),
        ("a number of 10⁶ digits", with(E, format!("e = [0.{}]", repeated("1", 1_000_000)))),
        ("a range from a number of 10⁶ digits", with(RANGE, format!("0.{} … 1 in 2 steps", repeated("1", 1_000_000)))),
        ("draws below a number of 10⁶ digits", {
            with(E, format!("e = {{ draws = 2, uniform = [0, 0.{}], seed = 1 }}", repeated("1", 1_000_000)))
        }),
        ("10⁵ lists in lists", with(E, format!("e = {}{}", repeated("[", 100_000), repeated("]", 100_000)))),
        ("10⁵ brackets", with(E, format!("e = [\"{}1{}\"]", repeated("(", 100_000), repeated(")", 100_000)))),
        ("10⁵ brackets in a condition", with("x^2 + y^2 <", format!("{}x <", repeated("(", 100_000)))),
        ("10⁵ tables in tables", with(E, format!("e.{}f = 1", repeated("e.", 100_000)))),
        ("a list of 10⁷ members", with(E, format!("e = [{}]", repeated("1,", 10_000_000)))),
        ("10⁴ axes", with(E, (0..10_000).map(|k| format!("e{k} = [0]\n")).collect())),
        ("10⁴ formulas", with("L = ", (0..10_000).map(|k| format!("L{k} = \"x\", ")).collect::<String>() + "L = ")),
        ("10⁵ zips", with("[problem]", format!("zip = [{}]\n[problem]", repeated("[\"e\"], ", 100_000)))),
    ]
}

/// What the program writes to stderr about a sweep, without the line that it shows, and its exit code.
fn answer(title: &str, sweep: &[u8]) -> String {
    let folder = folder("");
    fs::write(folder.path().join("sweep.toml"), sweep).unwrap();
    let result = run(folder.path(), "sweep sweep.toml --out out");
    let begun = if folder.path().join("out").exists() { ", computed" } else { "" };
    format!("▶ {title}\nexit code {}{begun}\n{}", result.code, result.err)
}
