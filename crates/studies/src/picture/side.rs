//! Ticks and labels along a side of a rectangle.

use maud::{Markup, html};

use super::elements::{BLACK, END, LINE, MIDDLE, Place, Point, START, TEXT, Type, commands, path, text, turned};
use super::text::width;
use super::ticks::Scale;

/// The length of a labelled tick.
pub(crate) const TICK: f64 = 5.0;
/// Of another one.
const MINOR: f64 = 3.0;
/// Between ticks and labels.
pub(crate) const NEAR: f64 = 4.0;

/// The cosine and the sine of the angle of tilted labels are both this.
pub(crate) const TILT: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Where labels stand, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Direction {
    /// Below, side by side.
    Below,
    /// Below, falling to the left.
    Tilted,
    /// At the left, one above the other.
    Left,
    /// At the right.
    Right,
}

/// Labels and ticks, at parts of the length of a side.
#[derive(Debug)]
pub(crate) struct Side {
    /// Each with its lines.
    pub(crate) labelled: Vec<(f64, Vec<String>)>,
    pub(crate) minor: Vec<f64>,
    pub(crate) direction: Direction,
}

impl Side {
    /// Labels of one line.
    pub(crate) fn of(labelled: impl IntoIterator<Item = (f64, String)>, minor: Vec<f64>, direction: Direction) -> Side {
        Side { labelled: labelled.into_iter().map(|(part, text)| (part, vec![text])).collect(), minor, direction }
    }

    /// Round numbers of a scale, with at most about this number of intervals between them, and so few that neighbouring
    /// labels on this length do not touch; none if not even one interval fits, or the values hardly differ.
    pub(crate) fn round(scale: Scale, range: (f64, f64), most: f64, length: f64, direction: Direction) -> Option<Side> {
        let part = |at: f64| (at - range.0) / (range.1 - range.0);
        let steps =
            [9.0, 7.0, 5.0, 4.0, 3.0, 2.0, 1.0].into_iter().filter(|steps| *steps <= most && scale.has_ticks(range));
        let mut sides = steps.map(|steps| scale.ticks(range, steps)).map(|ticks| {
            let labelled = ticks.labelled.into_iter().map(|(at, text)| (part(at), text));
            Side::of(labelled, ticks.minor.into_iter().map(part).collect(), direction)
        });
        sides.find(|side| !side.labelled.is_empty() && side.fits(length))
    }

    /// Whether neighbouring labels on a side of this length do not touch.
    pub(crate) fn fits(&self, length: f64) -> bool {
        let half = |lines: &[String]| match self.direction {
            Direction::Left | Direction::Right => LINE / 2.0,
            Direction::Below | Direction::Tilted => (widest(lines) + 0.6 * TEXT) / 2.0,
        };
        self.labelled.windows(2).all(|pair| (pair[1].0 - pair[0].0) * length >= half(&pair[0].1) + half(&pair[1].1))
    }

    /// The widest line.
    pub(crate) fn width(&self) -> f64 {
        self.labelled.iter().map(|(_, lines)| widest(lines)).fold(0.0, f64::max)
    }

    /// What labels below need.
    pub(crate) fn height(&self) -> f64 {
        match self.direction {
            Direction::Tilted => TILT * (self.width() + LINE),
            _ => self.labelled.iter().map(|(_, lines)| lines.len()).max().unwrap_or(0) as f64 * LINE,
        }
    }

    /// How far labels below reach to the left of a side of this length.
    pub(crate) fn overhang(&self, length: f64) -> f64 {
        let left = |lines: &[String]| match self.direction {
            Direction::Tilted => TILT * (widest(lines) + LINE / 2.0),
            _ => widest(lines) / 2.0,
        };
        self.labelled.iter().map(|(part, lines)| left(lines) - part * length).fold(0.0, f64::max)
    }

    /// Ticks and labels outside a rectangle.
    pub(crate) fn draw(&self, place: Place) -> Markup {
        html! { (self.ticks(place)) (self.labels(place)) }
    }

    fn at(&self, place: Place, part: f64) -> Point {
        match self.direction {
            Direction::Below | Direction::Tilted => place.at((part, 0.0)),
            Direction::Left => place.at((0.0, part)),
            Direction::Right => place.at((1.0, part)),
        }
    }

    pub(crate) fn ticks(&self, place: Place) -> Markup {
        let labelled = self.labelled.iter().map(|(part, _)| (*part, TICK));
        let ticks = labelled.chain(self.minor.iter().map(|part| (*part, MINOR)));
        let tick = |(part, long)| {
            let (x, y) = self.at(place, part);
            let end = match self.direction {
                Direction::Below | Direction::Tilted => (x, y + long),
                Direction::Left => (x - long, y),
                Direction::Right => (x + long, y),
            };
            commands([(x, y), end])
        };
        path(&ticks.map(tick).collect::<String>(), BLACK, 1.0)
    }

    pub(crate) fn labels(&self, place: Place) -> Markup {
        html! {
            @for (part, lines) in &self.labelled {
                @for (n, line) in lines.iter().enumerate() { (self.label(self.at(place, *part), n, line)) }
            }
        }
    }

    /// The n-th line of the label of a tick.
    fn label(&self, (x, y): Point, n: usize, line: &str) -> Markup {
        let beyond = TICK + NEAR;
        let (at, anchor) = match self.direction {
            Direction::Tilted => return turned((x + 2.0, y + beyond + 2.0), -45, END, line),
            Direction::Below => ((x, y + beyond + (n as f64 + 0.5) * LINE), MIDDLE),
            Direction::Left => ((x - beyond, y), END),
            Direction::Right => ((x + beyond, y), START),
        };
        text(at, Type::plain(anchor), line)
    }
}

fn widest(lines: &[String]) -> f64 {
    lines.iter().map(|line| width(line, TEXT)).fold(0.0, f64::max)
}
