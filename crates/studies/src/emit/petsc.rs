//! A header that registers a scheme for `TSBASICSYMPLECTIC` of PETSc.
//!
//! In a stage PETSc adds h c_i times the right-hand side of "momentum" to p and then h d_i times the right-hand side of
//! "position" to q (`TSStep_BasicSymplectic`; the manual page of `TSBasicSymplecticRegister` has c and d exchanged), so
//! c are the weights of kicks and d the weights of drifts, in the order of ours. A weight of 0 costs nothing, and
//! nothing is kept from step to step.

use shadowstep_schemes::Rational;

use crate::emit::language::{Language, no_action, plain_constant};
use crate::emit::step::{Step, literal, nearest};

const PETSC: Language = Language { comment: "//", constant: plain_constant, literal, action: no_action };

/// The header.
pub(crate) fn header(step: &Step<'_>) -> String {
    let mut values = PETSC.values(step);
    let [kicks, drifts] = step.stages();
    let constants = |weights: &[Rational]| -> Vec<String> {
        weights.iter().map(|weight| format!("{},", literal(nearest(weight)))).collect()
    };
    values
        .text("stages", kicks.len().to_string())
        .lines("kicks", constants(&kicks))
        .lines("drifts", constants(&drifts));
    values.fill(include_str!("templates/petsc.h"))
}
