//! What programs cost: never more than what a careful person writes by hand.

use super::support::program;
use shadowstep_schemes::symbolic::Operations;

/// Additions, multiplications, divisions, roots, elementary functions.
type Columns = [u64; 5];

fn columns(cost: Operations) -> Columns {
    [cost.additions, cost.multiplications, cost.divisions, cost.roots, cost.elementary]
}

/// Potentials with their coordinates and parameters, and the cost of gradient, and of gradient and rate, by hand.
const BY_HAND: [(&str, &str, &str, Columns, Columns); 10] = [
    // sin q; with the rate 2 cos q + q sin q
    ("-cos(q)", "q", "", [0, 0, 0, 0, 1], [1, 2, 0, 0, 1]),
    // x² + y·y, 1/√, square, cube, two products; with the rate a tripled 1/|q|
    ("-1/sqrt(x^2 + y^2)", "x y", "", [1, 6, 0, 1, 0], [1, 7, 0, 1, 0]),
    // x², y², (x + x)y + x, x² − y² + y; with the rate y² / −3 + x², times y
    ("(x^2 + y^2)/2 + x^2*y - y^3/3", "x y", "", [4, 3, 0, 0, 0], [5, 4, 1, 0, 0]),
    // x² + y·y, exp, times −2, two products; with the rate a product added
    ("exp(-(x^2+y^2))", "x y", "", [1, 5, 0, 0, 1], [2, 6, 0, 0, 1]),
    ("exp(-x^2-y^2)", "x y", "", [1, 5, 0, 0, 1], [2, 6, 0, 0, 1]),
    // ω² q; the rate is 0
    ("omega^2*(x^2)/2", "x", "omega", [0, 1, 0, 0, 0], [0, 1, 0, 0, 0]),
    ("omega^2*(x^2 + y^2)/2", "x y", "omega", [0, 2, 0, 0, 0], [0, 2, 0, 0, 0]),
    // q² q; with the rate (q²)²/2
    ("q^4/4", "q", "", [0, 2, 0, 0, 0], [0, 3, 1, 0, 0]),
    // 1/|q| as before, ³ times m; with the rate 3m/|q|
    // Lennard-Jones, with constants A to D: i = 1/r², i², i³, i⁴, (A − B i³) i⁴; with the rate (C − D i³) i³
    ("4*e*(s^12/r2^6 - s^6/r2^3)", "r2", "e s", [1, 5, 1, 0, 0], [2, 7, 1, 0, 0]),
    ("-m/sqrt(x^2 + y^2)", "x y", "m", [1, 7, 0, 1, 0], [1, 8, 0, 1, 0]),
];

#[test]
fn programs_cost_no_more_than_those_by_hand() {
    for (text, coordinates, parameters, gradient, both) in BY_HAND {
        for (rate, by_hand) in [(false, gradient), (true, both)] {
            // the gradient alone is that with the rate, less what only the rate needs
            let both = program(text, coordinates, parameters, true);
            let program = if rate { both } else { both.without_last_output() };
            let found = columns(program.cost());
            let dearer = found.iter().zip(by_hand).any(|(found, by_hand)| *found > by_hand);
            assert!(!dearer, "{text}: {found:?} against {by_hand:?}\n{program}");
        }
    }
}
