//! `shadowstep trace`.

use crate::program::{objects, quietly, shadowstep, text};

const RUN: &str = "trace --problem kepler --scheme stormer-verlet --step 1/32 --until 1/2 --digits 30 --estimator \
    central --order 5 --no-summary";

#[test]
fn there_is_a_line_per_state() {
    let lines = objects(&quietly(RUN));
    assert_eq!(lines.len(), 16 + 1);
    for (n, line) in lines.iter().enumerate() {
        assert_eq!(line["n"], n);
        assert_eq!(text(line, "t").parse::<f64>().unwrap(), n as f64 / 32.0);
        assert_eq!(line["order"], 5);
    }
    // H at the start; the modified energy changes less than the energy
    assert_eq!(text(&lines[0], "energy"), "-0.5");
    let spread = |field| {
        let values: Vec<f64> = lines.iter().map(|line| text(line, field).parse().unwrap()).collect();
        values.iter().copied().fold(f64::MIN, f64::max) - values.iter().copied().fold(f64::MAX, f64::min)
    };
    assert!(spread("modified_energy") < spread("energy") / 100.0);
}

#[test]
fn the_extremes_are_those_of_drift() {
    let values: Vec<String> =
        objects(&quietly(RUN)).iter().map(|line| text(line, "modified_energy").to_owned()).collect();
    let record = &objects(&quietly(&format!("{} --json", RUN.replace("trace", "drift"))))[0];
    assert_eq!(values[record["at_minimum"].as_u64().unwrap() as usize], text(record, "minimum"));
    assert_eq!(values[record["at_maximum"].as_u64().unwrap() as usize], text(record, "maximum"));
    assert_eq!((&*values[0], &*values[16]), (text(record, "first"), text(record, "last")));
}

#[test]
fn states_are_written_on_request() {
    let lines = objects(&quietly(&format!("{RUN} --states")));
    assert_eq!(lines[0]["q"], serde_json::json!(["0.4", "0.0"]));
    assert_eq!(lines[0]["p"], serde_json::json!(["0.0", "2.0"]));
    assert_ne!(lines[1]["q"], lines[0]["q"]);
    assert!(objects(&quietly(RUN))[0].get("q").is_none());
}

#[test]
fn csv_has_a_header_and_the_same_numbers() {
    let csv = quietly(&format!("{RUN} --csv --states"));
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("n,t,energy,modified_energy,estimate,order,x,y,px,py"));
    for (row, line) in lines.zip(objects(&quietly(&format!("{RUN} --states")))) {
        let state = [&line["q"], &line["p"]].map(|v| v.as_array().unwrap().clone()).concat();
        let numbers = ["n", "t", "energy", "modified_energy", "estimate", "order"].map(|field| line[field].clone());
        let expected: Vec<String> =
            numbers.into_iter().chain(state).map(|value| value.to_string().replace('"', "")).collect();
        assert_eq!(row, expected.join(","));
    }
    assert_eq!(csv.lines().count(), 1 + 17);
    let short = quietly(&format!("{RUN} --csv"));
    assert_eq!(short.lines().next(), Some("n,t,energy,modified_energy,estimate,order"));
}

#[test]
fn rows_of_several_runs_have_their_names() {
    let words = "trace --problem kepler --until 1 --double --order 4 --no-summary";
    let several = objects(&quietly(&format!("{words} --step 1/10,1/20 --scheme ruth3,yoshida4")));
    assert_eq!(several.len(), 2 * (11 + 21));
    let one = objects(&quietly(&format!("{words} --step 1/20 --scheme yoshida4")));
    let named = several.iter().filter(|row| (text(row, "scheme"), text(row, "step")) == ("yoshida4", "1/20"));
    let mut named: Vec<_> = named.cloned().collect();
    named.iter_mut().for_each(|row| row.as_object_mut().unwrap().retain(|key, _| key != "scheme" && key != "step"));
    assert_eq!(named, one);
    let csv = quietly(&format!("{words} --step 1/10 --scheme ruth3,yoshida4 --csv"));
    assert!(csv.starts_with("scheme,step,n,t,energy,") && csv.contains("\nyoshida4,1/10,0,0.0,-0.5,"), "{csv}");
}

#[test]
fn a_reader_may_stop_reading() {
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_shadowstep"))
        .args("trace --problem kepler --scheme ruth3 --step 1/1000 --until 100 --double --order 2".split(' '))
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), &b""[..]));
}

