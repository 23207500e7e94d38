//! The picture as a whole.

use std::io;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::clip::Frame;
use super::ink::{FINE, Ink, finished};
use super::layout::{GAP, Layout, SAMPLE, Span, UNDER, in_legend};
use super::looks::{self, Shape};
use super::thin::thinned;
use super::{Chart, Curve, Look, Mark, Marker, Side};
use crate::Error;
use crate::labels::separate;
use crate::picture::{LINE, MARGIN, TEXT, TICK, TITLE, Theme};

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type DrawResult = Result<(), Box<dyn std::error::Error + Send + Sync>>;
type Pixel = (i32, i32);

const RADIUS: f64 = 4.0;

/// A length in the units of the picture.
fn fine(length: f64) -> i32 {
    (length * FINE).round() as i32
}

fn stroke(ink: Ink, width: f64) -> ShapeStyle {
    ink.placeholder().stroke_width(fine(width).unsigned_abs())
}

/// plotters divides font sizes by 1.24.
fn text(size: f64, anchor: (HPos, VPos)) -> TextStyle<'static> {
    let color = Ink::Text.placeholder().to_backend_color();
    TextStyle { font: ("sans-serif", size * FINE * 1.24).into_font(), color, pos: Pos::new(anchor.0, anchor.1) }
}

impl Chart {
    /// The SVG text, for a separate file or as a part of an HTML page.
    ///
    /// It has no `id`s and no scripts; text stays text, and on dark screens the picture is dark. Of a line, at most
    /// four points are written for each column of a pixel; of [`Curve::dots`], all.
    ///
    /// # Errors
    /// The picture cannot be drawn.
    pub fn svg(&self) -> Result<String, Error> {
        self.svg_of(Theme::LightAndDark)
    }

    /// The same in fixed colours on white, for a paper.
    ///
    /// # Errors
    /// The picture cannot be drawn.
    pub fn svg_for_print(&self) -> Result<String, Error> {
        self.svg_of(Theme::Light)
    }

    fn svg_of(&self, theme: Theme) -> Result<String, Error> {
        let layout = Layout::of(self);
        let size = (layout.width.ceil() as u32, layout.height.ceil() as u32);
        let mut drawn = String::new();
        let fine_size = (fine(size.0.into()).unsigned_abs(), fine(size.1.into()).unsigned_abs());
        let area = SVGBackend::with_string(&mut drawn, fine_size).into_drawing_area();
        self.draw(&area, &layout).map_err(io::Error::other)?;
        drop(area);
        Ok(finished(&drawn, size, &self.title, theme))
    }

    fn draw(&self, area: &Area<'_>, layout: &Layout) -> DrawResult {
        let [x, y, second] = [&layout.x, &layout.y, &layout.second];
        let mut builder = ChartBuilder::on(area);
        builder
            .margin_left(fine(MARGIN))
            .margin_top(fine(layout.above))
            .margin_bottom(fine(layout.below))
            .margin_right(fine(layout.right))
            .x_label_area_size(fine(UNDER))
            .y_label_area_size(fine(y.room()));
        if self.second_y.is_some() {
            builder.right_y_label_area_size(fine(second.room()));
        }
        let mut plot = builder.build_cartesian_2d(x, y)?.set_secondary_coord(x, second);
        let label = text(TEXT, (HPos::Center, VPos::Center));
        plot.configure_mesh()
            .bold_line_style(stroke(Ink::Grid, 1.0))
            .axis_style(stroke(Ink::Text, 1.0))
            .set_all_tick_mark_size(fine(TICK))
            .label_style(label.clone())
            .axis_desc_style(label.clone())
            .x_desc(&self.x.label)
            .y_desc(&self.y.label)
            .draw()?;
        if let Some(axis) = &self.second_y {
            plot.configure_secondary_axes()
                .axis_style(stroke(Ink::Text, 1.0))
                .set_all_tick_mark_size(fine(TICK))
                .label_style(label.clone())
                .axis_desc_style(label)
                .y_desc(&axis.label)
                .draw()?;
        }
        let (columns, rows) = plot.plotting_area().get_pixel_range();
        let first = |point: (f64, f64)| plot.plotting_area().map_coordinate(&point);
        let other = |point: (f64, f64)| plot.borrow_secondary().plotting_area().map_coordinate(&point);
        let right = (self.second_y.is_some()).then_some((second, &other as &dyn Fn((f64, f64)) -> Pixel));
        minor_ticks(area, x, y, &first, (columns.start, rows.end - 1))?;
        let column = |x: f64| first((x, y.range.0)).0;
        self.draw_marks(area, x, &column, &rows)?;
        let mut ends = Vec::new();
        for (n, curve) in self.curves.iter().enumerate() {
            let (span, place) = right.filter(|_| curve.side == Side::Second).unwrap_or((y, &first));
            let frame = Frame { x: x.range, y: span.range };
            ends.push(draw_curve(area, curve, n, self.curves.len() > 1, frame, place)?);
        }
        self.label_marks(area, (x, y), &first, &rows)?;
        // left and bottom are the axes
        let (left, top, end, bottom) = (columns.start, rows.start, columns.end - 1, rows.end - 1);
        area.draw(&PathElement::new([(left, top), (end, top), (end, bottom)], stroke(Ink::Text, 1.0)))?;
        if right.is_none() {
            self.label_ends(area, &ends, columns.start..columns.end, rows)?;
        }
        self.draw_texts(area, layout)
    }

