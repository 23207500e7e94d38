//! The colour bar, and the entries of words and special values.

use maud::{Markup, html};

use super::HeatMap;
use super::cells::{hatching, mark};
use super::scale::Measure;
use super::shades::{LEVELS, MISSING, SPECIAL, Shades};
use super::svg::{Anchor, NEAR, Place, length, text};
use crate::labels::{lines, width};
use crate::picture::{LINE, TEXT, TICK};
use crate::ticks::{Ticks, significant};

const BAR: f64 = 16.0;
const SWATCH: f64 = 16.0;
/// Between entries.
const APART: f64 = 22.0;

/// What stands below the panels.
pub(super) struct Legend {
    label: Vec<String>,
    bar: Option<Bar>,
    entries: Vec<Entry>,
    place: Place,
}

struct Bar {
    place: Place,
    /// At parts of its width.
    labelled: Vec<(f64, String)>,
    minor: Vec<f64>,
}

struct Entry {
    colour: u8,
    text: String,
    at: (f64, f64),
}

impl Legend {
    /// The parts within a place, whose height follows, and a picture of this width.
    pub(super) fn of(
        map: &HeatMap,
        shades: &Shades<'_>,
        counts: &[usize; 256],
        (mut place, picture): (Place, f64),
    ) -> Legend {
        let label = lines(&label(map, shades.measure), place.width, TEXT);
        let mut top = place.top + label.len() as f64 * LINE + 2.0;
        let range = shades.range.filter(|_| shades.has_bar());
        let bar = range.map(|range| {
            let place = Place { top, height: BAR, ..place };
            top += BAR + TICK + NEAR + LINE + 6.0;
            Bar::of(shades.measure, range, place, picture)
        });
        let entries = entries(shades, counts, range.is_none());
        let entries = placed(entries, place, top + LINE / 2.0);
        let bottom = entries.last().map_or(top, |entry| entry.at.1 + LINE / 2.0 + 2.0);
        place.height = bottom - place.top;
        Legend { label, bar, entries, place }
    }

    pub(super) fn bottom(&self) -> f64 {
        self.place.bottom()
    }

    pub(super) fn draw(&self, shades: &Shades<'_>) -> Markup {
        html! {
            @for (n, line) in self.label.iter().enumerate() {
                (text((self.place.left, self.place.top + (n as f64 + 0.5) * LINE), Anchor::Start, TEXT, line))
            }
            @if let Some(bar) = &self.bar { (bar.draw(shades)) }
            @for entry in &self.entries { (entry.draw(shades)) }
        }
    }
}

/// The quantity, and what has to be known of a symmetric scale.
fn label(map: &HeatMap, measure: Measure) -> String {
    match measure {
        Measure::SymmetricLog(threshold) => {
            format!("{} (logarithmic, linear within ±{})", map.colour.label, significant(threshold, 3))
        }
        Measure::Linear | Measure::Log10 => map.colour.label.clone(),
    }
}

impl Bar {
    fn of(measure: Measure, range: (f64, f64), place: Place, picture: f64) -> Bar {
        let part = |at: f64| (at - range.0) / (range.1 - range.0);
        let fits = |ticks: &Ticks| {
            ticks.labelled.windows(2).all(|pair| {
                let half = (width(&pair[0].1, TEXT) + width(&pair[1].1, TEXT) + 0.6 * TEXT) / 2.0;
                (part(pair[1].0) - part(pair[0].0)) * place.width >= half
            })
        };
        let tried = [9.0, 7.0, 5.0, 3.0, 2.0].map(|steps| measure.ticks(range, steps));
        let ticks = tried.into_iter().find(fits).unwrap_or_else(|| measure.ticks(range, 1.0));
        let labelled = ticks.labelled.into_iter().map(|(at, text)| (part(at), text)).collect();
        let bar = Bar { place, labelled, minor: ticks.minor.into_iter().map(part).collect() };
        bar.within(picture)
    }

