//! Scenes with a custom kinetic energy: conservation, and valid schemes.

use std::fs;

use crate::scenes::{folder, printed, run, table};

/// A relativistic oscillator.
const RELATIVISTIC: &str = r#"
[problem]
potential = "x^2/2"
coordinates = ["x"]
kinetic = "sqrt(1 + px^2)"
[initial]
q = [1]
p = [0]
[run]
scheme = "yoshida4"
step = "1/40"
until = 5
digits = 40
[output]
energy = true
modified_energy = { order = 12 }
"#;

/// Of order 4 for quadratic T, and of order 3 for others.
const NYSTROM: &str = r#"
name = "nystrom"
order = 4
kinetic = "quadratic"
digits = 17
reference = "R. I. McLachlan, P. Atela, Nonlinearity 5 (1992) 541"

[stages]
kick  = ["0.13449619927743109", "-0.22481980307942081", "0.75632000051566829", "0.33400360328632143"]
drift = ["0.51535283743112294", "-0.085782019412973646", "0.44158302361646652", "0.12884615836538419"]
"#;

#[test]
fn masses_and_their_formula_give_the_same_energies() {
    // a mass of 4 rounds nothing
    let formula = RELATIVISTIC.replace("sqrt(1 + px^2)", "px^2/8");
    let masses = formula.replace("kinetic = \"px^2/8\"", "masses = [4]");
    assert_ne!(formula, masses);
    assert_eq!(table(&printed(&formula)), table(&printed(&masses)));
}

#[test]
fn momenta_can_be_named() {
    let own = RELATIVISTIC.replace("px", "p").replace("[initial]", "momenta = [\"p\"]\n[initial]");
    let asking = |scene: &str| scene.replace("[output]", "[output]\ntrajectory = true");
    let csv = printed(&asking(&own));
    assert!(csv.contains("# kinetic: sqrt(1 + p^2)\n# momenta: [\"p\"]\n"), "{csv}");
    let (header, rows) = table(&csv);
    assert_eq!(header[6..], ["x", "p"]);
    assert_eq!(rows, table(&printed(&asking(RELATIVISTIC))).1);
}

#[test]
fn a_scheme_for_quadratic_t_moves_no_other() {
    let scene = |kinetic: &str| {
        let scene = RELATIVISTIC.replace("sqrt(1 + px^2)", kinetic).replace("yoshida4", "nystrom.toml");
        let folder = folder(&scene.replace("digits = 40", "digits = \"double\""));
        fs::write(folder.path().join("nystrom.toml"), NYSTROM).unwrap();
        folder
    };
    let refused = scene("sqrt(1 + px^2)");
    let result = run(refused.path(), "");
    assert_eq!((result.code, result.out.as_str()), (2, ""));
    let message = "scene.toml:10:10: nystrom has order 4 for quadratic T only, for a general T(p) order 3\n";
    let hint = "hint: use a scheme such as shadowstep4-6, which has order 4 for every T(p)";
    assert!(result.err.contains(message) && result.err.contains(hint), "{}", result.err);
    for quadratic in ["px^2/2", "px*px"] {
        let result = run(scene(quadratic).path(), "");
        assert_eq!((result.code, result.err.as_str()), (0, ""));
        assert!(result.out.contains("# scheme_order: 4\n"), "{}", result.out);
    }
}

#[test]
fn the_order_in_the_head_is_that_for_this_t() {
    // order 4 for quadratic T, and claimed to be no more than the 3 that every T leaves
    let table = NYSTROM.replace("order = 4", "order = 3");
    for (kinetic, order) in [("sqrt(1 + px^2)", 3), ("px^2/2", 4)] {
        let folder = folder(&RELATIVISTIC.replace("sqrt(1 + px^2)", kinetic).replace("yoshida4", "nystrom.toml"));
        fs::write(folder.path().join("nystrom.toml"), &table).unwrap();
        let result = run(folder.path(), "");
        assert_eq!(result.code, 0, "{}", result.err);
        assert!(result.out.contains(&format!("# scheme_order: {order}\n")), "{}", result.out);
    }
}
