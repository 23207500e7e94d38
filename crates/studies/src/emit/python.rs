//! A module for NumPy.

use crate::emit::language::{Direction, Language, plain_constant};
use crate::emit::step::{Action, Step, literal};

const PYTHON: Language = Language { comment: "#", constant: plain_constant, literal, action };

/// The module.
pub(crate) fn module(step: &Step<'_>) -> String {
    let mut values = PYTHON.values(step);
    let products = if step.has_gradient_kicks() { ", hessian_product" } else { "" };
    values
        .text("numpy", "np")
        .text("parameters", format!("gradient{products}, velocity=unit_masses"))
        .text("arguments", format!("gradient{products}, velocity"))
        .text("test_arguments", format!("gradient{products}"));
    values.fill(concat!(include_str!("templates/python.py"), include_str!("templates/self_test.py")))
}

fn action(action: Action<'_>, direction: Direction) -> String {
    let [minus, plus] = ['-', '+'].map(|sign| direction.signed(sign));
    match action {
        Action::Gradient => "g = gradient(q)".to_owned(),
        Action::Curvature => "w = hessian_product(q, velocity(g))".to_owned(),
        Action::Kick(weight) => format!("p = p {minus} h * {} * g", weight.name),
        Action::GradientKick(weight) => format!("p = p {plus} 2 * h * h * h * {} * w", weight.name),
        Action::Drift(weight) => format!("q = q {plus} h * {} * velocity(p)", weight.name),
    }
}
