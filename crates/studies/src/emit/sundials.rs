//! A header with a table for SPRKStep of ARKODE, the symplectic steppers of SUNDIALS.
//!
//! In a stage SPRKStep adds h â_i f1(q) to p and then h a_i f2(p) to q (`sprkStep_TakeStep`), so â are the weights of
//! kicks and a the weights of drifts, in the order of ours. Each stage evaluates f1 and f2 once, also where the weight
//! is 0, and nothing is kept from step to step.

use shadowstep_schemes::Rational;

use crate::emit::language::{Language, no_action, plain_constant};
use crate::emit::step::{Step, literal, long_decimal};

const SUNDIALS: Language = Language { comment: "//", constant: plain_constant, literal, action: no_action };

/// The header.
pub(crate) fn header(step: &Step<'_>) -> String {
    let mut values = SUNDIALS.values(step);
    let [kicks, drifts] = step.stages();
    let constants = |weights: &[Rational]| -> Vec<String> {
        weights.iter().map(|weight| format!("SUN_RCONST({}),", long_decimal(weight))).collect()
    };
    values
        .text("stages", kicks.len().to_string())
        .lines("kicks", constants(&kicks))
        .lines("drifts", constants(&drifts));
    values.fill(include_str!("templates/sundials.h"))
}
