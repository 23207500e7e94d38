//! A module for JAX.

use crate::emit::language::{Direction, Language, plain_constant};
use crate::emit::step::{Action, Step, literal};

const JAX: Language = Language { comment: "#", constant: plain_constant, literal, action };

/// The module.
pub(crate) fn module(step: &Step<'_>) -> String {
    let mut values = JAX.values(step);
    values.text("numpy", "jnp");
    values.fill(concat!(include_str!("templates/jax.py"), include_str!("templates/self_test.py")))
}

fn action(action: Action<'_>, direction: Direction) -> String {
    let [minus, plus] = ['-', '+'].map(|sign| direction.signed(sign));
    match action {
        Action::Gradient => "g = gradient(q)".to_owned(),
        Action::Curvature => "w = curvature(q, g, gradient, velocity)".to_owned(),
        Action::Kick(weight) => format!("p = p {minus} h * {} * g", weight.name),
        Action::GradientKick(weight) => format!("p = p {plus} 2 * h * h * h * {} * w", weight.name),
        Action::Drift(weight) => format!("q = q {plus} h * {} * velocity(p)", weight.name),
    }
}
