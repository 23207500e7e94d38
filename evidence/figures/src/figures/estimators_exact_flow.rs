//! Estimators on the exact flow, against the number of states that they use.

use super::estimators::{BEST_UP_TO, BILINEAR, CENTRAL, Family, ORDERS, STATES, against_states, even};
use super::kepler::run;
use crate::drawing::{additional, digits_held};
use crate::estimator::bilinear;
use crate::figure::Figure;
use crate::numbers::power;
use crate::results::Results;
use crate::run::EXACT_FLOW;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;

pub(super) const FIGURE: Figure =
    Figure { name: "estimators-exact-flow", title: "Estimators on the exact flow", of_paper: "", draw };

fn draw(results: &Results) -> Finding {
    let mut finding = additional(
        "The states of Kepler's exact flow (e = 0.6) at t = n h, with β along it: the modified energy of this \
            trajectory is −1/2 at every state, so all variation of the estimates is the estimator's own error.",
    );
    let orders = results.grid(&ORDERS, &[1, 3, 8, 24, 200]);
    for n in [10, 20, 40] {
        let exact = run(EXACT_FLOW, n);
        let central = against_states(results, &exact, CENTRAL, orders);
        let best = against_states(results, &exact, BEST_UP_TO, &orders[1..]);
        let bilinear = against_states(results, &exact, BILINEAR, &even(orders));
        let least = |points: &[(f64, f64)]| points.iter().map(|(_, y)| *y).fold(f64::INFINITY, f64::min);
        let states = |(_, states): Family, orders: &[u32]| orders.iter().map(|&order| states(order)).max().unwrap_or(0);
        finding.found(format!(
            "h = 1/{n}: the variation is {} by the best m with up to {} states, at least {} by these fixed m, and at \
                least {} by the bilinear estimator with up to {} states.",
            power(best.last().map_or(f64::NAN, |(_, y)| *y)),
            states(BEST_UP_TO, orders),
            power(least(&central)),
            power(least(&bilinear)),
            states(BILINEAR, &even(orders)),
        ));
        finding.chart(
            Chart::new(
                format!("Exact flow, Kepler, e = 0.6, h = 1/{n}"),
                Axis::log10(STATES),
                Axis::log10("max − min of the estimates"),
                vec![
                    Curve::line("T_{m,m}, every state the same m", central, 0),
                    Curve::line("best m up to a cap", best, 1),
                    Curve::line("bilinear E_k", bilinear, 2),
                ],
            ),
            "2m + 1 or k + 1 states.",
        );
    }
    let held = results.digits_held(&run(EXACT_FLOW, 20), &bilinear(16), 200);
    digits_held(&mut finding, "the drift of the exact flow at h = 1/20 by E_16", held);
    finding
}
