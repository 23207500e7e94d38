//! Kepler's problem: the drift of several schemes, and of the exact flow.

use super::kepler::{fine, rate, run};
use crate::figures::prelude::*;

pub(super) fn draw(d: &mut Drawing<'_>) {
    let (of, control) = (d.family("drifts"), d.series("drifts", EXACT_FLOW));
    let mut curves = lines(&of, 0);
    curves.push(Curve::dashed(&control.label, control.points.clone(), 8));
    d.chart("drifts", curves);
    relative_to_the_flow(d, &of, &control.points);
    compare_drifts(d, &of);
    let mut fits: Vec<_> = of.iter().map(|series| (series.label.clone(), rate(&series.points))).collect();
    d.same_rates("The constant c is the same.", &fits);
    fits.push((control.label, rate(&control.points)));
    d.rates("Rates", fits, None);
    compare_coordinates(d);
}

/// The drifts divided by that of the exact flow, which is the estimator's alone.
fn relative_to_the_flow(d: &mut Drawing<'_>, of: &[Series], control: &[(f64, f64)]) {
    let relative: Vec<_> = of.iter().map(|series| series.relative_to(control)).collect();
    d.chart("relative", lines(&relative, 0));
    let ratios = of.iter().filter_map(|one| Some((&one.label, Ratio::of(&fine(&one.points), &fine(control))?)));
    let ratios: Vec<_> = ratios.collect();
    let farthest = ratios.iter().map(|(_, ratio)| ratio.most.max(1.0 / ratio.least)).fold(1.0, f64::max);
    let list: Vec<_> =
        ratios.iter().map(|(label, ratio)| format!("{label} {:.2} to {:.2}", ratio.least, ratio.most)).collect();
    d.finding.highlight(format!(
        "In the paper's measure the exact flow of Kepler's problem (e = 0.6) drifts, too, although its energy does \
         not change: at h ≤ 1/10 the drifts of the schemes are within a factor of {farthest:.1} of its drift ({}).",
        list.join(", ")
    ));
}

/// The ratios of the drifts to that of the first scheme, against those that the paper states.
fn compare_drifts(d: &mut Drawing<'_>, of: &[Series]) {
    let [verlet, others @ ..] = of else { return };
    for (Series { label, points }, stated) in others.iter().zip([3.0, 4.0, 4.0]) {
        let Some(ratio) = Ratio::of(&fine(points), &fine(&verlet.points)) else { continue };
        d.check(
            format!("The drift of {label} is about {stated} times that of Störmer–Verlet."),
            format!("{ratio} times, over h ≤ 1/10; {} to {} counts as about", stated - 0.5, stated + 0.5),
            ratio.is_about(stated),
        );
    }
}

/// Errors of the coordinates of Blanes and Moan's schemes beside those of Yoshida's at the same cost.
fn compare_coordinates(d: &mut Drawing<'_>) {
    let of = |scheme: &str, parts: u32, per_step: u32| -> Points {
        let steps = d.xs("coordinates").into_iter().map(|x| parts * x.parse::<u32>().expect("steps are numbers"));
        let error = |n: u32| d.results.coordinate_error(&run(scheme, n)).unwrap_or(f64::NAN);
        steps.map(|n| (f64::from(n * per_step).log10(), error(n))).collect()
    };
    let yoshida = of("yoshida4", 2, 3);
    let others: Vec<_> = d.cs("coordinates").iter().map(|scheme| of(scheme, 1, 6)).collect();
    let mut curves = vec![Curve::line("Yoshida 4", yoshida.clone(), 1)];
    for (i, points) in (2..).zip(others) {
        let label = SCHEMES[i].1;
        let gains: Vec<f64> = points.iter().zip(&yoshida).map(|((_, own), (_, other))| other - own).collect();
        curves.push(Curve::line(label, points, i));
        let Some(gain) = Interval::of_mean(&gains) else { continue };
        let (least, most) = range(gains);
        d.check(
            format!(
                "The coordinate errors of {label} are typically three orders of magnitude smaller than Yoshida's at \
                 equal cost."
            ),
            format!(
                "by {gain} orders in the mean of {} costs, {least:.2} to {most:.2}; 2.5 to 3.5 counts as three",
                gain.count
            ),
            gain.within(2.5, 3.5),
        );
    }
    d.chart("coordinates", curves);
}
