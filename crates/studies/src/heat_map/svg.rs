//! Places and texts as SVG.

use maud::{Markup, html};

use crate::picture::TEXT;

/// Between labels of an axis and its ticks.
pub(super) const NEAR: f64 = 4.0;

/// A rectangle in the picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Place {
    pub(super) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(super) fn bottom(&self) -> f64 {
        self.top + self.height
    }
}

/// The side of a place on which a text stands.
#[derive(Clone, Copy)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// A length to a hundredth of a pixel.
pub(super) fn length(value: f64) -> f64 {
    (value * 100.0).round() / 100.0
}

/// A text at a place, vertically centred on it.
pub(super) fn text((x, y): (f64, f64), anchor: Anchor, size: f64, content: &str) -> Markup {
    let anchor = match anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    html! {
        text x=(length(x)) y=(length(y)) dy="0.35em" text-anchor=(anchor) font-size=(size) fill="#000000" class="ink-fill" {
            (content)
        }
    }
}

/// The same, turned about its place by an angle in degrees, clockwise.
pub(super) fn turned((x, y): (f64, f64), angle: i32, anchor: Anchor, content: &str) -> Markup {
    html! { g transform=(format!("translate({} {}) \
    rotate({angle})", length(x), length(y))) { (text((0.0, 0.0), anchor, TEXT, content)) } }
}
