//! Kepler's problem: the drift against the eccentricity.

use super::kepler::run;
use crate::chart::{Axis, Curve};
use crate::drawing::Drawing;
use crate::estimator::BEST;
use crate::figure::Figure;
use crate::numbers::power;
use crate::results::Results;
use crate::run::Run;

pub(super) const FIGURE: Figure =
    Figure { name: "kepler-eccentricity", title: "Kepler: drift against the eccentricity", draw };

/// The smallest e with which the body escapes, to a thousandth.
fn escapes(results: &Results, n: u32, coarse: &[u32]) -> Option<f64> {
    // a bound orbit stays within 1 + e, its precession included
    let escapes = |e: u32| Some(results.farthest(&of(n, e))? > 3.0);
    let first = coarse.iter().position(|&e| escapes(e) == Some(true))?;
    let (mut bound, mut escaped) = (*coarse.get(first.checked_sub(1)?)?, coarse[first]);
    while escaped - bound > 1 {
        let middle = u32::midpoint(bound, escaped);
        match escapes(middle)? {
            true => escaped = middle,
            false => bound = middle,
        }
    }
    Some(f64::from(escaped) / 1000.0)
}

/// Störmer–Verlet with h = 1/n and e in thousandths.
fn of(n: u32, e: u32) -> Run {
    run("stormer-verlet", n).with("eccentricity", format!("{e}/1000"))
}

fn draw(results: &Results) -> Drawing {
    let mut drawing = Drawing::of_paper(&[
        "Almost circular orbits show much better preservation of the energy than highly elliptical ones.",
        "An instability occurs at a critical eccentricity which depends on the step size: the topology of the energy levels of the modified \
         energy changes, which leads to unbounded trajectories.",
    ]);
    let grid: Vec<u32> = (1..=19).map(|n| 50 * n).collect();
    let thousandths = results.grid(&grid, &[50, 300, 600, 750, 900]);
    let fine: Vec<u32> = grid.iter().copied().chain([970, 990]).collect();
    let (mut curves, mut rows) = (Vec::new(), Vec::new());
    for (i, n) in [5, 10, 20, 40].into_iter().enumerate() {
        let points: Vec<_> =
            thousandths.iter().map(|&e| (f64::from(e) / 1000.0, results.log10_drift(&of(n, e), &BEST))).collect();
        let escape = escapes(results, n, &fine);
        rows.push(vec![format!("1/{n}"), escape.map_or("none below 0.99".to_owned(), |e| format!("{e:.3}"))]);
        if let (Some((_, least)), Some((_, middle))) = (points.first(), points.iter().find(|(e, _)| *e >= 0.6)) {
            drawing.check(
                &format!("h = 1/{n}: almost circular orbits preserve it much better."),
                format!("{} at e = 0.05, {} at e = 0.6 or the next value of the grid", power(*least), power(*middle)),
                *least < middle - 3.0,
            );
        }
        curves.push(Curve::line(format!("h = 1/{n}"), points, i));
    }
    let located: Vec<&String> = rows.iter().map(|row| &row[1]).filter(|e| !e.starts_with("none")).collect();
    if !located.is_empty() {
        let grows = located.windows(2).all(|pair| pair[0] < pair[1]);
        let list = rows.iter().map(|row| format!("{} at h = {}", row[1], row[0])).collect::<Vec<_>>().join(", ");
        drawing.check("An instability occurs at a critical eccentricity which depends on the step size.", list, grows);
    }
    drawing.digits_held("the drift at h = 1/20, e = 0.8", results.digits_held(&of(20, 800), &BEST, 200));
    drawing.table("The smallest eccentricity for which |q| exceeds 3 before t = 100", &["h", "e"], rows);
    drawing.chart(
        "Störmer–Verlet, Kepler",
        Axis::linear("eccentricity e"),
        Axis::drift(),
        curves,
        "The best m of each state, up to 200.",
    );
    drawing
}
