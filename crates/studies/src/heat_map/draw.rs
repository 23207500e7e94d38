//! The picture as a whole.

use maud::{Markup, PreEscaped, html};

use super::cells::{hatching, marks, rectangles};
use super::image::{image, is_needed, pixels};
use super::layout::{Layout, PanelPlace};
use super::legend::counted;
use super::shades::{MISSING, Shades};
use super::strip::{Direction, Strip};
use super::svg::{Anchor, NEAR, Place, length, text, turned};
use super::{HeatMap, Values};
use crate::Error;
use crate::picture::{Frame, LINE, MARGIN, TEXT, TICK, TITLE, Theme};
use crate::ticks::significant;

/// What all panels have in common.
struct Common<'a> {
    shades: Shades<'a>,
    x: Strip,
    y: Strip,
    borders: (Vec<f64>, Vec<f64>),
    layout: Layout,
    has_images: bool,
}

impl HeatMap {
    /// The SVG text, for a separate file or as a part of an HTML page.
    ///
    /// It has no `id`s and no scripts; text stays text, and on dark screens the picture is dark. The number of elements
    /// does not depend on the number of cells.
    ///
    /// # Errors
    /// An axis or a panel has values that do not fit, such as too few cells, a value twice, or −1 on a logarithmic
    /// axis.
    pub fn svg(&self) -> Result<String, Error> {
        self.svg_of(Theme::LightAndDark)
    }

    /// The same in fixed colours on white, for a paper.
    ///
    /// # Errors
    /// As for [`HeatMap::svg`].
    pub fn svg_for_print(&self) -> Result<String, Error> {
        self.svg_of(Theme::Light)
    }

    fn svg_of(&self, theme: Theme) -> Result<String, Error> {
        self.check()?;
        let (x, y) = (Strip::of_x(&self.x), Strip::of_y(&self.y));
        let shades = Shades::of(self);
        let panels: Vec<_> = self.panels.iter().map(|panel| shades.numbers(&panel.cells, &x, &y)).collect();
        let mut counts = [0; 256];
        panels.iter().flatten().for_each(|&number| counts[usize::from(number)] += 1);
        let layout = Layout::of(self, (&x, &y), &shades, &counts);
        let cells = panels.iter().map(Vec::len).sum();
        let has_images = is_needed(cells, (x.count(), y.count()), layout.panels[0].cells);
        let common = Common { borders: (x.borders(), y.borders()), shades, x, y, layout, has_images };
        let mut content = String::new();
        for (place, numbers) in common.layout.panels.iter().zip(&panels) {
            content += &common.panel(place, numbers)?.into_string();
        }
        content += &self.texts(&common.layout).into_string();
        content += &common.layout.legend.draw(&common.shades).into_string();
        let content = html! { g font-family="sans-serif" { (PreEscaped(content)) } };
        let view = (common.layout.width.ceil(), common.layout.height.ceil());
        let description = self.description(&common.shades, &counts);
        let frame =
            Frame { size: (view.0 as u32, view.1 as u32), view, title: &self.title, description: Some(&description) };
        Ok(frame.around(&content.into_string(), theme))
    }

    /// Title, labels of the axes, and notes.
    fn texts(&self, layout: &Layout) -> Markup {
        let Place { left, top, width, height } = layout.grid;
        html! {
            @if !layout.title.is_empty() {
                g font-weight="bold" {
                    @for (n, line) in layout.title.iter().enumerate() {
                        (text((MARGIN, MARGIN + n as f64 * (LINE + 2.0) + LINE / 2.0), Anchor::Start, TITLE, line))
                    }
                }
            }
            (text((left + width / 2.0, layout.x_label), Anchor::Middle, TEXT, &self.x.label))
            (turned((MARGIN + LINE / 2.0, top + height / 2.0), -90, Anchor::Middle, &self.y.label))
            @for (n, line) in layout.notes.iter().enumerate() {
                @let y = layout.height - MARGIN - (layout.notes.len() - n) as f64 * LINE + LINE / 2.0;
                (text((MARGIN, y), Anchor::Start, TEXT * 0.9, line))
            }
        }
    }

