//! A module of Fortran 2008.

use crate::emit::language::{Direction, Language};
use crate::emit::step::{Action, Step, Weight, literal};

const FORTRAN: Language = Language { comment: "!", constant, literal: double, action };

/// The module.
pub(crate) fn module(step: &Step<'_>) -> String {
    let mut values = FORTRAN.values(step);
    let products = if step.has_gradient_kicks() { ", hessian_product" } else { "" };
    values.text("functions", format!("gradient{products}"));
    let derivatives = if step.kept.curvature { ", g, w" } else { ", g" };
    values.text("kept_arguments", if step.kept.gradient { derivatives } else { "" });
    values.fill(include_str!("templates/fortran.F90"))
}

fn double(value: f64) -> String {
    format!("{}_dp", literal(value))
}

fn constant(weight: &Weight) -> String {
    format!("real(dp), parameter :: {} = {}", weight.name, double(weight.double()))
}

fn action(action: Action<'_>, direction: Direction) -> String {
    let [minus, plus] = ['-', '+'].map(|sign| direction.signed(sign));
    match action {
        Action::Gradient => "call gradient(q, g)".to_owned(),
        Action::Curvature => "call curvature(q, g, w, hessian_product, velocity)".to_owned(),
        Action::Kick(weight) => format!("p = p {minus} (h * {}) * g", weight.name),
        Action::GradientKick(weight) => format!("p = p {plus} (2 * h * h * h * {}) * w", weight.name),
        Action::Drift(weight) => format!("call drift({} * {}, p, q, velocity)", direction.step_size(), weight.name),
    }
}
