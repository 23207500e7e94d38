//! The colour bar, and the entries of words and special values.

use maud::{Markup, html};

use super::HeatMap;
use super::cells::{hatching, mark};
use super::shades::{LEVELS, MISSING, SPECIAL, Shades};
use crate::picture::elements::{LINE, Place, Point, START, TEXT, Type, framed, rectangle, text};
use crate::picture::sheet::in_rows;
use crate::picture::side::{Direction, NEAR, Side, TICK};
use crate::picture::text::{lines, width};
use crate::picture::ticks::{Scale, significant};

const BAR: f64 = 16.0;
const SWATCH: f64 = 16.0;
/// The approximate number of intervals along the colour bar.
const INTERVALS: f64 = 9.0;

/// What stands below the panels.
pub(super) struct Legend {
    label: Vec<String>,
    bar: Option<(Place, Side)>,
    /// The numbers of colours, with their texts and places.
    entries: Vec<((u8, String), Point)>,
    place: Place,
    pub(super) bottom: f64,
}

impl Legend {
    /// The parts from the top of a place downwards, in a picture of this width.
    pub(super) fn of(
        map: &HeatMap,
        shades: &Shades<'_>,
        counts: &[usize; 256],
        (place, picture): (Place, f64),
    ) -> Legend {
        let label = lines(&label(map, shades.scale), place.width, TEXT);
        let mut top = place.top + label.len() as f64 * LINE + 2.0;
        let bar = shades.range.filter(|_| shades.has_bar()).map(|range| {
            let place = Place { top, height: BAR, ..place };
            top += BAR + TICK + NEAR + LINE + 6.0;
            bar(shades.scale, range, place, picture)
        });
        let entries = entries(shades, counts, bar.is_none());
        let widths = entries.iter().map(|(_, text)| SWATCH + 6.0 + width(text, TEXT));
        let places = in_rows(widths, (place.left, place.right()), top + LINE / 2.0);
        let bottom = places.last().map_or(top, |at| at.1 + LINE / 2.0 + 2.0);
        Legend { label, bar, entries: entries.into_iter().zip(places).collect(), place, bottom }
    }

    pub(super) fn draw(&self, shades: &Shades<'_>) -> Markup {
        let row = |n: usize| self.place.top + (n as f64 + 0.5) * LINE;
        html! {
            @for (n, line) in self.label.iter().enumerate() {
                (text((self.place.left, row(n)), Type::plain(START), line))
            }
            @if let Some((place, side)) = &self.bar { (levels(shades, *place)) (framed(*place, "none")) (side.draw(*place)) }
            @for ((colour, text), at) in &self.entries { (entry(shades, *colour, text, *at)) }
        }
    }
}

/// The quantity, and what has to be known of a symmetric scale.
fn label(map: &HeatMap, scale: Scale) -> String {
    match scale {
        Scale::SymmetricLog(threshold) => {
            format!("{} (logarithmic, linear within ±{})", map.colour.label, significant(threshold, 3))
        }
        Scale::Linear | Scale::Log10 => map.colour.label.clone(),
    }
}

/// The labels of the colour bar, which is shortened so that they are within a picture of this width.
fn bar(scale: Scale, range: (f64, f64), place: Place, picture: f64) -> (Place, Side) {
    let side = Side::round(scale, range, INTERVALS, place.width, Direction::Below);
    let side = side.unwrap_or_else(|| Side::of([], Vec::new(), Direction::Below));
    let most = |beyond: &dyn Fn(f64, f64) -> f64| {
        let halves =
            side.labelled.iter().map(|(part, lines)| beyond(place.at((*part, 0.0)).0, width(&lines[0], TEXT) / 2.0));
        halves.fold(0.0, f64::max)
    };
    let (before, after) = (most(&|at, half| half - at), most(&|at, half| at + half - picture));
    (Place { left: place.left + before, width: place.width - before - after, ..place }, side)
}

/// The colours of the bar.
fn levels(shades: &Shades<'_>, place: Place) -> Markup {
    let part = |n: u8| f64::from(n) / f64::from(LEVELS) * place.width;
    let level = |n: u8| Place { left: place.left + part(n), width: part(n + 1) - part(n), ..place };
    html! {
        g shape-rendering="crispEdges" {
            @for n in 0..LEVELS { path fill=(shades.hex(n)) d=(rectangle(level(n))) {} }
        }
    }
}

/// Words, a single value that all cells have, and the special values that occur with the numbers of their cells.
fn entries(shades: &Shades<'_>, counts: &[usize; 256], without_bar: bool) -> Vec<(u8, String)> {
    let words = (0..).zip(shades.words().iter().cloned());
    let value = shades.data.filter(|_| without_bar);
    let single = value.map(|(value, _)| (shades.number(Some(value)), significant(value, 6)));
    let special = SPECIAL.map(|(colour, name)| (colour, name.to_owned()));
    let counted = shades.beyond().into_iter().chain(special).filter(|(colour, _)| counts[usize::from(*colour)] > 0);
    let counted = counted.map(|(colour, text)| (colour, format!("{text}: {}", cells(counts[usize::from(colour)]))));
    words.chain(single).chain(counted).collect()
}

/// A number of cells.
pub(super) fn cells(count: usize) -> String {
    if count == 1 { "1 cell".to_owned() } else { format!("{count} cells") }
}

/// A swatch and its text, at the middle of the swatch's left side.
fn entry(shades: &Shades<'_>, colour: u8, content: &str, (x, y): Point) -> Markup {
    let swatch = Place { left: x, top: y - SWATCH / 2.0, width: SWATCH, height: SWATCH };
    html! {
        @if colour == MISSING { (hatching(swatch)) (framed(swatch, "none")) } @else { (framed(swatch, &shades.hex(colour))) }
        (mark(shades, colour, [swatch]))
        (text((x + SWATCH + 6.0, y), Type::plain(START), content))
    }
}
