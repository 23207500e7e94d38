//! Protects the grammar of tables: every fault of a text, of its cells and of what it is composed of, each with its
//! whole message and its place.

use shadowstep_schemes::{Faults, Proved, Source, read};
use shadowstep_tests::refusals::{assert_message, assert_refused, judge};

/// Keys, kinds and values: everything that is wrong with the text, in one go.
#[test]
fn all_faults_of_the_text_at_once() {
    assert_refused(
        r#"nam = "Mine"
order = 40
kinetic = "cubic"
symetric = true
digits = "many"
doi = "https://doi.org/10.1/2"

[constants]
1x = "1/2"
y = true

[stages]
kick = [inf, "1/2", nan]
drift = []
weights = [1]
"#,
        r#"
mine.toml:1:1: unknown key `nam`
  1 | nam = "Mine"
    | ^^^
  hint: did you mean `name`?
mine.toml:2:9: 40 is out of range
  2 | order = 40
    |         ^^
  hint: write an order from 1 to 10
mine.toml:3:11: `cubic` is not known here
  3 | kinetic = "cubic"
    |           ^^^^^^^
  hint: write "any" or "quadratic"
mine.toml:4:1: unknown key `symetric`
  4 | symetric = true
    | ^^^^^^^^
  hint: did you mean `symmetric`?
mine.toml:5:10: this value is of the wrong kind
  5 | digits = "many"
    |          ^^^^^^
  found a text, needed a whole number
mine.toml:6:7: `https://doi.org/10.1/2` is not a valid DOI
  6 | doi = "https://doi.org/10.1/2"
    |       ^^^^^^^^^^^^^^^^^^^^^^^^
  hint: a DOI looks like "10.1016/0375-9601(90)90092-3", without https://doi.org/
mine.toml:9:1: `1x` is not a valid name of a constant
  9 | 1x = "1/2"
    | ^^
  hint: the name of a constant is a letter, then letters, digits and _
mine.toml:10:5: this value is of the wrong kind
  10 | y = true
     |     ^^^^
  found a truth value, needed an exact number: 1, 0.25 or an expression in quotes, "1/(2 - 2^(1/3))"
mine.toml:13:9: inf is not a finite number
  13 | kick = [inf, "1/2", nan]
     |         ^^^
  hint: write a number: 1, 0.25 or an expression in quotes, "1/(2 - 2^(1/3))"
mine.toml:13:21: nan is not a finite number
  13 | kick = [inf, "1/2", nan]
     |                     ^^^
  hint: write a number: 1, 0.25 or an expression in quotes, "1/(2 - 2^(1/3))"
mine.toml:14:9: this list is empty
  14 | drift = []
     |         ^^
  hint: write a list of weights, such as ["1/2", "1/2"]
mine.toml:15:1: unknown key `weights`
  15 | weights = [1]
     | ^^^^^^^
  hint: the keys of [stages] are kick, gradient_kick, drift
"#,
    );
}

