//! Kepler's problem: the drift of several schemes, and of the exact flow.

use super::kepler::{FEW_STEPS, STEPS, drifts, rate, run};
use crate::drawing::{digits_held, drift_axis};
use crate::estimator::BEST;
use crate::figure::Figure;
use crate::fit::{DECAY_HEADER, Ratio, decay_row, logarithms, same_rates};
use crate::interval::Interval;
use crate::results::Results;
use crate::run::{EXACT_FLOW, SCHEMES};
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;

pub(super) const FIGURE: Figure = Figure {
    name: "kepler-schemes",
    title: "Kepler: three schemes, and the exact flow",
    of_paper: "section 5.2, text",
    draw,
};

/// The label of a scheme, and its drifts against 1/h.
type Labelled = (&'static str, Vec<(f64, f64)>);

/// The points with h ≤ 1/10.
fn fine(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    points.iter().copied().filter(|(n, _)| *n >= 10.0).collect()
}

fn draw(results: &Results) -> Finding {
    let mut finding = Finding::on(&[
        "The plots for the drift of Yoshida's method and of the Blanes–Moan method look the same as for \
         Störmer–Verlet; in particular the constant c in exp(−c/h) is the same.",
        "The drift of Störmer–Verlet is about a factor of three smaller than that of Yoshida's method and a factor of \
         four smaller than that of Blanes and Moan.",
        "The Blanes–Moan method has coordinate errors that are typically three orders of magnitude smaller than those \
         of Yoshida's method at the same computational cost.",
    ]);
    let steps = results.grid(&STEPS, &FEW_STEPS);
    let of = SCHEMES.map(|(scheme, label)| (label, drifts(results, scheme, steps, &BEST)));
    let control = drifts(results, EXACT_FLOW, steps, &BEST);
    let mut curves: Vec<_> =
        of.iter().enumerate().map(|(i, (label, points))| Curve::line(*label, points.clone(), i)).collect();
    curves.push(Curve::dashed("exact flow", control.clone(), 8));
    finding.chart(
        Chart::new("Kepler, e = 0.6, the best m up to 200", Axis::linear("1/h"), drift_axis(), curves),
        "Dashed: the same estimator on the exact flow, whose energy is −1/2 at every state.",
    );
    relative_to_the_flow(&mut finding, &of, &control);
    compare_drifts(&mut finding, &of);
    compare_rates(&mut finding, &of, &control);
    compare_coordinates(results, &mut finding);
    for (scheme, label) in SCHEMES.into_iter().skip(1) {
        digits_held(
            &mut finding,
            &format!("the drift of {label} at h = 1/20"),
            results.digits_held(&run(scheme, 20), &BEST, 200),
        );
    }
    finding
}

/// The drifts divided by that of the exact flow, which is the estimator's alone.
fn relative_to_the_flow(finding: &mut Finding, of: &[Labelled], control: &[(f64, f64)]) {
    let curve = |(i, (label, points)): (usize, &Labelled)| Curve::line(*label, logarithms(points, control), i);
    finding.chart(
        Chart::new(
            "Drifts relative to that of the exact flow",
            Axis::linear("1/h"),
            Axis::log10("drift / drift of the exact flow"),
            of.iter().enumerate().map(curve).collect(),
        ),
        "At 1 an estimator shows of a scheme what it shows of a trajectory whose energy does not change.",
    );
    let ratios = of.iter().filter_map(|(label, points)| Some((label, Ratio::of(&fine(points), &fine(control))?)));
    let ratios: Vec<_> = ratios.collect();
    let farthest = ratios.iter().map(|(_, ratio)| ratio.most.max(1.0 / ratio.least)).fold(1.0, f64::max);
    let list: Vec<_> =
        ratios.iter().map(|(label, ratio)| format!("{label} {:.2} to {:.2}", ratio.least, ratio.most)).collect();
    finding.highlight(format!(
        "In the paper's measure the exact flow of Kepler's problem (e = 0.6) drifts, too, although its energy does \
         not change: at h ≤ 1/10 the drifts of the schemes are within a factor of {farthest:.1} of its drift ({}).",
        list.join(", ")
    ));
}

/// The ratios of the drifts to that of the first scheme, against those that the paper states.
fn compare_drifts(finding: &mut Finding, of: &[Labelled]) {
    let [verlet, others @ ..] = of else { return };
    for ((label, points), stated) in others.iter().zip([3.0, 4.0, 4.0]) {
        let Some(ratio) = Ratio::of(&fine(points), &fine(&verlet.1)) else { continue };
        finding.check(
            format!("The drift of {label} is about {stated} times that of Störmer–Verlet."),
            format!("{ratio} times, over h ≤ 1/10; {} to {} counts as about", stated - 0.5, stated + 0.5),
            ratio.is_about(stated),
        );
    }
}

/// The rates of the schemes, which must be the same, and of the exact flow.
fn compare_rates(finding: &mut Finding, of: &[Labelled], control: &[(f64, f64)]) {
    let fits: Vec<_> = of.iter().map(|(label, points)| (*label, rate(points))).collect();
    if let [(_, Some(first)), others @ ..] = &fits[..] {
        let others: Vec<_> = others.iter().filter_map(|(label, fit)| Some((*label, fit.as_ref()?))).collect();
        let (verdict, found) = same_rates(first, &others);
        finding.check("The constant c is the same.", found, verdict);
    }
    let mut rows: Vec<_> = fits.iter().map(|(label, fit)| decay_row(label, fit.as_ref())).collect();
    rows.push(decay_row("exact flow", rate(control).as_ref()));
    finding.table("Rates", &DECAY_HEADER, rows);
}

/// Errors of the coordinates of Blanes and Moan's schemes at h, of six force evaluations per step, and of Yoshida's at
/// h/2, of three.
fn compare_coordinates(results: &Results, finding: &mut Finding) {
    let steps = results.grid(&[5, 6, 7, 8, 9, 10, 12, 14, 16, 20, 25, 30], &[5, 10, 20]);
    let of = |scheme: &'static str, n: u32, per_step: u32| {
        let cost = f64::from(n * per_step);
        let error = results.coordinate_error(&run(scheme, n)).unwrap_or(f64::NAN);
        (cost, error)
    };
    let yoshida: Vec<_> = steps.iter().map(|&n| of("yoshida4", 2 * n, 3)).collect();
    let mut curves = vec![Curve::line("Yoshida 4", yoshida.clone(), 1)];
    for (i, (scheme, label)) in SCHEMES.into_iter().enumerate().skip(2) {
        let points: Vec<_> = steps.iter().map(|&n| of(scheme, n, 6)).collect();
        let gains: Vec<f64> = points.iter().zip(&yoshida).map(|((_, own), (_, other))| other - own).collect();
        curves.push(Curve::line(label, points, i));
        let Some(gain) = Interval::of_mean(&gains) else { continue };
        let (least, most) = gains.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), y| (a.min(*y), b.max(*y)));
        finding.check(
            format!(
                "The coordinate errors of {label} are typically three orders of magnitude smaller than Yoshida's \
                at equal cost."
            ),
            format!(
                "by {gain} orders in the mean of {} costs, {least:.2} to {most:.2}; 2.5 to 3.5 counts as three",
                gain.count
            ),
            gain.within(2.5, 3.5),
        );
    }
    finding.chart(
        Chart::new(
            "Errors of the coordinates at equal cost",
            Axis::log10("force evaluations per unit of time"),
            Axis::log10("largest |q − q of the exact flow|"),
            curves
                .into_iter()
                .map(|mut curve| {
                    curve.points.iter_mut().for_each(|(x, _)| *x = x.log10());
                    curve
                })
                .collect(),
        ),
        "Kepler, e = 0.6, over [0, 100].",
    );
}
