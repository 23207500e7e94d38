//! Colours and dashes that a style sheet can change.
//!
//! plotters writes plain colours, without dashes and classes. So each kind of part is drawn in a placeholder colour, which
//! is then replaced by its attributes.

use maud::{PreEscaped, html};
use plotters::style::RGBColor;

use super::looks;
use crate::indices::first_index;

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

/// Exponents as raised small digits: many fonts lack some of the raised characters, or have them in two styles.
fn raised(text: &str) -> String {
    const RAISED: [(char, char); 11] = [
        ('⁰', '0'),
        ('¹', '1'),
        ('²', '2'),
        ('³', '3'),
        ('⁴', '4'),
        ('⁵', '5'),
        ('⁶', '6'),
        ('⁷', '7'),
        ('⁸', '8'),
        ('⁹', '9'),
        ('⁻', '−'),
    ];
    let mut plain = String::with_capacity(text.len());
    let mut within = false;
    for character in text.chars() {
        let lowered = RAISED.iter().find(|(raised, _)| *raised == character).map(|(_, lowered)| *lowered);
        if lowered.is_some() != within {
            // the line goes back down where the exponent ends: by 0.4 em of the smaller font
            plain += match within {
                false => "<tspan dy=\"-0.4em\" font-size=\"0.75em\">",
                true if character == '<' => "</tspan>",
                true => "</tspan><tspan dy=\"0.3em\">\u{200b}</tspan>",
            };
            within = !within;
        }
        plain.push(lowered.unwrap_or(character));
    }
    plain
}

/// Indices as lowered small letters, in the texts of the picture.
fn lowered(content: &str) -> String {
    let mut all = String::with_capacity(content.len());
    let mut rest = content;
    while let Some((before, index, after)) = first_index(rest) {
        all += &format!(
            "{before}<tspan dy=\"0.3em\" font-size=\"0.75em\">{index}</tspan><tspan dy=\"-0.225em\">\u{200b}</tspan>"
        );
        rest = after;
    }
    all + rest
}

/// Indices in line: E40.
fn without_marks(text: &str) -> String {
    let mut all = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, index, after)) = first_index(rest) {
        all = all + before + index;
        rest = after;
    }
    all + rest
}

/// Whether a picture is dark on dark screens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Theme {
    LightAndDark,
    Light,
}

/// The style of all charts. It is the same in each, so that pictures on one page do not interfere.
const STYLE: &str = "
svg.chart text { font-family: Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif; }
svg.chart polyline { stroke-linejoin: round; }
";

/// On dark screens, in addition.
const DARK: &str = "\
@media screen and (prefers-color-scheme: dark) {
  svg.chart .paper { fill: #16191d; }
  svg.chart .halo-fill { fill: #16191d; stroke: #16191d; }
  svg.chart .ink-fill { fill: #e8e8e8; }
  svg.chart .ink-stroke { stroke: #e8e8e8; }
  svg.chart .blue-fill { fill: #3c97d6; }
  svg.chart .blue-stroke { stroke: #3c97d6; }
  svg.chart .grid-stroke { stroke: #3a3f45; }
}
";

/// The picture of plotters with its size in pixels, a title, a style and a background.
///
/// It has no `id`s, so that one page can contain many pictures.
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
    let content = lowered(&raised(&content));
    let fine = |length: u32| f64::from(length) * FINE;
    let view = format!("0 0 {} {}", fine(width), fine(height));
    let svg = html! {
        svg xmlns="http://www.w3.org/2000/svg" class="chart" role="img" width=(width) height=(height) viewBox=(view) {
            title { (without_marks(title)) }
            style { (PreEscaped(STYLE)) @if theme == Theme::LightAndDark { (PreEscaped(DARK)) } }
            rect class="paper" width="100%" height="100%" fill="#FFFFFF" {}
            (PreEscaped(content))
        }
    };
    svg.into_string()
}
