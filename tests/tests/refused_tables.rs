//! Protects the compiler's refusals: tables with the mistakes that are found in published codes, and every fault of the
//! grammar, each with its whole message, its place, the value found and the value needed.

use shadowstep_schemes::{Faults, Proved, Source, read, shipped};

fn judge(text: &str) -> Result<Proved, Faults> {
    let source = Source { path: "mine.toml".to_owned(), text: text.to_owned() };
    read(&source, &|base, _| shipped(base))
}

/// The whole message, as a user sees it.
#[track_caller]
fn assert_refused(text: &str, message: &str) {
    let faults = judge(text).map(|proved| proved.proof).expect_err("this table must be refused");
    assert_message(&faults.to_string(), message);
}

#[track_caller]
fn assert_message(found: &str, expected: &str) {
    assert_eq!(found, expected.trim_matches('\n'), "\n{found}\n");
}

/// The proved orders for every T(p) and for quadratic T.
#[track_caller]
fn assert_orders(text: &str, general: u32, quadratic: u32) {
    let proved = judge(text).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!((proved.proof.general.order, proved.proof.quadratic.order), (general, quadratic));
}

// ---------------------------------------------------------------------------------------------------------------
// Mistakes of published codes

/// McLachlan's SB3A numbers in five stages, with one drift too few for them: order 1 where 4 is claimed.
#[test]
fn one_drift_too_few() {
    let table = r#"
name = "mcate42"
order = 4
kinetic = "any"
digits = 20
reference = "R. I. McLachlan, SIAM J. Sci. Comput. 16 (1995) 151, SB3A, as found in a library"

[constants]
a1 = "-3/73"
a2 = "17/59"
b1 = "0.40518861839525227722"
b2 = "-0.28714404081652408900"

[stages]
kick = ["a1", "a2", "1 - 2*(a1 + a2)", "a2", "a1"]
drift = ["b1", "b2", "1 - 2*(b1 + b2)", "b2", "b1"]
"#;
    assert_refused(
        table,
        r#"
mine.toml:3:9: order 4 is claimed, order 1 holds for every T(p): the condition of the word KD fails
  3 | order = 4
    |         ^
  found 0.5938511087408138…, needed 1/2
"#,
    );

    // with all six drifts, and a drift first, the same numbers have the order that was published
    let right = table.replace(
        "kick = [\"a1\", \"a2\", \"1 - 2*(a1 + a2)\", \"a2\", \"a1\"]\n\
         drift = [\"b1\", \"b2\", \"1 - 2*(b1 + b2)\", \"b2\", \"b1\"]",
        "kick = [0, \"a1\", \"a2\", \"1 - 2*(a1 + a2)\", \"a2\", \"a1\"]\n\
         drift = [\"b1\", \"b2\", \"1/2 - (b1 + b2)\", \"1/2 - (b1 + b2)\", \"b2\", \"b1\"]",
    );
    assert_orders(&right, 4, 4);
}

/// McLachlan's fourth-order composition of a first-order step and its adjoint, c_i h and d_i h with d the reverse of c.
fn composed_with_adjoint(kick: &str, drift: &str) -> String {
    format!(
        r#"
name = "mclachlan4"
order = 4
kinetic = "any"
symmetric = true
reference = "R. I. McLachlan, SIAM J. Sci. Comput. 16 (1995) 151"

[constants]
c1 = "(146 + 5*sqrt(19))/540"
c2 = "(-2 + 10*sqrt(19))/135"
c3 = "1/5"
c4 = "(-23 - 20*sqrt(19))/270"
c5 = "1/2 - (c1 + c2 + c3 + c4)"

[stages]
kick = [{kick}]
drift = [{drift}]
"#
    )
}

/// Step and adjoint composed in the wrong order: order 2.
#[test]
fn maps_composed_in_the_wrong_order() {
    let right = composed_with_adjoint(
        r#""c5", "c1 + c4", "c2 + c3", "c3 + c2", "c4 + c1", "c5""#,
        r#""c5 + c1", "c4 + c2", "c3 + c3", "c2 + c4", "c1 + c5", 0"#,
    );
    assert_orders(&right, 4, 4);
    let wrong = composed_with_adjoint(
        r#""c1", "c5 + c2", "c4 + c3", "c3 + c4", "c2 + c5", "c1""#,
        r#""c1 + c5", "c2 + c4", "c3 + c3", "c4 + c2", "c5 + c1", 0"#,
    );
    assert_refused(
        &wrong,
        r#"
mine.toml:3:9: order 4 is claimed, order 2 holds for every T(p): the condition of the word KKD fails
  3 | order = 4
    |         ^
  found 0.135…, needed 1/6
"#,
    );
}

