//! Heat maps: cells over two quantities, coloured by a third, as SVG pictures.
//!
//! A [`HeatMap`] has two axes, a colour scale, and one or more panels of cells, such as one for each scheme. All panels
//! have the same axes and one common colour scale. Axes hold numbers or words; the border between two cells lies midway
//! between their values, on a logarithmic axis midway between the logarithms. So values may have any distances and any
//! order.
//!
//! Numbers of one sign have the colours of viridis, from dark to bright, which increase in lightness evenly, also in
//! grey print and for people with any colour vision. Where a linear or a symmetric logarithmic scale has values of both
//! signs, colours go from blue through white at 0 to red; in grey print, the sign is not visible. Words, such as
//! verdicts, have colours of their own, and marks within cells that are large enough.
//!
//! A cell without a value is hatched. Zero and negative numbers on a logarithmic scale, and infinite numbers, have
//! colours that the scale does not contain. Each of these has an entry in the legend, with the number of its cells.
//!
//! Fewer than 10 000 cells of at least two pixels are rectangles, of which neighbours with one colour are one. Others
//! are an image within the picture (PNG, lossless, without smoothing) of about a byte for each cell: 2000 × 2000 cells
//! without any order are 5.4 MB of SVG, those of an escape map 0.08 MB. If the cells have different sizes, the image
//! has four pixels for each unit of the picture, so that borders are exact to an eighth of a unit.
//!
//! | module | what it is |
//! | --- | --- |
//! | `check` | what cannot be drawn |
//! | `scale` | which scale suits the values, and where it ends |
//! | `shades` | from a value to its colour; words and special values |
//! | `strip` | the cells along an axis: order, borders, labels |
//! | `layout` | the sizes and places of all parts |
//! | `draw` | the picture as a whole: panels, axes, title |
//! | `cells` | cells as rectangles, marks, hatching |
//! | `image` | cells as an image |
//! | `legend` | the colour bar, and the entries below it |

mod cells;
mod check;
mod draw;
mod image;
mod layout;
mod legend;
mod scale;
mod shades;
mod strip;

use crate::picture::ticks::Scale;

/// The content of one picture.
#[derive(Clone, Debug)]
pub(crate) struct HeatMap {
    /// Above the picture; T_{m,m} and E_40 get subscripts, here and in all labels.
    pub(crate) title: String,
    /// The axis below.
    pub(crate) x: CellAxis,
    /// The axis at the left.
    pub(crate) y: CellAxis,
    /// What the colours mean, in all panels.
    pub(crate) colour: Colour,
    /// In rows from left to right.
    pub(crate) panels: Vec<Panel>,
    /// Short remarks below the picture.
    pub(crate) notes: Vec<String>,
}

/// The values along an axis, one for each column or row of cells.
#[derive(Clone, Debug)]
pub(crate) struct CellAxis {
    /// The quantity, with its unit.
    pub(crate) label: String,
    /// In the order of the cells.
    pub(crate) values: Values,
}

/// The values of an axis.
#[derive(Clone, Debug)]
pub(crate) enum Values {
    /// Different numbers in any order, on a logarithmic scale positive ones; they are drawn from left to right, and
    /// upwards.
    Numbers(Scale, Vec<f64>),
    /// Names, such as those of schemes; they are drawn from left to right, and downwards, in cells of one size. If
    /// there are too many for labels beside each other, only every n-th cell has one.
    Words(Vec<String>),
}

/// One map of several.
#[derive(Clone, Debug)]
pub(crate) struct Panel {
    /// Above the panel.
    pub(crate) title: String,
    /// Row by row: of nx values of x and ny of y, the value at (i, j) is `cells[i + nx·j]`. `None` and NaN are cells
    /// without a value, such as those of failed runs. With [`Colour::words`], the number of the word, from 0.
    pub(crate) cells: Vec<Option<f64>>,
}

