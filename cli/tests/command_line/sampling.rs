//! `shadowstep sampling`: what it lists, and what it refuses. The numbers are tested in `tests/tests/sampling.rs` and
//! `analysis`.

use std::fs;

use crate::program::{objects, quietly, text};

#[test]
fn schemes_are_listed_by_their_cost() {
    let all = objects(&quietly("sampling --json"));
    let cost = |name: &str| all.iter().find(|row| text(row, "scheme") == name).unwrap()["cost"].as_f64().unwrap();
    assert!(all.is_sorted_by_key(|row| row["cost"].as_f64().unwrap()));
    // for which Blanes, Casas and Sanz-Serna made it
    assert!(cost("bcss3") < 0.7 * cost("stormer-verlet"));
    assert!(!all.iter().any(|row| ["ruth3", "blanes6-7", "r-respa-4"].contains(&text(row, "scheme"))));
    let table = quietly("sampling --dimension 30");
    assert_eq!(table.lines().filter(|line| line.contains("bcss")).count(), 3, "{table}");
    assert!(table.contains("of 30 oscillators"), "{table}");
}

#[test]
fn an_acceptance_or_a_number_of_steps_may_be_given() {
    let of = |words: &str| objects(&quietly(&format!("sampling stormer-verlet --json {words}"))).remove(0);
    let wanted = of("--acceptance 0.9");
    let steps = wanted["steps"].as_u64().unwrap();
    assert!(wanted["acceptance"].as_f64().unwrap() >= 0.9);
    assert_eq!(of(&format!("--steps {steps}")), wanted);
    assert!(of(&format!("--steps {}", steps - 1))["acceptance"].as_f64().unwrap() < 0.9);
}

#[test]
fn frequencies_are_a_list_or_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frequencies.txt");
    fs::write(&path, "0.5 1\n\n2,3e0\n").unwrap();
    let of = |words: &str| quietly(&format!("sampling bcss2 --time 3 --frequencies {words}"));
    assert_eq!(of(&path.display().to_string()), of("1/2,1,2,3"));
}