/// The sign of 1/3 − z = −0.0215… lost.
#[test]
fn a_lost_sign() {
    let table = r#"
name = "sb3a4"
order = 4
kinetic = "any"
reference = "R. I. McLachlan, SIAM J. Sci. Comput. 16 (1995) 151"

[constants]
z = "sqrt(7/8)/3"

[stages]
kick = [0, 1, "-1/2", "-1/2", 1]
drift = ["1/2 - z", "1/3 - z", "2/3", "1/3 - z", "1/2 - z"]
"#;
    assert_refused(
        table,
        r#"
mine.toml:12:9: the drifts do not sum to 1, so not even order 1 holds
  12 | drift = ["1/2 - z", "1/3 - z", "2/3", "1/3 - z", "1/2 - z"]
     |         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  found 1.086114204408686…, needed 1
"#,
    );
    assert_orders(&table.replace("1/3 - z", "z - 1/3"), 4, 4);
}

/// 2^(−1/3) = 0.79… where 2^(1/3) is meant.
#[test]
fn wrong_sign_of_an_exponent() {
    let yoshida = r#"
name = "thermostat"
order = 4
kinetic = "any"
reference = "as found in molecular dynamics codes"

[constants]
w1 = "1/(2 - 2^(-1/3))"

[composition]
base = "stormer-verlet"
gamma = ["w1", "1 - 2*w1", "w1"]
"#;
    assert_refused(
        yoshida,
        r#"
mine.toml:3:9: order 4 is claimed, order 2 holds for every T(p): the condition of the word KKD fails
  3 | order = 4
    |         ^
  found 0.131061370551692…, needed 1/6
"#,
    );
    assert_orders(&yoshida.replace("2^(-1/3)", "2^(1/3)"), 4, 4);

    // the same as decimals, and Suzuki's five-fold one, where the honest claim is 2
    let decimals =
        yoshida.replace("1/(2 - 2^(-1/3))", "0.828981543588751").replace("order = 4", "order = 4\ndigits = 15");
    assert!(judge(&decimals).unwrap_err().to_string().contains("order 4 is claimed, order 2 holds"));
    let suzuki = yoshida
        .replace("1/(2 - 2^(-1/3))", "1/(4 - 4^(-1/3))")
        .replace(r#"["w1", "1 - 2*w1", "w1"]"#, r#"["w1", "w1", "1 - 4*w1", "w1", "w1"]"#);
    assert!(judge(&suzuki).unwrap_err().to_string().contains("order 4 is claimed, order 2 holds"));
    assert_orders(&suzuki.replace("order = 4", "order = 2"), 2, 2);
    assert_orders(&suzuki.replace("4^(-1/3)", "4^(1/3)"), 4, 4);
}

/// Fourteen digits taken for exact numbers: the sums are off by 6e-14.
#[test]
fn fourteen_digits_taken_for_exact() {
    let table = r#"
name = "yoshida6"
order = 6
kinetic = "any"
symmetric = true
reference = "H. Yoshida, Phys. Lett. A 150 (1990) 262, solution A"

[constants]
a1 = "0.78451361047756"
a2 = "0.23557321335936"
a3 = "-1.1776799841789"
a4 = "1.3151863206839"

[composition]
base = "stormer-verlet"
gamma = ["a1", "a2", "a3", "a4", "a3", "a2", "a1"]
"#;
    assert_refused(
        table,
        r#"
mine.toml:16:9: the kicks do not sum to 1, so not even order 1 holds
  16 | gamma = ["a1", "a2", "a3", "a4", "a3", "a2", "a1"]
     |         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  found 0.99999999999994, needed 1
  help: the condition is off by 6e-14: if the weights are rounded, say so with `digits = …`
mine.toml:16:9: the drifts do not sum to 1, so not even order 1 holds
  16 | gamma = ["a1", "a2", "a3", "a4", "a3", "a2", "a1"]
     |         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  found 0.99999999999994, needed 1
  help: the condition is off by 6e-14: if the weights are rounded, say so with `digits = …`
"#,
    );

    let honest = table.replace("order = 6", "order = 6\ndigits = 14");
    assert_orders(&honest, 6, 6);
    let digits = judge(&honest).unwrap().proof.general.digits.unwrap();
    assert!((13..=14).contains(&digits), "{digits}");
    // more digits than there are
    let boast = judge(&table.replace("order = 6", "order = 6\ndigits = 20")).unwrap_err().to_string();
    assert!(boast.contains("more than 20 digits of the weights can account for"), "{boast}");
}

/// Order 4 for quadratic T, 3 for others.
#[test]
fn order_4_for_quadratic_kinetic_energy_only() {
    let table = r#"
name = "mcate4"
order = 4
kinetic = "any"
digits = 17
reference = "R. I. McLachlan, P. Atela, Nonlinearity 5 (1992) 541"

[stages]
kick = ["0.13449619927743109", "-0.22481980307942081", "0.75632000051566829", "0.33400360328632143"]
drift = ["0.51535283743112294", "-0.085782019412973646", "0.44158302361646652", "0.12884615836538419"]
"#;
    assert_refused(
        table,
        r#"
mine.toml:3:9: order 4 is claimed, order 3 holds for every T(p): the condition of the word KKKD fails
  3 | order = 4
    |         ^
  found 0.04343472671724274…, needed 1/24
  help: order 4 holds for quadratic T: write `kinetic = "quadratic"`
"#,
    );
    assert_orders(&table.replace("\"any\"", "\"quadratic\""), 3, 4);
    assert_orders(&table.replace("order = 4", "order = 3"), 3, 4);
}

/// One map too many or too few at the ends, and the sums no longer hold.
#[test]
fn sums_that_are_not_one() {
    assert_refused(
        r#"name = "verlet"
order = 2
kinetic = "any"
reference = "none"

[stages]
kick = ["1/2", "1/3"]
drift = [1, 0]
"#,
        r#"
mine.toml:7:8: the kicks do not sum to 1, so not even order 1 holds
  7 | kick = ["1/2", "1/3"]
    |        ^^^^^^^^^^^^^^
  found 5/6, needed 1
"#,
    );
}

// ---------------------------------------------------------------------------------------------------------------
// Claims

#[test]
fn a_palindrome_that_is_none() {
    assert_refused(
        r#"name = "ruth3"
order = 3
kinetic = "any"
symmetric = true
reference = "R. D. Ruth, IEEE Trans. Nucl. Sci. NS-30 (1983) 2669"

[stages]
kick = ["7/24", "3/4", "-1/24"]
drift = ["2/3", "-2/3", 1]
"#,
        r#"
mine.toml:4:13: a palindrome is claimed, the maps do not read the same backwards
  4 | symmetric = true
    |             ^^^^
  found kick 7/24 as map 1 from the start, needed drift 1, the map 1 from the end
  help: correct the weights, or leave `symmetric` out
"#,
    );
}

/// A wrong order and a wrong symmetry come together, in the order of their places.
#[test]
fn all_wrong_claims_at_once() {
    assert_refused(
        r#"name = "euler"
symmetric = true
order = 2
kinetic = "any"
reference = "none"

[stages]
kick = [1]
drift = [1]
"#,
        r#"
mine.toml:2:13: a palindrome is claimed, the maps do not read the same backwards
  2 | symmetric = true
    |             ^^^^
  found kick 1 as map 1 from the start, needed drift 1, the map 1 from the end
  help: correct the weights, or leave `symmetric` out
mine.toml:3:9: order 2 is claimed, order 1 holds for every T(p): the condition of the word KD fails
  3 | order = 2
    |         ^
  found 1, needed 1/2
"#,
    );
}

// ---------------------------------------------------------------------------------------------------------------
// The text

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
  help: did you mean `name`?
mine.toml:1:1: the key `reference` is missing
  1 | nam = "Mine"
    | ^
  help: add `reference = …`: who published the scheme where
mine.toml:2:9: 40 is out of range
  2 | order = 40
    |         ^^
  help: orders from 1 to 10 can be proved
mine.toml:3:11: `cubic` is no kind of kinetic energy
  3 | kinetic = "cubic"
    |           ^^^^^^^
  help: write "any" for every T(p), "quadratic" for T = ½pᵀM⁻¹p only
mine.toml:4:1: unknown key `symetric`
  4 | symetric = true
    | ^^^^^^^^
  help: did you mean `symmetric`?
mine.toml:5:10: this value is of the wrong kind
  5 | digits = "many"
    |          ^^^^^^
  found a text, needed a whole number
mine.toml:6:7: `https://doi.org/10.1/2` is no DOI
  6 | doi = "https://doi.org/10.1/2"
    |       ^^^^^^^^^^^^^^^^^^^^^^^^
  help: a DOI looks like "10.1016/0375-9601(90)90092-3", without https://doi.org/
mine.toml:9:1: `1x` is no name for a constant
  9 | 1x = "1/2"
    | ^^
  help: a constant's name starts with a letter and goes on with letters, digits and _
mine.toml:10:5: this value is of the wrong kind
  10 | y = true
     |     ^^^^
  found a truth value, needed an exact number: 1, 0.25 or an expression in quotes, "1/(2 - 2^(1/3))"
mine.toml:13:9: a weight cannot be inf
  13 | kick = [inf, "1/2", nan]
     |         ^^^
  help: weights are finite exact numbers
mine.toml:13:21: a weight cannot be nan
  13 | kick = [inf, "1/2", nan]
     |                     ^^^
  help: weights are finite exact numbers
mine.toml:14:9: this list of weights is empty
  14 | drift = []
     |         ^^
  help: a scheme has at least one stage
mine.toml:15:1: unknown key `weights`
  15 | weights = [1]
     | ^^^^^^^
  help: the keys of [stages] are kick, drift
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
mine.toml:13:43: `2 3`: an operator is missing between `2` and `3`
  13 | kick = ["gama1", "(-3)^(1/4)", "1 - (2", "2 3"]
     |                                           ^^^
mine.toml:14:11: the exponent of this number is beyond 10000
  14 | drift = ["1e400000", "foo(2)", "0^0", 5000]
     |           ^^^^^^^^
mine.toml:14:23: unknown function `foo`; known functions: sqrt, cbrt, exp, log, sin, cos, tan, sinh, cosh, tanh, atan, asin, acos
  14 | drift = ["1e400000", "foo(2)", "0^0", 5000]
     |                       ^^^^^^
mine.toml:14:33: 0^0 has no value
  14 | drift = ["1e400000", "foo(2)", "0^0", 5000]
     |                                 ^^^
mine.toml:14:39: a weight of 5000 is an absurd size
  14 | drift = ["1e400000", "foo(2)", "0^0", 5000]
     |                                       ^^^^
  help: weights are fractions of a step, at most 1000
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
  help: keep one of the two
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
  help: add `name = …`: the scheme's short name, such as "yoshida4"
mine.toml:1:1: the key `order` is missing
  1 | 
    | ^
  help: add `order = …`: the order claimed, such as 4
mine.toml:1:1: the key `kinetic` is missing
  1 | 
    | ^
  help: add `kinetic = …`: "any" or "quadratic"
mine.toml:1:1: the key `reference` is missing
  1 | 
    | ^
  help: add `reference = …`: who published the scheme where
mine.toml:1:1: the weights are missing
  1 | 
    | ^
  help: add [stages] with kick and drift, or [composition] with base and gamma
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
  found 2 for the kicks, 1 for the drifts, needed as many of both
  help: each stage is a kick and then a drift; write 0 where there is none
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
  help: keep one of the two
"#,
    );
}