    /// Whether fewer points are in the upper half of the chart than in the lower one, near the marks.
    fn is_emptier_above(&self, marks: &[&Mark], x: &Span, y: &Span) -> bool {
        let near = |value: f64| marks.iter().any(|mark| (mark.x - value).abs() < 0.2 * (x.range.1 - x.range.0));
        let middle = f64::midpoint(y.range.0, y.range.1);
        let points = self.curves.iter().flat_map(|curve| &curve.points).filter(|point| near(point.0));
        let (above, below): (Vec<f64>, Vec<f64>) = points.map(|point| point.1).partition(|value| *value > middle);
        above.len() <= below.len()
    }

    /// The marks within the chart.
    fn visible_marks(&self, x: &Span) -> Vec<&Mark> {
        self.marks.iter().filter(|mark| (x.range.0..=x.range.1).contains(&mark.x)).collect()
    }

    /// Vertical lines, behind the curves.
    fn draw_marks(&self, area: &Area<'_>, x: &Span, place: &dyn Fn(f64) -> i32, rows: &Range<i32>) -> DrawResult {
        for mark in self.visible_marks(x) {
            let column = place(mark.x);
            area.draw(&PathElement::new([(column, rows.start), (column, rows.end - 1)], stroke(Ink::Leader, 1.2)))?;
        }
        Ok(())
    }

    /// The labels of the marks, before the curves: in the middle of their jumps, or one below the other, at the end and
    /// on the side where there is room.
    fn label_marks(
        &self,
        area: &Area<'_>,
        (x, y): (&Span, &Span),
        place: &dyn Fn((f64, f64)) -> Pixel,
        rows: &Range<i32>,
    ) -> DrawResult {
        let mut visible = self.visible_marks(x);
        visible.retain(|mark| !mark.label.is_empty());
        let at_the_top = self.is_emptier_above(&visible, x, y);
        for (n, mark) in visible.into_iter().enumerate() {
            let (side, shift) = match mark.jump {
                Some(_) => (HPos::Center, 0),
                None if mark.x > f64::midpoint(x.range.0, x.range.1) => (HPos::Right, -fine(5.0)),
                None => (HPos::Left, fine(5.0)),
            };
            let down = fine(LINE * (n as f64 + 0.6));
            let column = place((mark.x, y.range.0)).0;
            let row = match mark.jump {
                Some((from, to)) => at_a_jump([from, to].map(|value| place((mark.x, value)).1), rows),
                None if at_the_top => rows.start + down,
                None => rows.end - down,
            };
            let style = text(TEXT * 0.9, (side, VPos::Center));
            let halo = TextStyle { color: Ink::Halo.placeholder().to_backend_color(), ..style.clone() };
            for style in [halo, style] {
                area.draw(&Text::new(mark.label.clone(), (column + shift, row), style))?;
            }
        }
        Ok(())
    }

