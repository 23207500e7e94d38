//! Drawing: a heat map, or curves.

use shadowstep_scenes::family::Meaning;

use super::cells::{Cells, Value, double};
use super::drawn::{OfSeveral, Picture, Scale};
use crate::Error;
use crate::chart::{Axis as ChartAxis, Chart, Curve, log10_of, stacked};
use crate::heat_map::{CellAxis, Colour, HeatMap, Panel};
use crate::sweeps::axes::Axes;
use crate::sweeps::axis::Axis;
use crate::sweeps::keep::Column;

/// The most words that have colours.
const MOST_WORDS: usize = 12;

/// The most curves of a chart, and the most charts.
const MOST_CURVES: usize = 24;

/// An axis of positive numbers over this ratio or more is logarithmic.
const LOGARITHMIC_FROM: f64 = 10.0;

impl Picture {
    /// The picture as SVG; `None` where no place has a value, or where there are too many words, curves or panels.
    ///
    /// # Errors
    /// Values that cannot be drawn.
    pub(crate) fn svg(
        &self,
        cells: &Cells,
        axes: &Axes,
        columns: &[Column],
        file: &str,
    ) -> Result<Option<String>, Error> {
        if cells.values.iter().all(|value| *value == Value::None) {
            return Ok(None);
        }
        let axis = |place: usize| &axes.all()[place];
        let label = self.label.clone().unwrap_or_else(|| columns[self.value].name.clone());
        let title = self.title.clone().unwrap_or_else(|| file.to_owned());
        let notes: Vec<String> = self.several(cells).into_iter().collect();
        match self.y {
            Some(y) => {
                let Some(colour) = self.colour(cells, &label) else { return Ok(None) };
                let panels = self.panels(cells, self.panels.map(axis));
                let map = HeatMap::new(title, cell_axis(axis(self.x)), cell_axis(axis(y)), colour, panels);
                HeatMap { notes, ..map }.svg().map(Some)
            }
            None => {
                let Some(mut charts) = self.charts(cells, axes, (&title, &label)) else { return Ok(None) };
                charts.iter_mut().for_each(|chart| chart.notes.extend(notes.iter().cloned()));
                Ok(Some(if let [chart] = &charts[..] { chart.svg() } else { stacked(&title, &charts) }))
            }
        }
    }

    /// A remark where a place has the values of several runs.
    fn several(&self, cells: &Cells) -> Option<String> {
        let count = |value: &Value| if let Value::Number(_, count) = value { *count } else { 1 };
        let most = cells.values.iter().map(count).max().filter(|most| *most > 1)?;
        let what = match self.of_several {
            OfSeveral::Mean => "the mean",
            OfSeveral::Largest => "the largest",
            OfSeveral::Least => "the least",
        };
        let place = if self.y.is_some() { "cell" } else { "point" };
        Some(format!("each {place}: {what} of up to {most} runs"))
    }

    fn colour(&self, cells: &Cells, label: &str) -> Option<Colour> {
        let words = cells.words();
        if !words.is_empty() {
            return (words.len() <= MOST_WORDS).then(|| Colour::words(label, words));
        }
        let colour = match self.scale {
            Some(Scale::Linear) => Colour::linear(label),
            Some(Scale::Logarithmic) if cells.numbers().any(|number| number < 0.0) => {
                Colour::symmetric_logarithmic(label)
            }
            Some(Scale::Logarithmic) => Colour::logarithmic(label),
            None => Colour::automatic(label),
        };
        Some(match &self.range {
            Some([least, most]) => colour.over(double(least), double(most)),
            None => colour,
        })
    }

    fn panels(&self, cells: &Cells, axis: Option<&Axis>) -> Vec<Panel> {
        let words = cells.words();
        let size = cells.counts[0] * cells.counts[1];
        let panels = cells.values.chunks(size).enumerate();
        let of = |(place, values): (usize, &[Value])| {
            let title = axis.map(|axis| value_text(axis, place as u64)).unwrap_or_default();
            let cell = |value: &Value| match value {
                Value::None => None,
                Value::Number(number, _) => Some(*number),
                Value::Word(word) => words.iter().position(|known| known == word).map(|place| place as f64),
            };
            Panel::new(title, values.iter().map(cell).collect())
        };
        panels.map(of).collect()
    }

