//! Estimators on the exact flow and on schemes, against the number of states that they use.

use crate::figures::prelude::*;

pub(super) fn on_the_exact_flow(d: &mut Drawing<'_>) {
    for n in d.cs("central") {
        let all = ["central", "best", "bilinear"].map(|family| d.series(family, &n));
        let [central, best, bilinear] = &all;
        let least = |one: &Series| power(range(one.points.iter().map(|(_, y)| *y)).0);
        let states = |one: &Series| 10_f64.powf(range(one.points.iter().map(|(x, _)| *x)).1);
        d.found(format!(
            "h = 1/{n}: the variation is {} by the best m with up to {:.0} states, at least {} by these fixed m, and at \
             least {} by the bilinear estimator with up to {:.0} states.",
            power(best.points.last().map_or(f64::NAN, |(_, y)| *y)),
            states(best),
            least(central),
            least(bilinear),
            states(bilinear),
        ));
        d.chart_of("variation", &[("n", &n)], lines(&all, 0));
    }
}

pub(super) fn on_schemes(d: &mut Drawing<'_>) {
    for family in ["best", "bilinear"] {
        let (of, control) = (d.family(family), d.series(family, EXACT_FLOW));
        let relative: Vec<_> = of.iter().map(|series| series.relative_to(&control.points)).collect();
        let mut curves = lines(&of, 0);
        curves.push(Curve::dashed(control.label, control.points, 8));
        d.chart(family, curves);
        d.chart(&format!("{family}_relative"), lines(&relative, 0));
    }
    let mut rows = Vec::new();
    for (scheme, label) in SCHEMES.into_iter().chain([(EXACT_FLOW, "exact flow")]) {
        let [best, bilinear] = [("best", "200"), ("bilinear", "50")].map(|(family, k)| d.sizes(family, scheme, k));
        let (Some(best), Some(bilinear)) = (best, bilinear) else { continue };
        let permanent = bilinear.permanent.map_or("not resolved".to_owned(), |(change, _)| power(change));
        rows.push(vec![label.to_owned(), power(best.drift), power(bilinear.drift), permanent]);
    }
    d.finding.table("h = 1/20", &["", "drift by the best m ≤ 200", "drift by E_50", "permanent change"], rows);
}
