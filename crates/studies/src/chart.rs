//! Charts: curves over two or three axes, as SVG pictures.
//!
//! A [`Chart`] has a title, two axes and curves. A curve is recognised by its marker and, beyond the ninth, by its
//! dashes as well as by its colour; the colours are those of Okabe and Ito, which people with any colour vision can
//! distinguish. Labels have the colours of their curves and stand at the right ends of these, without overlaps, or are
//! listed in their order. [`Chart::svg`] follows `prefers-color-scheme`; [`Chart::svg_for_print`] has fixed colours on
//! white.
//!
//! Axes are linear, or logarithmic: then the points hold log₁₀ of the values, so that 1e-400 is −400 instead of 0.
//! [`log10_of`] takes logarithms of plain numbers.
//!
//! ```
//! use shadowstep_studies::chart::{Axis, Chart, Curve, log10_of};
//!
//! let verlet = [(1e3, 2.1e-2), (2e3, 5.3e-3), (4e3, 1.3e-3)];
//! let yoshida = [(3e3, 4.0e-3), (6e3, 2.6e-4), (12e3, 1.6e-5)];
//! let chart = Chart::new(
//!     "Kepler, e = 0.6, over [0, 100]",
//!     Axis::log10("force evaluations"),
//!     Axis::log10("relative error of H"),
//!     vec![
//!         Curve::marked("Störmer–Verlet", log10_of(&verlet, (true, true)), 0),
//!         Curve::marked("Yoshida 4", log10_of(&yoshida, (true, true)), 1),
//!     ],
//! );
//! assert!(chart.svg().starts_with("<svg "));
//! ```
//!
//! | module | what it is |
//! | --- | --- |
//! | `draw` | the picture as a whole: title, axes, curves, labels, notes |
//! | `layout` | what the axes show, and the sizes of all parts |
//! | `clip` | the visible part of a curve |
//! | `thin` | lines of many points |
//! | `looks` | colours and dashes; samples with labels |

mod clip;
mod draw;
mod layout;
mod looks;
mod thin;

pub use crate::picture::markers::Marker;
use crate::picture::sheet::Sheet;
use crate::picture::ticks::Scale;
pub use crate::picture::ticks::power_of_ten;

/// The content of one picture.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Above the picture; T_{m,m} and E_40 get subscripts, here and in all labels.
    pub title: String,
    /// The axis below.
    pub x: Axis,
    /// The axis at the left.
    pub y: Axis,
    /// A second vertical axis, at the right.
    pub second_y: Option<Axis>,
    /// Values of x that matter.
    pub marks: Vec<Mark>,
    /// Labelled at their ends, or with a second axis in a legend above the chart.
    pub curves: Vec<Curve>,
    /// Short remarks below the chart.
    pub notes: Vec<String>,
    /// Whether one unit is as long on both axes, unless the curves are much longer in one direction.
    pub equal_scales: bool,
    /// Whether the labels are listed in the order of the curves, as for charts that are compared; else they stand where
    /// the curves end.
    pub listed: bool,
}

impl Chart {
    /// A chart without marks, notes, and a second vertical axis.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis, curves: Vec<Curve>) -> Self {
        Chart {
            title: title.into(),
            x,
            y,
            second_y: None,
            marks: Vec::new(),
            curves,
            notes: Vec::new(),
            equal_scales: false,
            listed: false,
        }
    }
}

/// (x, y) with log₁₀ of each coordinate whose axis is logarithmic. A value that is not positive becomes NaN, a missing
/// point.
pub fn log10_of(points: &[(f64, f64)], (x_is_log, y_is_log): (bool, bool)) -> Vec<(f64, f64)> {
    let log10 = |value: f64| if value > 0.0 { value.log10() } else { f64::NAN };
    let of = |value: f64, is_log: bool| if is_log { log10(value) } else { value };
    points.iter().map(|&(x, y)| (of(x, x_is_log), of(y, y_is_log))).collect()
}

/// The SVG text of charts below each other, for a file; `title` is the text of the whole for screen readers.
pub fn stacked(title: &str, charts: &[Chart]) -> String {
    let sheets: Vec<Sheet> = charts.iter().map(Chart::sheet).collect();
    Sheet::stacked(title, &sheets).svg()
}

