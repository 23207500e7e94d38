//! `shadowstep modified`: series, formulas in all notations, refusals. The formulas are held against modified energies in `scenes`.

use crate::program::shadowstep;

fn out(command: &str) -> String {
    let result = shadowstep(command);
    assert_eq!((result.code, &*result.err), (0, ""), "{command}");
    result.out
}

/// The leapfrog's series is in every textbook; that of three parts and of yoshida4 agree with `bch_expansion` of PennyLane 0.45.1 to 3e-16.
#[test]
fn series_have_exact_coefficients_and_rounded_ones() {
    assert_eq!(
        out("modified stormer-verlet --grade 2"),
        "stormer-verlet: H = T + U becomes H + h^2 H_3 + O(h^4)\n\nH_3\n  -1/24  [K,[K,D]]\n   1/12  [D,[D,K]]\n"
    );
    let yoshida = out("modified yoshida4 --digits 5");
    assert!(yoshida.contains("  -0.00041376  [K,[K,[K,[K,D]]]]\n"), "{yoshida}");
    let three = out("modified stormer-verlet --grade 2 --parts 3");
    assert!(three.contains("\n  -1/24  [A,[A,B]]\n") && three.contains("\n   -1/6  [B,[A,C]]\n"), "{three}");
    let json = out("modified symplectic-euler --grade 1 --json");
    assert_eq!(
        json,
        "{\"scheme\":\"symplectic-euler\",\"kinetic\":\"any\",\"parts\":2,\"exact\":true,\"terms\":[{\"power\":1,\"bracket\":\"[K,D]\",\"coefficient\":\"1/2\"}]}\n"
    );
    assert!(out("modified yoshida4 --quadratic").contains("T + U with quadratic T"));
    assert!(out("modified chin-4a").contains("T + U with quadratic T"), "gradient kicks are for quadratic T only");
}

#[test]
fn formulas_are_written_in_all_notations() {
    let with = |flags: &str| out(&format!("modified stormer-verlet pendulum --grade 2 {flags}"));
    assert_eq!(
        with(""),
        "stormer-verlet, pendulum: H + h^2 H_3 + O(h^4)\n\nH = p^2/2 - cos(q)\n\nH_3 = -sin(q)^2/24 + p^2*cos(q)/12\n"
    );
    let latex = with("--to latex");
    assert!(latex.contains(r"H_{3} &= -\frac{\sin\left(q\right)^{2}}{24}"), "{latex}");
    assert!(with("--to numpy").contains("def modified_hamiltonian(h, q, p):\n"));
    let rust = with("--to rust");
    assert!(rust.contains("pub fn modified_hamiltonian(h: f64, q: f64, p: f64) -> f64 {\n"), "{rust}");
    assert!(rust.contains("total += h.powi(2)*(-q.sin().powi(2)/24.0 + p.powi(2)*q.cos()/12.0);"), "{rust}");
    let json = with("--json");
    assert!(json.contains("\"terms\":[{\"power\":2,\"formula\":\"-sin(q)^2/24 + p^2*cos(q)/12\"}]"), "{json}");
    // a parameter that no formula has is no argument
    assert!(out("modified stormer-verlet kepler --to rust").contains("(h: f64, x: f64, y: f64, px: f64, py: f64)"));
}

#[test]
fn what_has_no_series_is_refused_with_what_would_be_right() {
    for (command, message, hint) in [
        ("modified r-respa-4", "r-respa-4 has multiple time steps", "add --parts 3"),
        ("modified chin-4a --parts 3", "chin-4a has gradient kicks", "use a scheme such as yoshida4"),
        ("modified yoshida4 --to latex", "there is no system", "name a problem or a scene"),
        (
            "modified yoshida4 --parts 9 --grade 10",
            "the series of 9 parts up to h^10 has too many terms",
            "fewer parts",
        ),
        ("modified yoshida4 fput-stiff", "fput-stiff has none in its coordinates", "write `potential` as a formula"),
        ("modified stormer-verlet outer-solar-system --grade 8", "has more than 100000 parts", "powers of h below"),
        ("modified yoshida4 --grade 11", "11", "1"),
    ] {
        let result = shadowstep(command);
        assert_eq!(result.code, 2, "{command}: {}", result.out);
        assert!(result.err.contains(message) && result.err.contains(hint), "{command}: {}", result.err);
    }
}
