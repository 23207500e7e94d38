//! The picture as a whole.

use maud::{Markup, html};

use super::clip::{alone, pieces};
use super::layout::{GAP, Layout, Span, UNDER};
use super::looks::in_legend;
use super::thin::thinned;
use super::{Chart, Curve, Look, Mark};
use crate::picture::elements::{
    BLACK, END, GREY, GRID, LINE, MARGIN, MIDDLE, Place, Point, SMALL, START, Type, commands, framed, line, path,
    stroke, text, text_on_lines, turned,
};
use crate::picture::sheet::Sheet;
use crate::picture::text::separate;

impl Chart {
    /// The SVG text, for a separate file or as a part of an HTML page.
    ///
    /// It has no `id`s and no scripts; text stays text, and on dark screens the picture is dark. Of a line, at most
    /// four points are written for each column of a pixel; of [`Curve::dots`], all.
    pub fn svg(&self) -> String {
        self.sheet().svg()
    }

    /// The same in fixed colours on white, for a paper.
    pub fn svg_for_print(&self) -> String {
        self.sheet().svg_for_print()
    }

    pub(super) fn sheet(&self) -> Sheet {
        let layout = Layout::of(self);
        let content = self.content(&layout);
        let Layout { width, height, .. } = layout;
        Sheet { width, height, title: self.title.clone(), description: None, content }
    }

    fn content(&self, layout: &Layout) -> Markup {
        let Layout { x, y, second, plot, .. } = layout;
        let drawn: Vec<_> =
            self.curves.iter().enumerate().map(|(n, curve)| self.draw_curve(n, curve, layout)).collect();
        let ends: Vec<_> = drawn.iter().map(|(_, end)| *end).collect();
        html! {
            (grid(x, y, plot))
            @for side in [Some(x), Some(y), second.as_ref()].into_iter().flatten() { (side.side.draw(*plot)) }
            (self.names_of_axes(layout))
            @for mark in self.visible_marks(x) {
                @let column = plot.at((x.part(mark.x), 0.0)).0;
                (line(&[(column, plot.top), (column, plot.bottom())], stroke(GREY, 1.2)))
            }
            @for (curve, _) in &drawn { (curve) }
            (self.labels_of_marks(x, y, plot))
            (framed(*plot, "none"))
            @if second.is_none() { (self.labels_of_ends(&ends, plot)) }
            @for (curve, place) in self.curves.iter().zip(&layout.legend) {
                (curve.labelled(*place, self.has_markers(curve), &in_legend(curve)))
            }
            (layout.texts.draw(layout.height))
        }
    }

    fn names_of_axes(&self, Layout { plot, width, .. }: &Layout) -> Markup {
        let (column, row) = plot.at((0.5, 0.5));
        html! {
            (text((column, plot.bottom() + UNDER - LINE / 2.0), Type::plain(MIDDLE), &self.x.label))
            (turned((MARGIN + LINE / 2.0, row), -90, MIDDLE, &self.y.label))
            @if let Some(axis) = &self.second_y {
                (turned((width - MARGIN - LINE / 2.0, row), 90, MIDDLE, &axis.label))
            }
        }
    }

    /// Whether a curve has markers: a line has some beside other curves.
    fn has_markers(&self, curve: &Curve) -> bool {
        match curve.look {
            Look::Points(_) | Look::Marked => true,
            Look::Line => self.curves.len() > 1,
            Look::Dashed | Look::Thick => false,
        }
    }

    /// The visible part of the n-th curve, and its rightmost point.
    fn draw_curve(&self, n: usize, curve: &Curve, layout: &Layout) -> (Markup, Option<Point>) {
        let plot = &layout.plot;
        let y = layout.second.as_ref().filter(|_| curve.is_right).unwrap_or(&layout.y);
        let points: Vec<Point> =
            curve.points.iter().map(|point| plot.at((layout.x.part(point.0), y.part(point.1)))).collect();
        let inside: Vec<Point> = points.iter().copied().filter(|point| plot.contains(*point)).collect();
        let (pieces, alone) = match curve.look {
            Look::Points(_) => (Vec::new(), Vec::new()),
            _ => (pieces(plot, &points), alone(plot, &points)),
        };
        let marked = match curve.look {
            Look::Line if self.has_markers(curve) => some_of(&inside, n),
            _ if self.has_markers(curve) => inside.clone(),
            _ => Vec::new(),
        };
        let end = inside.iter().chain(pieces.iter().flatten()).copied().max_by(|a, b| a.0.total_cmp(&b.0));
        let drawn = html! {
            @for piece in &pieces { (line(&thinned(piece), curve.stroke())) }
            (curve.marks(alone.into_iter().chain(marked)))
        };
        (drawn, end)
    }