    /// What the picture shows, in one or two sentences.
    fn description(&self, shades: &Shades<'_>, counts: &[usize; 256]) -> String {
        let mut description = format!(
            "Heat map of {} over {} (across) and {} ({}), {} in {} panel{}.",
            self.colour.label,
            self.x.label,
            self.y.label,
            if matches!(self.y.values, Values::Words(_)) { "downwards" } else { "upwards" },
            counted(counts.iter().sum()),
            self.panels.len(),
            if self.panels.len() == 1 { "" } else { "s" },
        );
        if let Some((least, most)) = shades.data {
            description += &format!(" Values from {} to {}.", significant(least, 4), significant(most, 4));
        }
        for (number, word) in shades.words().iter().enumerate() {
            description += &format!(" {word}: {}.", counted(counts[number]));
        }
        if counts[usize::from(MISSING)] > 0 {
            description += &format!(" No value: {}.", counted(counts[usize::from(MISSING)]));
        }
        description
    }
}

impl Common<'_> {
    /// A panel with its title, ticks, and labels.
    fn panel(&self, place: &PanelPlace, numbers: &[u8]) -> Result<Markup, Error> {
        let cells = place.cells;
        let borders = (self.borders.0.as_slice(), self.borders.1.as_slice());
        let drawn = if self.has_images {
            let pixels =
                |strip: &Strip, borders: &[f64], length: f64| pixels(borders, strip.is_even(0.05 / length), length);
            let (x, y) = (pixels(&self.x, borders.0, cells.width), pixels(&self.y, borders.1, cells.height));
            image(&self.shades, numbers, (self.x.count(), (&x, &y)), cells)?
        } else {
            html! { (rectangles(&self.shades, numbers, cells, borders)) (marks(&self.shades, numbers, cells, borders)) }
        };
        Ok(html! {
            g class="panel" {
                @if numbers.contains(&MISSING) { (hatching(&[cells])) }
                (drawn)
                rect x=(length(cells.left)) y=(length(cells.top)) width=(length(cells.width)) height=(length(cells.height))
                    fill="none" stroke="#000000" class="ink-stroke" {}
                (self.ticks(cells))
                (self.labels_below(cells))
                @if place.is_first { (self.labels_beside(cells)) }
                @for (n, line) in place.title.iter().enumerate() {
                    @let y = cells.top - 4.0 - (place.title.len() - n) as f64 * LINE + LINE / 2.0;
                    (text((cells.left + cells.width / 2.0, y), Anchor::Middle, TEXT, line))
                }
            }
        })
    }

    /// Outside the frame, so that they do not hide cells.
    fn ticks(&self, cells: Place) -> Markup {
        let (x, y) = (&self.layout.x, &self.layout.y);
        let mut path = String::new();
        let long = |labels: &[(f64, Vec<String>)]| labels.iter().map(|(part, _)| (*part, TICK)).collect::<Vec<_>>();
        let short = |minor: &[f64]| minor.iter().map(|part| (*part, TICK * 0.6)).collect::<Vec<_>>();
        for (part, size) in long(&x.labelled).into_iter().chain(short(&x.minor)) {
            path +=
                &format!("M{} {}v{}", length(cells.left + part * cells.width), length(cells.bottom()), length(size));
        }
        for (part, size) in long(&y.labelled).into_iter().chain(short(&y.minor)) {
            path +=
                &format!("M{} {}h{}", length(cells.left), length(cells.bottom() - part * cells.height), length(-size));
        }
        html! { path d=(path) fill="none" stroke="#000000" class="ink-stroke" {} }
    }

    fn labels_below(&self, cells: Place) -> Markup {
        let labels = &self.layout.x;
        let top = cells.bottom() + TICK + NEAR;
        html! {
            @for (part, lines) in &labels.labelled {
                @let x = cells.left + part * cells.width;
                @for (n, line) in lines.iter().enumerate() {
                    @if labels.direction == Direction::Tilted {
                        (turned((x + 2.0, top + 2.0), -45, Anchor::End, line))
                    } @else {
                        (text((x, top + (n as f64 + 0.5) * LINE), Anchor::Middle, TEXT, line))
                    }
                }
            }
        }
    }

    fn labels_beside(&self, cells: Place) -> Markup {
        html! {
            @for (part, lines) in &self.layout.y.labelled {
                @for line in lines {
                    (text((cells.left - TICK - NEAR, cells.bottom() - part * cells.height), Anchor::End, TEXT, line))
                }
            }
        }
    }
}
