//! What cannot be drawn, each with a sentence that says where.

use super::scale::{LARGEST, Measure};
use super::shades::MOST_WORDS;
use super::{CellAxis, Colour, ColourScale, HeatMap, Panel, Values};
use crate::Error;

fn usage(message: String, hint: &str) -> Error {
    Error::Usage { message, hint: hint.to_owned() }
}

impl HeatMap {
    /// Whether all sizes agree, and all values can be drawn.
    pub(super) fn check(&self) -> Result<(), Error> {
        self.x.check()?;
        self.y.check()?;
        if self.panels.is_empty() {
            return Err(usage(format!("the heat map {:?} has no panel", self.title), "give it at least one panel"));
        }
        self.colour.check()?;
        self.panels.iter().try_for_each(|panel| self.check_panel(panel))
    }

    fn check_panel(&self, panel: &Panel) -> Result<(), Error> {
        let (columns, rows) = (self.x.values.count(), self.y.values.count());
        if Some(panel.cells.len()) != columns.checked_mul(rows) {
            let message = format!(
                "the panel {:?} has {} cells, but the axes have {columns} and {rows} values",
                panel.title,
                panel.cells.len()
            );
            return Err(usage(message, "give one cell for each pair of values, row by row"));
        }
        let values = panel.cells.iter().flatten().copied();
        if let ColourScale::Words(words) = &self.colour.scale {
            return check_words(&panel.title, words, values);
        }
        let is_too_large = |value: &f64| value.is_finite() && value.abs() > LARGEST;
        match values.into_iter().find(is_too_large) {
            Some(value)
                if self.colour.range.is_none() && Measure::of(&self.colour, &self.panels) == Measure::Linear =>
            {
                Err(usage(
                    format!(
                        "the panel {:?} has the value {value:e}, which is too large for a linear scale",
                        panel.title
                    ),
                    "use a logarithmic scale",
                ))
            }
            _ => Ok(()),
        }
    }
}

impl Colour {
    fn check(&self) -> Result<(), Error> {
        if let ColourScale::SymmetricLogarithmic { linear_within: Some(threshold) } = self.scale
            && !(threshold > 0.0 && threshold.is_finite())
        {
            let message = format!("the threshold of a symmetric logarithmic scale must be positive, not {threshold}");
            return Err(usage(message, "give the size below which the scale is linear, such as 1e-12"));
        }
        let Some((least, most)) = self.range else { return Ok(()) };
        if !(least < most && least.abs() <= LARGEST && most.abs() <= LARGEST) {
            let message = format!("the range of colours from {least:e} to {most:e} is empty or too large");
            return Err(usage(message, "give the smaller value first, both of them finite"));
        }
        if least <= 0.0 && matches!(self.scale, ColourScale::Logarithmic) {
            let message = format!("the range of colours from {least:e} to {most:e} has no logarithms");
            return Err(usage(message, "give positive values, or use a linear or a symmetric logarithmic scale"));
        }
        Ok(())
    }
}

fn check_words(panel: &str, words: &[String], mut numbers: impl Iterator<Item = f64>) -> Result<(), Error> {
    if words.len() > MOST_WORDS {
        let message = format!("{} words cannot be distinguished by their colours", words.len());
        return Err(usage(message, &format!("use at most {MOST_WORDS}, for example by joining some of them")));
    }
    let is_word = |number: f64| number.is_nan() || (0..words.len()).any(|word| word as f64 == number);
    match numbers.find(|&number| !is_word(number)) {
        Some(number) => Err(usage(
            format!("the panel {panel:?} has a cell {number}, which is not the number of a word"),
            &format!("words are numbered from 0; there are {}", words.len()),
        )),
        None => Ok(()),
    }
}

impl CellAxis {
    fn check(&self) -> Result<(), Error> {
        if self.values.count() == 0 {
            return Err(usage(format!("the axis {:?} has no values", self.label), "give it at least one"));
        }
        let (values, is_logarithmic) = match &self.values {
            Values::Linear(values) => (values, false),
            Values::Logarithmic(values) => (values, true),
            Values::Words(_) => return Ok(()),
        };
        if let Some(value) = values.iter().find(|value| !value.is_finite() || value.abs() > LARGEST) {
            let message = format!("the axis {:?} has the value {value}, which is not finite or too large", self.label);
            return Err(usage(message, &format!("give finite values of at most {LARGEST:e}, or words")));
        }
        if let Some(value) = values.iter().find(|value| is_logarithmic && **value <= 0.0) {
            let message = format!("the logarithmic axis {:?} has the value {value}", self.label);
            return Err(usage(message, "give positive values, or use a linear axis"));
        }
        let mut sorted = values.clone();
        sorted.sort_by(f64::total_cmp);
        match sorted.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(usage(
                format!("the axis {:?} has the value {} twice", self.label, pair[0]),
                "give each value once, with one column or row of cells",
            )),
            None => Ok(()),
        }
    }
}
