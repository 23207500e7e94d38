//! `shadowstep drift`.

use crate::program::{objects, quietly, shadowstep, text};
use serde_json::Value;
use shadowstep::exact;
use shadowstep::number::{Limbs, Real};

const FAST: &str = "drift --problem kepler --scheme stormer-verlet --double --order 4 --until 2";

const FIELDS: [&str; 33] = [
    "shadowstep",
    "problem",
    "parameters",
    "scheme",
    "step",
    "until",
    "end",
    "digits",
    "estimator",
    "order",
    "max_order",
    "stop",
    "rule",
    "accuracy",
    "energy_error",
    "drift",
    "minimum",
    "maximum",
    "at_minimum",
    "at_maximum",
    "first",
    "last",
    "permanent_change",
    "control",
    "control_left_out",
    "order_least",
    "order_most",
    "steps",
    "forces_per_step",
    "own_force_evaluations",
    "force_evaluations",
    "seconds",
    "summary",
];

#[test]
fn a_record_has_its_fields_in_order() {
    let line = quietly(&format!("{FAST} --step 1/10 --json"));
    let mut rest = line.as_str();
    for field in FIELDS {
        rest = rest.split_once(&format!("\"{field}\":")).unwrap_or_else(|| panic!("{field}: {line}")).1;
    }
    assert_eq!(objects(&line)[0].as_object().unwrap().len(), FIELDS.len());
}

#[test]
fn a_record_contains_the_run() {
    let words = "drift --problem kepler --set eccentricity=1/3 --scheme ruth3 --step 0.05 --until 4/2 --digits 20 \
                 --estimator central --order 3 --json";
    let record = &objects(&quietly(words))[0];
    assert_eq!(text(record, "problem"), "kepler");
    assert_eq!(text(record, "scheme"), "ruth3");
    assert_eq!((text(record, "step"), text(record, "until")), ("1/20", "2"));
    assert_eq!((&record["digits"], &record["order"]), (&Value::from(20), &Value::from(3)));
    assert_eq!((&record["order_least"], &record["order_most"]), (&Value::from(3), &Value::from(3)));
    assert_eq!(text(record, "estimator"), "central");
    assert_eq!(record["steps"], 40);
    // 40 steps, 3 beyond each end and 3 more for the errors there, 3 forces each: ruth3 begins with a kick and ends
    // with a drift
    assert_eq!(record["force_evaluations"], (40 + 6 + 6) * 3);
    let parameters = &record["parameters"];
    assert_eq!(text(parameters, "eccentricity"), "1/3");
    assert_eq!(text(parameters, "x"), "2/3");
    // sqrt 2, rounded beyond the digits of the run
    assert!(text(parameters, "py").starts_with("1.41421356237309504880168872"), "{parameters}");
}

#[test]
fn a_record_contains_how_the_order_was_chosen() {
    let words = "drift --problem kepler --scheme stormer-verlet --step 1/10 --until 1 --digits 20 --no-control --json";
    let settings = |flags: &str| {
        let record = objects(&quietly(&format!("{words} {flags}"))).remove(0);
        assert_eq!(text(&record, "shadowstep"), env!("CARGO_PKG_VERSION"));
        ["max_order", "stop", "rule", "accuracy"].map(|field| record[field].clone())
    };
    let (word, none) = (|word: &str| Value::from(word), Value::Null);
    assert_eq!(settings("--order 4"), [const { Value::Null }; 4]);
    assert_eq!(settings("--estimator central"), [200.into(), word("full"), word("least"), none.clone()]);
    assert_eq!(
        settings("--estimator central --max-order 20 --stop early --rule robust"),
        [20.into(), word("early"), word("robust"), none.clone()]
    );
    assert_eq!(settings(""), [64.into(), none.clone(), none.clone(), none.clone()]);
    let bilinear = settings("--max-order 8 --accuracy 1/1000000000");
    assert_eq!(bilinear, [8.into(), none.clone(), none, word("0.000000001")]);
}

