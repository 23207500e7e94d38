//! A Python function that makes a `CustomIntegrator` of OpenMM.
//!
//! OpenMM evaluates forces where an expression has `f` and positions have changed since the last time, also across
//! steps: so the force of the last kick serves the first of the next step.

use crate::emit::language::{Direction, Language, plain_constant};
use crate::emit::step::{Action, Step, literal};

const OPENMM: Language = Language { comment: "#", constant: plain_constant, literal, action };

/// The module.
pub(crate) fn module(step: &Step<'_>) -> String {
    OPENMM.values(step).fill(include_str!("templates/openmm.py"))
}

fn action(action: Action<'_>, _: Direction) -> String {
    match action {
        // OpenMM evaluates it
        Action::Gradient => String::new(),
        Action::Kick(weight) => format!("kick({})", weight.name),
        Action::Drift(weight) => format!("drift({})", weight.name),
        Action::Curvature | Action::GradientKick(_) => unreachable!("schemes with gradient kicks are refused"),
    }
}