/// What the colours of the cells mean.
#[derive(Clone, Debug)]
pub(crate) struct Colour {
    /// The quantity, with its unit.
    pub(crate) label: String,
    /// From numbers to colours.
    pub(crate) scale: ColourScale,
    /// The values at the ends of the colour bar; `None` for the smallest and the largest one. Where values of both
    /// signs occur, the bar is extended to be the same on both sides of 0. Cells beyond have the colours of the ends,
    /// and are counted in the legend.
    pub(crate) range: Option<(f64, f64)>,
}

/// From numbers to colours.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ColourScale {
    /// The values themselves.
    Linear,
    /// log₁₀ of the values. Zero and negative values are shown in colours of their own.
    Logarithmic,
    /// For values of both signs over many decades: with the threshold c, v/c for |v| ≤ c, and ±(1 + log₁₀|v/c|) beyond.
    /// The label states c.
    /// It is the power of ten below which about 5 % of the nonzero |v| lie, but no less than 10⁻¹² of the largest.
    SymmetricLogarithmic,
    /// One of these three. Without its smallest 5 %, does the nonzero |v| extend over more than three decades? If not,
    /// linear. If so, logarithmic, or symmetric if some value is negative.
    Automatic,
    /// Up to 12 words, such as verdicts; a cell holds the number of its word, from 0.
    Words(Vec<String>),
}

impl HeatMap {
    /// A map without notes, whose panels have any convenient size.
    pub(crate) fn new(title: impl Into<String>, x: CellAxis, y: CellAxis, colour: Colour, panels: Vec<Panel>) -> Self {
        HeatMap { title: title.into(), x, y, colour, panels, notes: Vec::new() }
    }
}

impl CellAxis {
    /// An axis with the numbers themselves.
    pub(crate) fn linear(label: impl Into<String>, values: Vec<f64>) -> Self {
        CellAxis { label: label.into(), values: Values::Numbers(Scale::Linear, values) }
    }

    /// An axis of positive numbers, by their logarithms.
    pub(crate) fn logarithmic(label: impl Into<String>, values: Vec<f64>) -> Self {
        CellAxis { label: label.into(), values: Values::Numbers(Scale::Log10, values) }
    }

    /// An axis of names.
    pub(crate) fn words(label: impl Into<String>, words: Vec<String>) -> Self {
        CellAxis { label: label.into(), values: Values::Words(words) }
    }
}

impl Values {
    /// The number of columns or rows.
    pub(crate) fn count(&self) -> usize {
        match self {
            Values::Numbers(_, values) => values.len(),
            Values::Words(words) => words.len(),
        }
    }
}

impl Panel {
    /// Cells row by row.
    pub(crate) fn new(title: impl Into<String>, cells: Vec<Option<f64>>) -> Self {
        Panel { title: title.into(), cells }
    }
}

impl Colour {
    /// A scale from the smallest to the largest value.
    fn new(label: impl Into<String>, scale: ColourScale) -> Self {
        Colour { label: label.into(), scale, range: None }
    }

    /// The same from one value to another, so that several pictures have the same colours, or a few extreme values do
    /// not hide the others.
    pub(crate) fn over(self, least: f64, most: f64) -> Self {
        Colour { range: Some((least, most)), ..self }
    }

    /// The values themselves.
    pub(crate) fn linear(label: impl Into<String>) -> Self {
        Colour::new(label, ColourScale::Linear)
    }

    /// The logarithms of the values.
    pub(crate) fn logarithmic(label: impl Into<String>) -> Self {
        Colour::new(label, ColourScale::Logarithmic)
    }

    /// Logarithms of values of both signs, with a threshold that the values give.
    pub(crate) fn symmetric_logarithmic(label: impl Into<String>) -> Self {
        Colour::new(label, ColourScale::SymmetricLogarithmic)
    }

    /// The scale that suits the values.
    pub(crate) fn automatic(label: impl Into<String>) -> Self {
        Colour::new(label, ColourScale::Automatic)
    }

    /// Words, such as verdicts.
    pub(crate) fn words(label: impl Into<String>, words: Vec<String>) -> Self {
        Colour::new(label, ColourScale::Words(words))
    }
}

#[cfg(test)]
mod tests;
