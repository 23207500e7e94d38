//! The sizes and places of all parts of a heat map.

use super::legend::Legend;
use super::shades::Shades;
use super::strip::Strip;
use super::{CellAxis, HeatMap, Values};
use crate::picture::elements::{LINE, MARGIN, Place, TEXT};
use crate::picture::sheet::Texts;
use crate::picture::side::{Direction, NEAR, Side, TICK};
use crate::picture::text::{lines, width};

/// The least width of the legend, if the picture is so wide.
const LEGEND: f64 = 440.0;
/// The width of a picture with one panel, and with several.
const WIDTHS: (f64, f64) = (660.0, 800.0);
/// Of a picture of few cells; the title and the legend need some room.
const LEAST_WIDTH: f64 = 420.0;
/// The greatest width of a single panel, if it has this number of columns.
const WIDEST: f64 = 800.0;
/// The greatest size of a cell.
const LARGEST_CELL: (f64, f64) = (64.0, 44.0);
/// Of a word below a cell.
const LONGEST_LINE: f64 = 110.0;
/// The least size of a panel.
const LEAST_PANEL: (f64, f64) = (120.0, 44.0);
/// Height : width of panels in one, two or more columns, if there are enough cells.
const SHAPES: [f64; 3] = [0.75, 0.9, 1.0];
/// Between panels, and between their rows.
const GAP: f64 = 40.0;
const BETWEEN_ROWS: f64 = 10.0;
/// For half of the last label of an axis.
const RIGHT: f64 = MARGIN + 16.0;

/// A panel's rectangle, and what stands beside it.
pub(super) struct PanelPlace {
    pub(super) cells: Place,
    /// The lines of its title, above the cells.
    pub(super) title: Vec<String>,
    /// Whether the vertical axis has its labels here.
    pub(super) is_first: bool,
}

/// The places of all parts.
pub(super) struct Layout {
    pub(super) texts: Texts,
    pub(super) x: Side,
    pub(super) y: Side,
    pub(super) panels: Vec<PanelPlace>,
    /// All panels together, without labels.
    pub(super) grid: Place,
    /// The middle of the label of the horizontal axis.
    pub(super) x_label: f64,
    pub(super) legend: Legend,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Layout {
    /// For panels of these cells, and a number of cells of each colour.
    pub(super) fn of(map: &HeatMap, (x, y): (&Strip, &Strip), shades: &Shades<'_>, counts: &[usize; 256]) -> Layout {
        let columns = columns(map.panels.len());
        let (size, x, y) = panel_size(map, (x, y), columns);
        let left = MARGIN + beside(&x, &y, size.0);
        let grid_width = columns as f64 * size.0 + (columns - 1) as f64 * GAP;
        let picture = (left + grid_width + RIGHT).max(LEAST_WIDTH);
        let texts = Texts::of(&map.title, &map.notes, picture);
        let top = texts.top() + 8.0;
        let (panels, bottom) = panels(map, columns, size, (left, top), TICK + NEAR + x.height());
        let grid = Place { left, top, width: grid_width, height: panels[panels.len() - 1].cells.bottom() - top };
        let x_label = bottom + if map.x.label.is_empty() { -LINE / 2.0 } else { 6.0 + LINE / 2.0 };
        // below the panels, and further to the left if these are narrow
        let legend_left = left.min((picture - RIGHT - LEGEND).max(MARGIN));
        let (legend_top, legend_width) = (x_label + LINE / 2.0 + 12.0, picture - RIGHT - legend_left);
        let place = Place { left: legend_left, top: legend_top, width: legend_width, height: 0.0 };
        let legend = Legend::of(map, shades, counts, (place, picture));
        let height = legend.bottom + texts.below();
        Layout { texts, x, y, panels, grid, x_label, legend, width: picture, height }
    }
}

/// The places of the panels in rows, and where the last row with its labels, of this height, ends.
fn panels(
    map: &HeatMap,
    columns: usize,
    (width, height): (f64, f64),
    (left, mut top): (f64, f64),
    labels: f64,
) -> (Vec<PanelPlace>, f64) {
    let mut places = Vec::new();
    for row in map.panels.chunks(columns) {
        let titles: Vec<_> = row.iter().map(|panel| lines(&panel.title, width + GAP - 8.0, TEXT)).collect();
        top += titles.iter().map(Vec::len).max().unwrap_or(0) as f64 * LINE;
        for (n, title) in titles.into_iter().enumerate() {
            let cells = Place { left: left + n as f64 * (width + GAP), top, width, height };
            places.push(PanelPlace { cells, title, is_first: n == 0 });
        }
        top += height + labels + BETWEEN_ROWS;
    }
    (places, top - BETWEEN_ROWS)
}

/// What the labels at the left of the panels need, of which each is so wide.
fn beside(x: &Side, y: &Side, width: f64) -> f64 {
    LINE + 4.0 + (y.width() + TICK + NEAR).max(x.overhang(width))
}

/// So that rows are full if possible, and panels not too small.
fn columns(panels: usize) -> usize {
    match panels {
        0..=3 => panels.max(1),
        4 => 2,
        _ => 3,
    }
}

/// The width and the height of a panel, and the labels of its axes.
fn panel_size(map: &HeatMap, (x, y): (&Strip, &Strip), columns: usize) -> ((f64, f64), Side, Side) {
    let picture = if columns == 1 { WIDTHS.0 } else { WIDTHS.1 };
    let shape = SHAPES[columns.min(SHAPES.len()) - 1];
    let mut room = 0.0;
    // the labels at the left need more or less room with the height, which depends on the width
    loop {
        let most = (picture - MARGIN - room - RIGHT - (columns - 1) as f64 * GAP) / columns as f64;
        let most = if columns == 1 { (x.count() as f64).clamp(most, WIDEST) } else { most }.max(LEAST_PANEL.0);
        let width = most.min((x.count() as f64 * widest_cell(&map.x)).max(LEAST_PANEL.0));
        let height = (most * shape).min((y.count() as f64 * LARGEST_CELL.1).max(LEAST_PANEL.1));
        let (x, y) = (x.side(&map.x, width, Direction::Below), y.side(&map.y, height, Direction::Left));
        let needed = beside(&x, &y, width);
        if needed <= room {
            return ((width, height), x, y);
        }
        room = needed;
    }
}

/// Cells are wider below long words, which may take several lines.
fn widest_cell(axis: &CellAxis) -> f64 {
    let words = if let Values::Words(words) = &axis.values { words.as_slice() } else { &[] };
    let lines = words.iter().flat_map(|word| lines(word, LONGEST_LINE, TEXT)).map(|line| width(&line, TEXT));
    lines.fold(LARGEST_CELL.0, |widest, line| widest.max(line.min(LONGEST_LINE) + TEXT))
}
