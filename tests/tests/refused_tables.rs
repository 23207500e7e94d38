//! Protects the compiler's refusals of tables, each with its whole message and its places: the grammar of the text, its
//! cells, what it is composed of, and its claims. The tables are in refused_tables.md; those that are wrong in published
//! codes in errata.rs.

use std::fmt::Write as _;

use shadowstep_schemes::{Faults, Source, read, shipped};
use shadowstep_tests::pages::{assert_page, project_file, table, with_messages};
use shadowstep_tests::refusals::{assert_orders, judge};

const PAGE: &str = "tests/tests/refused_tables.md";

#[test]
fn tables_are_refused_with_their_messages() {
    let page = project_file(PAGE);
    let base = |name: &str| {
        let text = table(&page, name).map(|text| Source { path: format!("{name}.toml"), text });
        text.or_else(|| shipped(name))
    };
    let message = |text: &str, _: &str| {
        let name = text.strip_prefix("name = \"").map_or("mine", |rest| rest.split('"').next().unwrap());
        let source = Source { path: format!("{name}.toml"), text: text.to_owned() };
        read(&source, &|name, _| base(name)).map(|proved| proved.proof).expect_err(text).to_string()
    };
    assert_page(PAGE, &with_messages(&page, message));
}

/// A table with these lines below its head.
fn table_with(order: u32, lines: &str) -> String {
    format!("name = \"mine\"\norder = {order}\nkinetic = \"any\"\nreference = \"none\"\n{lines}")
}

/// What is said of kicks and drifts.
fn faults_of_stages(order: u32, kick: &str, drift: &str) -> Faults {
    judge(&table_with(order, &format!("[stages]\nkick = [{kick}]\ndrift = [{drift}]\n"))).unwrap_err()
}

/// What follows from an open bracket is not for the test to say, but the first fault is where the parser stumbled.
#[test]
fn an_open_bracket() {
    let Faults(faults) = judge(&table_with(2, "[stages]\nkick = [0.5, 0.5\ndrift = [1, 0]\n")).unwrap_err();
    assert_eq!((faults[0].line, faults[0].column), (7, 1), "{}", faults[0]);
}

/// Refused before any cell is computed, or written out, which would take gigabytes: with the limit.
#[test]
fn lists_that_are_too_long() {
    let list = |member: &str, count: usize| vec![member; count].join(", ");
    let verlet = "[stages]\nkick = [0.5, 0.5]\ndrift = [1, 0]\n";
    let roots = list("\"sqrt(2)\"", 5000);
    let constants = (0..2001).fold(String::new(), |mut all, i| {
        writeln!(all, "a{i} = \"sqrt(2)\"").unwrap();
        all
    });
    let composed = |base: &str, gamma: &str| format!("[composition]\nbase = \"{base}\"\ngamma = [{gamma}]\n");
    let ones = list("1", 2000);
    let long = Source {
        path: "long.toml".to_owned(),
        text: table_with(1, &format!("[stages]\nkick = [{ones}]\ndrift = [{ones}]\n")),
    };
    let base = |name: &str, _: &Source| if name == "long" { Some(long.clone()) } else { shipped(name) };
    for (lines, place, what, most) in [
        (composed("stormer-verlet", &list("\"1/5000\"", 5000)), "7:9", "5000 weights", 2000),
        (composed("long", &ones), "1:8", "4000000 stages", 2000),
        (format!("[stages]\nkick = [{roots}]\ndrift = [{roots}]\n"), "6:8", "5000 weights", 2000),
        (format!("near_integrable = [{}]\n{verlet}", list("2", 100_000)), "5:19", "100000 orders", 12),
        (format!("aliases = [{}]\n{verlet}", list("\"a\"", 100_000)), "5:11", "100000 names", 200),
        (format!("[constants]\n{constants}{verlet}"), "5:1", "2001 constants", 2000),
    ] {
        let source = Source { path: "mine.toml".to_owned(), text: table_with(1, &lines) };
        let faults = read(&source, &base).unwrap_err().to_string();
        assert!(faults.starts_with(&format!("mine.toml:{place}: {what} are too many\n")), "{faults}");
        assert!(faults.contains(&format!("hint: at most {most} are allowed")), "{faults}");
    }
}

/// Numbers that would take minutes to compute with.
#[test]
fn numbers_that_are_too_long() {
    let fractions: Vec<_> = (0..5).map(|i| format!("\"1/{}^490\"", 1009 + 2 * i)).collect();
    let fractions = fractions.join(", ");
    for (kick, drift, place, message) in [
        ("\"1e999999999\"", "1", "6:10", "the exponent of this number is out of range"),
        ("\"2^999999999\"", "1", "6:10", "a number is too long"),
        ("\"1/3^5000\"", "1", "6:10", "a weight has more than 1500 digits"),
        (&fractions, &fractions, "1:8", "the common denominator of the weights has more than 6000 digits"),
    ] {
        let faults = faults_of_stages(1, kick, drift).to_string();
        assert!(faults.contains(&format!("mine.toml:{place}: {message}")), "{faults}");
    }
    // exact sums of unlike denominators are long, and not needed to see that they are wrong
    let list = |start: u32| (start..start + 300).map(|n| format!("\"7/{n}\"")).collect::<Vec<_>>().join(", ");
    let faults = faults_of_stages(4, &list(1001), &list(2001));
    assert_eq!(faults.0.len(), 2, "the kicks and the drifts: {faults}");
}

#[test]
fn a_long_line_is_shown_around_the_place() {
    let weights = "\"1/2\", ".repeat(100);
    assert_eq!(
        faults_of_stages(1, &format!("{weights}\"1/0\""), &format!("{weights}1")).to_string(),
        "mine.toml:6:712: division by zero\n  6 | …, \"1/2\", \"1/2\", \"1/2\", \"1/2\", \"1/2\", \"1/0\"]\n    \
         |                                          ^"
    );
}

#[test]
fn a_library_of_base_tables_without_the_shipped_ones() {
    let composition = table_with(2, "[composition]\nbase = \"stormer-verlet\"\ngamma = [1]\n");
    let source = Source { path: "mine.toml".to_owned(), text: composition };
    let alone = read(&source, &|_, _| None).unwrap_err().to_string();
    assert!(
        alone.contains("`stormer-verlet` is a shipped table, which this library of base tables does not"),
        "{alone}"
    );
}

/// What the first claim of the page's SABA3 should have been.
#[test]
fn near_integrable_orders_that_hold() {
    let right = table(&project_file(PAGE), "saba3").expect("it is on the page");
    let right = right.replace("\"1/4\", \"1/2\", \"1/4\"", "\"5/18\", \"4/9\", \"5/18\"");
    assert_orders(&right, 2, 2);
    // with the kicks as the dominant part it is an ordinary scheme of order 2
    let dominant = judge(&right.replace("[6, 2]", "[6, 2]\ndominant = \"kick\"")).unwrap_err().to_string();
    assert!(dominant.contains("order 6 is claimed, order 2 holds for the terms of ε: "), "{dominant}");
    // a claim below the truth
    let modest = judge(&right.replace("[6, 2]", "[4, 2]")).unwrap();
    let remarks: Vec<_> = modest.notes.iter().map(ToString::to_string).collect();
    assert!(matches!(&remarks[..], [one] if one.contains("order 4 is claimed, order 6 holds for the terms of ε")));
}
