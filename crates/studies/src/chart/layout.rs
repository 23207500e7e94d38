//! The places and sizes of all parts of a chart.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

use super::{Axis, Chart, Curve, Scale, Side};
use crate::labels::{BOLD, lines, width};
use crate::picture::{LINE, MARGIN, TEXT, TICK, TITLE};
use crate::ticks::{SMALLEST, Ticks, has_ticks, largest};

// sizes in pixels
/// Between the plot and the labels of curves.
pub(super) const GAP: f64 = 14.0;
/// The sample of a curve beside its label.
pub(super) const SAMPLE: f64 = 26.0;
/// For the labels and the description of the horizontal axis.
pub(super) const UNDER: f64 = 2.0 * TICK + 2.0 * LINE + 4.0;
const WIDTH: f64 = 660.0;
const LEAST_PLOT_WIDTH: f64 = 400.0;
const PLOT_HEIGHT: f64 = 330.0;
/// Ranges of more different lengths have no common scale.
const MOST_UNEQUAL: f64 = 5.0;

/// The range and the ticks of an axis.
pub(super) struct Span {
    pub(super) range: (f64, f64),
    pub(super) ticks: Ticks,
}

impl Span {
    fn of(axis: &Axis, values: impl Iterator<Item = f64>) -> Span {
        let range = axis.range.map(|(a, b)| (a.min(b), a.max(b)));
        let range = range.filter(|&range| has_ticks(range, axis.scale)).unwrap_or_else(|| extent(values, axis.scale));
        Span { range, ticks: Ticks::new(axis.scale, range) }
    }

    /// The span that is longer by this factor, with the same middle.
    fn widened(self, times: f64, scale: Scale) -> Span {
        let (middle, half) = (f64::midpoint(self.range.0, self.range.1), (self.range.1 - self.range.0) / 2.0);
        let range = (middle - times * half, middle + times * half);
        Span { range, ticks: Ticks::new(scale, range) }
    }

    /// The width of the labels of a vertical axis, with its description.
    pub(super) fn room(&self) -> f64 {
        let widest = self.ticks.labelled.iter().map(|(_, label)| width(label, TEXT)).fold(0.0, f64::max);
        widest + 2.0 * TICK + LINE + 2.0
    }
}

impl Ranged for &Span {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (start, end): (i32, i32)) -> i32 {
        let (least, most) = self.range;
        start + (f64::from(end - start) * (value - least) / (most - least)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        // the grid has lines at labels only
        if hint.weight().allow_light_points() { Vec::new() } else { self.ticks.values() }
    }

    fn range(&self) -> Range<f64> {
        self.range.0..self.range.1
    }
}

impl ValueFormatter<f64> for &Span {
    fn format(value: &f64) -> String {
        value.to_string()
    }

    fn format_ext(&self, value: &f64) -> String {
        self.ticks.label(*value)
    }
}

/// From the smallest to the largest value that an axis can show, with a margin.
fn extent(values: impl Iterator<Item = f64>, scale: Scale) -> (f64, f64) {
    let usable = values.filter(|value| value.abs() < largest(scale));
    let (least, most) = usable.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), value| (a.min(value), b.max(value)));
    if least > most {
        return (0.0, 1.0);
    }
    if !has_ticks((least, most), scale) {
        let half = if scale == Scale::Log10 || least.abs() < SMALLEST { 1.0 } else { least.abs() / 2.0 };
        return (least - half, most + half);
    }
    let room = 0.03 * (most - least);
    (least - room, most + room)
}

