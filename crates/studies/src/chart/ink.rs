//! Colours and dashes that a style sheet can change.
//!
//! plotters writes plain colours, without dashes and classes. So each kind of part is drawn in a placeholder colour,
//! which is then replaced by its attributes.

use plotters::style::RGBColor;

use super::looks;
use crate::picture::{Frame, Theme};

/// The kind of a stroke, a filled shape, or a text.
#[derive(Clone, Copy)]
pub(super) enum Ink {
    /// Frame and texts.
    Text,
    /// Lines of the grid.
    Grid,
    /// From a curve to its label.
    Leader,
    /// Behind a text that lies on lines: the same text, broad and in the colour of the paper.
    Halo,
    /// A continuous line, or a marker, of a colour.
    Curve(usize),
    /// A dashed line of a colour.
    Dashed(usize),
}

/// Lengths in the picture are in tenths of a pixel, because plotters has integers only.
pub(super) const FINE: f64 = 10.0;

impl Ink {
    fn all() -> impl Iterator<Item = Ink> {
        let curves = (0..looks::COUNT).flat_map(|index| [Ink::Curve(index), Ink::Dashed(index)]);
        [Ink::Text, Ink::Grid, Ink::Leader, Ink::Halo].into_iter().chain(curves)
    }

    /// The placeholder colour until the picture is finished.
    pub(super) fn placeholder(self) -> RGBColor {
        match self {
            Ink::Text => RGBColor(1, 0, 0),
            Ink::Grid => RGBColor(1, 0, 1),
            Ink::Leader => RGBColor(1, 0, 2),
            Ink::Halo => RGBColor(1, 0, 3),
            Ink::Curve(index) => RGBColor(2, 0, (index % looks::COUNT) as u8),
            Ink::Dashed(index) => RGBColor(2, 1, (index % looks::COUNT) as u8),
        }
    }

    fn colour(self) -> &'static str {
        match self {
            Ink::Text => "#000000",
            Ink::Grid => "#DDDDDD",
            Ink::Leader => "#888888",
            Ink::Halo => "#FFFFFF",
            Ink::Curve(index) | Ink::Dashed(index) => looks::colour(index),
        }
    }

    /// Its class in the style sheet; other colours are visible on white and on black.
    fn class(self) -> Option<&'static str> {
        match self {
            Ink::Text | Ink::Curve(looks::BLACK) | Ink::Dashed(looks::BLACK) => Some("ink"),
            Ink::Curve(looks::BLUE) | Ink::Dashed(looks::BLUE) => Some("blue"),
            Ink::Grid => Some("grid"),
            Ink::Halo => Some("halo"),
            _ => None,
        }
    }

    fn attributes(self, paint: &str) -> String {
        let mut text = format!("{paint}=\"{}\"", self.colour());
        if let Some(class) = self.class() {
            text += &format!(" class=\"{class}-{paint}\"");
        }
        if let Ink::Halo = self {
            text += &format!(" stroke=\"{}\" stroke-width=\"{}\" aria-hidden=\"true\"", self.colour(), 5.0 * FINE);
        }
        if let Ink::Dashed(index) = self {
            let lengths: Vec<_> =
                looks::dashes(index).iter().map(|&length| (f64::from(length) * FINE).to_string()).collect();
            text += &format!(" stroke-dasharray=\"{}\"", lengths.join(" "));
        }
        text
    }
}

/// The picture of plotters as one that stands alone.
pub(super) fn finished(drawn: &str, (width, height): (u32, u32), title: &str, theme: Theme) -> String {
    let mut content = drawn.split_once(">\n").map_or("", |(_, content)| content).trim_end().to_owned();
    if let Some(end) = content.rfind("</svg>") {
        content.truncate(end);
    }
    content = content.replace(" opacity=\"1\"", "").replace("\">\n", "\">").replace("\n</text>", "</text>");
    for ink in Ink::all() {
        let RGBColor(r, g, b) = ink.placeholder();
        for paint in ["stroke", "fill"] {
            // texts cannot match, because their quotation marks are escaped
            content = content.replace(&format!("{paint}=\"#{r:02X}{g:02X}{b:02X}\""), &ink.attributes(paint));
        }
    }
    let fine = |length: u32| f64::from(length) * FINE;
    let frame = Frame { size: (width, height), view: (fine(width), fine(height)), title, description: None };
    frame.around(&content, theme)
}
