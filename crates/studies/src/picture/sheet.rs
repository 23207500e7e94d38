//! The whole picture: its title, notes and style, and its colours on light and dark screens.

use maud::{Markup, PreEscaped, html};

use super::elements::{BLACK, LINE, MARGIN, Point, SMALL, START, TITLE, Type, text};
use super::text::{BOLD, lines, without_marks};

/// The style of all pictures. It is the same in each, so that pictures on one page do not interfere.
const STYLE: &str = "
svg.chart text { font-family: Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif; }
svg.chart polyline { stroke-linejoin: round; }
";

/// On dark screens, in addition.
const DARK: &str = "\
@media screen and (prefers-color-scheme: dark) {
  svg.chart .paper { fill: #16191d; }
  svg.chart .halo-fill { fill: #16191d; }
  svg.chart .halo-stroke { stroke: #16191d; }
  svg.chart .ink-fill { fill: #e8e8e8; }
  svg.chart .ink-stroke { stroke: #e8e8e8; }
  svg.chart .blue-fill { fill: #3c97d6; }
  svg.chart .blue-stroke { stroke: #3c97d6; }
  svg.chart .grid-fill { fill: #3a3f45; }
  svg.chart .grid-stroke { stroke: #3a3f45; }
}
";

/// Everything on a picture.
pub(crate) struct Sheet {
    pub(crate) width: f64,
    pub(crate) height: f64,
    /// For screen readers.
    pub(crate) title: String,
    /// The same at length.
    pub(crate) description: Option<String>,
    pub(crate) content: Markup,
}

impl Sheet {
    /// The picture in colours that follow the screen.
    pub(crate) fn svg(&self) -> String {
        self.with_style(&format!("{STYLE}{DARK}"))
    }

    /// In fixed colours on white.
    pub(crate) fn svg_for_print(&self) -> String {
        self.with_style(STYLE)
    }

    /// It has no `id`s, so that one page can contain many pictures. A minus sign is that of ASCII, so that numbers can
    /// be searched and copied.
    fn with_style(&self, style: &str) -> String {
        let (width, height) = (self.width.ceil(), self.height.ceil());
        let svg = html! {
            svg xmlns="http://www.w3.org/2000/svg" class="chart" role="img" width=(width) height=(height)
                viewBox=(format!("0 0 {width} {height}")) font-family="sans-serif" {
                title { (without_marks(&self.title)) }
                @if let Some(description) = &self.description { desc { (without_marks(description)) } }
                style { (PreEscaped(style)) }
                rect class="paper" width="100%" height="100%" fill="#FFFFFF" {}
                (self.content)
            }
        };
        svg.into_string().replace('−', "-")
    }

    /// Several pictures below each other as one.
    pub(crate) fn stacked(title: &str, sheets: &[Sheet]) -> Sheet {
        let tops = sheets.iter().scan(0.0, |top, sheet| Some(std::mem::replace(top, *top + sheet.height.ceil())));
        let content = html! {
            @for (sheet, top) in sheets.iter().zip(tops) {
                svg y=(top) width=(sheet.width.ceil()) height=(sheet.height.ceil()) {
                    title { (without_marks(&sheet.title)) }
                    (sheet.content)
                }
            }
        };
        Sheet {
            width: sheets.iter().map(|sheet| sheet.width).fold(0.0, f64::max),
            height: sheets.iter().map(|sheet| sheet.height.ceil()).sum(),
            title: title.to_owned(),
            description: None,
            content,
        }
    }
}

/// The title above and the notes below everything else, in lines that fit the width of a picture.
pub(crate) struct Texts {
    title: Vec<String>,
    notes: Vec<String>,
}

impl Texts {
    pub(crate) fn of(title: &str, notes: &[String], width: f64) -> Texts {
        let room = width - 2.0 * MARGIN;
        let notes = notes.iter().flat_map(|note| lines(note, room, SMALL)).collect();
        Texts { title: lines(title, room, TITLE * BOLD), notes }
    }

    /// Where the title ends.
    pub(crate) fn top(&self) -> f64 {
        MARGIN + self.title.len() as f64 * (LINE + 2.0)
    }

    /// What the notes need, with the margin below.
    pub(crate) fn below(&self) -> f64 {
        MARGIN + self.notes.len() as f64 * LINE + if self.notes.is_empty() { 0.0 } else { 8.0 }
    }

    /// On a picture of this height.
    pub(crate) fn draw(&self, height: f64) -> Markup {
        let of = |size: f64| Type { anchor: START, size, ink: BLACK };
        let note = |n: usize| height - MARGIN - ((self.notes.len() - n) as f64 - 0.5) * LINE;
        html! {
            @if !self.title.is_empty() {
                g font-weight="bold" {
                    @for (n, line) in self.title.iter().enumerate() {
                        (text((MARGIN, MARGIN + n as f64 * (LINE + 2.0) + LINE / 2.0), of(TITLE), line))
                    }
                }
            }
            @for (n, line) in self.notes.iter().enumerate() { (text((MARGIN, note(n)), of(SMALL), line)) }
        }
    }
}

/// The places of entries of these widths from left to right, in as many rows as necessary.
pub(crate) fn in_rows(widths: impl Iterator<Item = f64>, (left, right): (f64, f64), top: f64) -> Vec<Point> {
    const APART: f64 = 22.0;
    let (mut x, mut y) = (left, top);
    let place = |width: f64| {
        if x > left && x + width > right {
            (x, y) = (left, y + LINE + 4.0);
        }
        let place = (x, y);
        x += width + APART;
        place
    };
    widths.map(place).collect()
}