#[test]
fn numbers_round_trip_and_the_drift_is_maximum_minus_minimum() {
    let words = "drift --problem pendulum --scheme yoshida4 --step 1/10 --until 3 --digits 60 --order 6 --json";
    let record = &objects(&quietly(words))[0];
    // the fewest limbs that have 60 digits
    let number = |field| text(record, field).parse::<Limbs<4>>().unwrap();
    assert_eq!(number("drift"), &number("maximum") - &number("minimum"));
    assert!(!number("drift").is_below_zero() && !number("drift").is_zero());
    for field in ["drift", "minimum", "maximum", "first", "last"] {
        assert_eq!(Real::to_text(&number(field)), text(record, field));
    }
    // the last state's modified energy is between the extremes
    assert!(number("minimum") <= number("last") && number("last") <= number("maximum"));
}

#[test]
fn there_is_a_run_per_scheme_and_step() {
    let words = "drift --problem pendulum --scheme stormer-verlet,ruth3 --step 1/10,1/20 --until 1 --double --order 2 \
                 --json";
    let runs = objects(&quietly(words));
    let made: Vec<_> = runs.iter().map(|run| (text(run, "scheme"), text(run, "step"))).collect();
    let expected = [("stormer-verlet", "1/10"), ("stormer-verlet", "1/20"), ("ruth3", "1/10"), ("ruth3", "1/20")];
    assert_eq!(made, expected);
}

#[test]
fn auto_chooses_among_the_orders_allowed() {
    let words = "drift --problem kepler --scheme stormer-verlet --step 1/20 --until 2 --digits 40 --json";
    let full = &objects(&quietly(&format!("{words} --max-order 20")))[0];
    assert_eq!(text(full, "order"), "auto");
    let (least, most) = (full["order_least"].as_u64().unwrap(), full["order_most"].as_u64().unwrap());
    assert!(2 <= least && least < most && most <= 20, "{least}–{most}");
    // with D_4 alone it is worse
    let fixed = &objects(&quietly(&format!("{words} --order 4")))[0];
    let drift = |record| text(record, "drift").parse::<f64>().unwrap();
    assert!(drift(full) < drift(fixed) / 10.0, "{full} {fixed}");
}

#[test]
fn the_early_stop_uses_lower_orders_with_almost_the_same_error() {
    let words = "drift --problem kepler --scheme stormer-verlet --step 1/10 --until 14 --digits 60 --estimator \
        central --max-order 100 --json";
    let record = |stop: &str| objects(&quietly(&format!("{words} --stop {stop}"))).remove(0);
    let (full, early) = (record("full"), record("early"));
    let least = |record: &serde_json::Value| record["order_least"].as_u64().unwrap();
    assert!(least(&early) < least(&full), "{early} {full}");
    let drift = |record| text(record, "drift").parse::<f64>().unwrap();
    let ratio = drift(&early) / drift(&full);
    assert!((0.5..2.0).contains(&ratio), "{ratio}");
}

/// With ≤, as the paper prints it, the search ends at the first ripple.
#[test]
fn the_printed_stop_is_worse_than_the_early_one() {
    let words = "drift --problem kepler --scheme stormer-verlet --step 1/20 --until 7 --digits 60 --estimator central \
        --max-order 100 --json";
    let record = |stop: &str| objects(&quietly(&format!("{words} --stop {stop}"))).remove(0);
    let [early, printed] = ["early", "printed"].map(record);
    assert_eq!(printed["stop"], "printed");
    let drift = |record| text(record, "drift").parse::<f64>().unwrap();
    assert!(drift(&printed) > 5.0 * drift(&early), "{printed} {early}");
}

#[test]
fn the_robust_rule_is_another_one() {
    let words = "drift --problem kepler --scheme stormer-verlet --step 1/20 --until 7 --digits 60 --estimator central \
        --max-order 60";
    let drift = |rule: &str| objects(&quietly(&format!("{words} --json {rule}"))).remove(0);
    let [least, paper, robust] = ["", "--rule least", "--rule robust"].map(drift);
    assert_eq!((text(&least, "minimum"), text(&least, "drift")), (text(&paper, "minimum"), text(&paper, "drift")));
    assert_ne!(text(&robust, "drift"), text(&paper, "drift"));
    assert!(
        quietly(&format!("{words} --rule robust"))
            .replace('\n', " ")
            .contains("the best m of 2–60 by the robust rule ")
    );
}

