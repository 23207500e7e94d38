//! Error coefficients, against the values in papers.

use shadowstep_analysis::Analysis;
use shadowstep_schemes::{First, Kinetic, to_text};

use crate::{SHIPPED, analysis, with_weights};

/// Equal to all digits that were printed.
fn assert_printed(value: f64, printed: f64, digits: i32) {
    let unit = 10_f64.powi(printed.abs().log10().floor() as i32 + 1 - digits);
    assert!((value - printed).abs() <= unit, "{value} is not the published {printed}");
}

#[test]
fn stormer_verlet_has_the_coefficients_of_the_textbooks() {
    let verlet = analysis("stormer-verlet");
    for error in [&verlet.general, &verlet.quadratic] {
        let terms: Vec<_> = error.terms.iter().map(|(bracket, c)| (bracket.to_string(), *c)).collect();
        assert_eq!(terms, [("[K,[K,D]]".to_owned(), -1.0 / 24.0), ("[D,[D,K]]".to_owned(), 1.0 / 12.0)]);
        assert_eq!(error.power, 3);
        assert!((error.norm() - 5_f64.sqrt() / 24.0).abs() < 1e-16, "one rounding or two of f64");
    }
}

#[test]
fn symplectic_euler_has_half_a_bracket() {
    let euler = analysis("symplectic-euler");
    assert_eq!(euler.general.terms[0].1, 0.5);
    assert_eq!(euler.effective_error(Kinetic::Any), 0.5);
}

const PEFRL: [&str; 3] = ["0.1786178958448091", "-0.2123418310626054", "-0.06626458266981849"];

#[test]
fn norms_are_those_of_omelyan_mryglod_and_folk() {
    // Phys. Rev. E 65 (2002) 056706: ξ minimises the norm for two evaluations, from 0.0932 to 0.00855
    let x = "0.1931833275037836";
    let verlet_like = with_weights(
        "order = 2\nkinetic = \"any\"\ndigits = 15",
        "0, \"1/2\", \"1/2\"",
        &format!("{x}, \"1 - 2*{x}\", {x}"),
    );
    assert_printed(Analysis::of(&verlet_like).general.norm(), 0.00855, 3);

    // Comput. Phys. Commun. 146 (2002) 188, for quadratic T
    let [x, l, c] = PEFRL;
    let pefrl = with_weights(
        "order = 4\nkinetic = \"any\"\ndigits = 15",
        &format!("0, \"(1 - 2*({l}))/2\", {l}, {l}, \"(1 - 2*({l}))/2\""),
        &format!("{x}, {c}, \"1 - 2*({c} + {x})\", {c}, {x}"),
    );
    assert_printed(Analysis::of(&pefrl).quadratic.norm(), 0.00061, 2);
}

#[test]
fn effective_errors_are_those_of_blanes_and_moan() {
    // J. Comput. Appl. Math. 142 (2002) 313: S6 for every T(p), SRKN6b for quadratic T
    assert_printed(analysis("blanes-moan-s6").effective_error(Kinetic::Any), 0.56, 2);
    assert_printed(analysis("blanes-moan-srkn6b").effective_error(Kinetic::Quadratic), 0.29, 2);
}

#[test]
fn for_every_kinetic_energy_kick_and_drift_are_treated_alike() {
    for (name, proved, analysis) in SHIPPED.iter() {
        let (mut other, general) = (proved.clone(), &analysis.general);
        if general.power > 4 && general.power.is_multiple_of(2) {
            continue; // in the basis of an even degree from 6 on, K comes before D
        }
        if proved.scheme.has_gradient_kicks() {
            continue; // [K,[D,K]] is not exchanged
        }
        other.scheme = other.scheme.starting_with(First::Drift);
        // the order for every T(p) does not depend on which map is called the kick
        let exchanged = Analysis::of(&other).general.norm();
        let norm = general.norm();
        assert!((norm - exchanged).abs() <= 1e-14 * norm, "{name}: {norm} and {exchanged}");
    }
}

#[test]
fn sizes_of_weights_are_counted_once_a_map() {
    let ruth = analysis("ruth3");
    assert_eq!(to_text(&ruth.kicks.sum_of_sizes), "13/12");
    assert_eq!(to_text(&ruth.drifts.sum_of_sizes), "7/3");
    assert_eq!((to_text(&ruth.kicks.smallest), to_text(&ruth.kicks.largest)), ("-1/24".into(), "3/4".into()));
    let verlet = analysis("stormer-verlet");
    assert_eq!((to_text(&verlet.drifts.smallest), to_text(&verlet.drifts.largest)), ("1".into(), "1".into()));
}
