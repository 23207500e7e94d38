//! The schemes of the results: those found, and the shipped ones of the same order and class.

use shadowstep_analysis::search::{Goal, Measure, Request, Search};
use shadowstep_schemes::{Kinetic, Proved, shipped_names, shipped_proved};

/// A scheme of the results.
pub(super) struct Row {
    pub(super) name: String,
    pub(super) forces: usize,
    pub(super) values: Vec<f64>,
    /// Whether its measures were minimised here.
    pub(super) is_new: bool,
}

/// A scheme with its measures.
pub(super) fn row(search: &Search, name: String, proved: &Proved) -> Row {
    let values = measures(&search.request).into_iter().map(|measure| search.measure(measure, proved)).collect();
    let forces = proved.plan.evaluations + proved.plan.hessian_products;
    Row { name, forces, values, is_new: false }
}

/// The measures of the goal, and a second one for the picture.
pub(super) fn measures(request: &Request) -> Vec<Measure> {
    let mut measures = request.goal.measures();
    if measures.len() == 1 {
        let other = if measures[0] == Measure::Instability { Measure::EffectiveError } else { Measure::Instability };
        measures.push(other);
    }
    measures
}

/// The shipped schemes of the same order and class.
pub(super) fn published(search: &Search) -> Vec<Row> {
    let request = &search.request;
    let is_alike = |proved: &&Proved| {
        let table = &proved.scheme.table;
        // of a processed scheme the effective ones
        let (order, claims) = match &table.processor {
            Some(processor) => (processor.order.value, &processor.near_integrable),
            None => (table.order.value, &table.near_integrable),
        };
        // what holds for every T(p) holds for a quadratic one
        let kinetic = request.kinetic == Kinetic::Quadratic || table.kinetic == Kinetic::Any;
        let mut claims = claims.iter().flat_map(|claim| &claim.orders).map(|order| order.value);
        let order = match request.near_integrable.is_empty() {
            true => order == request.order && claims.next().is_none(),
            false => claims.eq(request.near_integrable.iter().copied()),
        };
        // one that is not symmetric has no sampling error
        let measured = proved.proof.symmetric || !request.goal.measures().contains(&Measure::SamplingError);
        kinetic
            && order
            && measured
            && table.processor.is_some() == request.processor.is_some()
            && table.inner.is_none()
    };
    let schemes = shipped_names().into_iter().filter_map(shipped_proved).filter(is_alike);
    let mut rows: Vec<Row> =
        schemes.map(|proved| row(search, proved.scheme.table.name.value.clone(), proved)).collect();
    let by = |row: &Row| match &request.goal {
        Goal::Sum(weighed) => weighed.iter().zip(&row.values).map(|((_, factor), value)| factor * value).sum::<f64>(),
        Goal::Front(_) => row.values[0],
    };
    rows.sort_by(|a, b| by(a).total_cmp(&by(b)));
    rows
}

impl Row {
    /// Its cells in tables, one for each column of [`header`].
    pub(super) fn cells(&self) -> Vec<String> {
        let name = if self.is_new { self.name.clone() } else { format!("{} (shipped)", self.name) };
        [name, self.forces.to_string()].into_iter().chain(self.values.iter().map(|value| short(*value))).collect()
    }
}

/// The columns of tables.
pub(super) fn header(request: &Request) -> Vec<&'static str> {
    ["scheme", "forces"].into_iter().chain(measures(request).into_iter().map(Measure::name)).collect()
}

/// Five digits.
fn short(value: f64) -> String {
    if value != 0.0 && value.abs() < 1e-3 { format!("{value:.4e}") } else { format!("{value:.5}") }
}