/// A vertical line with a label.
#[derive(Clone, Debug)]
pub struct Mark {
    /// In the values of the axis.
    pub x: f64,
    /// Beside the line; without one, the line is all.
    pub label: String,
    /// The values of y between which a curve jumps there: the label stands in the middle of the jump.
    pub(crate) jump: Option<(f64, f64)>,
}

/// An axis along one side.
#[derive(Clone, Debug)]
pub struct Axis {
    /// The quantity, with its unit.
    pub label: String,
    /// Linear or logarithmic.
    pub(crate) scale: Scale,
    /// The smallest and the largest value; `None` for those of the curves with a margin.
    pub range: Option<(f64, f64)>,
}

impl Mark {
    /// A line at x, in the values of the axis.
    pub fn at(x: f64, label: impl Into<String>) -> Self {
        Mark { x, label: label.into(), jump: None }
    }

    /// The mark of a jump from one value of y to another.
    pub(crate) fn of_jump(self, from: f64, to: f64) -> Self {
        Mark { jump: Some((from, to)), ..self }
    }
}

impl Axis {
    /// An axis with the values themselves.
    pub fn linear(label: &str) -> Self {
        Axis { label: label.to_owned(), scale: Scale::Linear, range: None }
    }

    /// The axis from one value to another.
    pub fn over(self, least: f64, most: f64) -> Self {
        Axis { range: Some((least, most)), ..self }
    }

    /// An axis with decades, of the logarithms to the base 10.
    pub fn log10(label: &str) -> Self {
        Axis { label: label.to_owned(), scale: Scale::Log10, range: None }
    }
}

/// Points, and how they are shown.
#[derive(Clone, Debug)]
pub struct Curve {
    /// At its right end, or in the legend.
    pub label: String,
    /// In the order of the line; NaN and infinite values are missing points, which interrupt the line.
    pub points: Vec<(f64, f64)>,
    /// How it is drawn.
    pub(crate) look: Look,
    /// Whether it belongs to [`Chart::second_y`], if there is one.
    pub(crate) is_right: bool,
    /// The number of its colour, markers, and dashes. There are 9 colours, also of dashes, and 12 markers; a line with
    /// markers is dashed from the tenth on, so that 12 curves differ in print as well.
    pub colour: usize,
}

impl Curve {
    /// A line with a few of its points marked.
    pub fn line(label: impl Into<String>, points: Vec<(f64, f64)>, colour: usize) -> Self {
        Curve { label: label.into(), points, look: Look::Line, is_right: false, colour }
    }

    /// A line with all of its points marked: for few points, as of a work–precision diagram.
    pub fn marked(label: impl Into<String>, points: Vec<(f64, f64)>, colour: usize) -> Self {
        Curve { look: Look::Marked, ..Curve::line(label, points, colour) }
    }

    /// A broad line.
    pub fn thick(label: impl Into<String>, points: Vec<(f64, f64)>, colour: usize) -> Self {
        Curve { look: Look::Thick, ..Curve::line(label, points, colour) }
    }

    /// A dashed line.
    pub fn dashed(label: impl Into<String>, points: Vec<(f64, f64)>, colour: usize) -> Self {
        Curve { look: Look::Dashed, ..Curve::line(label, points, colour) }
    }

    /// Points without a line.
    pub fn dots(label: impl Into<String>, points: Vec<(f64, f64)>, colour: usize, marker: Marker) -> Self {
        Curve { look: Look::Points(marker), ..Curve::line(label, points, colour) }
    }

    /// Points without a line, with the markers of their colour.
    pub(crate) fn unjoined(label: impl Into<String>, points: Vec<(f64, f64)>, colour: usize) -> Self {
        Curve::dots(label, points, colour, Marker::of(colour))
    }

    /// The curve on the axis at the right.
    pub(crate) fn on_the_right(self) -> Self {
        Curve { is_right: true, ..self }
    }
}

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Look {
    /// A line; a few of its points are marked if there are other curves.
    Line,
    /// A line with all points marked.
    Marked,
    /// A dashed line, with the dashes of its colour.
    Dashed,
    /// A broad line.
    Thick,
    /// Points without a line.
    Points(Marker),
}

#[cfg(test)]
mod tests;
#[cfg(test)]
pub(crate) use tests::samples;
