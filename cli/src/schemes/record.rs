//! What the list knows about a scheme.

use serde::Serialize;
use shadowstep::tables::TableScheme;
use shadowstep_analysis::error::LeadingError;
use shadowstep_analysis::stability::Stability;

use shadowstep_scenes::scheme_record::{aliases, digits, effective_near_integrable, kinetic, near_integrable};

#[derive(Serialize)]
pub(super) struct Record {
    pub(super) name: String,
    pub(super) shipped: bool,
    aliases: Vec<String>,
    /// For every T(p); `None` with gradient kicks, which there are for quadratic T only.
    pub(super) order: Option<u32>,
    pub(super) order_quadratic: u32,
    pub(super) near_integrable: Vec<u32>,
    /// The effective orders of a processed scheme, for every T(p), quadratic T and A + εB; the others are those of its kernel.
    pub(super) effective_order: Option<u32>,
    pub(super) effective_order_quadratic: Option<u32>,
    pub(super) effective_near_integrable: Vec<u32>,
    /// Rows of the table of weights, those with a 0 included.
    pub(super) stages: usize,
    pub(super) evaluations: usize,
    /// One for each gradient kick.
    pub(super) hessian_products: usize,
    /// Products beside the forces, and as many additions.
    pub(super) products_per_dimension: usize,
    /// Products that a step carrying β adds, and as many additions.
    pub(super) products_for_beta: usize,
    /// For every T(p), as the order.
    pub(super) effective_error: Option<f64>,
    pub(super) effective_error_quadratic: f64,
    pub(super) stability_limit: Option<String>,
    pub(super) stability_limit_per_force: Option<f64>,
    pub(super) symmetric: bool,
    kinetic: &'static str,
    /// Whether the order claimed holds for every T(p).
    #[serde(skip)]
    pub(super) moves_any: bool,
    pub(super) digits: Option<u32>,
    title: Option<String>,
}

impl Record {
    pub(super) fn of(name: &str, scheme: &TableScheme, shipped: bool) -> Record {
        let proved = scheme.proved();
        let (cost, evaluations) = (scheme.plan().cost(), proved.plan.evaluations);
        let order = proved.order_for_every_kinetic().map(|order| order.order);
        // not the whole analysis, which takes longer
        let [general, quadratic] = LeadingError::of(proved);
        let mut record = Record {
            name: name.to_owned(),
            shipped,
            aliases: aliases(&proved.scheme.table),
            order,
            order_quadratic: proved.proof.quadratic.order,
            near_integrable: near_integrable(&proved.proof),
            effective_order: order.and(proved.proof.effective.as_ref()).map(|effective| effective.general.order),
            effective_order_quadratic: proved.proof.effective.as_ref().map(|effective| effective.quadratic.order),
            effective_near_integrable: effective_near_integrable(&proved.proof),
            stages: proved.scheme.stages.kick.len(),
            evaluations,
            hessian_products: proved.plan.hessian_products,
            products_per_dimension: cost.products_per_dimension,
            products_for_beta: cost.products_for_beta,
            effective_error: order.map(|_| general.effective(evaluations)),
            effective_error_quadratic: quadratic.effective(proved.plan.degree()),
            stability_limit: Stability::of_scheme(proved).map(|stability| stability.limit),
            stability_limit_per_force: None,
            symmetric: proved.proof.symmetric,
            kinetic: kinetic(proved.scheme.table.kinetic),
            moves_any: proved.holds_for_every_kinetic(),
            digits: digits(proved.scheme.held),
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