/// Every cell that has no value, each at its own place inside the quotes.
#[test]
fn all_faults_of_the_cells_at_once() {
    assert_refused(
        r#"name = "mine"
order = 2
kinetic = "any"
reference = "none"

[constants]
a = "1/(2 - 2)"
b = "sqrt(1 - 2)"
c = "1/2 + * 3"
gamma1 = "1/2"

[stages]
kick = ["gama1", "(-3)^(1/4)", "1 - (2", "2 3"]
drift = ["1e400000", "foo(2)", "0^0", 5000]
"#,
        r#"
mine.toml:7:8: division by zero
  7 | a = "1/(2 - 2)"
    |        ^^^^^^^
mine.toml:8:11: even root of the negative number -1: it has no real value
  8 | b = "sqrt(1 - 2)"
    |           ^^^^^
mine.toml:9:12: unexpected `*`: a number, a name or `(` should follow `+`
  9 | c = "1/2 + * 3"
    |            ^
mine.toml:13:10: unknown name `gama1`; did you mean `gamma1`? known names: a, b, c, gamma1
  13 | kick = ["gama1", "(-3)^(1/4)", "1 - (2", "2 3"]
     |          ^^^^^
mine.toml:13:19: even root of the negative number -3: it has no real value
  13 | kick = ["gama1", "(-3)^(1/4)", "1 - (2", "2 3"]
     |                   ^^^^
mine.toml:13:37: unexpected end: this `(` has no `)`
  13 | kick = ["gama1", "(-3)^(1/4)", "1 - (2", "2 3"]
     |                                     ^
mine.toml:13:43: an operator is missing between `2` and `3`
  13 | kick = ["gama1", "(-3)^(1/4)", "1 - (2", "2 3"]
     |                                           ^^^
mine.toml:14:11: the exponent of this number is out of range: -10000 to 10000 is allowed
  14 | drift = ["1e400000", "foo(2)", "0^0", 5000]
     |           ^^^^^^^^
mine.toml:14:23: unknown function `foo`; known functions: sqrt, cbrt, exp, log, sin, cos, tan, sinh, cosh, tanh, atan, asin, acos
  14 | drift = ["1e400000", "foo(2)", "0^0", 5000]
     |                       ^^^^^^
mine.toml:14:33: 0^0 is undefined
  14 | drift = ["1e400000", "foo(2)", "0^0", 5000]
     |                                 ^^^
mine.toml:14:39: a weight of 5000 is too large
  14 | drift = ["1e400000", "foo(2)", "0^0", 5000]
     |                                       ^^^^
  hint: weights are fractions of a step, at most 1000
"#,
    );
}

/// The keys that a scheme does not need.
#[test]
fn all_faults_of_names_free_parameters_and_near_integrable_orders() {
    assert_refused(
        r#"name = "mine"
aliases = ["Mine 4", "m-i-n-e", "...", "MINE4", 4]
order = 2
kinetic = "any"
near_integrable = [2, 40, "4", 3]
dominant = "kepler"
free = ["g1", "g2", "h1", "g3"]
reference = "none"

[constants]
g1 = "1/3"
g2 = "1 - 2*g1"
g3 = "sqrt(2)"

[stages]
kick = ["1/2", "1/2"]
drift = [1, 0]
"#,
        r#"
mine.toml:2:22: `m-i-n-e` is a name of this table already
  2 | aliases = ["Mine 4", "m-i-n-e", "...", "MINE4", 4]
    |                      ^^^^^^^^^
  hint: small and capital letters, hyphens, blanks and the like make no difference: leave it out
mine.toml:2:33: `...` is not a valid name
  2 | aliases = ["Mine 4", "m-i-n-e", "...", "MINE4", 4]
    |                                 ^^^^^
  hint: a name has letters or digits
mine.toml:2:40: `MINE4` is a name of this table already
  2 | aliases = ["Mine 4", "m-i-n-e", "...", "MINE4", 4]
    |                                        ^^^^^^^
  hint: small and capital letters, hyphens, blanks and the like make no difference: leave it out
mine.toml:2:49: this value is of the wrong kind
  2 | aliases = ["Mine 4", "m-i-n-e", "...", "MINE4", 4]
    |                                                 ^
  found a whole number, needed a text in quotes
mine.toml:5:23: 40 is out of range
  5 | near_integrable = [2, 40, "4", 3]
    |                       ^^
  hint: write an order from 1 to 12
mine.toml:5:27: this value is of the wrong kind
  5 | near_integrable = [2, 40, "4", 3]
    |                           ^^^
  found a text, needed a whole number
mine.toml:5:32: order 3 is claimed for a higher power of ε than order 2
  5 | near_integrable = [2, 40, "4", 3]
    |                                ^
  hint: the orders for ε, ε², … do not increase
mine.toml:6:12: `kepler` is not known here
  6 | dominant = "kepler"
    |            ^^^^^^^^
  hint: write "drift" or "kick"
mine.toml:7:15: `g2` is not a free parameter: its value is `1 - 2*g1`
  7 | free = ["g1", "g2", "h1", "g3"]
    |               ^^^^
  hint: a free parameter is a plain number, exactly as published
mine.toml:7:21: there is no constant `h1`
  7 | free = ["g1", "g2", "h1", "g3"]
    |                     ^^^^
  hint: did you mean `g1`?
mine.toml:7:27: `g3` is not a free parameter: its value is `sqrt(2)`
  7 | free = ["g1", "g2", "h1", "g3"]
    |                           ^^^^
  hint: a free parameter is a plain number, exactly as published
"#,
    );
    let alone = "name = \"mine\"\naliases = []\norder = 2\nkinetic = \"any\"\ndominant = \"drift\"\nfree = \"g1\"\n\
                 reference = \"none\"\n\n[stages]\nkick = [\"1/2\", \"1/2\"]\ndrift = [1, 0]\n";
    assert_refused(
        alone,
        r#"
mine.toml:2:11: this list is empty
  2 | aliases = []
    |           ^^
  hint: write a list of names, such as ["PEFRL"]
mine.toml:5:12: `dominant` needs near-integrable orders
  5 | dominant = "drift"
    |            ^^^^^^^
  hint: add `near_integrable = [8, 2]`, the orders claimed, or leave it out
mine.toml:6:8: this value is of the wrong kind
  6 | free = "g1"
    |        ^^^^
  found a text, needed a list of constants, such as ["g1"]
"#,
    );
}

