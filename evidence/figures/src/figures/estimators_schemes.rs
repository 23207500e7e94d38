//! Estimators on schemes, against the number of states that they use.

use super::estimators::{BEST_UP_TO, BILINEAR, Family, ORDERS, STATES, against_states, even};
use super::kepler::run;
use crate::drawing::{additional, drift_axis};
use crate::estimator::{BEST, bilinear};
use crate::figure::Figure;
use crate::fit::logarithms;
use crate::numbers::power;
use crate::results::Results;
use crate::run::{EXACT_FLOW, SCHEMES};
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;

pub(super) const FIGURE: Figure =
    Figure { name: "estimators-schemes", title: "Estimators on schemes", of_paper: "", draw };

fn draw(results: &Results) -> Finding {
    let mut finding = additional(
        "The same estimators on schemes, Kepler, e = 0.6, h = 1/20, and the permanent change between low-error states.",
    );
    let orders = results.grid(&ORDERS, &[1, 3, 8, 24, 200]);
    let mut chart = |title: &str, family: Family, orders: &[u32]| {
        let mut curves: Vec<Curve> = Vec::new();
        for (i, (scheme, label)) in SCHEMES.into_iter().enumerate() {
            curves.push(Curve::line(label, against_states(results, &run(scheme, 20), family, orders), i));
        }
        let control = against_states(results, &run(EXACT_FLOW, 20), family, orders);
        let relative = curves
            .iter()
            .cloned()
            .map(|mut curve| {
                curve.points = logarithms(&curve.points, &control);
                curve
            })
            .collect();
        curves.push(Curve::dashed("exact flow", control, 8));
        finding.chart(
            Chart::new(format!("{title}, h = 1/20"), Axis::log10(STATES), drift_axis(), curves),
            "All estimates are of the same states.",
        );
        finding.chart(
            Chart::new(
                format!("{title}, relative to the exact flow, h = 1/20"),
                Axis::log10(STATES),
                Axis::log10("drift / drift of the exact flow"),
                relative,
            ),
            "At 1 an estimator shows of a scheme what it shows of a trajectory whose energy does not change.",
        );
    };
    chart("Best m up to a cap", BEST_UP_TO, &orders[1..]);
    chart("Bilinear E_k", BILINEAR, &even(orders));
    let mut rows = Vec::new();
    for (scheme, label) in SCHEMES.into_iter().chain([(EXACT_FLOW, "exact flow")]) {
        let [best, bilinear] = [BEST, bilinear(50)].map(|by| results.sizes(&run(scheme, 20), &by));
        let (Some(best), Some(bilinear)) = (best, bilinear) else { continue };
        let permanent = bilinear.permanent.map_or("not resolved".to_owned(), |(change, _)| power(change));
        rows.push(vec![label.to_owned(), power(best.drift), power(bilinear.drift), permanent]);
    }
    finding.table("h = 1/20", &["", "drift by the best m ≤ 200", "drift by E_50", "permanent change"], rows);
    finding
}
