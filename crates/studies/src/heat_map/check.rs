//! What cannot be drawn, each with a sentence that says where.

use super::scale::scale;
use super::shades::MOST_WORDS;
use super::{CellAxis, Colour, ColourScale, HeatMap, Panel, Values};
use crate::Error;
use crate::picture::ticks::Scale;

/// Beyond this, differences of values may overflow.
const LARGEST: f64 = 1e290;

/// The error if something does not hold.
fn require(holds: bool, message: impl FnOnce() -> String, hint: &str) -> Result<(), Error> {
    if holds { Ok(()) } else { Err(Error::usage(message(), hint)) }
}

impl HeatMap {
    /// Whether all sizes agree, and all values can be drawn.
    pub(super) fn check(&self) -> Result<(), Error> {
        self.x.check()?;
        self.y.check()?;
        let none = || format!("the heat map {:?} has no panel", self.title);
        require(!self.panels.is_empty(), none, "give it at least one panel")?;
        self.colour.check()?;
        self.panels.iter().try_for_each(|panel| self.check_panel(panel))
    }

    fn check_panel(&self, Panel { title, cells }: &Panel) -> Result<(), Error> {
        let (columns, rows) = (self.x.values.count(), self.y.values.count());
        let sizes = || {
            let count = cells.len();
            format!("the panel {title:?} has {count} cells, but the axes have {columns} and {rows} values")
        };
        let agree = Some(cells.len()) == columns.checked_mul(rows);
        require(agree, sizes, "give one cell for each pair of values, row by row")?;
        let mut values = cells.iter().flatten().copied().filter(|value| !value.is_nan());
        let is_wrong = |value: &f64| match &self.colour.scale {
            ColourScale::Words(words) => !(0..words.len()).any(|word| word as f64 == *value),
            _ => value.is_finite() && value.abs() > LARGEST,
        };
        match (values.find(is_wrong), &self.colour.scale) {
            (Some(number), ColourScale::Words(words)) => Err(Error::usage(
                format!("the panel {title:?} has a cell {number}, which is not the number of a word"),
                format!("words are numbered from 0; there are {}", words.len()),
            )),
            (Some(value), _) if self.colour.range.is_none() && scale(&self.colour, &self.panels) == Scale::Linear => {
                let message =
                    format!("the panel {title:?} has the value {value:e}, which is too large for a linear scale");
                Err(Error::usage(message, "use a logarithmic scale"))
            }
            _ => Ok(()),
        }
    }
}

impl Colour {
    fn check(&self) -> Result<(), Error> {
        if let ColourScale::Words(words) = &self.scale {
            let message = || format!("{} words cannot be distinguished by their colours", words.len());
            let hint = format!("use at most {MOST_WORDS}, for example by joining some of them");
            require(words.len() <= MOST_WORDS, message, &hint)?;
        }
        let Some((least, most)) = self.range else { return Ok(()) };
        let range = |fault: &str| format!("the range of colours from {least:e} to {most:e} {fault}");
        let is_range = least < most && least.abs() <= LARGEST && most.abs() <= LARGEST;
        require(is_range, || range("is empty or too large"), "give the smaller value first, both of them finite")?;
        let has_logarithms = least > 0.0 || self.scale != ColourScale::Logarithmic;
        let hint = "give positive values, or use a linear or a symmetric logarithmic scale";
        require(has_logarithms, || range("has no logarithms"), hint)
    }
}

impl CellAxis {
    /// Whether it can be drawn: it has values, and numbers on it are different and not too large.
    pub(crate) fn is_drawable(&self) -> bool {
        self.check().is_ok()
    }

    fn check(&self) -> Result<(), Error> {
        let label = &self.label;
        require(self.values.count() > 0, || format!("the axis {label:?} has no values"), "give it at least one")?;
        let Values::Numbers(scale, values) = &self.values else { return Ok(()) };
        let mut sorted = values.clone();
        sorted.sort_by(f64::total_cmp);
        if let Some(value) = values.iter().find(|value| !value.is_finite() || value.abs() > LARGEST) {
            let message = format!("the axis {label:?} has the value {value}, which is not finite or too large");
            return Err(Error::usage(message, format!("give finite values of at most {LARGEST:e}, or words")));
        }
        let positive = || format!("the logarithmic axis {label:?} has the value {}", sorted[0]);
        require(*scale != Scale::Log10 || sorted[0] > 0.0, positive, "give positive values, or use a linear axis")?;
        let twice = sorted.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0]);
        let message = || format!("the axis {label:?} has the value {} twice", twice.unwrap_or_default());
        require(twice.is_none(), message, "give each value once, with one column or row of cells")
    }
}
