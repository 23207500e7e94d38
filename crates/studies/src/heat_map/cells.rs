//! Cells as rectangles, the marks within them, and the hatching of cells without a value.

use std::fmt::Write;

use maud::{Markup, html};

use super::shades::{ABOVE, INFINITE, LEVELS, MINUS_INFINITE, MISSING, MOST_WORDS, NEGATIVE, Shades, ZERO, lightness};
use super::svg::{Place, length};

/// Between the lines of the hatching.
const APART: f64 = 4.0;

/// Smaller cells have no marks.
const LEAST_MARKED: f64 = 9.0;

/// The cells of a panel as one path for each colour; neighbours of one colour in a row are one rectangle. Cells without
/// a value are left out.
pub(super) fn rectangles(shades: &Shades<'_>, numbers: &[u8], place: Place, (x, y): (&[f64], &[f64])) -> Markup {
    let mut paths = vec![String::new(); 256];
    let columns = x.len() - 1;
    for (j, row) in numbers.chunks(columns).enumerate() {
        let (top, bottom) = (upwards(place, y[j + 1]), upwards(place, y[j]));
        let mut start = 0;
        for run in row.chunk_by(|a, b| a == b) {
            let end = start + run.len();
            let [left, right] = [start, end].map(|n| length(place.left + x[n] * place.width));
            // writing to a text does not fail
            let _ = write!(paths[usize::from(run[0])], "M{left} {top}H{right}V{bottom}H{left}z");
            start = end;
        }
    }
    html! {
        g shape-rendering="crispEdges" {
            @for (number, path) in (0..=ABOVE).zip(&paths).filter(|(number, path)| *number != MISSING && !path.is_empty()) {
                path fill=(shades.hex(number)) d=(path) {}
            }
        }
    }
}

fn upwards(place: Place, part: f64) -> f64 {
    length(place.bottom() - part * place.height)
}

/// The marks of words and of special values in all cells of a panel that are large enough.
pub(super) fn marks(shades: &Shades<'_>, numbers: &[u8], place: Place, (x, y): (&[f64], &[f64])) -> Markup {
    let columns = x.len() - 1;
    let cell = |n: usize| {
        let (i, j) = (n % columns, n / columns);
        let (left, top) = (place.left + x[i] * place.width, place.bottom() - y[j + 1] * place.height);
        Place { left, top, width: (x[i + 1] - x[i]) * place.width, height: (y[j + 1] - y[j]) * place.height }
    };
    let of = |number: u8| -> Vec<Place> {
        (0..numbers.len())
            .filter(|&n| numbers[n] == number)
            .map(cell)
            .filter(|cell| cell.width.min(cell.height) >= LEAST_MARKED)
            .collect()
    };
    let last_word = shades.words().len() as u8;
    html! {
        @for number in (0..last_word).chain(LEVELS..MISSING) { (mark(shades, number, &of(number))) }
    }
}

/// The mark of a colour in the middle of each of these cells, as one path: colours of words and special values are
/// recognised without seeing colours.
pub(super) fn mark(shades: &Shades<'_>, number: u8, cells: &[Place]) -> Markup {
    let strokes = strokes(shades, number);
    let mut path = String::new();
    for cell in cells {
        let (x, y) = (cell.left + cell.width / 2.0, cell.top + cell.height / 2.0);
        let radius = (0.28 * cell.width.min(cell.height)).min(5.0);
        for [from, to] in strokes {
            let at = |(dx, dy): (f64, f64)| (length(x + dx * radius), length(y + dy * radius));
            let (from, to) = (at(*from), at(*to));
            let _ = write!(path, "M{} {}L{} {}", from.0, from.1, to.0, to.1);
        }
    }
    // visible on the colour of the cell
    let colour = if lightness(shades.rgb(number)) > 55.0 { "#000000" } else { "#ffffff" };
    html! { @if !path.is_empty() { path class="mark" d=(path) fill="none" stroke=(colour) stroke-width="1.2" {} } }
}

type Stroke = [(f64, f64); 2];

const RISING: Stroke = [(-0.8, 0.8), (0.8, -0.8)];
const FALLING: Stroke = [(-0.8, -0.8), (0.8, 0.8)];
const LEVEL: Stroke = [(-1.0, 0.0), (1.0, 0.0)];
const UPRIGHT: Stroke = [(0.0, -1.0), (0.0, 1.0)];
const SQUARE: [Stroke; 4] =
    [[(-0.8, -0.8), (0.8, -0.8)], [(0.8, -0.8), (0.8, 0.8)], [(0.8, 0.8), (-0.8, 0.8)], [(-0.8, 0.8), (-0.8, -0.8)]];
const DIAMOND: [Stroke; 4] =
    [[(0.0, -1.1), (1.1, 0.0)], [(1.1, 0.0), (0.0, 1.1)], [(0.0, 1.1), (-1.1, 0.0)], [(-1.1, 0.0), (0.0, -1.1)]];
const TRIANGLE: [Stroke; 3] = [[(0.0, -1.0), (1.0, 0.8)], [(1.0, 0.8), (-1.0, 0.8)], [(-1.0, 0.8), (0.0, -1.0)]];

const NABLA: [Stroke; 3] = [[(0.0, 1.0), (1.0, -0.8)], [(1.0, -0.8), (-1.0, -0.8)], [(-1.0, -0.8), (0.0, 1.0)]];

/// Those of words; the first has none.
const OF_WORDS: [&[Stroke]; MOST_WORDS] = [
    &[],
    &[RISING],
    &[FALLING, RISING],
    &[LEVEL],
    &[LEVEL, UPRIGHT],
    &SQUARE,
    &TRIANGLE,
    &DIAMOND,
    &[UPRIGHT],
    &[FALLING],
    &[LEVEL, UPRIGHT, FALLING, RISING],
    &NABLA,
];

/// In units of the radius, downwards.
fn strokes(shades: &Shades<'_>, number: u8) -> &'static [Stroke] {
    match number {
        ZERO => &SQUARE,
        NEGATIVE => &[LEVEL],
        MINUS_INFINITE => &[FALLING, RISING, LEVEL],
        INFINITE => &[FALLING, RISING],
        word if !shades.words().is_empty() => OF_WORDS.get(usize::from(word)).copied().unwrap_or_default(),
        _ => &[],
    }
}

/// Grey rectangles with lines from the lower left to the upper right: what is seen where no cell is drawn.
pub(super) fn hatching(places: &[Place]) -> Markup {
    let (mut ground, mut path) = (String::new(), String::new());
    for place in places {
        let [left, top, right, bottom] = [place.left, place.top, place.right(), place.bottom()];
        let _ =
            write!(ground, "M{} {}H{}V{}H{}z", length(left), length(top), length(right), length(bottom), length(left));
        // x + y is constant on a line
        let mut sum = ((left + top) / APART).ceil() * APART;
        while sum < right + bottom {
            let (x1, x2) = ((sum - bottom).max(left), (sum - top).min(right));
            let _ = write!(path, "M{} {}L{} {}", length(x1), length(sum - x1), length(x2), length(sum - x2));
            sum += APART;
        }
    }
    html! {
        path class="grid-fill" d=(ground) fill="#DDDDDD" {}
        path class="hatching" d=(path) fill="none" stroke="#888888" {}
    }
}