/// An even k has its values at the states, an odd one between them.
#[test]
fn the_bilinear_estimator_belongs_to_the_middle_of_its_states() {
    let run = |k: &str| RUN.replace("--estimator central --order 5", &format!("--order {k}"));
    let [even, odd] = ["8", "7"].map(|k| objects(&quietly(&run(k))));
    assert_eq!((even.len(), odd.len()), (17, 16));
    let times = |lines: &[serde_json::Value]| -> Vec<f64> {
        lines.iter().map(|line| text(line, "t").parse::<f64>().unwrap() * 32.0).collect()
    };
    assert_eq!(times(&even)[..3], [0.0, 1.0, 2.0]);
    assert_eq!(times(&odd)[..3], [0.5, 1.5, 2.5]);
    assert!(even[0]["energy"].is_string() && odd[0]["energy"].is_null());
    let value = |line: &serde_json::Value| text(line, "modified_energy").parse::<f64>().unwrap();
    assert!((value(&even[3]) - value(&odd[3])).abs() < 1e-9, "one modified energy, two orders");
}

#[test]
fn drift_names_its_estimator() {
    let run = RUN.replace("trace", "drift").replace("--estimator central --order 5", "--order 8");
    let record = &objects(&quietly(&format!("{run} --json")))[0];
    assert_eq!((text(record, "estimator"), &record["order"]), ("bilinear", &8.into()));
    assert!(quietly(&run).replace('\n', " ").contains("modified energy by products of 9 states, k = 8"));
    let run = run.replace("--order 8", "--max-order 16 --accuracy 1e-9");
    let record = &objects(&quietly(&format!("{run} --json")))[0];
    assert_eq!((text(record, "estimator"), text(record, "order")), ("bilinear", "auto"));
    let readable = quietly(&run).replace('\n', " ");
    assert!(readable.contains("by products of states, the best k of 2–16 for an accuracy of 1e-9"), "{readable}");
}

#[test]
fn without_a_reliable_estimate_the_estimate_is_empty() {
    for estimator in ["central", "bilinear"] {
        let other = format!("--estimator {estimator} --order 1");
        let result = shadowstep(&RUN.replace("--estimator central --order 5", &other));
        assert_eq!(result.code, 0);
        assert!(result.err.starts_with("note: no error estimate at --order 1"), "{}", result.err);
        assert!(objects(&result.out).iter().all(|line| line["estimate"].is_null() && line["order"] == 1));
    }
}

/// Double-doubles have the numbers of 50 digits to about 30; compensated sums have less round-off than plain ones.
#[test]
fn numbers_of_more_than_a_double_are_number_types() {
    const RUN: &str = "kepler --scheme yoshida4 --step 1/20 --until 10 --estimator central --order 5 --no-summary";
    let last = |flags: &str| objects(&quietly(&format!("trace {RUN} --states {flags}"))).pop().unwrap();
    let x = |flags: &str| shadowstep::exact(last(flags)["q"][0].to_string().trim_matches('"')).unwrap();
    let exact = x("--digits 50");
    let [double_double, compensated, plain] = ["--double-double", "--compensated", "--double"].map(|flags| {
        let error = <f64 as shadowstep::Number>::from_rational(&(x(flags) - &exact), &());
        error.abs()
    });
    assert!(0.0 < double_double && double_double < 1e-28, "{double_double:e}");
    assert!(0.0 < compensated && compensated < 0.5 * plain && plain < 1e-12, "{compensated:e} {plain:e}");
    for digits in ["double-double", "compensated"] {
        let record = objects(&quietly(&format!("drift {RUN} --no-control --json --{digits}"))).remove(0);
        assert_eq!(record["digits"], digits);
    }
}

#[test]
fn a_file_whose_name_ends_in_csv_is_csv() {
    let folder = tempfile::TempDir::new().unwrap();
    assert_eq!(quietly(RUN), quietly(&format!("{RUN} --json")));
    for (name, option, begins) in [
        ("run.csv", "", "n,t,"),
        ("run.csv", "--json", "{\"n\":0"),
        ("run.jsonl", "", "{\"n\":0"),
        ("run", "--csv", "n,t,"),
    ] {
        let file = folder.path().join(name);
        quietly(&format!("{RUN} {option} --force --output {}", file.display()));
        let written = std::fs::read_to_string(file).unwrap();
        assert!(written.starts_with(begins), "{name} {option}: {}", &written[..40]);
    }
}
