//! Work–precision diagrams: errors against cost, a curve for each scheme.

use shadowstep_report::chart::{Axis, Chart, Curve};

use crate::of::Of;
use crate::study::{Cost, Study};

/// A chart with the end of its file's name and its caption.
pub(crate) struct Picture {
    pub(crate) name: &'static str,
    pub(crate) caption: &'static str,
    pub(crate) chart: Chart,
}

impl Study<'_> {
    /// The errors of the position and of H, against evaluations and against time.
    pub(crate) fn pictures(&self, title: &str) -> Vec<Picture> {
        let chart = |name, of, cost, caption| Picture { name, caption, chart: self.chart(title, of, cost) };
        vec![
            chart(
                "position-forces",
                Of::Position,
                Cost::Evaluations,
                "The error of the position at the end, |q − q of the reference|, against the evaluations of the gradient. Points are runs; \
                 schemes have them at equal numbers of evaluations, as nearly as whole steps allow.",
            ),
            chart("position-time", Of::Position, Cost::Seconds, "The same against the time of the steps alone."),
            chart(
                "energy-forces",
                Of::Energy,
                Cost::Evaluations,
                "The largest |H(t) − H(0)|, as a part of |H(0)| unless that is 0, against the evaluations of the gradient.",
            ),
            chart("energy-time", Of::Energy, Cost::Seconds, "The same against the time of the steps alone."),
        ]
    }

    fn chart(&self, title: &str, of: Of, cost: Cost) -> Chart {
        let x = Axis::log10(match cost {
            Cost::Evaluations => "evaluations of the gradient",
            Cost::Seconds => "time of the steps in seconds",
        });
        let y = Axis::log10(of.name());
        let curve = |(n, studied): (usize, &crate::study::Studied<'_>)| {
            let points = until_round_off(studied.curve(of, cost)).map(|(cost, log10)| (cost.log10(), log10)).collect();
            Curve::marked(studied.scheme.name.clone(), points, n)
        };
        Chart::new(title, x, y, self.schemes.iter().enumerate().map(curve).collect())
    }
}

/// Beyond the smallest error there is only round-off: two points show that.
fn until_round_off(curve: Vec<(f64, f64)>) -> impl Iterator<Item = (f64, f64)> {
    let least = (0..curve.len()).min_by(|&a, &b| curve[a].1.total_cmp(&curve[b].1)).unwrap_or(0);
    curve.into_iter().take(least + 3)
}
