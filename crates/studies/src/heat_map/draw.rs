//! The picture as a whole.

use maud::{Markup, html};

use super::cells::{hatching, marks, rectangles};
use super::image::{image, is_needed, pixels};
use super::layout::{Layout, PanelPlace};
use super::legend::cells;
use super::shades::{MISSING, Shades};
use super::strip::Strip;
use super::{HeatMap, Values};
use crate::Error;
use crate::picture::elements::{Anchor, LINE, MARGIN, Type, framed, text, turned};
use crate::picture::sheet::Sheet;
use crate::picture::ticks::significant;

/// What all panels have in common.
struct Common<'a> {
    shades: Shades<'a>,
    x: Strip,
    y: Strip,
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
        Ok(self.sheet()?.svg())
    }

    /// The same in fixed colours on white, for a paper.
    ///
    /// # Errors
    /// As for [`HeatMap::svg`].
    pub fn svg_for_print(&self) -> Result<String, Error> {
        Ok(self.sheet()?.svg_for_print())
    }

    fn sheet(&self) -> Result<Sheet, Error> {
        self.check()?;
        let (x, y) = (Strip::of_x(&self.x), Strip::of_y(&self.y));
        let shades = Shades::of(self);
        let panels: Vec<_> = self.panels.iter().map(|panel| shades.numbers(&panel.cells, &x, &y)).collect();
        let mut counts = [0; 256];
        panels.iter().flatten().for_each(|&number| counts[usize::from(number)] += 1);
        let layout = Layout::of(self, (&x, &y), &shades, &counts);
        let count = panels.iter().map(Vec::len).sum();
        let has_images = is_needed(count, (x.count(), y.count()), layout.panels[0].cells);
        let common = Common { shades, x, y, layout, has_images };
        let layout = &common.layout;
        let panels = layout.panels.iter().zip(&panels).map(|(place, numbers)| common.panel(place, numbers));
        let panels: Vec<Markup> = panels.collect::<Result<_, _>>()?;
        let (across, up) = layout.grid.at((0.5, 0.5));
        let content = html! {
            @for panel in &panels { (panel) }
            (layout.texts.draw(layout.height))
            (text((across, layout.x_label), Type::plain(Anchor::Middle), &self.x.label))
            (turned((MARGIN + LINE / 2.0, up), -90, Anchor::Middle, &self.y.label))
            (layout.legend.draw(&common.shades))
        };
        let description = Some(self.description(&common.shades, &counts));
        Ok(Sheet { width: layout.width, height: layout.height, title: self.title.clone(), description, content })
    }

    /// What the picture shows, in one or two sentences.
    fn description(&self, shades: &Shades<'_>, counts: &[usize; 256]) -> String {
        let mut description = format!(
            "Heat map of {} over {} (across) and {} ({}), {} in {} panel{}.",
            self.colour.label,
            self.x.label,
            self.y.label,
            if matches!(self.y.values, Values::Words(_)) { "downwards" } else { "upwards" },
            cells(counts.iter().sum()),
            self.panels.len(),
            if self.panels.len() == 1 { "" } else { "s" },
        );
        if let Some((least, most)) = shades.data {
            description += &format!(" Values from {} to {}.", significant(least, 4), significant(most, 4));
        }
        for (number, word) in shades.words().iter().enumerate() {
            description += &format!(" {word}: {}.", cells(counts[number]));
        }
        if counts[usize::from(MISSING)] > 0 {
            description += &format!(" No value: {}.", cells(counts[usize::from(MISSING)]));
        }
        description
    }
}

impl Common<'_> {
    /// A panel with its title, ticks, and labels.
    fn panel(&self, PanelPlace { cells, title, is_first }: &PanelPlace, numbers: &[u8]) -> Result<Markup, Error> {
        let borders = (self.x.borders.as_slice(), self.y.borders.as_slice());
        let drawn = if self.has_images {
            let (x, y) = (pixels(&self.x, cells.width), pixels(&self.y, cells.height));
            image(&self.shades, numbers, (self.x.count(), (&x, &y)), *cells)?
        } else {
            html! { (rectangles(&self.shades, numbers, *cells, borders)) (marks(&self.shades, numbers, *cells, borders)) }
        };
        let row = |n: usize| cells.top - 4.0 - ((title.len() - n) as f64 - 0.5) * LINE;
        Ok(html! {
            g class="panel" {
                @if numbers.contains(&MISSING) { (hatching(*cells)) }
                (drawn)
                (framed(*cells, "none"))
                (self.layout.x.draw(*cells))
                (self.layout.y.ticks(*cells))
                @if *is_first { (self.layout.y.labels(*cells)) }
                @for (n, line) in title.iter().enumerate() {
                    (text((cells.at((0.5, 0.0)).0, row(n)), Type::plain(Anchor::Middle), line))
                }
            }
        })
    }
}
