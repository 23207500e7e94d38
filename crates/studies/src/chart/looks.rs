//! Colours and dashes of curves, and the labels with samples of them.

use maud::{Markup, html};

use super::{Curve, Look};
use crate::picture::elements::{BLACK, Ink, Point, START, Stroke, TEXT, Type, filled, line, path, text};
use crate::picture::markers::Marker;

/// The colours of Okabe and Ito (2008), which people with any colour vision can distinguish, and a grey; the most
/// different first, with their dashes. The yellow is darker here, because a thin yellow line is not visible on white.
/// Black and the dark blue have lighter forms on dark screens.
const INKS: [(Ink, &str); 9] = [
    (BLACK, "7 4"),
    (Ink { colour: "#0072B2", class: Some("blue") }, "2 3"),
    (plain("#D55E00"), "12 4"),
    (plain("#009E73"), "8 3 2 3"),
    (plain("#CC79A7"), "4 4"),
    (plain("#E69F00"), "12 3 2 3 2 3"),
    (plain("#56B4E9"), "1 5"),
    (plain("#777777"), "16 5"),
    (plain("#B5A500"), "8 3 2 3 2 3 2 3"),
];

const fn plain(colour: &'static str) -> Ink {
    Ink { colour, class: None }
}

const RADIUS: f64 = 4.0;
/// The length of the sample of a curve.
const SAMPLE: f64 = 26.0;

impl Curve {
    pub(super) fn ink(&self) -> Ink {
        INKS[self.colour % INKS.len()].0
    }

    pub(super) fn stroke(&self) -> Stroke {
        // beyond the colours, a line with markers is dashed
        let (width, is_dashed) = match self.look {
            Look::Dashed => (1.8, true),
            Look::Thick => (3.6, false),
            Look::Line | Look::Marked | Look::Points(_) => (1.6, self.colour >= INKS.len()),
        };
        let dashes = if is_dashed { INKS[self.colour % INKS.len()].1 } else { "" };
        Stroke { ink: self.ink(), width, dashes }
    }

    /// The marker of its points, also of those that no line shows.
    fn marker(&self) -> Marker {
        if let Look::Points(marker) = self.look { marker } else { Marker::of(self.colour) }
    }

    /// Markers at these places.
    pub(super) fn marks(&self, places: impl IntoIterator<Item = Point>) -> Markup {
        let (ink, marker) = (self.ink(), self.marker());
        let commands: String = places.into_iter().map(|at| marker.drawn(at, RADIUS)).collect();
        if marker.is_filled() && !commands.is_empty() { filled(&commands, ink) } else { path(&commands, ink, 1.5) }
    }

    /// A sample and the label, to the right of a place and vertically centred on it.
    pub(super) fn labelled(&self, (x, y): Point, has_markers: bool, label: &str) -> Markup {
        let is_line = !matches!(self.look, Look::Points(_));
        let of = Type { anchor: START, size: TEXT, ink: self.ink() };
        html! {
            @if is_line { (line(&[(x, y), (x + SAMPLE, y)], self.stroke())) }
            @if has_markers { (self.marks([(x + SAMPLE / 2.0, y)])) }
            (text((x + SAMPLE + 5.0, y), of, label))
        }
    }
}

/// The label of a curve, with its axis if that is the right one.
pub(super) fn in_legend(curve: &Curve) -> String {
    format!("{}{}", curve.label, if curve.is_right { " (right axis)" } else { "" })
}