#[test]
fn a_scene_can_run_backwards_in_time() {
    let words = FAST.replace("--until 2", "--until -2");
    let record = &objects(&quietly(&format!("{words} --step -1/10 --json")))[0];
    assert_eq!((text(record, "step"), text(record, "until")), ("-1/10", "-2"));
    assert_eq!(record["steps"], 20);
    // the orbit and the scheme are symmetric in time
    let forward = &objects(&quietly(&format!("{FAST} --step 1/10 --json")))[0];
    let number = |record, field| text(record, field).parse::<f64>().unwrap();
    assert!((number(record, "last") - number(forward, "last")).abs() < 1e-14);
}

#[test]
fn people_get_a_table() {
    let words = "drift --problem kepler --scheme stormer-verlet,yoshida4 --step 1/10 --until 10 --digits 30 \
        --estimator central --order 4";
    let table = quietly(words);
    let [title, values, how, rest, ..] = table.lines().collect::<Vec<_>>()[..] else { panic!("{table}") };
    assert!(title.contains("Kepler") && title.contains("1/sqrt(x^2 + y^2)"), "{title}");
    assert!(values.contains("eccentricity = 3/5, x = 2/5"), "{values}");
    assert!(how.contains("30 digits") && format!("{how} {rest}").contains("m = 4"), "{how}");
    let lines: Vec<&str> = table.lines().collect();
    let scheme =
        lines.iter().position(|line| line.contains("yoshida4, 3 forces a step")).expect("a line for each scheme");
    let row: Vec<&str> = lines[scheme + 1].split_whitespace().collect();
    let [step, error, drift, .., order, forces, _, "+", _] = row[..] else { panic!("{row:?}") };
    assert_eq!((step, order, forces), ("1/10", "4", "301"), "one force to begin with, and three a step");
    // the same numbers as JSON has, to 3 digits
    let record = &objects(&quietly(&format!("{words} --json")))[1];
    for (shown, full) in [(drift, &record["drift"]), (error, &record["energy_error"]["largest_relative"])] {
        let [shown, full]: [f64; 2] = [shown, full.as_str().unwrap()].map(|text| text.parse().unwrap());
        assert!((shown / full - 1.0).abs() < 1e-2, "{shown} {full}");
    }
    assert!(lines.iter().all(|line| line.chars().count() <= 80), "{table}");
    assert!(!table.contains('\u{1b}'), "no colours where there is no terminal");
}

#[test]
#[cfg(feature = "mpfr")]
fn drifts_below_the_range_of_f64_are_shown() {
    // the modified energy at h changes by round-off only, some 1e-310 with a step of 1e-90
    let words = "drift --problem harmonic-oscillator --scheme stormer-verlet --step 1e-90 --until 5e-90 --digits 400 \
                 --order 1";
    let table = quietly(words);
    let row = table.lines().skip_while(|line| !line.contains("stormer-verlet, 1 force a step")).nth(1).unwrap();
    let cells: Vec<&str> = row.split_whitespace().collect();
    let exponent: i32 = cells[2].split_once('e').expect("a power of ten").1.parse().unwrap();
    assert!(exponent < -310, "{cells:?}");
}

#[test]
fn a_note_gives_the_end_of_an_incomplete_interval() {
    let result = shadowstep(&format!("{} --step 3/10 --json", FAST.replace("--until 2", "--until 100")));
    assert_eq!(result.err, "note: 100 is not a multiple of 3/10: the run ends at n = 333, t = 99.9\n");
    let record = &objects(&result.out)[0];
    assert_eq!((text(record, "until"), text(record, "end"), &record["steps"]), ("100", "999/10", &333.into()));
    assert_eq!(result.code, 0);
}

#[test]
#[cfg(feature = "mpfr")]
fn a_note_gives_the_digits_to_which_an_order_holds() {
    let words = "drift --problem pendulum --scheme blanes-moan-s6 --step 1/10,1/20 --until 1 --order 2";
    let result = shadowstep(&format!("{words} --digits 300"));
    assert!(result.err.starts_with("note: blanes-moan-s6 has order 4 to 25"), "{}", result.err);
    assert_eq!(result.err.lines().count(), 1, "once per scheme: {}", result.err);
    quietly(&format!("{words} --digits 200"));
}

