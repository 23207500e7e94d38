//! What the list knows about a scheme.

use serde::Serialize;
use shadowstep::tables::{Proved, TableScheme};
use shadowstep_analysis::error::LeadingError;
use shadowstep_analysis::stability::Stability;

use shadowstep_scenes::scheme_record::{aliases, digits, effective_near_integrable, kinetic, near_integrable};

#[derive(Serialize)]
pub(super) struct Record {
    pub(super) name: String,
    pub(super) shipped: bool,
    aliases: Vec<String>,
    /// Of a processed scheme the effective ones.
    #[serde(flatten)]
    pub(super) orders: Orders,
    /// Those of the kernel of a processed scheme.
    pub(super) kernel: Option<Orders>,
    /// Rows of the table of weights, those with a 0 included.
    pub(super) stages: usize,
    pub(super) evaluations: usize,
    /// One for each gradient kick.
    pub(super) hessian_products: usize,
    /// Products beside the forces, and as many additions.
    pub(super) products_per_dimension: usize,
    /// Products that a step carrying β adds, and as many additions.
    pub(super) products_for_beta: usize,
    pub(super) stability_limit: Option<String>,
    pub(super) stability_limit_per_force: Option<f64>,
    pub(super) symmetric: bool,
    kinetic: &'static str,
    /// Whether the order claimed holds for every T(p).
    #[serde(skip)]
    pub(super) moves_any: bool,
    pub(super) digits: Option<u32>,
    /// Whether there is an inner scheme: the other values are of the outer one.
    pub(super) is_nested: bool,
    title: Option<String>,
}

/// Orders and effective errors.
#[derive(Serialize)]
pub(super) struct Orders {
    /// For every T(p); `None` with gradient kicks, which there are for quadratic T only.
    pub(super) order: Option<u32>,
    pub(super) order_quadratic: u32,
    pub(super) near_integrable: Vec<u32>,
    /// For every T(p), as the order.
    pub(super) effective_error: Option<f64>,
    pub(super) effective_error_quadratic: f64,
}

impl Orders {
    fn of(
        order: Option<u32>,
        (order_quadratic, near_integrable): (u32, Vec<u32>),
        [general, quadratic]: &[LeadingError; 2],
        proved: &Proved,
    ) -> Orders {
        Orders {
            order,
            order_quadratic,
            near_integrable,
            effective_error: order.map(|_| general.effective(proved.plan.evaluations)),
            effective_error_quadratic: quadratic.effective(proved.plan.degree()),
        }
    }
}

impl Record {
    pub(super) fn of(name: &str, scheme: &TableScheme, shipped: bool) -> Record {
        let proved = scheme.proved();
        let (cost, evaluations) = (scheme.plan().cost(), proved.plan.evaluations);
        let order = proved.order_for_every_kinetic().map(|order| order.order);
        // not the whole analysis, which takes longer
        let of_kernel = (proved.proof.quadratic.order, near_integrable(&proved.proof));
        let of_kernel = Orders::of(order, of_kernel, &LeadingError::of(proved), proved);
        let effective = proved.proof.effective.as_ref().zip(LeadingError::processed(proved));
        let effective = effective.map(|(effective, errors)| {
            let orders = (effective.quadratic.order, effective_near_integrable(&proved.proof));
            Orders::of(order.map(|_| effective.general.order), orders, &errors, proved)
        });
        let (orders, kernel) = match effective {
            Some(effective) => (effective, Some(of_kernel)),
            None => (of_kernel, None),
        };
        let mut record = Record {
            name: name.to_owned(),
            shipped,
            aliases: aliases(&proved.scheme.table),
            orders,
            kernel,
            stages: proved.scheme.stages.kick.len(),
            evaluations,
            hessian_products: proved.plan.hessian_products,
            products_per_dimension: cost.products_per_dimension,
            products_for_beta: cost.products_for_beta,
            stability_limit: Stability::of_scheme(proved).map(|stability| stability.limit),
            stability_limit_per_force: None,
            symmetric: proved.proof.symmetric,
            kinetic: kinetic(proved.scheme.table.kinetic),
            moves_any: proved.holds_for_every_kinetic(),
            digits: digits(proved.scheme.held),
            is_nested: proved.scheme.inner.is_some(),
            title: proved.scheme.table.title.clone(),
        };
        record.stability_limit_per_force = record.limit().map(|limit| limit / proved.plan.degree() as f64);
        record
    }

    /// The stability limit as a number.
    pub(super) fn limit(&self) -> Option<f64> {
        self.stability_limit.as_ref()?.parse().ok()
    }
}
