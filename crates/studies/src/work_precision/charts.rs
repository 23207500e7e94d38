//! Work–precision diagrams: errors against cost, a curve for each scheme.

use crate::chart::{Axis, Chart, Curve};
use crate::work_precision::best::{self, cost_of};
use crate::work_precision::of::Of;
use crate::work_precision::size::Size;
use crate::work_precision::study::{Cost, Study};

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
    /// The errors of the position and of H, against evaluations and against time: in all of them the same schemes, in
    /// one order and with the same looks.
    pub(crate) fn pictures(&self) -> Vec<Picture> {
        let each = [
            (
                Of::Position,
                Cost::Evaluations,
                "The error of the position at the end, |q − q of the reference|, against the evaluations of the \
                 gradient. Points are runs; schemes have them at equal numbers of evaluations, as nearly as whole \
                 steps allow.",
            ),
            (Of::Position, Cost::Seconds, "The same against the time of the steps alone."),
            (
                Of::Energy,
                Cost::Evaluations,
                "The largest |H(t) − H(0)|, as a part of |H(0)| unless that is 0, against the evaluations of the \
                    gradient.",
            ),
            (Of::Energy, Cost::Seconds, "The same against the time of the steps alone."),
        ];
        let of_each: Vec<_> = each.iter().map(|(of, cost, _)| self.curves(*of, *cost)).collect();
        let shown = shown(&of_each);
        let pictures = PICTURES.into_iter().zip(each).zip(&of_each);
        let picture = |((name, (of, cost, caption)), curves): (_, &Vec<_>)| {
            let chart = self.chart(of, cost, curves, &shown);
            Picture { name, caption, chart }
        };
        pictures.map(picture).collect()
    }

    /// A curve for each scheme.
    fn curves(&self, of: Of, cost: Cost) -> Vec<best::Curve> {
        let mut curves: Vec<_> =
            self.schemes.iter().map(|studied| studied.curve(of, cost, self.problem.system)).collect();
        let largest = LARGEST + if of == Of::Position { self.reference.size().log10() } else { 0.0 };
        without_lost_runs(&mut curves, largest);
        curves
    }

    fn chart(&self, of: Of, cost: Cost, curves: &[best::Curve], shown: &[usize]) -> Chart {
        let (x, against) = match cost {
            Cost::Evaluations => ("evaluations of the gradient", "evaluations"),
            Cost::Seconds => ("time of the steps in seconds", "time"),
        };
        let curve = |(n, &place): (usize, &usize)| {
            let points = until_round_off(&curves[place]).map(|(cost, log10)| (cost.log10(), log10)).collect();
            Curve::marked(self.schemes[place].scheme.name.clone(), points, n)
        };
        let curves_shown = shown.iter().enumerate().map(curve).collect();
        let title = format!("The {} against {against}", of.name());
        let mut chart = Chart::new(title, Axis::log10(x), Axis::log10(of.name()), curves_shown);
        chart.listed = true;
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

/// The schemes that are drawn, in their order: those that need the least for an error of 1e-1, 1e-2, … in any of the
/// charts, then those that need the least more than these.
fn shown(charts: &[Vec<best::Curve>]) -> Vec<usize> {
    let schemes = charts.first().map_or(0, Vec::len);
    let (mut extra, mut is_best) = (vec![0.0; schemes], vec![false; schemes]);
    charts.iter().for_each(|curves| rank(curves, &mut extra, &mut is_best));
    let mut places: Vec<usize> = (0..schemes).collect();
    places.sort_by(|&a, &b| is_best[b].cmp(&is_best[a]).then(extra[a].total_cmp(&extra[b])));
    places.truncate(MOST_CURVES);
    places.sort_unstable();
    places
}

/// Adds what each scheme needs more than the best ones in a chart, and which are the best.
fn rank(curves: &[best::Curve], extra: &mut [f64], is_best: &mut [bool]) {
    let least = curves.iter().flatten().map(|(_, log10)| *log10).fold(0.0, f64::min);
    for target in (1..=(-least) as u32).map(|decade| Size::power_of_ten(-f64::from(decade))) {
        let costs: Vec<Option<f64>> = curves.iter().map(|curve| cost_of(curve, target)).collect();
        let Some(lowest) = costs.iter().flatten().copied().reduce(f64::min) else { continue };
        for (place, cost) in costs.into_iter().enumerate() {
            extra[place] += cost.map_or(NOT_MET, |cost| (cost / lowest).min(NOT_MET)).ln();
            is_best[place] |= cost == Some(lowest);
        }
    }
}

/// Beyond the smallest error there is only round-off: two points show that.
fn until_round_off(curve: &best::Curve) -> impl Iterator<Item = (f64, f64)> {
    let least = (0..curve.len()).min_by(|&a, &b| curve[a].1.total_cmp(&curve[b].1)).unwrap_or(0);
    curve.iter().copied().take(least + 3)
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

    /// Twenty schemes of order 2, of which each is a little more expensive than the last; and one that is the best for
    /// small errors only.
    #[test]
    fn the_best_schemes_are_drawn() {
        let of_order =
            |order: f64, first: f64| (0..20).map(|i| (first * 2_f64.powi(i), -0.3 * order * f64::from(i))).collect();
        let mut curves: Vec<best::Curve> = (0..20).map(|n| of_order(2.0, 10.0 + f64::from(n))).collect();
        assert_eq!(shown(&[curves[..12].to_vec()]), (0..12).collect::<Vec<_>>());
        let others = curves.iter().cloned().chain([of_order(2.0, 100.0)]).collect();
        curves.push(of_order(8.0, 1e4));
        // the best in one chart is drawn in all
        assert_eq!(shown(&[curves, others]), (0..11).chain([20]).collect::<Vec<_>>());
    }
}