#[test]
fn a_run_that_fails_does_not_stop_the_others() {
    let words = "drift --problem harmonic-oscillator --scheme stormer-verlet --step 10,1/10 --until 4000 --double \
                 --order 2 --json";
    let result = shadowstep(words);
    assert_eq!(result.code, 3);
    assert!(result.err.contains("error: stormer-verlet, step 10: the run stopped at n = "), "{}", result.err);
    let runs = objects(&result.out);
    assert_eq!(runs.len(), 1);
    assert_eq!(text(&runs[0], "step"), "1/10");
}

/// Orbits that escape: from 0 to 3 the states are finite, not all that the estimator needs on either side.
#[test]
fn where_only_the_estimators_states_fail_a_lower_order_is_the_hint() {
    let (before, after) = ("states before t = 0 are made", "states after the last one are made");
    for (start, order, why, here) in [
        ("--set y=1.1", "", before, "--max-order (here 200)"),
        ("--set y=1.1", "--order 150", before, "--order (here 150)"),
        ("--set y=1 --set py=1", "--order 40", after, "--order (here 40)"),
    ] {
        let words = format!(
            "drift --problem henon-heiles --scheme stormer-verlet --step 1/10 --until 3 --digits 120 --estimator central \
             {start}"
        );
        let result = shadowstep(&format!("{words} {order}"));
        assert_eq!((result.code, result.out.as_str()), (3, ""), "{start} {order}");
        let expected =
            format!("; {why} for the modified energies near it\n  hint: a lower {here} needs fewer of them; ");
        assert!(result.err.contains(&expected), "{}", result.err);
        quietly(&format!("{words} --order 8"));
    }
}

#[test]
fn an_energy_that_is_not_finite_fails_though_the_states_are_finite() {
    let words = "drift --problem harmonic-oscillator --set q=1e200 --scheme stormer-verlet --step 1/10 --until 1 \
                 --double --order 2 --json";
    let result = shadowstep(words);
    assert_eq!((result.code, result.out.as_str()), (3, ""));
    assert!(result.err.contains("the energy is inf"), "{}", result.err);
}

#[test]
fn output_goes_to_a_file_that_is_complete() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("out.json");
    let result = quietly(&format!("{FAST} --step 1/10 --json --output {}", file.display()));
    assert_eq!(result, "");
    assert_eq!(objects(&std::fs::read_to_string(&file).unwrap()).len(), 1);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "nothing else is left");
}

#[test]
fn set_takes_the_exact_values_of_expressions() {
    let words = "drift --problem henon-heiles --set px=sqrt(4)/10 --set y=x+1/8 --set x=0.5 --scheme ruth3 --step 1/10 \
                 --until 1 --double --order 2 --json";
    let parameters = &objects(&quietly(words))[0]["parameters"];
    for (name, value) in [("x", "0.5"), ("y", "0.625"), ("px", "0.2"), ("py", "0")] {
        assert_eq!(exact(text(parameters, name)).unwrap(), exact(value).unwrap(), "{name}");
    }
}

#[test]
fn a_scheme_or_step_given_twice_is_run_once() {
    let result = shadowstep(
        "drift --problem kepler --scheme ruth3,ruth3 --step 1/10,0.1,1/5 --until 1 --double --order 2 --json",
    );
    assert_eq!((result.code, objects(&result.out).len()), (0, 2));
    assert!(result.err.contains("the scheme ruth3 is given twice"), "{}", result.err);
    assert!(result.err.contains("the step 1/10 is given twice"), "{}", result.err);
}

/// The paper's drift is the error of the estimator on Kepler's problem; the permanent change is far below it.
#[test]
fn the_drift_stands_beside_the_estimators_own_and_the_permanent_change() {
    let words = "drift --problem kepler --scheme blanes-moan-srkn6b,exact-flow --step 1/20 --until 30 --digits 50 \
                 --estimator bilinear --order 12 --control --json";
    let records = objects(&quietly(words));
    let value = |text: &Value| text.as_str().unwrap().parse::<f64>().unwrap();
    let [scheme, flow] = &records[..] else { panic!("{records:?}") };
    assert_eq!(
        (text(flow, "scheme"), &flow["control"], &flow["force_evaluations"]),
        ("exact-flow", &Value::Null, &0.into())
    );
    // the estimate on the exact flow is the other run
    assert_eq!(scheme["control"]["drift"], flow["drift"]);
    assert_eq!(scheme["control"]["permanent_change"], flow["permanent_change"]);
    let (drift, own) = (value(&scheme["drift"]), value(&flow["drift"]));
    assert!((drift / own - 1.0).abs() < 0.01, "{drift:e} {own:e}");
    assert!(value(&scheme["permanent_change"]["change"]) < 1e-15);
    assert_eq!(
        (&scheme["permanent_change"]["seen"], &flow["permanent_change"]["seen"]),
        (&"resolved".into(), &"below".into())
    );
    assert_eq!(objects(&quietly(&words.replace("--control", "--no-control")))[0]["control"], Value::Null);
    let table = quietly(&words.replace(" --json", ""));
    assert!(table.contains("on exact") && table.contains("permanent"), "{table}");
}

