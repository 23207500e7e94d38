//! A chart: curves over two or three axes, as an SVG picture.
//!
//! | file | what it is |
//! | --- | --- |
//! | [`draw`] | the picture as a whole: title, axes, curves, labels, notes |
//! | [`layout`] | what the axes show, and the sizes of all parts |
//! | [`ticks`] | round numbers and decades on an axis |
//! | [`clip`] | the visible part of a curve |
//! | [`labels`] | labels beside the chart, without overlaps |
//! | [`looks`] | colours, dashes and markers |
//! | [`ink`] | from the plain colours of plotters to classes that a style sheet can change |

mod clip;
mod draw;
mod ink;
mod labels;
mod layout;
mod looks;
mod ticks;

pub(crate) use ticks::power_of_ten;

/// The content of one picture.
#[derive(Clone, Debug)]
pub(crate) struct Chart {
    pub(crate) title: String,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    /// A second vertical axis, at the right.
    pub(crate) second_y: Option<Axis>,
    /// Values of x that matter.
    pub(crate) marks: Vec<Mark>,
    /// Labelled at their ends, or with a second axis in a legend above the chart.
    pub(crate) curves: Vec<Curve>,
    /// Short remarks below the chart.
    pub(crate) notes: Vec<String>,
}

/// A vertical line with a label.
#[derive(Clone, Debug)]
pub(crate) struct Mark {
    pub(crate) x: f64,
    pub(crate) label: String,
}

/// An axis along one side.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    /// The quantity, with its unit.
    pub(crate) label: String,
    pub(crate) scale: Scale,
    /// The smallest and the largest value; `None` for those of the curves with a margin.
    pub(crate) range: Option<(f64, f64)>,
}

impl Mark {
    pub(crate) fn at(x: f64, label: impl Into<String>) -> Self {
        Mark { x, label: label.into() }
    }
}

impl Axis {
    /// An axis with the values themselves.
    pub(crate) fn linear(label: &str) -> Self {
        Axis { label: label.to_owned(), scale: Scale::Linear, range: None }
    }

    /// The axis from one value to another.
    pub(crate) fn over(self, least: f64, most: f64) -> Self {
        Axis { range: Some((least, most)), ..self }
    }

    /// The axis of drifts over [0, 100].
    pub(crate) fn drift() -> Self {
        Axis::log10("drift of the modified energy over [0, 100]")
    }

    /// An axis with decades, of the logarithms to the base 10.
    pub(crate) fn log10(label: &str) -> Self {
        Axis { label: label.to_owned(), scale: Scale::Log10, range: None }
    }
}

/// The scale of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scale {
    /// The values themselves.
    Linear,
    /// log₁₀ of the values, so that 1e-400 is −400 instead of 0.
    Log10,
}

/// Points, and how they are shown.
#[derive(Clone, Debug)]
pub(crate) struct Curve {
    pub(crate) label: String,
    /// In the order of the line; NaN and infinite values are missing points, which interrupt the line.
    pub(crate) points: Vec<(f64, f64)>,
    pub(crate) look: Look,
    pub(crate) side: Side,
    /// The number of its colour, markers, and dashes, which repeat after the ninth.
    pub(crate) colour: usize,
}

impl Curve {
    /// A line with a few of its points marked.
    pub(crate) fn line(label: impl Into<String>, points: Vec<(f64, f64)>, colour: usize) -> Self {
        Curve { label: label.into(), points, look: Look::Line, side: Side::First, colour }
    }

    /// A broad line.
    pub(crate) fn thick(label: impl Into<String>, points: Vec<(f64, f64)>, colour: usize) -> Self {
        Curve { look: Look::Thick, ..Curve::line(label, points, colour) }
    }

    /// A dashed line.
    pub(crate) fn dashed(label: impl Into<String>, points: Vec<(f64, f64)>, colour: usize) -> Self {
        Curve { look: Look::Dashed, ..Curve::line(label, points, colour) }
    }

    /// Points without a line.
    pub(crate) fn dots(label: impl Into<String>, points: Vec<(f64, f64)>, colour: usize, marker: Marker) -> Self {
        Curve { look: Look::Points(marker), ..Curve::line(label, points, colour) }
    }

    /// The curve on the axis at the right.
    pub(crate) fn on_the_right(self) -> Self {
        Curve { side: Side::Second, ..self }
    }
}

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Look {
    /// A line; a few of its points are marked if there are other curves.
    Line,
    /// A dashed line, with the dashes of its colour.
    Dashed,
    /// A broad line.
    Thick,
    /// Points without a line.
    Points(Marker),
}

/// The shape of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Marker {
    Circle,
    Square,
    Triangle,
    Diamond,
    /// ×
    Cross,
    Plus,
    /// A filled circle.
    Dot,
    /// A triangle that points down.
    Nabla,
    Star,
}

/// Which vertical axis a curve belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    First,
    /// [`Chart::second_y`]; without one, the first.
    Second,
}

#[cfg(test)]
mod tests;
#[cfg(test)]
pub(crate) use tests::samples;
