//! Where a file comes from: table, version, hash, proved orders, reference.

use shadowstep_scenes::library::weights_fingerprint;
use shadowstep_schemes::{Orders, counted};

use crate::emit::step::Step;
use crate::emit::text::commented;

/// The lines of provenance, as comments.
pub(crate) fn lines(step: &Step<'_>, sign: &str) -> Vec<String> {
    let table = &step.proved.scheme.table;
    let doi = table.doi.as_ref().map_or(String::new(), |doi| format!(", https://doi.org/{doi}"));
    let lines = [
        format!("{}: {}", step.name(), table.title.as_deref().unwrap_or("a splitting scheme")),
        String::new(),
        table.reference.as_ref().map_or_else(|| "Unpublished.".to_owned(), |reference| format!("{reference}{doi}")),
        proved(step),
        format!(
            "Emitted by Shadowstep {} from the table {}, hash of its weights {}.",
            env!("CARGO_PKG_VERSION"),
            step.name(),
            weights_fingerprint(step.proved)
        ),
    ];
    commented(sign, &lines)
}

/// What is proved.
pub(crate) fn proved(step: &Step<'_>) -> String {
    let proof = &step.proved.proof;
    let symmetric = if proof.symmetric { "" } else { "not " };
    let of_steps = orders(step.proved.orders_of_steps());
    if proof.effective.is_none() {
        return format!("Proved: {of_steps}; {symmetric}symmetric.");
    }
    let effective = step.proved.orders();
    format!(
        "Proved: order {} for quadratic T{}, with pre-map and post-map; the steps alone: {of_steps}; \
            {symmetric}symmetric.",
        effective.quadratic,
        near_integrable(effective)
    )
}

/// What a step costs.
pub(crate) fn cost(step: &Step<'_>) -> String {
    let plan = &step.proved.plan;
    let gradients = counted(plan.evaluations, "evaluation");
    match plan.hessian_products {
        0 => format!("{gradients} of U_q"),
        products => format!("{gradients} of U_q and {} U_qq v", counted(products, "product")),
    }
}

fn orders(orders: Orders<'_>) -> String {
    let (near, quadratic) = (near_integrable(orders), orders.quadratic);
    match orders.general {
        Some(every) if every.order == quadratic.order => format!("order {every} for every T(p){near}"),
        Some(every) => format!("order {every} for every T(p), {quadratic} for quadratic T{near}"),
        None => format!("order {quadratic} for quadratic T{near}"),
    }
}

fn near_integrable(orders: Orders<'_>) -> String {
    orders.and_in_epsilon().replace("for A", "for H = A")
}
