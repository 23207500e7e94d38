//! A scheme of the list.

use shadowstep_scenes::object::{Json, Object};
use shadowstep_scenes::scheme_record::{Accuracy, SchemeFacts};
use shadowstep_schemes::{Kinetic, Proved};

pub(super) struct Listed<'a> {
    /// By which it is asked for.
    pub(super) name: &'a str,
    shipped: bool,
    pub(super) facts: SchemeFacts<'a>,
}

impl<'a> Listed<'a> {
    pub(super) fn of(name: &'a str, proved: &'a Proved, shipped: bool) -> Self {
        Listed { name, shipped, facts: SchemeFacts::of(proved) }
    }

    /// Whether there is an inner scheme: the other values are of the outer one.
    pub(super) fn is_nested(&self) -> bool {
        self.facts.proved.scheme.inner.is_some()
    }

    /// What the list has of it as JSON.
    pub(super) fn record(&self) -> Object {
        let facts = &self.facts;
        let mut all = vec![("name", self.name.into()), ("shipped", self.shipped.into())];
        all.extend(facts.some(&["aliases"]));
        all.extend(orders(&facts.accuracy()));
        all.push(("kernel", facts.kernel().map(|kernel| Object(orders(&kernel))).into()));
        all.extend(facts.some(&["stages", "evaluations", "hessian_products"]));
        all.extend(facts.some(&["products_per_dimension", "products_for_beta", "stability_limit"]));
        all.push(("stability_limit_per_force", facts.limit_per_force().into()));
        all.extend(facts.some(&["symmetric", "kinetic", "digits"]));
        all.push(("is_nested", self.is_nested().into()));
        all.extend(facts.some(&["title"]));
        Object(all)
    }
}

fn orders(accuracy: &Accuracy<'_>) -> Vec<(&'static str, Json)> {
    let mut facts = accuracy.some(&["order", "order_quadratic", "near_integrable"]);
    facts.push(("effective_error", effective_error(accuracy).into()));
    facts.extend(accuracy.some(&["effective_error_quadratic"]));
    facts
}

/// The effective error for every T(p), where there is such an order.
pub(super) fn effective_error(accuracy: &Accuracy<'_>) -> Option<f64> {
    accuracy.orders.general.map(|_| accuracy.effective_error(Kinetic::Any))
}
