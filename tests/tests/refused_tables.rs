//! Protects the compiler's refusals of wrong claims, each with its message, the value found and the value needed.
//! Tables that are wrong in published codes are in errata.rs.

use shadowstep_tests::refusals::{assert_orders, assert_refused, judge};

/// A near-integrable order that one wrong weight spoils: Laskar and Robutel's SABA3 with 1/4 and 1/2 for its kicks.
#[test]
fn a_near_integrable_order_that_does_not_hold() {
    let table = r#"
name = "saba3"
order = 2
kinetic = "any"
near_integrable = [6, 2]
reference = "J. Laskar, P. Robutel, Celest. Mech. Dyn. Astron. 80 (2001) 39"

[constants]
b1 = "(1 - sqrt(3/5))/2"

[stages]
kick = [0, "1/4", "1/2", "1/4"]
drift = ["b1", "1/2 - b1", "1/2 - b1", "b1"]
"#;
    assert_refused(
        table,
        r#"
mine.toml:5:20: order 6 is claimed, order 2 holds for the terms of ε: the condition of the word KDD fails
  5 | near_integrable = [6, 2]
    |                    ^
  found 0.1625…, needed 1/6
"#,
    );
    let right = table.replace("\"1/4\", \"1/2\", \"1/4\"", "\"5/18\", \"4/9\", \"5/18\"");
    assert_orders(&right, 2, 2);
    // with the kicks as the dominant part it is an ordinary scheme of order 2
    let dominant = judge(&right.replace("[6, 2]", "[6, 2]\ndominant = \"kick\"")).unwrap_err().to_string();
    assert!(dominant.contains("order 6 is claimed, order 2 holds for the terms of ε: "), "{dominant}");
    // a claim below the truth
    let modest = judge(&right.replace("[6, 2]", "[4, 2]")).unwrap();
    let remarks: Vec<_> = modest.notes.iter().map(ToString::to_string).collect();
    assert_eq!(remarks.len(), 1);
    assert!(remarks[0].contains("order 4 is claimed, order 6 holds for the terms of ε"), "{}", remarks[0]);
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
  hint: correct the weights, or leave `symmetric` out
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
  hint: correct the weights, or leave `symmetric` out
mine.toml:3:9: order 2 is claimed, order 1 holds for every T(p): the condition of the word KD fails
  3 | order = 2
    |         ^
  found 1, needed 1/2
"#,
    );
}