#[test]
fn unknown_exact_flows_are_refused() {
    let refused = |words: &str| {
        let found = shadowstep(words);
        assert_eq!(found.code, 2, "{words}");
        found.err
    };
    let words = "drift --scheme exact-flow --step 1/10 --until 1 --problem";
    let other = refused(&format!("{words} henon-heiles"));
    assert!(other.contains("it is known for harmonic-oscillator, pendulum, kepler"), "{other}");
    let unbound = refused(&format!("{words} kepler --set py=5"));
    assert!(unbound.contains("bound orbits"), "{unbound}");
    // without it the scheme runs too
    let record = &objects(&quietly(
        "drift --scheme stormer-verlet --step 1/100 --until 1 --problem kepler --set py=5 --order 4 --json",
    ))[0];
    assert_eq!(record["control"], Value::Null);
}

/// Escape after one encounter, and a run that ends in the second one: states with small errors on one side only.
#[test]
fn a_change_that_nothing_bounds_is_not_seen() {
    let words = "drift --problem kepler --scheme stormer-verlet --digits 60 --no-control --estimator bilinear --order 24 \
                 --no-summary";
    for run in ["--set eccentricity=0.9 --step 1/10 --until 20", "--step 1/20 --until 7"] {
        let record = &objects(&quietly(&format!("{words} {run} --json")))[0];
        assert_eq!(record["permanent_change"]["seen"], "not seen", "{record}");
        let table = quietly(&format!("{words} {run}"));
        assert!(table.contains("\nnot seen: ") && !table.contains("< "), "{table}");
    }
    let record = &objects(&quietly(&format!("{words} --step 1/20 --until 10 --json")))[0];
    assert_eq!(
        (&record["permanent_change"]["seen"], &record["permanent_change"]["stretches"]),
        (&"resolved".into(), &2.into())
    );
    let [change, jump] = ["change", "largest_jump"]
        .map(|field| record["permanent_change"][field].as_str().unwrap().parse::<f64>().unwrap());
    // two intervals: the change is over all their states, the jump between those with the smallest errors
    assert!((change / jump - 1.0).abs() < 1e-9, "{change:e} {jump:e}");
}

/// Round-off is not a change of the scheme: in double precision, with few digits, and on the exact flow.
#[test]
fn round_off_is_not_resolved() {
    let words = "drift --problem kepler --no-control --estimator bilinear --order auto --json";
    for run in [
        "--scheme stormer-verlet,yoshida4 --step 1/40 --until 100 --double",
        "--scheme stormer-verlet,yoshida4 --step 1/100 --until 50 --double",
        "--scheme exact-flow --step 1/80 --until 20 --digits 10",
        "--scheme exact-flow --step 1/80 --until 20 --digits 16",
        "--scheme exact-flow,stormer-verlet --step 1/80 --until 20 --digits 20",
        "--scheme stormer-verlet --step 1/10 --until 50 --set eccentricity=0",
    ] {
        for record in objects(&quietly(&format!("{words} {run}"))) {
            assert_ne!(record["permanent_change"]["seen"], "resolved", "{record}");
        }
    }
}

#[test]
fn set_takes_several_values_with_commas() {
    let trace = |set: &str| {
        quietly(&format!(
            "trace --potential depth*x^2+width*x^4 {set} --q x=1 --p 0 --scheme ruth3 --step 1/10 --until 1 --double \
                --no-summary"
        ))
    };
    assert_eq!(trace("--set depth=2,width=1/2"), trace("--set depth=2 --set width=1/2"));
    assert_ne!(trace("--set depth=2,width=1/2"), trace("--set depth=2,width=1/3"));
}