#[test]
fn an_absurd_number_of_stages() {
    let gamma = vec!["\"1/5000\""; 5000].join(", ");
    assert_refused(
        &format!(
            r#"name = "mine"
order = 2
kinetic = "any"
reference = "none"

[composition]
base = "stormer-verlet"
gamma = [{gamma}]
"#
        ),
        r#"
mine.toml:1:8: 5001 stages are an absurd size
  1 | name = "mine"
    |        ^^^^^^
  help: at most 2000 are allowed
"#,
    );
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
  help: a composition must end at a table with [stages]
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
  help: a composition must end at a table with [stages]
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
  help: did you mean `stormer-verlet`?
"#,
    );
    let far = judge(&composition_of("rk4")).unwrap_err().to_string();
    assert!(far.starts_with("mine.toml:7:8: there is no table `rk4`\n"), "{far}");
    assert!(far.contains(" tables are shipped, such as efrl, ruth3, "), "{far}");
}

/// The faults of a base are told with the base's own path.
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
            format!("mine.toml:5:10: {digits} digits are too few to tell whether order 1 holds for every T(p)");
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
        ones(20_000)
    );
    let source = |path: &str, text: &str| Source { path: path.to_owned(), text: text.to_owned() };
    let faults = read(&source("mine.toml", &table), &|_, _| Some(source("base.toml", &base))).unwrap_err().to_string();
    assert!(faults.starts_with("mine.toml:1:8: 40000000 stages are an absurd size"), "{faults}");
    assert!(faults.ends_with("help: at most 2000 are allowed"), "{faults}");
}
