//! What all pictures have in common: the sizes of their texts, raised and lowered characters, the minus sign, and
//! colours on light and dark screens.

use maud::{PreEscaped, html};

use crate::indices::first_index;

// sizes in pixels; half a page is about 640 of them
pub(crate) const TITLE: f64 = 18.0;
pub(crate) const TEXT: f64 = 16.0;
pub(crate) const LINE: f64 = 20.0;
pub(crate) const MARGIN: f64 = 10.0;
pub(crate) const TICK: f64 = 5.0;

/// Whether a picture is dark on dark screens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Theme {
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
  svg.chart .grid-fill { fill: #3a3f45; }
  svg.chart .grid-stroke { stroke: #3a3f45; }
}
";

/// An `<svg>` element without its content.
pub(crate) struct Frame<'a> {
    /// In pixels.
    pub(crate) size: (u32, u32),
    /// In the units of the content.
    pub(crate) view: (f64, f64),
    /// For screen readers.
    pub(crate) title: &'a str,
    /// The same at length.
    pub(crate) description: Option<&'a str>,
}

impl Frame<'_> {
    /// The whole picture, with a style and a background. It has no `id`s, so that one page can contain many pictures. A
    /// minus sign is that of ASCII, so that numbers can be searched and copied.
    pub(crate) fn around(&self, content: &str, theme: Theme) -> String {
        let ((width, height), view) = (self.size, format!("0 0 {} {}", self.view.0, self.view.1));
        let svg = html! {
            svg xmlns="http://www.w3.org/2000/svg" class="chart" role="img" width=(width) height=(height) viewBox=(view) {
                title { (without_marks(self.title)) }
                @if let Some(description) = self.description { desc { (without_marks(description)) } }
                style { (PreEscaped(STYLE)) @if theme == Theme::LightAndDark { (PreEscaped(DARK)) } }
                rect class="paper" width="100%" height="100%" fill="#FFFFFF" {}
                (PreEscaped(lowered(&raised(content))))
            }
        };
        svg.into_string().replace('−', "-")
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
        ('⁻', '-'),
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
