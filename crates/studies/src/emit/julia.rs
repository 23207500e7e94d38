//! A Julia module.

use crate::emit::language::{Direction, Language};
use crate::emit::step::{Action, Step, Weight, literal};

const JULIA: Language = Language { comment: "#", constant, literal, action };

/// The module.
pub(crate) fn module(step: &Step<'_>) -> String {
    let mut values = JULIA.values(step);
    let products = if step.has_gradient_kicks() { ", hessian_product" } else { "" };
    let module: String = step.identifier().split('_').map(capitalised).collect();
    values.text("module", module).text("functions", format!("gradient{products}"));
    values.fill(include_str!("templates/julia.jl"))
}

fn capitalised(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

fn constant(weight: &Weight) -> String {
    format!("const {} = {}", weight.name, weight.literal())
}

fn action(action: Action<'_>, direction: Direction) -> String {
    let [minus, plus] = ['-', '+'].map(|sign| direction.signed(sign));
    match action {
        Action::Gradient => "g = gradient(q)".to_owned(),
        Action::Curvature => "w = hessian_product(q, velocity(g))".to_owned(),
        Action::Kick(weight) => format!("p = p .{minus} (h * {}) .* g", weight.name),
        Action::GradientKick(weight) => format!("p = p .{plus} (2 * h * h * h * {}) .* w", weight.name),
        Action::Drift(weight) => format!("q = q .{plus} (h * {}) .* velocity(p)", weight.name),
    }
}
