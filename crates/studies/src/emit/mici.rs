//! The coefficients of a scheme for `SymmetricCompositionIntegrator` of mici, which takes all but the two in the middle
//! and its mirror image: these follow from the sums, which are 1.

use crate::emit::language::{Language, no_action, plain_constant};
use crate::emit::step::{Step, literal};

const MICI: Language = Language { comment: "#", constant: plain_constant, literal, action: no_action };

/// The module.
pub(crate) fn module(step: &Step<'_>) -> String {
    let names = step.alternating();
    let free = (names.len() - 1) / 2 - 1;
    let mut values = MICI.values(step);
    values
        .text("numpy", "np")
        .text("coefficients", names.join(", "))
        .text("free", free.to_string())
        .text("kick_first", if step.begins_with_kick() { "True" } else { "False" });
    values.fill(concat!(include_str!("templates/mici.py"), include_str!("templates/self_test.py")))
}