    /// Whether fewer points are in the upper half of the chart than in the lower one, near the marks.
    fn is_emptier_above(&self, marks: &[&Mark], x: &Span, y: &Span) -> bool {
        let near = |value: f64| marks.iter().any(|mark| (x.part(mark.x) - x.part(value)).abs() < 0.2);
        let points = self.curves.iter().flat_map(|curve| &curve.points).filter(|point| near(point.0));
        let (above, below): (Vec<f64>, Vec<f64>) = points.map(|point| y.part(point.1)).partition(|part| *part > 0.5);
        above.len() <= below.len()
    }

    /// The marks within the chart.
    fn visible_marks(&self, x: &Span) -> Vec<&Mark> {
        self.marks.iter().filter(|mark| (x.range.0..=x.range.1).contains(&mark.x)).collect()
    }

    /// The labels of the marks, before the curves: in the middle of their jumps, or one below the other, at the end and
    /// on the side where there is room.
    fn labels_of_marks(&self, x: &Span, y: &Span, plot: &Place) -> Markup {
        let mut visible = self.visible_marks(x);
        visible.retain(|mark| !mark.label.is_empty());
        let at_the_top = self.is_emptier_above(&visible, x, y);
        let place = |n: usize, mark: &Mark| {
            let down = LINE * (n as f64 + 0.6);
            let (column, row) = plot.at((x.part(mark.x), 0.0));
            let row = if at_the_top { plot.top + down } else { row - down };
            match mark.jump {
                Some((from, to)) => {
                    ((column, at_a_jump([from, to].map(|value| plot.at((0.0, y.part(value))).1), plot)), MIDDLE)
                }
                None if x.part(mark.x) > 0.5 => ((column - 5.0, row), END),
                None => ((column + 5.0, row), START),
            }
        };
        html! {
            @for (n, mark) in visible.into_iter().enumerate() {
                @let (at, anchor) = place(n, mark);
                (text_on_lines(at, Type { anchor, size: SMALL, ink: BLACK }, &mark.label))
            }
        }
    }

    /// At the right, each curve's label at the height where the curve ends, or as near as there is room; or one below
    /// the other.
    fn labels_of_ends(&self, ends: &[Option<Point>], plot: &Place) -> Markup {
        let range = (plot.top + LINE / 2.0, plot.bottom() - LINE / 2.0);
        // curves without visible points are labelled below the others
        let wanted: Vec<f64> = match self.listed {
            true => vec![range.0; ends.len()],
            false => ends.iter().map(|end| end.map_or(plot.bottom(), |(_, y)| y)).collect(),
        };
        let left = plot.right() + GAP;
        // a longer leader would look like a curve
        let is_near = |(x, _): &Point| !self.listed && plot.right() - x < plot.width / 4.0;
        let is_apart = |(x, y): &Point, place: f64| (y - place).abs() > 1.0 || *x < plot.right() - 8.0;
        html! {
            @for ((curve, end), place) in self.curves.iter().zip(ends).zip(separate(&wanted, LINE, range)) {
                @if let Some(end) = end.filter(|end| is_near(end) && is_apart(end, place)) {
                    (line(&[end, (left - 2.0, place)], stroke(GREY, 0.8)))
                }
                (curve.labelled((left, place), self.has_markers(curve), &curve.label))
            }
        }
    }
}

/// Lines at the labels of both axes.
fn grid(x: &Span, y: &Span, plot: &Place) -> Markup {
    let columns = x.side.labelled.iter().map(|(part, _)| [(*part, 0.0), (*part, 1.0)]);
    let rows = y.side.labelled.iter().map(|(part, _)| [(0.0, *part), (1.0, *part)]);
    let lines: String = columns.chain(rows).map(|ends| commands(ends.map(|end| plot.at(end)))).collect();
    path(&lines, GRID, 1.0)
}

/// The row of a label at a jump: in its middle, which it covers; but above a low jump, or below that at the top of the
/// chart.
fn at_a_jump([from, to]: [f64; 2], plot: &Place) -> f64 {
    let half = LINE * 0.6;
    match (from - to).abs() > 4.0 * half {
        true => f64::midpoint(from, to),
        false if from.min(to) - 2.0 * half > plot.top => from.min(to) - half,
        false => from.max(to) + half,
    }
}

/// Points of the n-th curve that are far enough from each other for markers. Those of different curves begin at
/// different places, so that they do not cover each other.
fn some_of(points: &[Point], n: usize) -> Vec<Point> {
    const APART: f64 = 64.0;
    let mut last = points.first().map_or(0.0, |(x, _)| *x);
    let mut wait = APART * (n % 5 + 1) as f64 / 6.0;
    let mut is_marked = |(x, _): &Point| {
        let is_far = (x - last).abs() >= wait;
        if is_far {
            (last, wait) = (*x, APART);
        }
        is_far
    };
    points.iter().copied().filter(|point| is_marked(point)).collect()
}