    /// At the right, each curve's label at the height where the curve ends, or as near as there is room; or one below
    /// the other.
    fn label_ends(&self, area: &Area<'_>, ends: &[Option<Pixel>], columns: Range<i32>, rows: Range<i32>) -> DrawResult {
        // curves without visible points are labelled below the others
        let wanted: Vec<_> = ends.iter().map(|end| f64::from(end.map_or(rows.end, |(_, y)| y))).collect();
        let range = (f64::from(rows.start + fine(LINE / 2.0)), f64::from(rows.end - fine(LINE / 2.0)));
        let places = match self.listed {
            true => separate(&vec![range.0; wanted.len()], LINE * FINE, (range.0, range.1)),
            false => separate(&wanted, LINE * FINE, range),
        };
        for ((curve, end), place) in self.curves.iter().zip(ends).zip(places) {
            let at = (columns.end + fine(GAP), place.round() as i32);
            // a longer leader would look like a curve
            let near = end.filter(|(x, _)| !self.listed && columns.end - x < (columns.end - columns.start) / 4);
            if let Some(end) = near.filter(|(x, y)| (y - at.1).abs() > fine(1.0) || *x < columns.end - fine(8.0)) {
                area.draw(&PathElement::new([end, (at.0 - fine(2.0), at.1)], stroke(Ink::Leader, 0.8)))?;
            }
            draw_label(area, curve, self.curves.len() > 1, at, &curve.label)?;
        }
        Ok(())
    }

    /// Title, legend, and notes.
    fn draw_texts(&self, area: &Area<'_>, layout: &Layout) -> DrawResult {
        for (n, line) in layout.title.iter().enumerate() {
            let mut style = text(TITLE, (HPos::Left, VPos::Top));
            style.font = style.font.style(FontStyle::Bold);
            area.draw(&Text::new(line.clone(), (fine(MARGIN), fine(MARGIN + n as f64 * (LINE + 2.0))), style))?;
        }
        for (n, (x, y)) in layout.legend.iter().enumerate() {
            let curve = &self.curves[n];
            draw_label(area, curve, self.curves.len() > 1, (fine(*x), fine(*y)), &in_legend(curve))?;
        }
        for (n, line) in layout.notes.iter().enumerate() {
            let y = layout.height - MARGIN - (layout.notes.len() - n) as f64 * LINE;
            area.draw(&Text::new(line.clone(), (fine(MARGIN), fine(y)), text(TEXT * 0.9, (HPos::Left, VPos::Top))))?;
        }
        Ok(())
    }
}

/// The row of a label at a jump: in its middle, which it covers; but above a low jump, or below that at the top of the
/// chart.
fn at_a_jump([from, to]: [i32; 2], rows: &Range<i32>) -> i32 {
    let half = fine(LINE * 0.6);
    match (from - to).abs() > 4 * half {
        true => i32::midpoint(from, to),
        false if from.min(to) - 2 * half > rows.start => from.min(to) - half,
        false => from.max(to) + half,
    }
}

/// Short strokes at the left and lower sides.
fn minor_ticks(area: &Area<'_>, x: &Span, y: &Span, place: &dyn Fn((f64, f64)) -> Pixel, corner: Pixel) -> DrawResult {
    let style = stroke(Ink::Text, 0.8);
    for &value in &x.ticks.minor {
        let column = place((value, y.range.0)).0;
        area.draw(&PathElement::new([(column, corner.1), (column, corner.1 - fine(4.0))], style))?;
    }
    for &value in &y.ticks.minor {
        let row = place((x.range.0, value)).1;
        area.draw(&PathElement::new([(corner.0, row), (corner.0 + fine(4.0), row)], style))?;
    }
    Ok(())
}

