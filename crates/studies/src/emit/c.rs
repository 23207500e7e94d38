//! A header of C99.

use crate::emit::language::{Direction, Language};
use crate::emit::step::{Action, Step, Weight, literal};

const C: Language = Language { comment: "//", constant, literal, action };

/// The header.
pub(crate) fn header(step: &Step<'_>) -> String {
    let mut values = C.values(step);
    values.text("arrays", if step.has_gradient_kicks() { "3" } else { "2" });
    // the actions name functions by the identifier
    values.fill(include_str!("templates/c.h")).replace("SCHEME_", &format!("{}_", step.identifier()))
}

fn constant(weight: &Weight) -> String {
    format!("static const double SCHEME_{} = {};", weight.name, weight.literal())
}

fn action(action: Action<'_>, direction: Direction) -> String {
    let h = direction.step_size();
    match action {
        Action::Gradient => "s->gradient(s->n, q, g, s->context);".to_owned(),
        Action::Curvature => "SCHEME_curvature(s, q, g, v, w);".to_owned(),
        Action::Kick(weight) => format!("SCHEME_kick(s, {h} * SCHEME_{}, g, p);", weight.name),
        // a processor has no gradient kicks, so that they never go back
        Action::GradientKick(weight) => format!("SCHEME_kick(s, -2 * h * h * h * SCHEME_{}, w, p);", weight.name),
        Action::Drift(weight) => format!("SCHEME_drift(s, {h} * SCHEME_{}, p, v, q);", weight.name),
    }
}
