//! Shapes about a point: a curve, a word or a special value is recognised by more than its colour.

use super::elements::{Point, commands, length};

/// The shape of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// ○
    Circle,
    /// □
    Square,
    /// △
    Triangle,
    /// ◇
    Diamond,
    /// ×
    Cross,
    /// +
    Plus,
    /// ●
    Dot,
    /// ▽
    Nabla,
    /// + and × together
    Star,
    /// ■
    FilledSquare,
    /// ▲
    FilledTriangle,
    /// ◆
    FilledDiamond,
}

/// A line through points in units of a radius, to the right and downwards.
type Line = &'static [Point];

const SQUARE: Line = &[(-0.85, -0.85), (0.85, -0.85), (0.85, 0.85), (-0.85, 0.85), (-0.85, -0.85)];
const TRIANGLE: Line = &[(0.0, -1.15), (1.05, 0.7), (-1.05, 0.7), (0.0, -1.15)];
const NABLA: Line = &[(0.0, 1.15), (1.05, -0.7), (-1.05, -0.7), (0.0, 1.15)];
const DIAMOND: Line = &[(0.0, -1.25), (1.0, 0.0), (0.0, 1.25), (-1.0, 0.0), (0.0, -1.25)];
const RISING: Line = &[(-0.85, 0.85), (0.85, -0.85)];
const FALLING: Line = &[(-0.85, -0.85), (0.85, 0.85)];
const LEVEL: Line = &[(-1.1, 0.0), (1.1, 0.0)];
const UPRIGHT: Line = &[(0.0, -1.1), (0.0, 1.1)];

/// A shape of lines.
pub(crate) type Shape = &'static [Line];

/// Those of words; the first has none.
pub(crate) const OF_WORDS: [Shape; 12] = [
    &[],
    &[RISING],
    &[FALLING, RISING],
    &[LEVEL],
    &[LEVEL, UPRIGHT],
    &[SQUARE],
    &[TRIANGLE],
    &[DIAMOND],
    &[UPRIGHT],
    &[FALLING],
    &[LEVEL, UPRIGHT, FALLING, RISING],
    &[NABLA],
];

/// Those of 0, negative numbers, −∞ and ∞, where the scale does not contain them.
pub(crate) const OF_SPECIAL: [Shape; 4] = [&[SQUARE], &[LEVEL], &[FALLING, RISING, LEVEL], &[FALLING, RISING]];

/// The commands of a shape about a point, as a part of a path.
pub(crate) fn drawn(shape: Shape, (x, y): Point, radius: f64) -> String {
    shape.iter().map(|line| commands(line.iter().map(|(dx, dy)| (x + dx * radius, y + dy * radius)))).collect()
}

impl Marker {
    /// The marker of the curve of a colour.
    pub(crate) fn of(colour: usize) -> Marker {
        use Marker::{Circle, Cross, Diamond, Dot, FilledDiamond, FilledSquare, FilledTriangle, Nabla, Plus};
        use Marker::{Square, Star, Triangle};
        const ALL: [Marker; 12] = [
            Circle,
            Square,
            Triangle,
            Diamond,
            Cross,
            Nabla,
            Plus,
            Dot,
            Star,
            FilledSquare,
            FilledTriangle,
            FilledDiamond,
        ];
        ALL[colour % ALL.len()]
    }

    pub(crate) fn is_filled(self) -> bool {
        matches!(self, Marker::Dot | Marker::FilledSquare | Marker::FilledTriangle | Marker::FilledDiamond)
    }

    /// Its commands about a point, as a part of a path.
    pub(crate) fn drawn(self, at: Point, radius: f64) -> String {
        let shape: Shape = match self {
            Marker::Circle | Marker::Dot => {
                let (left, y, r) = (length(at.0 - radius), length(at.1), radius);
                return format!("M{left} {y}a{r} {r} 0 1 0 {0} 0a{r} {r} 0 1 0 -{0} 0z", 2.0 * r);
            }
            Marker::Square | Marker::FilledSquare => &[SQUARE],
            Marker::Triangle | Marker::FilledTriangle => &[TRIANGLE],
            Marker::Nabla => &[NABLA],
            Marker::Diamond | Marker::FilledDiamond => &[DIAMOND],
            Marker::Plus => &[LEVEL, UPRIGHT],
            Marker::Cross => &[FALLING, RISING],
            Marker::Star => &[LEVEL, UPRIGHT, FALLING, RISING],
        };
        drawn(shape, at, radius)
    }
}