/// Draws the visible part of a curve, and returns its rightmost point.
fn draw_curve(
    area: &Area<'_>,
    curve: &Curve,
    n: usize,
    marked: bool,
    frame: Frame,
    place: &dyn Fn((f64, f64)) -> Pixel,
) -> Result<Option<Pixel>, Box<dyn std::error::Error + Send + Sync>> {
    let inside: Vec<_> =
        curve.points.iter().filter(|point| frame.contains(**point)).map(|point| place(*point)).collect();
    if let Look::Points(marker) = curve.look {
        for &point in &inside {
            draw_marker(area, marker, curve.colour, point)?;
        }
        return Ok(rightmost(&inside));
    }
    let pieces = frame.pieces(&curve.points);
    let mut visible = inside.clone();
    for piece in &pieces {
        let path: Vec<_> = piece.iter().map(|point| place(*point)).collect();
        visible.extend(&path);
        area.draw(&PathElement::new(thinned(&path, fine(1.0)), line_style(curve)))?;
    }
    for point in frame.alone(&curve.points) {
        draw_marker(area, looks::marker(curve.colour), curve.colour, place(point))?;
    }
    // markers of different curves begin at different places, so that they do not cover each other
    let apart = fine(64.0);
    let mut last = inside.first().map_or(0, |(x, _)| *x);
    let mut wait = apart * (n as i32 % 5 + 1) / 6;
    let all = curve.look == Look::Marked;
    for &point in inside.iter().filter(|_| all || marked && has_markers(curve.look)) {
        if all || (point.0 - last).abs() >= wait {
            draw_marker(area, looks::marker(curve.colour), curve.colour, point)?;
            (last, wait) = (point.0, apart);
        }
    }
    Ok(rightmost(&visible))
}

/// The rightmost point of a curve, whatever the order of its points.
fn rightmost(points: &[Pixel]) -> Option<Pixel> {
    points.iter().copied().max_by_key(|(x, _)| *x)
}

fn has_markers(look: Look) -> bool {
    matches!(look, Look::Line | Look::Marked)
}

fn line_style(curve: &Curve) -> ShapeStyle {
    match curve.look {
        Look::Dashed => stroke(Ink::Dashed(curve.colour), 1.8),
        Look::Thick => stroke(Ink::Curve(curve.colour), 3.6),
        // beyond the colours, a line with markers is dashed
        Look::Line | Look::Marked if curve.colour >= looks::COUNT => stroke(Ink::Dashed(curve.colour), 1.6),
        Look::Line | Look::Marked | Look::Points(_) => stroke(Ink::Curve(curve.colour), 1.6),
    }
}

fn draw_marker(area: &Area<'_>, marker: Marker, colour: usize, at: Pixel) -> DrawResult {
    let style = stroke(Ink::Curve(colour), 1.5);
    match marker.shape(at, RADIUS * FINE) {
        Shape::Strokes(strokes) => {
            for path in strokes {
                area.draw(&PathElement::new(path, style))?;
            }
        }
        Shape::Filled(corners) => area.draw(&Polygon::new(corners, style.filled()))?,
        Shape::Circle { filled } => {
            area.draw(&Circle::new(at, fine(RADIUS), ShapeStyle { filled, ..style }))?;
        }
    }
    Ok(())
}

/// A sample of the curve and its label, to the right of a place and vertically centred on it.
fn draw_label(area: &Area<'_>, curve: &Curve, marked: bool, (x, y): Pixel, label: &str) -> DrawResult {
    if !matches!(curve.look, Look::Points(_)) {
        area.draw(&PathElement::new([(x, y), (x + fine(SAMPLE), y)], line_style(curve)))?;
    }
    let marker = match curve.look {
        Look::Points(marker) => Some(marker),
        look => (look == Look::Marked || marked && has_markers(look)).then(|| looks::marker(curve.colour)),
    };
    if let Some(marker) = marker {
        draw_marker(area, marker, curve.colour, (x + fine(SAMPLE / 2.0), y))?;
    }
    let color = Ink::Curve(curve.colour).placeholder().to_backend_color();
    let style = TextStyle { color, ..text(TEXT, (HPos::Left, VPos::Center)) };
    area.draw(&Text::new(label.to_owned(), (x + fine(SAMPLE + 5.0), y), style))?;
    Ok(())
}
