//! Runs with processed schemes: rows are read through the post-map.

use std::fs;

use crate::program::{objects, quietly, text};
use crate::scenes::{folder, printed, run, table};
use shadowstep_scenes::{FileOptions, Observer, Outcome, Scene};

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

/// The largest |H(t) − H(0)|.
fn energy_error(scheme: &str) -> f64 {
    let (header, rows) = table(&printed(&NEAR.replace("SCHEME", scheme)));
    let column = header.iter().position(|name| name == "energy").unwrap();
    let energies: Vec<f64> = rows.iter().map(|row| row[column].parse().unwrap()).collect();
    energies.iter().map(|energy| (energy - energies[0]).abs()).fold(0.0, f64::max)
}

#[test]
fn a_corrector_leaves_the_error_of_the_second_order_in_epsilon() {
    let plain = energy_error("stormer-verlet");
    let corrected = energy_error("wisdom-corrector-11");
    assert!(plain > 1e-6, "{plain}");
    // ε h² with and without another factor ε
    assert!(corrected < 5e-3 * plain, "{plain} without a corrector, {corrected} with it");
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

/// Stops a run after some states.
struct StopAt(i64);

impl Observer for StopAt {
    fn progress(&mut self, n: i64) {
        self.0 -= i64::from(n > 0);
    }

    fn stops(&mut self) -> bool {
        self.0 == 0
    }
}

#[test]
fn a_resumed_run_does_not_begin_with_the_pre_map_again() {
    for modified in ["", "modified_energy = { order = 6 }\n"] {
        let scene = NEAR.replace("SCHEME", "wisdom-corrector-5").replace("digits = 40", "digits = \"double\"");
        let scene = format!("{scene}{modified}file = \"out.csv\"\ncheckpoint = 10\n");
        let [whole, stopped] = [folder(&scene), folder(&scene)];
        assert_eq!(run(whole.path(), "").code, 0);
        let scene = Scene::open(stopped.path().join("scene.toml")).unwrap();
        let outcome = scene.run_to_file(FileOptions::default(), &mut StopAt(25)).unwrap();
        assert_eq!(outcome, Outcome::Stopped { n: 25 });
        assert_eq!(run(stopped.path(), "").code, 0);
        let [whole, stopped] =
            [&whole, &stopped].map(|folder| fs::read_to_string(folder.path().join("out.csv")).unwrap());
        assert_eq!(table(&whole), table(&stopped));
    }
}

#[test]
fn the_drift_and_the_work_of_a_processed_scheme_are_measured() {
    let found = objects(&quietly("drift kepler --scheme wisdom-corrector-3 --step 1/40 --until 2 --order 6 --json"));
    assert!(!found.is_empty());
}

#[test]
fn kernel_and_effective_orders_are_shown_apart() {
    let shown = quietly("schemes show wisdom-corrector-7");
    for line in ["processor:", "effective:", "11 force evaluations", "effective orders (8,2)"] {
        assert!(shown.contains(line), "{line} is missing in\n{shown}");
    }
    let record = &objects(&quietly("schemes show wisdom-corrector-7 --json"))[0];
    assert_eq!(text(record, "name"), "wisdom-corrector-7");
    assert_eq!(record["near_integrable"], serde_json::json!([8, 2]));
    assert_eq!((&record["order"], &record["kernel"]["order"]), (&2.into(), &2.into()));
}

/// The kernel of order 2 has terms of h² that the post-map takes away.
#[test]
fn orders_and_errors_of_a_processed_scheme_are_those_after_processing() {
    let record = &objects(&quietly("schemes show wisdom-kernel-17 --json"))[0];
    let kernel = &record["kernel"];
    assert_eq!((&record["order_quadratic"], &kernel["order_quadratic"]), (&4.into(), &2.into()));
    assert_eq!(
        (&record["leading_error_quadratic"]["power"], &kernel["leading_error_quadratic"]["power"]),
        (&5.into(), &3.into())
    );
    let shown = quietly("schemes show wisdom-kernel-17");
    let words = shown.split_whitespace().collect::<Vec<_>>().join(" ");
    for text in [
        "after processing",
        "quadratic T: h^5, norm",
        "of the kernel, h^3, norm",
        "of the kernel, order 2",
        "effective order 4",
    ] {
        assert!(words.contains(text), "{text} is missing in\n{shown}");
    }
    let listed = objects(&quietly("schemes --json --order 4 --for quadratic"));
    let found = listed.iter().find(|scheme| scheme["name"] == "wisdom-kernel-17").unwrap();
    assert_eq!((&found["order_quadratic"], &found["kernel"]["order_quadratic"]), (&4.into(), &2.into()));
    assert_eq!(found["effective_error_quadratic"], record["effective_error_quadratic"]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kernel.toml");
    fs::write(&path, shadowstep_schemes::shipped("wisdom-kernel-17").unwrap().text).unwrap();
    let checked = quietly(&format!("schemes check {}", path.display()));
    assert!(
        checked.contains(
            "proved: effective order 4 for quadratic T, (18,4,3) for A + εB, to 320 digits; of the kernel order 2"
        ),
        "{checked}"
    );
}

#[test]
fn the_measure_of_schemes_for_sampling_is_shown() {
    let shown = quietly("schemes show bcss2");
    assert!(shown.contains("sampling:") && shown.contains("3.990e-4"), "{shown}");
}

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

#[test]
fn a_corrector_lowers_the_error_of_a_wisdom_holman_map_by_the_size_of_the_interactions() {
    let [plain, corrected] = ["stormer-verlet", "wisdom-corrector-17"].map(|scheme| {
        let (_, rows) = table(&printed(&PLANETS.replace("SCHEME", scheme)));
        let energies: Vec<f64> = rows.iter().map(|row| row[2].parse().unwrap()).collect();
        energies.iter().map(|energy| (energy / energies[0] - 1.0).abs()).fold(0.0, f64::max)
    });
    assert!(corrected < plain / 100.0, "{plain} without a corrector, {corrected} with it");
}
