//! The picture as a whole.

use maud::{Markup, html};

use super::cells::{hatching, rectangles};
use super::image::{image, is_needed, pixels};
use super::layout::{Layout, PanelPlace};
use super::legend::cells;
use super::shades::{MISSING, Shades};
use super::strip::Strip;
use super::{HeatMap, Values};
use crate::Error;
use crate::picture::elements::{LINE, MARGIN, MIDDLE, Type, framed, text, turned};
use crate::picture::sheet::Sheet;
use crate::picture::ticks::significant;

impl HeatMap {
    /// The SVG text, for a separate file or as a part of an HTML page.
    ///
    /// It has no `id`s and no scripts; text stays text, and on dark screens the picture is dark. The number of elements
    /// does not depend on the number of cells.
    ///
    /// # Errors
    /// An axis or a panel has values that do not fit, such as too few cells, a value twice, or −1 on a logarithmic
    /// axis.
    pub(crate) fn svg(&self) -> Result<String, Error> {
        Ok(self.sheet()?.svg())
    }

    pub(super) fn sheet(&self) -> Result<Sheet, Error> {
        self.check()?;
        let (x, y) = (Strip::of_x(&self.x), Strip::of_y(&self.y));
        let shades = Shades::of(self);
        let panels: Vec<_> = self.panels.iter().map(|panel| shades.numbers(&panel.cells, &x, &y)).collect();
        let mut counts = [0; 256];
        panels.iter().flatten().for_each(|&number| counts[usize::from(number)] += 1);
        let layout = Layout::of(self, (&x, &y), &shades, &counts);
        let count = panels.iter().map(Vec::len).sum();
        let has_images = is_needed(count, (x.count(), y.count()), layout.panels[0].cells);
        let cells = |PanelPlace { cells, .. }: &PanelPlace, numbers: &[u8]| match has_images {
            true => image(&shades, numbers, (x.count(), (&pixels(&x, cells.width), &pixels(&y, cells.height))), *cells),
            false => Ok(rectangles(&shades, numbers, *cells, (&x.borders, &y.borders))),
        };
        let panel = |(place, numbers): (&PanelPlace, &Vec<u8>)| {
            Ok(draw_panel(place, &layout, numbers.contains(&MISSING), &cells(place, numbers)?))
        };
        let panels = layout.panels.iter().zip(&panels).map(panel).collect::<Result<Vec<Markup>, Error>>()?;
        let (across, up) = layout.grid.at((0.5, 0.5));
        let content = html! {
            @for panel in &panels { (panel) }
            (layout.texts.draw(layout.height))
            (text((across, layout.x_label), Type::plain(MIDDLE), &self.x.label))
            (turned((MARGIN + LINE / 2.0, up), -90, MIDDLE, &self.y.label))
            (layout.legend.draw(&shades))
        };
        let description = Some(self.description(&shades, &counts));
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

/// A panel with its title, ticks, and labels, and hatching behind its cells.
fn draw_panel(
    PanelPlace { cells, title, is_first }: &PanelPlace,
    layout: &Layout,
    is_hatched: bool,
    drawn: &Markup,
) -> Markup {
    let row = |n: usize| cells.top - 4.0 - ((title.len() - n) as f64 - 0.5) * LINE;
    html! {
        g class="panel" {
            @if is_hatched { (hatching(*cells)) }
            (drawn)
            (framed(*cells, "none"))
            (layout.x.draw(*cells))
            (layout.y.ticks(*cells))
            @if *is_first { (layout.y.labels(*cells)) }
            @for (n, line) in title.iter().enumerate() {
                (text((cells.at((0.5, 0.0)).0, row(n)), Type::plain(MIDDLE), line))
            }
        }
    }
}
