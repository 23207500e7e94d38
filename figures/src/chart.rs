//! A chart: curves over two or three axes, as the text of an SVG picture.
//!
//! | file | what it is |
//! | --- | --- |
//! | [`draw`] | the picture as a whole: title, axes, curves, labels, notes |
//! | [`layout`] | what the axes show, and how much room everything takes |
//! | [`ticks`] | round numbers and decades on an axis |
//! | [`clip`] | what of a curve is visible |
//! | [`labels`] | texts beside the chart that do not overlap |
//! | [`looks`] | colours, dashes and markers |
//! | [`ink`] | what a style sheet can change: from plotters' plain colours to classes |

mod clip;
mod draw;
mod ink;
mod labels;
mod layout;
mod looks;
mod ticks;

/// What one picture shows.
#[derive(Clone, Debug)]
pub(crate) struct Chart {
    pub(crate) title: String,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    /// A second vertical axis, at the right.
    pub(crate) second_y: Option<Axis>,
    /// Without a second axis, each is labelled where it ends; else in a legend above the chart.
    pub(crate) curves: Vec<Curve>,
    /// Short remarks below the chart.
    pub(crate) notes: Vec<String>,
}

/// What is along one side.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    /// What it is, with its unit.
    pub(crate) label: String,
    pub(crate) scale: Scale,
    /// The least and the largest value; `None` for those of the curves and a little room.
    pub(crate) range: Option<(f64, f64)>,
}

impl Axis {
    /// An axis with the values themselves.
    pub(crate) fn linear(label: &str) -> Self {
        Axis { label: label.to_owned(), scale: Scale::Linear, range: None }
    }

    /// An axis with decades, of the logarithms to the base 10.
    pub(crate) fn log10(label: &str) -> Self {
        Axis { label: label.to_owned(), scale: Scale::Log10, range: None }
    }
}

/// How values are meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scale {
    /// The values themselves.
    Linear,
    /// log₁₀ of the values, so that 1e-400 is −400 and not 0.
    Log10,
}

/// Points, and how they are shown.
#[derive(Clone, Debug)]
pub(crate) struct Curve {
    pub(crate) label: String,
    /// In the order in which the line goes; NaN and infinite values are missing points, and break the line.
    pub(crate) points: Vec<(f64, f64)>,
    pub(crate) look: Look,
    pub(crate) side: Side,
    /// Its colour, markers, and dashes; after the ninth they come again.
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
    /// A line with a few of its points marked, where there are other curves.
    Line,
    /// Dashes that go with the colour.
    Dashed,
    /// A broad line.
    Thick,
    /// Each point, and no line.
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
    /// A full circle.
    Dot,
    /// A triangle on its tip.
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