#[test]
fn a_name_that_is_there_twice() {
    assert_refused(
        r#"name = "mine"
order = 2
kinetic = "any"
reference = "none"

[constants]
a = "1/2"
a = "1/3"

[stages]
kick = ["a", "a"]
drift = [1, 0]
"#,
        r#"
mine.toml:8:1: duplicate key
  8 | a = "1/3"
    | ^
  hint: keep one of the two
"#,
    );
}

#[test]
fn a_text_that_is_no_toml() {
    assert_refused(
        r#"name = "mine"
order = 2
kinetic = any
reference = "none"

[stages]
kick = ["1/2", "1/2"]
drift = [1, 0]
"#,
        r#"
mine.toml:3:11: string values must be quoted, expected literal string
  3 | kinetic = any
    |           ^^^
"#,
    );

    // what follows from an open bracket is not for the test to say, but the first fault is where the parser stumbled
    let open = "name = \"mine\"\norder = 2\nkinetic = \"any\"\nreference = \"none\"\n\n\
                [stages]\nkick = [\"1/2\", \"1/2\"\ndrift = [1, 0]\n";
    let Faults(faults) = judge(open).unwrap_err();
    assert_eq!((faults[0].line, faults[0].column), (8, 1), "{}", faults[0]);
}

#[test]
fn an_empty_text() {
    assert_refused(
        "",
        r#"
mine.toml:1:1: the key `name` is missing
  1 | 
    | ^
  hint: add `name = "my-scheme"`
mine.toml:1:1: the key `order` is missing
  1 | 
    | ^
  hint: add `order = 4`
mine.toml:1:1: the key `kinetic` is missing
  1 | 
    | ^
  hint: add `kinetic = "any"`
mine.toml:1:1: the weights are missing
  1 | 
    | ^
  hint: add [stages] with kick and drift, or [composition] with base and gamma
"#,
    );
}

#[test]
fn kicks_and_drifts_of_different_lengths() {
    assert_refused(
        r#"name = "mine"
order = 2
kinetic = "any"
reference = "none"

[stages]
kick = ["1/2", "1/2"]
drift = [1]
"#,
        r#"
mine.toml:8:9: kick and drift must have as many weights as there are stages
  8 | drift = [1]
    |         ^^^
  found 2 for the kicks, 1 for the drifts, needed the same number of both
  hint: each stage is a kick and then a drift; write 0 where there is none
"#,
    );
}

#[test]
fn both_kinds_of_weights() {
    assert_refused(
        r#"name = "mine"
order = 2
kinetic = "any"
reference = "none"

[stages]
kick = ["1/2", "1/2"]
drift = [1, 0]

[composition]
base = "stormer-verlet"
gamma = [1]
"#,
        r#"
mine.toml:10:1: stages and a composition are both given
  10 | [composition]
     | ^^^^^^^^^^^^^
  hint: keep one of the two
"#,
    );
}

