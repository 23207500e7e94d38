//! A figure of the list.

use std::sync::OnceLock;

use crate::claim;
use crate::figures::drawing::Drawing;
use crate::figures::results::Results;
use crate::figures::table::Table;
use crate::finding::Finding;

/// A figure by its name.
pub(crate) struct Figure {
    pub(crate) name: &'static str,
    text: &'static str,
    read: OnceLock<Table>,
    draw: fn(&mut Drawing<'_>),
}

impl Figure {
    /// The figure with this name, the text of its table, and the function that requests the results that it needs and
    /// draws those that are there. It is called again until none is missing, so that it may request more depending on
    /// those.
    pub(crate) const fn new(name: &'static str, text: &'static str, draw: fn(&mut Drawing<'_>)) -> Figure {
        Figure { name, text, read: OnceLock::new(), draw }
    }

    pub(crate) fn table(&self) -> &Table {
        self.read.get_or_init(|| claim::read(self.text))
    }

    /// What it shows of the results that are there.
    pub(crate) fn draw(&self, results: &Results) -> Finding {
        let mut drawing = Drawing::new(results, self.table());
        (self.draw)(&mut drawing);
        drawing.finished()
    }
}