    /// A chart for each panel, with a curve for each value of an axis; `None` for too many, or where the values are
    /// words.
    fn charts(&self, cells: &Cells, axes: &Axes, (title, label): (&str, &str)) -> Option<Vec<Chart>> {
        let [count, curves, panels] = cells.counts;
        if curves.max(panels) > MOST_CURVES || !cells.words().is_empty() {
            return None;
        }
        let axis = |place: usize| &axes.all()[place];
        let x = axis(self.x);
        let positions: Vec<f64> = (0..x.count()).map(|number| number_at(x, number).unwrap_or(number as f64)).collect();
        let is_log = (is_logarithmic(x, &positions), self.has_logarithms(cells));
        let curve = |(place, values): (usize, &[Value])| {
            let label = self.curves.map(|of| value_text(axis(of), place as u64)).unwrap_or_default();
            let number = |value: &Value| if let Value::Number(number, _) = value { *number } else { f64::NAN };
            let mut points: Vec<_> = positions.iter().copied().zip(values.iter().map(number)).collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            Curve::marked(label, log10_of(&points, is_log), place)
        };
        let scale = |label: &str, is_log| if is_log { ChartAxis::log10(label) } else { ChartAxis::linear(label) };
        let (across, mut up) = (scale(&x.name, is_log.0), scale(label, is_log.1));
        if panels > 1 {
            // charts that can be compared
            let all: Vec<_> = cells.numbers().map(|number| (0.0, number)).collect();
            up = up.around(log10_of(&all, is_log).into_iter().map(|point| point.1));
        }
        let chart = |(place, values): (usize, &[Value])| {
            let title = match self.panels {
                Some(panels) => format!("{title}: {}", value_text(axis(panels), place as u64)),
                None => title.to_owned(),
            };
            let curves = values.chunks(count).enumerate().map(curve).collect();
            let chart = Chart::new(title, across.clone(), up.clone(), curves);
            Chart { notes: words_of(x).into_iter().collect(), ..chart }
        };
        Some(cells.values.chunks(count * curves).enumerate().map(chart).collect())
    }

    /// Whether curves show the logarithms of the values.
    fn has_logarithms(&self, cells: &Cells) -> bool {
        match self.scale {
            Some(scale) => scale == Scale::Logarithmic,
            None => is_wide(cells.numbers().filter(|number| *number != 0.0)),
        }
    }
}

/// What the numbers of an axis of words mean.
fn words_of(axis: &Axis) -> Option<String> {
    let words = || (0..axis.count()).map(|number| format!("{number}: {}", axis.value(number).text()));
    (!axis.is_numeric()).then(|| format!("{}: {}", axis.name, words().collect::<Vec<_>>().join(", ")))
}

/// `yoshida4`, or `e = 1/10`.
fn value_text(axis: &Axis, number: u64) -> String {
    let text = axis.value(number).text();
    if axis.is_numeric() { format!("{} = {text}", axis.name) } else { text }
}

fn number_at(axis: &Axis, number: u64) -> Option<f64> {
    match axis.value(number) {
        Meaning::Number(number) => Some(double(&number)),
        Meaning::Word(_) => None,
    }
}

/// Words, and numbers of which some are equal or too large for doubles, have cells of one size.
fn cell_axis(axis: &Axis) -> CellAxis {
    let numbers: Option<Vec<f64>> = (0..axis.count()).map(|number| number_at(axis, number)).collect();
    let of_numbers = numbers.map(|numbers| match is_logarithmic(axis, &numbers) {
        true => CellAxis::logarithmic(&axis.name, numbers),
        false => CellAxis::linear(&axis.name, numbers),
    });
    let words = || CellAxis::words(&axis.name, (0..axis.count()).map(|number| axis.value(number).text()).collect());
    of_numbers.filter(CellAxis::is_drawable).unwrap_or_else(words)
}

fn is_logarithmic(axis: &Axis, numbers: &[f64]) -> bool {
    numbers.iter().all(|number| *number > 0.0) && (axis.is_logarithmic() || is_wide(numbers.iter().copied()))
}

/// Whether numbers are positive and extend over a large ratio.
fn is_wide(numbers: impl Iterator<Item = f64>) -> bool {
    let (mut least, mut largest) = (f64::INFINITY, 0.0_f64);
    for number in numbers {
        least = least.min(number);
        largest = largest.max(number);
    }
    least > 0.0 && largest / least >= LOGARITHMIC_FROM
}
