//! Where a file comes from: table, version, hash, proved orders, reference.

use shadowstep_scenes::library::weights_fingerprint;
use shadowstep_schemes::Proved;
use shadowstep_schemes::claims::HIGHEST_ORDER;
use shadowstep_schemes::proof::Order;

use crate::step::Step;
use crate::text::{commented, counted};

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
    let orders = orders(step.proved);
    match &proof.effective {
        None => format!("Proved: {orders}; {symmetric}symmetric."),
        Some(effective) => {
            let near = near_integrable(&effective.near_integrable);
            let quadratic = order(&effective.quadratic);
            format!(
                "Proved: order {quadratic} for quadratic T{near}, with pre-map and post-map; the steps alone: \
                    {orders}; {symmetric}symmetric."
            )
        }
    }
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

fn orders(proved: &Proved) -> String {
    let near = near_integrable(&proved.proof.near_integrable);
    let quadratic = &proved.proof.quadratic;
    match proved.order_for_every_kinetic() {
        Some(every) if every.order == quadratic.order => format!("order {} for every T(p){near}", order(every)),
        Some(every) => format!("order {} for every T(p), {} for quadratic T{near}", order(every), order(quadratic)),
        None => format!("order {} for quadratic T{near}", order(quadratic)),
    }
}

fn near_integrable(orders: &[Order]) -> String {
    let orders: Vec<_> = orders.iter().map(|order| order.order.to_string()).collect();
    if orders.is_empty() { String::new() } else { format!(", ({}) for H = A + εB", orders.join(",")) }
}

/// `4 (exactly)`, `4 (to 248 digits)`
fn order(order: &Order) -> String {
    let least = if order.failed.is_none() && order.order == HIGHEST_ORDER { " or more" } else { "" };
    match order.digits {
        None => format!("{}{least} (exactly)", order.order),
        Some(digits) => format!("{}{least} (to {digits} digits)", order.order),
    }
}