    /// The bar shortened so that its labels are within a picture of this width.
    fn within(mut self, picture: f64) -> Bar {
        let Place { left, width: long, .. } = self.place;
        let most = |beyond: &dyn Fn(f64, f64) -> f64| {
            let all = self.labelled.iter().map(|(part, text)| beyond(left + part * long, width(text, TEXT) / 2.0));
            all.fold(0.0, f64::max)
        };
        let (before, after) = (most(&|at, half| half - at), most(&|at, half| at + half - picture));
        self.place = Place { left: left + before, width: long - before - after, ..self.place };
        self
    }

    fn draw(&self, shades: &Shades<'_>) -> Markup {
        let Place { left, top, width, height } = self.place;
        let (bottom, at) = (self.place.bottom(), |part: f64| left + part * width);
        let border = |n: u8| length(at(f64::from(n) / f64::from(LEVELS)));
        html! {
            g shape-rendering="crispEdges" {
                @for level in 0..LEVELS {
                    path fill=(shades.hex(level))
                        d=(format!("M{} {}H{}V{}H{0}z", border(level), length(top), border(level + 1), length(bottom))) {}
                }
            }
            rect x=(length(left)) y=(length(top)) width=(length(width)) height=(length(height))
                fill="none" stroke="#000000" class="ink-stroke" {}
            @for part in &self.minor { (tick(at(*part), bottom, TICK * 0.6)) }
            @for (part, label) in &self.labelled {
                (tick(at(*part), bottom, TICK))
                (text((at(*part), bottom + TICK + NEAR + LINE / 2.0), Anchor::Middle, TEXT, label))
            }
        }
    }
}

fn tick(x: f64, y: f64, down: f64) -> Markup {
    html! { path d=(format!("M{} {}v{}", length(x), length(y), length(down))) stroke="#000000" class="ink-stroke" {} }
}

/// Words, a single value that all cells have, and the special values that occur with the numbers of their cells.
fn entries(shades: &Shades<'_>, counts: &[usize; 256], without_bar: bool) -> Vec<(u8, String)> {
    let mut entries: Vec<_> = (0..).zip(shades.words().iter().cloned()).collect();
    if let Some((value, _)) = shades.data.filter(|_| without_bar) {
        entries.push((shades.number(Some(value)), significant(value, 6)));
    }
    for (colour, text) in shades.beyond() {
        if counts[usize::from(colour)] > 0 {
            entries.push((colour, format!("{text}: {}", counted(counts[usize::from(colour)]))));
        }
    }
    for (colour, name) in SPECIAL {
        if counts[usize::from(colour)] > 0 {
            entries.push((colour, format!("{name}: {}", counted(counts[usize::from(colour)]))));
        }
    }
    entries
}

pub(super) fn counted(cells: usize) -> String {
    if cells == 1 { "1 cell".to_owned() } else { format!("{cells} cells") }
}

/// From left to right, in as many rows as necessary.
fn placed(entries: Vec<(u8, String)>, place: Place, top: f64) -> Vec<Entry> {
    let (mut x, mut y) = (place.left, top);
    let mut all = Vec::new();
    for (colour, text) in entries {
        let wide = SWATCH + 6.0 + width(&text, TEXT);
        if x > place.left && x + wide > place.right() {
            (x, y) = (place.left, y + LINE + 4.0);
        }
        all.push(Entry { colour, text, at: (x, y) });
        x += wide + APART;
    }
    all
}

impl Entry {
    /// A swatch and its text, at the middle of the swatch's left side.
    fn draw(&self, shades: &Shades<'_>) -> Markup {
        let (x, y) = self.at;
        let swatch = Place { left: x, top: y - SWATCH / 2.0, width: SWATCH, height: SWATCH };
        html! {
            @if self.colour == MISSING { (hatching(&[swatch])) }
            rect x=(length(x)) y=(length(swatch.top)) width=(SWATCH) height=(SWATCH)
                fill=(if self.colour == MISSING { "none".to_owned() } else { shades.hex(self.colour) })
                stroke="#000000" class="ink-stroke" {}
            (mark(shades, self.colour, &[swatch]))
            (text((x + SWATCH + 6.0, y), Anchor::Start, TEXT, &self.text))
        }
    }
}
