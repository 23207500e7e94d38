//! `shadowstep drift`.

use crate::program::{objects, quietly, shadowstep, text};
use serde_json::Value;
use shadowstep::exact;
use shadowstep::number::{Limbs, Real};

const FAST: &str = "drift --problem kepler --scheme stormer-verlet --double --order 4 --until 2";

/// In their order.
const FIELDS: &str = "shadowstep problem parameters scheme step until end digits estimator order max_order stop rule \
    accuracy energy_error drift minimum maximum at_minimum at_maximum first last permanent_change control \
    control_left_out order_least order_most steps forces_per_step own_force_evaluations force_evaluations seconds summary";

#[test]
fn a_record_has_its_fields_in_order() {
    let line = quietly(&format!("{FAST} --step 1/10 --json"));
    let mut rest = line.as_str();
    for field in FIELDS.split(' ') {
        rest = rest.split_once(&format!("\"{field}\":")).unwrap_or_else(|| panic!("{field}: {line}")).1;
    }
    assert_eq!(objects(&line)[0].as_object().unwrap().len(), FIELDS.split(' ').count());
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
fn there_is_a_run_per_scheme_and_step_and_one_of_those_given_twice() {
    let words = "drift --problem pendulum --scheme stormer-verlet,ruth3,ruth3 --step 1/10,1/20,0.1 --until 1 --double \
                 --order 2 --json";
    let runs = objects(&shadowstep(words).out);
    let made: Vec<_> = runs.iter().map(|run| (text(run, "scheme"), text(run, "step"))).collect();
    let expected = [("stormer-verlet", "1/10"), ("stormer-verlet", "1/20"), ("ruth3", "1/10"), ("ruth3", "1/20")];
    assert_eq!(made, expected);
}

/// That each is its rule written out is shown in `tests/tests/modified_energy.rs`. With ≤, as the paper prints it, the
/// search ends at the first ripple.
#[test]
fn stops_and_rules_are_those_of_the_flags() {
    let words = "drift --problem kepler --scheme stormer-verlet --step 1/20 --until 7 --digits 60 --estimator central \
        --max-order 60";
    let record = |flags: &str| objects(&quietly(&format!("{words} --json {flags}"))).remove(0);
    let [full, early, printed, least, robust] =
        ["", "--stop early", "--stop printed", "--rule least", "--rule robust"].map(record);
    let fixed = &objects(&quietly(&format!("{} --json", words.replace("--max-order 60", "--order 4"))))[0];
    let drift = |record: &Value| text_as_f64(&record["drift"]);
    let orders = |record: &Value| ["order_least", "order_most"].map(|field| record[field].as_u64().unwrap());
    let [least_order, most] = orders(&full);
    assert!(text(&full, "order") == "auto" && 2 <= least_order && least_order < most && most <= 60, "{full}");
    assert!(drift(&full) < drift(fixed) / 10.0, "{full} {fixed}");
    assert!(orders(&early)[0] < least_order && (0.5..2.0).contains(&(drift(&early) / drift(&full))), "{early} {full}");
    assert!(printed["stop"] == "printed" && drift(&printed) > 5.0 * drift(&early), "{printed} {early}");
    assert_eq!((text(&full, "minimum"), text(&full, "drift")), (text(&least, "minimum"), text(&least, "drift")));
    assert_ne!(text(&robust, "drift"), text(&full, "drift"));
    let readable = quietly(&format!("{words} --rule robust")).replace('\n', " ");
    assert!(readable.contains("the best m of 2–60 by the robust rule "), "{readable}");
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
    let words = "drift --problem henon-heiles --set px=sqrt(4)/10,y=x+1/8 --set x=0.5 --scheme ruth3 --step 1/10 \
                 --until 1 --double --order 2 --json";
    let parameters = &objects(&quietly(words))[0]["parameters"];
    for (name, value) in [("x", "0.5"), ("y", "0.625"), ("px", "0.2"), ("py", "0")] {
        assert_eq!(exact(text(parameters, name)).unwrap(), exact(value).unwrap(), "{name}");
    }
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

/// The planets at 17/3 years: H errs by more than it is.
#[test]
fn strict_makes_a_bad_verdict_a_negative_answer() {
    let planets = "drift --problem outer-solar-system --scheme kahan-li8 --step 365.25*17/3 --until 2000000 --double \
                   --estimator bilinear --order 8 --strict --json";
    let result = shadowstep(planets);
    let record = &objects(&result.out)[0];
    assert!(text_as_f64(&record["energy_error"]["largest_relative"]) > 1.0, "{record}");
    assert_eq!((result.code, &record["summary"]["bounded"]), (1, &false.into()), "{record}");
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

#[test]
fn one_digit_is_singular_and_names_of_problems_ignore_case() {
    let of = |words: &str| quietly(&format!("drift {words} --step 1/10 --until 2 --order 2 --no-control --no-summary"));
    let table = |words: &str| of(words).lines().take(8).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(table("Kepler --scheme Stormer-Verlet --double"), table("kepler --scheme stormer-verlet --double"));
    let one = of("kepler --scheme stormer-verlet --digits 1");
    assert!(one.contains(", 1 digit; ") && !one.contains("1 digits"), "{one}");
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