/// The places of all parts, in pixels.
pub(super) struct Layout {
    pub(super) x: Span,
    pub(super) y: Span,
    pub(super) second: Span,
    pub(super) title: Vec<String>,
    /// The left ends of the entries of a legend.
    pub(super) legend: Vec<(f64, f64)>,
    pub(super) notes: Vec<String>,
    pub(super) above: f64,
    pub(super) below: f64,
    pub(super) right: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Layout {
    pub(super) fn of(chart: &Chart) -> Layout {
        let on = |side: Side| {
            let of_side = move |curve: &&Curve| chart.second_y.is_none() || curve.side == side;
            chart.curves.iter().filter(of_side).flat_map(|curve| &curve.points)
        };
        let x = Span::of(&chart.x, chart.curves.iter().flat_map(|curve| &curve.points).map(|point| point.0));
        let y = Span::of(&chart.y, on(Side::First).map(|point| point.1));
        let second = Span::of(chart.second_y.as_ref().unwrap_or(&chart.y), on(Side::Second).map(|point| point.1));
        let (right, beside) = match &chart.second_y {
            Some(_) => (MARGIN, second.room()),
            None => {
                let widest = chart.curves.iter().map(|curve| width(&curve.label, TEXT)).fold(0.0, f64::max);
                (GAP + SAMPLE + 5.0 + widest + MARGIN, 0.0)
            }
        };
        let picture = WIDTH.max(MARGIN + y.room() + LEAST_PLOT_WIDTH + beside + right);
        let title = lines(&chart.title, picture - 2.0 * MARGIN, TITLE * BOLD);
        let notes: Vec<_> =
            chart.notes.iter().flat_map(|note| lines(note, picture - 2.0 * MARGIN, TEXT * 0.9)).collect();
        let top = MARGIN + title.len() as f64 * (LINE + 2.0) + 4.0;
        let legend = match &chart.second_y {
            Some(_) => legend(chart, picture, top + LINE / 2.0),
            None => Vec::new(),
        };
        let above = legend.last().map_or(top + 4.0, |(_, y)| y + LINE / 2.0 + 6.0);
        let below = MARGIN + notes.len() as f64 * LINE + if notes.is_empty() { 0.0 } else { 8.0 };
        let plot = if chart.second_y.is_some() { 0.0 } else { (chart.curves.len() + 1) as f64 * LINE };
        let (x, y, plot) = match chart.equal_scales {
            true => with_equal_scales(chart, (x, y), picture - MARGIN - beside - right, plot.max(PLOT_HEIGHT)),
            false => (x, y, plot.max(PLOT_HEIGHT)),
        };
        let height = above + plot + UNDER + below;
        Layout { x, y, second, title, legend, notes, above, below, right, width: picture, height }
    }
}

/// Both axes with one scale, and the height of the plot. A high range of y makes the plot higher, up to a square;
/// beyond, one of the ranges becomes longer. Axes of which one would be much too long stay as they are.
fn with_equal_scales(chart: &Chart, (x, y): (Span, Span), room: f64, least: f64) -> (Span, Span, f64) {
    let ratio = |x: &Span, y: &Span| (y.range.1 - y.range.0) / (x.range.1 - x.range.0);
    if !(1.0 / MOST_UNEQUAL..=MOST_UNEQUAL).contains(&ratio(&x, &y)) {
        return (x, y, least);
    }
    let width = room - y.room();
    let natural = ratio(&x, &y) * width;
    let times = natural / natural.clamp(least, least.max(width));
    let (x, y) = match times > 1.0 {
        true => (x.widened(times, chart.x.scale), y),
        false => (x, y.widened(1.0 / times, chart.y.scale)),
    };
    // the labels of a longer range may be wider
    let height = ratio(&x, &y) * (room - y.room());
    (x, y, height)
}

/// Entries from left to right, in as many rows as necessary.
fn legend(chart: &Chart, picture: f64, top: f64) -> Vec<(f64, f64)> {
    let (mut x, mut y) = (MARGIN, top);
    let mut places = Vec::new();
    for curve in &chart.curves {
        let entry = SAMPLE + 5.0 + width(&in_legend(curve), TEXT);
        if x > MARGIN && x + entry > picture - MARGIN {
            (x, y) = (MARGIN, y + LINE + 2.0);
        }
        places.push((x, y));
        x += entry + 20.0;
    }
    places
}

/// The label of a curve, with its axis if that is the right one.
pub(super) fn in_legend(curve: &Curve) -> String {
    let right = if curve.side == Side::Second { " (right axis)" } else { "" };
    format!("{}{right}", curve.label)
}