/// A scene and a formula have the numbers of the shipped problem.
#[test]
fn a_scene_or_a_formula_may_be_the_problem() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("mine.toml");
    std::fs::write(
        &scene,
        "[problem]\npotential = \"-1/sqrt(x^2 + y^2)\"\ncoordinates = [\"x\", \"y\"]\n[initial]\nq = [\"2/5\", 0]\np \
            = [0, 2]\n",
    )
    .unwrap();
    let words = "--scheme yoshida4,ruth3 --step 1/20 --until 5 --digits 30 --order 4 --no-control --no-summary --json";
    let expected = objects(&quietly(&format!("drift --problem kepler {words}")));
    let formula = "--potential -a/sqrt(x^2+y^2) --set a=1 --q x=2/5,y=0 --p px=0,py=2";
    let exchanged = formula.replace("px=0,py=2", "py=2,px=0");
    for problem in [format!("--problem {}", scene.display()), formula.to_owned(), exchanged] {
        let found = objects(&quietly(&format!("drift {problem} {words}")));
        for (found, expected) in found.iter().zip(&expected) {
            assert_eq!((&found["drift"], &found["scheme"]), (&expected["drift"], &expected["scheme"]), "{problem}");
            assert_eq!(found["energy_error"], expected["energy_error"], "{problem}");
        }
    }
    for (wrong, sentence) in [
        ("--potential sqrt(1+x --q x=1 --p 0", "--potential \"sqrt(1+x\": unexpected end"),
        ("--potential x^2 --q x=1 --p 0,1", "--q has 1 value and --p has 2 values"),
        ("--potential x^2 --q 1 --p 0", "--q `1` has no name"),
        ("--potential x^2 --q x=1 --p vx=0", "--p has `vx`, which is no momentum of --q"),
        ("--potential x^2+y^2 --q x=1,y=0 --p px=0,px=1", "--p does not have each momentum once"),
        ("--problem missing.toml", "there is no file missing.toml"),
    ] {
        let result = shadowstep(&format!("drift {wrong} {words}"));
        assert_eq!((result.code, result.out.as_str()), (2, ""), "{wrong}");
        assert!(result.err.contains(sentence), "{wrong}: {}", result.err);
    }
}

/// T = √(1 + p²) needs a scheme for every T(p).
#[test]
fn a_scene_with_a_general_kinetic_energy_has_a_drift() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("mine.toml");
    let text = "[problem]\npotential = \"q^2/2\"\ncoordinates = [\"q\"]\nkinetic = \"sqrt(1 + pq^2)\"\n\
                [initial]\nq = [1]\np = [\"1/3\"]\n";
    std::fs::write(&scene, text).unwrap();
    let words = format!("drift --problem {} --step 1/20 --until 30 --digits 30 --order 8 --json", scene.display());
    let record = &objects(&quietly(&format!("{words} --scheme yoshida4")))[0];
    assert!(text_as_f64(&record["drift"]) < 1e-8 && text_as_f64(&record["energy_error"]["largest"]) > 1e-8, "{record}");
    let result = shadowstep(&format!("{words} --scheme blanes-moan-srkn11b"));
    assert_eq!(result.code, 2);
    assert!(result.err.contains("for quadratic T only"), "{}", result.err);
}

fn text_as_f64(value: &Value) -> f64 {
    value.as_str().unwrap().parse().unwrap()
}

/// The error of H ranks the schemes, where the drift of the modified energy is round-off.
#[test]
fn the_error_of_the_energy_stands_beside_the_drift() {
    let words = "drift --problem outer-solar-system --scheme stormer-verlet,blanes-moan-srkn6b --step 200 --until 200000 \
                 --double --estimator bilinear --order 8 --json";
    let records = objects(&quietly(words));
    let error = |record: &Value| text_as_f64(&record["energy_error"]["largest_relative"]);
    assert!(error(&records[0]) > 1e-3 && error(&records[1]) < 1e-6, "{records:?}");
    assert_eq!((&records[1]["forces_per_step"], &records[1]["own_force_evaluations"]), (&6.into(), &6001.into()));
    assert!(records.iter().all(|record| record["summary"]["bounded"] == true), "{records:?}");
}

