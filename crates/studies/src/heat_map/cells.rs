//! Cells as rectangles, the marks within them, and the hatching of cells without a value.

use maud::{Markup, html};

use super::shades::{ABOVE, LEVELS, MISSING, Shades, lightness};
use crate::picture::elements::{GREY, GRID, Place, commands, filled, path, rectangle};
use crate::picture::markers::{OF_SPECIAL, OF_WORDS, drawn};

/// Between the lines of the hatching.
const APART: f64 = 4.0;

/// Smaller cells have no marks.
const LEAST_MARKED: f64 = 9.0;

/// The rectangle between two borders of each axis, from 0 to 1.
fn between(place: Place, [left, right]: [f64; 2], [low, high]: [f64; 2]) -> Place {
    let (left, top) = (place.left + left * place.width, place.bottom() - high * place.height);
    Place {
        left,
        top,
        width: place.left + right * place.width - left,
        height: place.bottom() - low * place.height - top,
    }
}

/// The cells of a panel as one path for each colour; neighbours of one colour in a row are one rectangle. Cells without
/// a value are left out; words and special values have marks.
pub(super) fn rectangles(shades: &Shades<'_>, numbers: &[u8], place: Place, (x, y): (&[f64], &[f64])) -> Markup {
    let mut paths = vec![String::new(); 256];
    for (row, y) in numbers.chunks(x.len() - 1).zip(y.windows(2)) {
        let mut start = 0;
        for run in row.chunk_by(|a, b| a == b) {
            let end = start + run.len();
            paths[usize::from(run[0])] += &rectangle(between(place, [x[start], x[end]], [y[0], y[1]]));
            start = end;
        }
    }
    html! {
        g shape-rendering="crispEdges" {
            @for (number, path) in (0..=ABOVE).zip(&paths).filter(|(number, path)| *number != MISSING && !path.is_empty()) {
                path fill=(shades.hex(number)) d=(path) {}
            }
        }
        (marks(shades, numbers, place, (x, y)))
    }
}

/// The marks of words and of special values in all cells of a panel that are large enough.
fn marks(shades: &Shades<'_>, numbers: &[u8], place: Place, (x, y): (&[f64], &[f64])) -> Markup {
    let rows = y.windows(2).flat_map(|y| x.windows(2).map(|x| between(place, [x[0], x[1]], [y[0], y[1]])));
    let large: Vec<_> =
        numbers.iter().zip(rows).filter(|(_, cell)| cell.width.min(cell.height) >= LEAST_MARKED).collect();
    let words = 0..shades.words().len() as u8;
    html! {
        @for number in words.chain(LEVELS..MISSING) {
            (mark(shades, number, large.iter().filter(|(of, _)| **of == number).map(|(_, cell)| *cell)))
        }
    }
}

/// The mark of a colour in the middle of each of these cells, as one path: colours of words and special values are
/// recognised without seeing colours.
pub(super) fn mark(shades: &Shades<'_>, number: u8, cells: impl IntoIterator<Item = Place>) -> Markup {
    let shape = match number.checked_sub(LEVELS) {
        Some(special) => OF_SPECIAL.get(usize::from(special)),
        None => OF_WORDS.get(usize::from(number)).filter(|_| !shades.words().is_empty()),
    };
    let radius = |cell: &Place| (0.28 * cell.width.min(cell.height)).min(5.0);
    let of_cell = |cell: Place| drawn(shape.copied().unwrap_or_default(), cell.at((0.5, 0.5)), radius(&cell));
    let path: String = cells.into_iter().map(of_cell).collect();
    // visible on the colour of the cell
    let colour = if lightness(shades.rgb(number)) > 55.0 { "#000000" } else { "#ffffff" };
    html! { @if !path.is_empty() { path class="mark" d=(path) fill="none" stroke=(colour) stroke-width="1.2" {} } }
}

/// A grey rectangle with lines from the lower left to the upper right: what is seen where no cell is drawn.
pub(super) fn hatching(place: Place) -> Markup {
    let (Place { left, top, .. }, right, bottom) = (place, place.right(), place.bottom());
    // x + y is constant on a line
    let first = ((left + top) / APART).ceil();
    let sums = (0..).map(|n| (first + f64::from(n)) * APART).take_while(|sum| *sum < right + bottom);
    let ends = sums.map(|sum| [(sum - bottom).max(left), (sum - top).min(right)].map(|x| (x, sum - x)));
    html! {
        (filled(&rectangle(place), GRID))
        g class="hatching" { (path(&ends.map(commands).collect::<String>(), GREY, 1.0)) }
    }
}