/// Refused before any cell is computed, with the limit.
#[test]
fn lists_that_are_too_long() {
    let head = "name = \"mine\"\norder = 2\nkinetic = \"any\"\nreference = \"none\"\n";
    let list = |member: &str, count: usize| vec![member; count].join(", ");
    let verlet = "[stages]\nkick = [0.5, 0.5]\ndrift = [1, 0]\n";
    let roots = list("\"sqrt(2)\"", 5000);
    let constants: String = (0..2001).map(|i| format!("a{i} = \"sqrt(2)\"\n")).collect();
    for (lines, place, what, most) in [
        (
            format!("[composition]\nbase = \"stormer-verlet\"\ngamma = [{}]\n", list("\"1/5000\"", 5000)),
            "7:9",
            "5000 weights",
            2000,
        ),
        (format!("[stages]\nkick = [{roots}]\ndrift = [{roots}]\n"), "6:8", "5000 weights", 2000),
        (format!("near_integrable = [{}]\n{verlet}", list("2", 100_000)), "5:19", "100000 orders", 12),
        (format!("aliases = [{}]\n{verlet}", list("\"a\"", 100_000)), "5:11", "100000 names", 200),
        (format!("[constants]\n{constants}{verlet}"), "5:1", "2001 constants", 2000),
    ] {
        let faults = judge(&format!("{head}{lines}")).unwrap_err().to_string();
        assert!(faults.starts_with(&format!("mine.toml:{place}: {what} are too many\n")), "{faults}");
        assert!(faults.contains(&format!("hint: at most {most} are allowed")), "{faults}");
    }
}

/// Numbers that would take minutes to compute with.
#[test]
fn numbers_that_are_too_long() {
    let head = "name = \"mine\"\norder = 1\nkinetic = \"any\"\n\n[stages]\n";
    let fractions =
        |count: usize| (0..count).map(|i| format!("\"1/{}^490\"", 1009 + 2 * i)).collect::<Vec<_>>().join(", ");
    for (kick, drift, place, message) in [
        ("\"1e999999999\"".to_owned(), "1".to_owned(), "6:10", "the exponent of this number is out of range"),
        ("\"2^999999999\"".to_owned(), "1".to_owned(), "6:10", "a number is too long"),
        ("\"1/3^5000\"".to_owned(), "1".to_owned(), "6:10", "a weight has more than 1500 digits"),
        (fractions(5), fractions(5), "1:8", "the common denominator of the weights has more than 6000 digits"),
    ] {
        let faults = judge(&format!("{head}kick = [{kick}]\ndrift = [{drift}]\n")).unwrap_err().to_string();
        assert!(faults.contains(&format!("mine.toml:{place}: {message}")), "{faults}");
    }
}

/// Places are counted in characters, not bytes: the letters before the fault are two bytes each.
#[test]
fn places_count_characters() {
    let text = "name = \"mine\"\norder = 1\nkinetic = \"any\"\nreference = \"none\"\n\n\
                [stages]\nkick = [\"éß\", \"1/0\"] # ä\ndrift = [1, 1]\n";
    assert_refused(
        text,
        r#"
mine.toml:7:10: unknown character `é`
  7 | kick = ["éß", "1/0"] # ä
    |          ^
mine.toml:7:18: division by zero
  7 | kick = ["éß", "1/0"] # ä
    |                  ^
"#,
    );
}

/// In one and in three quotes, plain and literal, the caret stands under the culprit.
#[test]
fn places_in_all_kinds_of_quotes() {
    assert_refused(
        r#"name = "mine"
order = 1
kinetic = "any"
reference = "none"

[stages]
kick = ['1/0', """1/0""", '''1/0''', "1/0"]
drift = [1, 1, 1, 1]
"#,
        r#"
mine.toml:7:12: division by zero
  7 | kick = ['1/0', """1/0""", '''1/0''', "1/0"]
    |            ^
mine.toml:7:21: division by zero
  7 | kick = ['1/0', """1/0""", '''1/0''', "1/0"]
    |                     ^
mine.toml:7:32: division by zero
  7 | kick = ['1/0', """1/0""", '''1/0''', "1/0"]
    |                                ^
mine.toml:7:41: division by zero
  7 | kick = ['1/0', """1/0""", '''1/0''', "1/0"]
    |                                         ^
"#,
    );
}

