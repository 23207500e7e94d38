//! Lines, paths and texts as SVG, in pixels.

use maud::{Markup, html};

use super::text::set;

// sizes in pixels; half a page is about 640 of them
pub(crate) const TITLE: f64 = 18.0;
pub(crate) const TEXT: f64 = 16.0;
pub(crate) const SMALL: f64 = 0.9 * TEXT;
pub(crate) const LINE: f64 = 20.0;
pub(crate) const MARGIN: f64 = 10.0;

/// A place in the picture: to the right, downwards.
pub(crate) type Point = (f64, f64);

/// A rectangle in the picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

impl Place {
    pub(crate) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(crate) fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// At these parts of the way from the left to the right, and upwards.
    pub(crate) fn at(&self, (across, up): (f64, f64)) -> Point {
        (self.left + across * self.width, self.top + (1.0 - up) * self.height)
    }

    pub(crate) fn contains(&self, (x, y): Point) -> bool {
        (self.left..=self.right()).contains(&x) && (self.top..=self.bottom()).contains(&y)
    }
}

/// A colour, and its class where a style sheet changes it; other colours are visible on white and on black.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ink {
    pub(crate) colour: &'static str,
    pub(crate) class: Option<&'static str>,
}

impl Ink {
    /// The class of what is drawn with it: strokes, or fills.
    fn class_of(self, paint: &str) -> Option<String> {
        self.class.map(|class| format!("{class}-{paint}"))
    }
}

pub(crate) const BLACK: Ink = Ink { colour: "#000000", class: Some("ink") };
pub(crate) const GRID: Ink = Ink { colour: "#DDDDDD", class: Some("grid") };
pub(crate) const GREY: Ink = Ink { colour: "#888888", class: None };
const PAPER: Ink = Ink { colour: "#FFFFFF", class: Some("halo") };

/// How a line is drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stroke {
    pub(crate) ink: Ink,
    pub(crate) width: f64,
    /// Lengths of dashes and gaps; none for a continuous line.
    pub(crate) dashes: &'static str,
}

/// A continuous line.
pub(crate) fn stroke(ink: Ink, width: f64) -> Stroke {
    Stroke { ink, width, dashes: "" }
}

/// A length to a hundredth of a pixel.
pub(crate) fn length(value: f64) -> f64 {
    (value * 100.0).round() / 100.0
}

/// A line through points, to a tenth of a pixel.
pub(crate) fn line(points: &[Point], stroke: Stroke) -> Markup {
    let tenth = |value: f64| (value * 10.0).round() / 10.0;
    let points: Vec<_> = points.iter().map(|(x, y)| format!("{},{}", tenth(*x), tenth(*y))).collect();
    html! {
        polyline points=(points.join(" ")) fill="none" stroke=(stroke.ink.colour) class=[stroke.ink.class_of("stroke")]
            stroke-width=(stroke.width) stroke-dasharray=[Some(stroke.dashes).filter(|dashes| !dashes.is_empty())] {}
    }
}

/// The commands of a line through points, as a part of a path.
pub(crate) fn commands(points: impl IntoIterator<Item = Point>) -> String {
    let points = points.into_iter().zip("M".chars().chain(std::iter::repeat('L')));
    points.map(|((x, y), command)| format!("{command}{} {}", length(x), length(y))).collect()
}

/// The strokes of a path; nothing without commands.
pub(crate) fn path(commands: &str, ink: Ink, width: f64) -> Markup {
    html! {
        @if !commands.is_empty() {
            path d=(commands) fill="none" stroke=(ink.colour) class=[ink.class_of("stroke")] stroke-width=(width) {}
        }
    }
}

/// What a path encloses.
pub(crate) fn filled(commands: &str, ink: Ink) -> Markup {
    html! { path d=(commands) fill=(ink.colour) class=[ink.class_of("fill")] {} }
}

/// A rectangle as a part of a path.
pub(crate) fn rectangle(place: Place) -> String {
    let [left, top, right, bottom] = [place.left, place.top, place.right(), place.bottom()].map(length);
    format!("M{left} {top}H{right}V{bottom}H{left}z")
}

/// A rectangle with a thin border, filled with a colour or empty.
pub(crate) fn framed(place: Place, fill: &str) -> Markup {
    html! {
        rect x=(length(place.left)) y=(length(place.top)) width=(length(place.width)) height=(length(place.height))
            fill=(fill) stroke=(BLACK.colour) class=[BLACK.class_of("stroke")] {}
    }
}

/// The parts of a text that can stand at its place.
pub(crate) const START: &str = "start";
pub(crate) const MIDDLE: &str = "middle";
pub(crate) const END: &str = "end";

/// How a text is set.
#[derive(Clone, Copy)]
pub(crate) struct Type {
    pub(crate) anchor: &'static str,
    pub(crate) size: f64,
    pub(crate) ink: Ink,
}

impl Type {
    /// That of most texts.
    pub(crate) fn plain(anchor: &'static str) -> Type {
        Type { anchor, size: TEXT, ink: BLACK }
    }
}

/// A text at a place, vertically centred on it.
pub(crate) fn text((x, y): Point, Type { anchor, size, ink }: Type, content: &str) -> Markup {
    html! {
        text x=(length(x)) y=(length(y)) dy="0.35em" text-anchor=(anchor) font-size=(size) fill=(ink.colour)
            class=[ink.class_of("fill")] { (set(content)) }
    }
}

/// The same on its halo, to be read over lines: behind it the same text, broad and in the colour of the paper.
pub(crate) fn text_on_lines(at: Point, of: Type, content: &str) -> Markup {
    html! {
        g stroke=(PAPER.colour) class=[PAPER.class_of("stroke")] stroke-width="5" aria-hidden="true" {
            (text(at, Type { ink: PAPER, ..of }, content))
        }
        (text(at, of, content))
    }
}

/// A text turned about its place by an angle in degrees, clockwise.
pub(crate) fn turned((x, y): Point, angle: i32, anchor: &'static str, content: &str) -> Markup {
    let transform = format!("translate({} {}) rotate({angle})", length(x), length(y));
    html! { g transform=(transform) { (text((0.0, 0.0), Type::plain(anchor), content)) } }
}
