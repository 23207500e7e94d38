//! Work–precision diagrams: errors against cost, a curve for each scheme.

use shadowstep_studies::chart::{Axis, Chart, Curve};

use crate::best::{self, cost_of};
use crate::of::Of;
use crate::size::Size;
use crate::study::{Cost, Study};

/// log₁₀ of the largest error that is drawn, as a part of the positions' size or of H: what is larger is lost.
const LARGEST: f64 = 1.0;
/// At most this number of curves can be distinguished.
const MOST_CURVES: usize = 12;
/// A scheme that does not meet an error counts as one that needs this multiple of the least.
const NOT_MET: f64 = 100.0;

/// The names of the charts' files.
pub(crate) const PICTURES: [&str; 4] = ["position-forces", "position-time", "energy-forces", "energy-time"];

/// A chart with the name of its file and its caption.
pub(crate) struct Picture {
    pub(crate) name: &'static str,
    pub(crate) caption: &'static str,
    pub(crate) chart: Chart,
}

impl Study<'_> {
    /// The errors of the position and of H, against evaluations and against time.
    pub(crate) fn pictures(&self, title: &str) -> Vec<Picture> {
        let each = [
            (
                Of::Position,
                Cost::Evaluations,
                "The error of the position at the end, |q − q of the reference|, against the evaluations of the gradient. Points are runs; \
                 schemes have them at equal numbers of evaluations, as nearly as whole steps allow.",
            ),
            (Of::Position, Cost::Seconds, "The same against the time of the steps alone."),
            (
                Of::Energy,
                Cost::Evaluations,
                "The largest |H(t) − H(0)|, as a part of |H(0)| unless that is 0, against the evaluations of the gradient.",
            ),
            (Of::Energy, Cost::Seconds, "The same against the time of the steps alone."),
        ];
        let picture = |(name, (of, cost, caption))| Picture { name, caption, chart: self.chart(title, of, cost) };
        PICTURES.into_iter().zip(each).map(picture).collect()
    }

    fn chart(&self, title: &str, of: Of, cost: Cost) -> Chart {
        let x = Axis::log10(match cost {
            Cost::Evaluations => "evaluations of the gradient",
            Cost::Seconds => "time of the steps in seconds",
        });
        let y = Axis::log10(of.name());
        let mut curves: Vec<_> =
            self.schemes.iter().map(|studied| studied.curve(of, cost, self.problem.system)).collect();
        let largest = LARGEST + if of == Of::Position { self.reference.size().log10() } else { 0.0 };
        without_lost_runs(&mut curves, largest);
        let shown = shown(&curves);
        let named = shown.iter().map(|&place| (self.schemes[place].scheme.name.clone(), curves[place].clone()));
        let curve = |(n, (name, curve)): (usize, (String, best::Curve))| {
            let points = until_round_off(curve).map(|(cost, log10)| (cost.log10(), log10)).collect();
            Curve::marked(name, points, n)
        };
        let mut chart = Chart::new(title, x, y, named.enumerate().map(curve).collect());
        if shown.len() < curves.len() {
            chart.notes.push(format!("The {} of {} schemes that need the least.", shown.len(), curves.len()));
        }
        chart
    }
}

/// Leaves out errors above the largest one, unless there are no others: energies in other units, if H(0) is 0.
fn without_lost_runs(curves: &mut [best::Curve], largest: f64) {
    let is_kept = |point: &(f64, f64)| point.1 <= largest;
    if largest.is_finite() && curves.iter().flatten().any(is_kept) {
        curves.iter_mut().for_each(|curve| curve.retain(is_kept));
    }
}

/// The curves that are drawn, in their order: those that need the least for an error of 1e-1, 1e-2, …, then those that need the least
/// more than these.
fn shown(curves: &[best::Curve]) -> Vec<usize> {
    let least = curves.iter().flatten().map(|(_, log10)| *log10).fold(0.0, f64::min);
    let mut extra = vec![0.0; curves.len()];
    let mut is_best = vec![false; curves.len()];
    for target in (1..=(-least) as u32).map(|decade| Size::power_of_ten(-f64::from(decade))) {
        let costs: Vec<Option<f64>> = curves.iter().map(|curve| cost_of(curve, target)).collect();
        let Some(lowest) = costs.iter().flatten().copied().reduce(f64::min) else { continue };
        for (place, cost) in costs.into_iter().enumerate() {
            extra[place] += cost.map_or(NOT_MET, |cost| (cost / lowest).min(NOT_MET)).ln();
            is_best[place] |= cost == Some(lowest);
        }
    }
    let mut places: Vec<usize> = (0..curves.len()).collect();
    places.sort_by(|&a, &b| is_best[b].cmp(&is_best[a]).then(extra[a].total_cmp(&extra[b])));
    places.truncate(MOST_CURVES);
    places.sort_unstable();
    places
}

/// Beyond the smallest error there is only round-off: two points show that.
fn until_round_off(curve: Vec<(f64, f64)>) -> impl Iterator<Item = (f64, f64)> {
    let least = (0..curve.len()).min_by(|&a, &b| curve[a].1.total_cmp(&curve[b].1)).unwrap_or(0);
    curve.into_iter().take(least + 3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_that_are_lost_are_not_drawn() {
        let mut curves = vec![vec![(1.0, 250.0), (2.0, -1.0), (4.0, -3.0)], vec![(1.0, 0.5)]];
        without_lost_runs(&mut curves, 1.0);
        assert_eq!(curves, [vec![(2.0, -1.0), (4.0, -3.0)], vec![(1.0, 0.5)]]);
        let mut in_other_units = vec![vec![(1.0, 8.0), (2.0, 7.0)]];
        without_lost_runs(&mut in_other_units, 1.0);
        assert_eq!(in_other_units, [[(1.0, 8.0), (2.0, 7.0)]]);
    }

    /// Twenty schemes of order 2, of which each is a little more expensive than the last; and one that is the best for small errors only.
    #[test]
    fn the_best_schemes_are_drawn() {
        let of_order =
            |order: f64, first: f64| (0..20).map(|i| (first * 2_f64.powi(i), -0.3 * order * f64::from(i))).collect();
        let mut curves: Vec<best::Curve> = (0..20).map(|n| of_order(2.0, 10.0 + f64::from(n))).collect();
        assert_eq!(shown(&curves[..12]), (0..12).collect::<Vec<_>>());
        curves.push(of_order(8.0, 1e4));
        let shown = shown(&curves);
        assert_eq!(shown, (0..11).chain([20]).collect::<Vec<_>>());
    }
}