// ---------------------------------------------------------------------------------------------------------------
// Compositions

/// Finds the tables of a small library by name.
fn read_from(library: &[(&str, &str)], name: &str) -> Result<Proved, Faults> {
    let find = |name: &str, _: &Source| {
        let found = library.iter().find(|(known, _)| *known == name)?;
        Some(Source { path: format!("{name}.toml"), text: found.1.to_owned() })
    };
    let source = find(name, &Source { path: String::new(), text: String::new() }).expect("it is there");
    read(&source, &find)
}

fn composition_of(base: &str) -> String {
    format!(
        "name = \"mine\"\norder = 2\nkinetic = \"any\"\nreference = \"none\"\n\n\
         [composition]\nbase = \"{base}\"\ngamma = [\"1/2\", \"1/2\"]\n"
    )
}

#[test]
fn compositions_that_go_round() {
    let (one, two) = (composition_of("two"), composition_of("one"));
    let faults = read_from(&[("one", &one), ("two", &two)], "one").unwrap_err().to_string();
    assert_message(
        &faults,
        r#"
two.toml:7:8: this composition is cyclic: one.toml → two.toml → one.toml
  7 | base = "one"
    |        ^^^^^
  hint: a composition must end at a table with [stages]
"#,
    );

    let own = composition_of("own");
    let faults = read_from(&[("own", &own)], "own").unwrap_err().to_string();
    assert_message(
        &faults,
        r#"
own.toml:7:8: this composition is cyclic: own.toml → own.toml
  7 | base = "own"
    |        ^^^^^
  hint: a composition must end at a table with [stages]
"#,
    );
}

#[test]
fn a_base_that_is_not_there() {
    assert_refused(
        &composition_of("stormer-verle"),
        r#"
mine.toml:7:8: there is no table `stormer-verle`
  7 | base = "stormer-verle"
    |        ^^^^^^^^^^^^^^^
  hint: did you mean `stormer-verlet`?
"#,
    );
    let far = judge(&composition_of("rk4")).unwrap_err().to_string();
    assert!(far.starts_with("mine.toml:7:8: there is no table `rk4`\n"), "{far}");
    assert!(far.contains("no shipped table has a name like that"), "{far}");
    // a library of base tables without the shipped ones
    let source = Source { path: "mine.toml".to_owned(), text: composition_of("stormer-verlet") };
    let alone = read(&source, &|_, _| None).unwrap_err().to_string();
    assert!(
        alone.contains("`stormer-verlet` is a shipped table, which this library of base tables does not"),
        "{alone}"
    );
}

/// The faults of a base are reported with the path of the base.
#[test]
fn a_base_with_faults() {
    let base = "name = \"base\"\norder = 1\nkinetic = \"any\"\nreference = \"none\"\n\n\
                [stages]\nkick = [\"1/0\"]\ndrift = [1]\n";
    let faults = read_from(&[("top", &composition_of("base")), ("base", base)], "top").unwrap_err().to_string();
    assert_message(
        &faults,
        r#"
base.toml:7:12: division by zero
  7 | kick = ["1/0"]
    |            ^
"#,
    );
}

#[test]
fn digits_that_are_too_few_to_tell_one_order_from_the_next() {
    // a palindrome has no order 3, but to two digits 1/8 may be 1/6
    for digits in 1..=4 {
        let table = format!(
            "name = \"mine\"\norder = 3\nkinetic = \"any\"\nreference = \"none\"\ndigits = {digits}\n\n\
             [stages]\nkick = [\"1/2\", \"1/2\"]\ndrift = [1, 0]\n"
        );
        let faults = judge(&table).unwrap_err().to_string();
        let expected =
            format!("mine.toml:5:10: {digits} digits are too few to decide whether order 1 holds for every T(p)");
        assert!(faults.starts_with(&expected), "{faults}");
    }
}

