//! Runs with processed schemes: rows are read through the post-map.

use crate::program::{objects, quietly};
use crate::scenes::{printed, table};

/// H = A + εB with A = p²/2 and ε = 1/1000: the drifts solve A exactly.
const NEAR: &str = r#"
[problem]
potential = "cos(q)/1000"
coordinates = ["q"]
[initial]
q = [0]
p = [1]
[run]
scheme = "SCHEME"
step = "1/2"
steps = 40
digits = 40
[output]
energy = { every = 1 }
trajectory = { every = 1 }
"#;

/// The planets by Wisdom and Holman's parts: the error of H is O(εh² + ε²h²) of an energy that is itself of the size of
/// ε.
const PLANETS: &str = r#"
[problem]
name = "outer-solar-system"
parts = "wisdom-holman"
[run]
scheme = "SCHEME"
step = 200
until = 20000
digits = "double"
[output]
energy = { every = 1 }
"#;

/// The largest |H(t) − H(0)| of the rows of a scene.
fn energy_error(scene: &str, scheme: &str) -> f64 {
    let (header, rows) = table(&printed(&scene.replace("SCHEME", scheme)));
    let column = header.iter().position(|name| name == "energy").unwrap();
    let energies: Vec<f64> = rows.iter().map(|row| row[column].parse().unwrap()).collect();
    energies.iter().map(|energy| (energy - energies[0]).abs()).fold(0.0, f64::max)
}

/// ε h² with and without another factor ε, which is 1/1000 of the pendulum and less of the planets.
#[test]
fn a_corrector_leaves_the_error_of_the_second_order_in_epsilon() {
    for (scene, corrector, factor) in [(NEAR, "wisdom-corrector-11", 5e-3), (PLANETS, "wisdom-corrector-17", 1e-2)] {
        let [plain, corrected] = ["stormer-verlet", corrector].map(|scheme| energy_error(scene, scheme));
        assert!(plain > 0.0 && corrected < factor * plain, "{plain} without a corrector, {corrected} with it");
    }
}

#[test]
fn the_first_row_is_the_initial_state() {
    let (_, rows) = table(&printed(&NEAR.replace("SCHEME", "wisdom-corrector-7")));
    let first: Vec<f64> = rows[0].iter().skip(2).map(|cell| cell.parse().unwrap()).collect();
    assert!((first[0] - 0.501).abs() < 1e-15 && first[1].abs() < 1e-35 && (first[2] - 1.0).abs() < 1e-35, "{first:?}");
}

#[test]
fn rows_with_modified_energies_have_the_states_of_those_without() {
    let scene = NEAR.replace("SCHEME", "wisdom-corrector-5");
    let (_, plain) = table(&printed(&scene));
    let shadowed = scene.replace("[output]", "[output]\nmodified_energy = { order = 8 }");
    let (header, rows) = table(&printed(&shadowed));
    let of = |name: &str| header.iter().position(|known| known == name).unwrap();
    let [energy, q] = [of("energy"), of("q")];
    for (row, alone) in rows.iter().zip(&plain) {
        assert_eq!((&row[energy], &row[q]), (&alone[2], &alone[3]));
    }
    // the modified energy of the kernel's states is that of the processed scheme: it differs from H by ε²h², not εh²
    let modified = of("modified_energy");
    let difference = |row: &[String]| row[energy].parse::<f64>().unwrap() - row[modified].parse::<f64>().unwrap();
    let largest = rows.iter().map(|row| difference(row).abs()).fold(0.0, f64::max);
    assert!(largest > 0.0 && largest < 1e-7, "{largest}");
}

/// The kernel of order 2 has terms of h² that the post-map takes away.
#[test]
fn orders_and_errors_of_a_processed_scheme_are_those_after_processing() {
    let record = |name: &str| objects(&quietly(&format!("schemes show {name} --json"))).remove(0);
    let corrector = record("wisdom-corrector-7");
    assert_eq!(corrector["near_integrable"], serde_json::json!([8, 2]));
    assert_eq!((&corrector["order"], &corrector["kernel"]["order"]), (&2.into(), &2.into()));
    let processed = record("wisdom-kernel-17");
    let listed = objects(&quietly("schemes --json --order 4 --for quadratic"));
    let listed = listed.iter().find(|scheme| scheme["name"] == "wisdom-kernel-17").unwrap();
    for record in [&processed, listed] {
        assert_eq!((&record["order_quadratic"], &record["kernel"]["order_quadratic"]), (&4.into(), &2.into()));
    }
    assert_eq!(listed["effective_error_quadratic"], processed["effective_error_quadratic"]);
    let powers = [&processed, &processed["kernel"]].map(|record| &record["leading_error_quadratic"]["power"]);
    assert_eq!(powers, [5, 3]);
}
