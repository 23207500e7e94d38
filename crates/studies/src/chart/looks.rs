//! Colours, dashes and markers: a curve is recognised by more than its colour.

use super::{Curve, Marker};

/// The colours of Okabe and Ito (2008), which people with any colour vision can distinguish, and a grey; the most
/// different first. The yellow is darker here, because a thin yellow line is not visible on white.
const COLOURS: [&str; 9] =
    ["#000000", "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#777777", "#B5A500"];

/// Black and the dark blue have lighter forms on dark screens.
pub(super) const BLACK: usize = 0;
pub(super) const BLUE: usize = 1;

pub(super) const COUNT: usize = COLOURS.len();

pub(super) fn colour(index: usize) -> &'static str {
    COLOURS[index % COUNT]
}

/// Lengths of dashes and gaps.
pub(super) fn dashes(index: usize) -> &'static [u32] {
    const DASHES: [&[u32]; COUNT] = [
        &[7, 4],
        &[2, 3],
        &[12, 4],
        &[8, 3, 2, 3],
        &[4, 4],
        &[12, 3, 2, 3, 2, 3],
        &[1, 5],
        &[16, 5],
        &[8, 3, 2, 3, 2, 3, 2, 3],
    ];
    DASHES[index % COUNT]
}

pub(super) fn marker(index: usize) -> Marker {
    const MARKERS: [Marker; 12] = [
        Marker::Circle,
        Marker::Square,
        Marker::Triangle,
        Marker::Diamond,
        Marker::Cross,
        Marker::Nabla,
        Marker::Plus,
        Marker::Dot,
        Marker::Star,
        Marker::FilledSquare,
        Marker::FilledTriangle,
        Marker::FilledDiamond,
    ];
    MARKERS[index % MARKERS.len()]
}

impl Curve {
    /// Points without a line, with the markers of their colour.
    pub fn unjoined(label: impl Into<String>, points: Vec<(f64, f64)>, colour: usize) -> Self {
        Curve::dots(label, points, colour, marker(colour))
    }
}

/// A shape about a point.
pub(super) enum Shape {
    Strokes(Vec<Vec<(i32, i32)>>),
    Filled(Vec<(i32, i32)>),
    Circle { filled: bool },
}

impl Marker {
    pub(super) fn shape(self, (x, y): (i32, i32), radius: f64) -> Shape {
        let at = |(dx, dy): (f64, f64)| (x + (dx * radius).round() as i32, y + (dy * radius).round() as i32);
        let path = |corners: &[(f64, f64)]| corners.iter().chain(corners.first()).copied().map(at).collect();
        let closed = |corners: &[(f64, f64)]| Shape::Strokes(vec![path(corners)]);
        let square = [(-0.85, -0.85), (0.85, -0.85), (0.85, 0.85), (-0.85, 0.85)];
        let triangle = [(0.0, -1.15), (1.05, 0.7), (-1.05, 0.7)];
        let diamond = [(0.0, -1.25), (1.0, 0.0), (0.0, 1.25), (-1.0, 0.0)];
        let strokes =
            |lines: &[[(f64, f64); 2]]| Shape::Strokes(lines.iter().map(|ends| ends.map(at).to_vec()).collect());
        let plus = [[(-1.1, 0.0), (1.1, 0.0)], [(0.0, -1.1), (0.0, 1.1)]];
        let cross = [[(-0.85, -0.85), (0.85, 0.85)], [(-0.85, 0.85), (0.85, -0.85)]];
        match self {
            Marker::Circle => Shape::Circle { filled: false },
            Marker::Dot => Shape::Circle { filled: true },
            Marker::Square => closed(&square),
            Marker::Triangle => closed(&triangle),
            Marker::Nabla => closed(&[(0.0, 1.15), (1.05, -0.7), (-1.05, -0.7)]),
            Marker::Diamond => closed(&diamond),
            Marker::FilledSquare => Shape::Filled(path(&square)),
            Marker::FilledTriangle => Shape::Filled(path(&triangle)),
            Marker::FilledDiamond => Shape::Filled(path(&diamond)),
            Marker::Plus => strokes(&plus),
            Marker::Cross => strokes(&cross),
            Marker::Star => strokes(&[plus[0], plus[1], cross[0], cross[1]]),
        }
    }
}