#[test]
fn a_long_line_is_shown_around_the_place() {
    let weights = "\"1/2\", ".repeat(100);
    let table = format!(
        "name = \"mine\"\norder = 1\nkinetic = \"any\"\nreference = \"none\"\n\n\
         [stages]\nkick = [{weights}\"1/0\"]\ndrift = [{weights}1]\n"
    );
    let faults = judge(&table).unwrap_err().to_string();
    assert_eq!(
        faults,
        r#"mine.toml:7:712: division by zero
  7 | …, "1/2", "1/2", "1/2", "1/2", "1/2", "1/0"]
    |                                          ^"#
    );
}

/// A hundred weights of unlike denominators: exact sums of them are long, and not needed to see that they are wrong.
#[test]
fn many_unlike_fractions_are_refused_quickly() {
    let list = |start: u32| (start..start + 300).map(|n| format!("\"7/{n}\"")).collect::<Vec<_>>().join(", ");
    let table = format!(
        "name = \"mine\"\norder = 4\nkinetic = \"any\"\nreference = \"none\"\n\n\
         [stages]\nkick = [{}]\ndrift = [{}]\n",
        list(1001),
        list(2001)
    );
    let faults = judge(&table).unwrap_err();
    assert_eq!(faults.0.len(), 2, "the kicks and the drifts: {faults}");
}

/// Refused before it is written out, which would take gigabytes.
#[test]
fn a_composition_of_absurd_size() {
    let ones = |count: usize| vec!["1"; count].join(", ");
    let base = format!(
        "name = \"base\"\norder = 1\nkinetic = \"any\"\nreference = \"none\"\n\n[stages]\nkick = [{0}]\ndrift = [{0}]\n",
        ones(2000)
    );
    let table = format!(
        "name = \"mine\"\norder = 1\nkinetic = \"any\"\nreference = \"none\"\n\n\
         [composition]\nbase = \"base\"\ngamma = [{}]\n",
        ones(2000)
    );
    let source = |path: &str, text: &str| Source { path: path.to_owned(), text: text.to_owned() };
    let faults = read(&source("mine.toml", &table), &|_, _| Some(source("base.toml", &base))).unwrap_err().to_string();
    assert!(faults.starts_with("mine.toml:1:8: 4000000 stages are too many"), "{faults}");
    assert!(faults.ends_with("hint: at most 2000 are allowed"), "{faults}");
}

/// A constant that stands below, or is the one being defined, is not reported as an unknown name.
#[test]
fn constants_from_below() {
    let table = |x: &str, y: &str| {
        format!(
            "name = \"mine\"\norder = 2\nkinetic = \"any\"\nreference = \"none\"\n\n[constants]\nx = \"{x}\"\ny \
                = \"{y}\"\n\n\
             [stages]\nkick = [\"y\", \"y\"]\ndrift = [1, 0]\n"
        )
    };
    assert_eq!(
        judge(&table("y + 1", "1/2")).unwrap_err().to_string(),
        "mine.toml:7:6: `y` is not known yet\n  7 | x = \"y + 1\"\n    |      ^\n  hint: a constant may use those \
            above it only"
    );
    assert!(judge(&table("0", "1 - y")).unwrap_err().to_string().contains("`y` is not known yet"));
}

/// What is needed, where the digits shown would not tell the value found from it.
#[test]
fn sums_off_by_less_than_the_digits_shown() {
    let table = "name = \"mine\"\norder = 2\nkinetic = \"any\"\nreference = \"none\"\n\n\
                 [stages]\nkick = [\"1/2\", \"0.5000000000000000000000000003\"]\ndrift = [1, 0]\n";
    let said = judge(table).unwrap_err().to_string();
    assert!(said.contains("found 1 + 3e-28, needed 1"), "{said}");
}

/// Fractions and formulas are texts: without quotes the parser stops within them.
#[test]
fn a_fraction_without_quotes() {
    let head = "name = \"mine\"\norder = 1\nkinetic = \"any\"\n\n[stages]\n";
    for (cells, formula) in
        [("kick = [1/2, 0.5]", "1/2"), ("kick = [0.5, 2^(1/3)]", "2^(1/3)"), ("kick = 1/20", "1/20")]
    {
        let faults = judge(&format!("{head}{cells}\ndrift = [1, 0]\n")).unwrap_err().to_string();
        assert!(faults.contains(&format!("hint: write fractions and formulas in quotes: \"{formula}\"")), "{faults}");
    }
}
