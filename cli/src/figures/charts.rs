//! Short ways to say what a chart has.

use super::chart::{Axis, Curve, Look, Marker, Scale, Side};

/// An axis with the values themselves.
pub(crate) fn linear(label: &str) -> Axis {
    Axis { label: label.to_owned(), scale: Scale::Linear, range: None }
}

/// An axis with decades.
pub(crate) fn log10_axis(label: &str) -> Axis {
    Axis { label: label.to_owned(), scale: Scale::Log10, range: None }
}

/// A line with a few of its points marked.
pub(crate) fn line(label: impl Into<String>, points: Vec<(f64, f64)>, colour: usize) -> Curve {
    Curve { label: label.into(), points, look: Look::Line, side: Side::First, colour }
}

/// A broad line.
pub(crate) fn thick(label: impl Into<String>, points: Vec<(f64, f64)>, colour: usize) -> Curve {
    Curve { look: Look::Thick, ..line(label, points, colour) }
}

/// Dashes.
pub(crate) fn dashed(label: impl Into<String>, points: Vec<(f64, f64)>, colour: usize) -> Curve {
    Curve { look: Look::Dashed, ..line(label, points, colour) }
}

/// Points only.
pub(crate) fn dots(label: impl Into<String>, points: Vec<(f64, f64)>, colour: usize, marker: Marker) -> Curve {
    Curve { look: Look::Points(marker), ..line(label, points, colour) }
}

/// On the axis at the right.
pub(crate) fn right(curve: Curve) -> Curve {
    Curve { side: Side::Second, ..curve }
}
