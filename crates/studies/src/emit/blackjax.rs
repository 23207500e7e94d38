//! The coefficients of a scheme for `generate_euclidean_integrator` of BlackJAX, whose steps update p and q in turn, p
//! first and last.
//!
//! After each update of q it evaluates the density with its gradient, and the last of them serves the next step. So a
//! step costs as many evaluations as it has drifts, one more than here where a drift begins and ends it; then the first
//! and the last kick have weight 0.

use shadowstep_schemes::counted;

use crate::emit::language::{Language, no_action, plain_constant};
use crate::emit::step::{Step, literal};

const BLACKJAX: Language = Language { comment: "#", constant: plain_constant, literal, action: no_action };

/// The module.
pub(crate) fn module(step: &Step<'_>) -> String {
    let mut names = step.alternating();
    if !step.begins_with_kick() {
        names.insert(0, "0.0");
        names.push("0.0");
    }
    let mut values = BLACKJAX.values(step);
    values
        .text("numpy", "jnp")
        .text("coefficients", names.join(", "))
        .text("gradients", counted(names.len() / 2, "evaluation"));
    values.fill(concat!(include_str!("templates/blackjax.py"), include_str!("templates/self_test.py")))
}