#[test]
fn strict_makes_a_bad_verdict_a_negative_answer() {
    let words =
        "drift --problem harmonic-oscillator --scheme stormer-verlet --step 2.1 --until 210 --digits 30 --order 4";
    let result = shadowstep(words);
    assert_eq!(result.code, 0);
    assert!(result.out.contains("the step size is too large"), "{}", result.out);
    let note = "note: the fastest oscillation has omega = 1.0000, and h omega = 2.1000 is beyond the stability limit 2 of \
                stormer-verlet: the steps diverge\n";
    assert_eq!(result.err, note);
    let strict = shadowstep(&format!("{words} --strict"));
    assert_eq!(strict.code, 1);
    assert!(!shadowstep(&format!("{words} --no-summary")).out.contains("too large"));
    // the planets at 17/3 years: H errs by more than it is
    let planets = "drift --problem outer-solar-system --scheme kahan-li8 --step 365.25*17/3 --until 2000000 --double \
                   --estimator bilinear --order 8 --strict --json";
    let result = shadowstep(planets);
    let record = &objects(&result.out)[0];
    assert!(text_as_f64(&record["energy_error"]["largest_relative"]) > 1.0, "{record}");
    assert_eq!((result.code, &record["summary"]["bounded"]), (1, &false.into()), "{record}");
}

#[test]
fn a_file_is_replaced_only_by_force() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("mine.toml");
    let text =
        "name = \"euler\"\norder = 1\nkinetic = \"any\"\nreference = \"Euler\"\n[stages]\nkick = [1]\ndrift = [1]\n";
    std::fs::write(&table, text).unwrap();
    let path = table.display();
    let read = || std::fs::read_to_string(&table).unwrap();
    for words in [
        format!("drift --problem kepler --scheme {path} --step 1/10 --until 1 --double --order 2 --output {path}"),
        format!("trace --problem kepler --scheme {path} --step 1/10 --until 1 --double --order 2 --output {path}"),
        format!("schemes polish {path} --output {path}"),
    ] {
        let result = shadowstep(&words);
        assert_eq!(result.code, 2, "{words}: {}", result.err);
        assert!(
            result.err.contains("already exists") && result.err.contains("replace it with --force"),
            "{}",
            result.err
        );
        assert_eq!(read(), text);
    }
    let words =
        format!("drift --problem kepler --scheme {path} --step 1/10 --until 1 --double --order 2 --output {path}");
    assert_eq!(shadowstep(&format!("{words} --force")).code, 0);
    assert_ne!(read(), text);
}

/// max − min over low-error states, of all states and of the monitor's.
#[test]
fn the_permanent_change_is_the_same_in_the_record_and_in_its_summary() {
    let words = "drift --problem kepler --scheme stormer-verlet --double --until 100 --step 1/10 --json";
    let record = &objects(&quietly(words))[0];
    let number = |path: &str| record.pointer(path).unwrap().as_str().unwrap().parse::<f64>().unwrap();
    let (all, some) = (number("/permanent_change/change"), number("/summary/modified_energy/permanent_change"));
    // the estimators differ, and their errors are 1e-9 of the change; three digits are printed
    assert!(all > 7e-7 && (some - all).abs() < 1e-3 * all, "{all} {some}");
    let bound = number("/summary/modified_energy/permanent_bound");
    assert!(bound >= some, "what is measured cannot be excluded: {bound} {some}");
}

/// The first run of the README: the error of H is 7.8 % of it, which is for the user to judge.
#[test]
fn a_bounded_error_is_named_with_its_size() {
    let kepler = "drift --problem kepler --scheme stormer-verlet --double --until 100 --step";
    let out = shadowstep(&format!("{kepler} 1/10,1/20")).out.replace("\n    ", " ");
    assert!(out.contains("step 1/10: bounded: the energy error is 8.5 % of T; close encounters"), "{out}");
    assert!(out.contains("step 1/20: bounded: the energy error is 1.9 % of T; close encounters"), "{out}");
    assert!(!out.contains("fine"), "{out}");
    let alone = shadowstep(&format!("{kepler} 1/40")).out.replace("\n    ", " ");
    assert!(
        alone.contains("step 1/40: bounded: the energy error is 4.7e-3 of T; in 4000 steps a net change"),
        "{alone}"
    );
}
