//! The places and sizes of all parts of a chart.

use super::looks::in_legend;
use super::{Axis, Chart, Curve};
use crate::picture::elements::{LINE, MARGIN, Place, Point, TEXT};
use crate::picture::sheet::{Texts, in_rows};
use crate::picture::side::{Direction, Side, TICK};
use crate::picture::text::width;
use crate::picture::ticks::{SMALLEST, Scale};

/// Between the plot and the labels of curves.
pub(super) const GAP: f64 = 14.0;
/// From the left end of a sample of a curve to its label.
pub(super) const SAMPLE: f64 = 31.0;
/// For the labels and the description of the horizontal axis.
pub(super) const UNDER: f64 = 2.0 * TICK + 2.0 * LINE + 4.0;
const WIDTH: f64 = 660.0;
const LEAST_PLOT_WIDTH: f64 = 400.0;
const PLOT_HEIGHT: f64 = 330.0;
/// Ranges of more different lengths have no common scale.
const MOST_UNEQUAL: f64 = 5.0;
/// The approximate number of intervals between labels.
const INTERVALS: f64 = 7.0;

impl Axis {
    /// The axis over these values with a margin, as for charts that are compared; NaN and infinite values are left out.
    pub fn around(self, values: impl Iterator<Item = f64>) -> Self {
        Axis { range: Some(extent(values, self.scale)), ..self }
    }
}

/// The range of an axis, with its labels.
pub(super) struct Span {
    pub(super) range: (f64, f64),
    scale: Scale,
    pub(super) side: Side,
}

impl Span {
    fn of(axis: &Axis, values: impl Iterator<Item = f64>, direction: Direction) -> Span {
        let range = axis.range.map(|(a, b)| (a.min(b), a.max(b))).filter(|&range| axis.scale.has_ticks(range));
        Span::over(range.unwrap_or_else(|| extent(values, axis.scale)), axis.scale, direction)
    }

    fn over(range: (f64, f64), scale: Scale, direction: Direction) -> Span {
        // the plot is so large that labels do not touch
        let side = Side::round(scale, range, INTERVALS, f64::INFINITY, direction);
        Span { range, scale, side: side.unwrap_or_else(|| Side::of([], Vec::new(), direction)) }
    }

    /// The span that is longer by this factor, with the same middle.
    fn widened(self, times: f64) -> Span {
        let (middle, half) = (f64::midpoint(self.range.0, self.range.1), (self.range.1 - self.range.0) / 2.0);
        Span::over((middle - times * half, middle + times * half), self.scale, self.side.direction)
    }

    /// The part of the axis before a value.
    pub(super) fn part(&self, value: f64) -> f64 {
        (value - self.range.0) / (self.range.1 - self.range.0)
    }

    /// The width of the labels of a vertical axis, with its description.
    pub(super) fn room(&self) -> f64 {
        self.side.width() + 2.0 * TICK + LINE + 2.0
    }
}

/// From the smallest to the largest value that an axis can show, with a margin.
fn extent(values: impl Iterator<Item = f64>, scale: Scale) -> (f64, f64) {
    let usable = values.filter(|value| value.abs() < scale.largest());
    let (least, most) = usable.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), value| (a.min(value), b.max(value)));
    if least > most {
        return (0.0, 1.0);
    }
    if !scale.has_ticks((least, most)) {
        let half = if scale == Scale::Log10 || least.abs() < SMALLEST { 1.0 } else { least.abs() / 2.0 };
        return (least - half, most + half);
    }
    let room = 0.03 * (most - least);
    (least - room, most + room)
}

/// The places of all parts.
pub(super) struct Layout {
    pub(super) x: Span,
    pub(super) y: Span,
    pub(super) second: Option<Span>,
    pub(super) plot: Place,
    pub(super) texts: Texts,
    /// The left ends of the entries of a legend.
    pub(super) legend: Vec<Point>,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Layout {
    pub(super) fn of(chart: &Chart) -> Layout {
        let has_second = chart.second_y.is_some();
        let all = || chart.curves.iter().flat_map(|curve| &curve.points);
        let on = |right: bool| {
            let of_side = move |curve: &&Curve| !has_second || curve.is_right == right;
            chart.curves.iter().filter(of_side).flat_map(|curve| &curve.points).map(|point| point.1)
        };
        let x = Span::of(&chart.x, all().map(|point| point.0), Direction::Below);
        let y = Span::of(&chart.y, on(false), Direction::Left);
        let second = chart.second_y.as_ref().map(|axis| Span::of(axis, on(true), Direction::Right));
        let widest = chart.curves.iter().map(|curve| width(&curve.label, TEXT)).fold(0.0, f64::max);
        let right = MARGIN + second.as_ref().map_or(GAP + SAMPLE + widest, Span::room);
        let picture = WIDTH.max(MARGIN + y.room() + LEAST_PLOT_WIDTH + right);
        let texts = Texts::of(&chart.title, &chart.notes, picture);
        let (mut top, mut legend, mut least) = (texts.top() + 8.0, Vec::new(), PLOT_HEIGHT);
        if has_second {
            let entries = chart.curves.iter().map(|curve| SAMPLE + width(&in_legend(curve), TEXT));
            legend = in_rows(entries, (MARGIN, picture - MARGIN), top - 4.0 + LINE / 2.0);
            top = legend.last().map_or(top, |(_, y)| y + LINE / 2.0 + 6.0);
        } else {
            least = least.max((chart.curves.len() + 1) as f64 * LINE);
        }
        let (x, y, height) = match chart.equal_scales {
            true => with_equal_scales((x, y), picture - MARGIN - right, least),
            false => (x, y, least),
        };
        let left = MARGIN + y.room();
        let plot = Place { left, top, width: picture - right - left, height };
        let height = plot.bottom() + UNDER + texts.below();
        Layout { x, y, second, plot, texts, legend, width: picture, height }
    }
}

/// Both axes with one scale, and the height of the plot. A high range of y makes the plot higher, up to a square;
/// beyond, one of the ranges becomes longer. Axes of which one would be much too long stay as they are.
fn with_equal_scales((x, y): (Span, Span), room: f64, least: f64) -> (Span, Span, f64) {
    let ratio = |x: &Span, y: &Span| (y.range.1 - y.range.0) / (x.range.1 - x.range.0);
    if !(1.0 / MOST_UNEQUAL..=MOST_UNEQUAL).contains(&ratio(&x, &y)) {
        return (x, y, least);
    }
    let width = room - y.room();
    let natural = ratio(&x, &y) * width;
    let times = natural / natural.clamp(least, least.max(width));
    let (x, y) = if times > 1.0 { (x.widened(times), y) } else { (x, y.widened(1.0 / times)) };
    // the labels of a longer range may be wider
    let height = ratio(&x, &y) * (room - y.room());
    (x, y, height)
}
