//! Why a table was not polished: what happened, with numbers, and what would be right.

use crate::polish::newton::{Failure, Problem, What};
use crate::polish::numbers::power_of_ten;
use crate::polish::unknowns::Model;
use crate::polish::{formulas, printed};
use shadowstep_schemes::table::Table;
use shadowstep_schemes::{ExactScheme, counted};

/// What would be right, as far as the printed table shows it.
pub(super) fn reason(scheme: &ExactScheme, model: &Model) -> Option<String> {
    printed::quadratic_only(&scheme.table, &printed::proof(scheme, model))
        .or_else(|| printed::verlet_steps(scheme, model))
        .or_else(|| fixed_decimals(&scheme.table))
}

/// What would be right where decimals stand within formulas.
pub(super) fn fixed_decimals(table: &Table) -> Option<String> {
    let cells = formulas::cells_with_decimals(table);
    match cells.len() {
        0 => None,
        1 => Some(format!("the decimal in {} does not move: make it a constant", cells[0])),
        _ => Some(format!("the decimals in {} do not move: make them constants", cells.join(", "))),
    }
}

/// What happened, with numbers, and what may be the reason.
pub(super) fn unsolved(
    problem: &Problem<'_>,
    failure: &Failure,
    residual_printed: f64,
    held: &[usize],
) -> (String, String) {
    let rows = problem.rows(&problem.printed(), 60).map_or_else(Vec::new, |(rows, _)| rows);
    let worst = rows
        .iter()
        .max_by_key(|row| row.off.magnitude())
        .map_or(String::new(), |row| row.condition.functional.to_string());
    let numbers = format!(
        "{} for {}, {} of them solved for; as printed off by {}, most of all {worst}; at best by {}; \
         condition number {:.1e}",
        counted(rows.len(), "condition"),
        counted(problem.model.unknowns.len(), "decimal"),
        failure.moving,
        power_of_ten(residual_printed),
        power_of_ten(failure.residual.min(residual_printed)),
        failure.condition_number
    );
    let (what, hint) = match failure.what {
        What::Stuck if !held.is_empty() => {
            ("no values near the printed ones meet the conditions", "let more decimals move")
        }
        What::Stuck if failure.moving < problem.model.unknowns.len() => (
            "no values near the printed ones of those decimals that the conditions determine meet them all",
            "a weight may be misprinted, or the weights are a singular solution of the conditions",
        ),
        What::Stuck => (
            "no values near the printed ones meet the conditions",
            "a weight may be misprinted, or the order or the kinetic energy claimed is not the scheme's",
        ),
        What::Slow => (
            "the conditions do not determine the weights well: their derivatives are singular at the solution",
            "hold some decimals as printed with --free",
        ),
        What::Leaves => (
            "Newton's iteration leaves the neighbourhood of the printed values",
            "a weight may be misprinted, or the order claimed is not the scheme's; else hold some decimals with --free",
        ),
        What::Singular => (
            "the conditions do not determine the weights: their derivatives are singular",
            "hold some decimals as printed with --free",
        ),
    };
    (format!("{what} ({numbers})"), hint.to_owned())
}
