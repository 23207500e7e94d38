//! The cells along an axis: their order, their borders, and the labels beside them.

use super::{CellAxis, Values};
use crate::picture::elements::{LINE, TEXT};
use crate::picture::side::{Direction, Side, TILT};
use crate::picture::text::{lines, width};
use crate::picture::ticks::{Scale, significant};

/// Each cell has a label if there are at most this number of cells.
const MOST_LABELLED: usize = 12;

/// And if the labels have at most this number of characters.
const LONGEST_NUMBER: usize = 7;

/// More characters of a word are cut.
const LONGEST_WORD: usize = 32;

/// The approximate number of intervals between round numbers.
const INTERVALS: f64 = 7.0;

/// The cells along an axis, as they are drawn: from left to right, or upwards.
pub(super) struct Strip {
    /// The numbers of the cells in the values of the axis.
    pub(super) order: Vec<usize>,
    /// From the first to the last border, in the measure of the axis.
    pub(super) range: (f64, f64),
    /// The values at parts of the length.
    centres: Vec<f64>,
    /// The borders of the cells, one more than these, from 0 to 1.
    pub(super) borders: Vec<f64>,
}

impl Strip {
    pub(super) fn of_x(axis: &CellAxis) -> Strip {
        match &axis.values {
            Values::Numbers(scale, values) => Strip::of_numbers(values, |value| scale.at(value)),
            Values::Words(words) => {
                Strip::of_numbers(&(0..words.len()).map(|n| n as f64 + 0.5).collect::<Vec<_>>(), |place| place)
            }
        }
    }

    /// Words are read downwards.
    pub(super) fn of_y(axis: &CellAxis) -> Strip {
        let mut strip = Strip::of_x(axis);
        if let Values::Words(_) = axis.values {
            strip.order.reverse();
        }
        strip
    }

    fn of_numbers(values: &[f64], measure: impl Fn(f64) -> f64) -> Strip {
        let mut order: Vec<usize> = (0..values.len()).collect();
        order.sort_by(|&i, &j| values[i].total_cmp(&values[j]));
        let centres: Vec<f64> = order.iter().map(|&i| measure(values[i])).collect();
        let between = centres.windows(2).map(|pair| f64::midpoint(pair[0], pair[1]));
        let (before, after) = match &centres[..] {
            // one cell has no neighbours that say how large it is
            [only] => (0.5 * only.abs().max(1.0), 0.5 * only.abs().max(1.0)),
            [first, second, ..] => {
                ((second - first) / 2.0, (centres[order.len() - 1] - centres[order.len() - 2]) / 2.0)
            }
            [] => (0.5, 0.5),
        };
        let range = (centres[0] - before, centres[order.len() - 1] + after);
        let part = |at: f64| (at - range.0) / (range.1 - range.0);
        let borders = [range.0].into_iter().chain(between).chain([range.1]).map(part).collect();
        let centres = centres.iter().map(|&at| part(at)).collect();
        Strip { order, range, centres, borders }
    }

    pub(super) fn count(&self) -> usize {
        self.order.len()
    }

    /// Whether each border is where it would be between cells of one size, to within a part of the length.
    pub(super) fn is_even(&self, tolerance: f64) -> bool {
        let of_one_size = |n: usize| n as f64 / self.count() as f64;
        self.borders.iter().enumerate().all(|(n, border)| (border - of_one_size(n)).abs() <= tolerance)
    }

    /// The labels of an axis of this length.
    pub(super) fn side(&self, axis: &CellAxis, length: f64, direction: Direction) -> Side {
        let room = length / self.count() as f64;
        match &axis.values {
            Values::Numbers(scale, values) => self.numbers(*scale, values, length, direction),
            Values::Words(words) if direction == Direction::Below => self.words_below(words, room),
            Values::Words(words) => self.words(words, LINE / room, direction),
        }
    }

    /// The values of the cells, if they are few and short; else round numbers.
    fn numbers(&self, scale: Scale, values: &[f64], length: f64, direction: Direction) -> Side {
        let of_cells = self.order.iter().zip(&self.centres).map(|(&i, &part)| (part, significant(values[i], 4)));
        let of_cells: Vec<_> = of_cells.take(MOST_LABELLED + 1).collect();
        let are_short = of_cells.iter().all(|(_, text)| text.chars().count() <= LONGEST_NUMBER);
        let are_different = of_cells.windows(2).all(|pair| pair[0].1 != pair[1].1);
        let few = |count: usize| Side::of(of_cells.iter().take(count).cloned(), Vec::new(), direction);
        let all = few(self.count());
        if self.count() == 1 || self.count() <= MOST_LABELLED && are_short && are_different && all.fits(length) {
            return all;
        }
        Side::round(scale, self.range, INTERVALS, length, direction).unwrap_or_else(|| few(1))
    }

    /// Side by side if they fit, on several lines if these do, or tilted.
    fn words_below(&self, words: &[String], room: f64) -> Side {
        let within = room - 0.6 * TEXT;
        let broken: Vec<_> = words.iter().map(|word| lines(&shortened(word), within, TEXT)).collect();
        let fits = |lines: &Vec<String>| lines.len() <= 3 && lines.iter().all(|line| width(line, TEXT) <= within);
        if broken.iter().all(fits) {
            let labelled = self.centres.iter().copied().zip(broken).collect();
            return Side { labelled, minor: Vec::new(), direction: Direction::Below };
        }
        self.words(words, LINE / TILT / room, Direction::Tilted)
    }

    /// Every word, or of many narrow cells every n-th.
    fn words(&self, words: &[String], every: f64, direction: Direction) -> Side {
        let of_cells = self.order.iter().zip(&self.centres).step_by((every.ceil() as usize).max(1));
        Side::of(of_cells.map(|(&i, &part)| (part, shortened(&words[i]))), Vec::new(), direction)
    }
}

fn shortened(word: &str) -> String {
    match word.char_indices().nth(LONGEST_WORD) {
        Some((end, _)) => format!("{}…", &word[..end]),
        None => word.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_lie_midway_between_values() {
        let strip = Strip::of_x(&CellAxis::linear("", vec![4.0, 1.0, 2.0]));
        assert_eq!((strip.order.as_slice(), strip.range), ([1, 2, 0].as_slice(), (0.5, 5.0)));
        assert_eq!(strip.borders, [0.0, 1.0 / 4.5, 2.5 / 4.5, 1.0]);
        assert!(!strip.is_even(1e-3));
    }

    /// Between 1 and 100 the border is 10, not 50.5.
    #[test]
    fn borders_of_logarithmic_axes_are_geometric_means() {
        let strip = Strip::of_x(&CellAxis::logarithmic("", vec![1.0, 100.0, 1e4]));
        assert_eq!((strip.range, strip.borders.as_slice()), ((-1.0, 5.0), [0.0, 2.0 / 6.0, 4.0 / 6.0, 1.0].as_slice()));
        assert!(strip.is_even(1e-12));
    }

    #[test]
    fn one_value_has_a_cell_about_it() {
        for axis in
            [CellAxis::linear("", vec![0.0]), CellAxis::linear("", vec![-7.0]), CellAxis::logarithmic("", vec![1.0])]
        {
            let strip = Strip::of_x(&axis);
            assert!(strip.range.0 < strip.range.1 && strip.centres == [0.5]);
        }
    }

    #[test]
    fn words_are_read_downwards() {
        let axis = CellAxis::words("", ["a", "b", "c"].map(str::to_owned).to_vec());
        assert_eq!((Strip::of_x(&axis).order, Strip::of_y(&axis).order), (vec![0, 1, 2], vec![2, 1, 0]));
        let labels = Strip::of_y(&axis).side(&axis, 300.0, Direction::Left);
        assert_eq!(labels.labelled[0], (0.5 / 3.0, vec!["c".to_owned()]));
    }

    fn texts(labels: &Side) -> Vec<String> {
        labels.labelled.iter().map(|(_, lines)| lines.join(" ")).collect()
    }

    #[test]
    fn few_cells_are_labelled_with_their_values_and_many_with_round_numbers() {
        let across = |values: Vec<f64>, length: f64| {
            let axis = CellAxis::linear("", values);
            texts(&Strip::of_x(&axis).side(&axis, length, Direction::Below))
        };
        assert_eq!(across(vec![0.1, 0.25, 0.7], 400.0), ["0.1", "0.25", "0.7"]);
        assert_eq!(across((0..100).map(|n| f64::from(n) / 99.0).collect(), 400.0).len(), 6);
        assert_eq!(across(vec![0.031_25], 40.0), ["0.03125"]);
        // close values are not shown as the same number
        let close = across(vec![1.0, 1.000_001, 1.000_002], 400.0);
        assert!(!close.contains(&"1".to_owned()), "{close:?}");
    }

    /// Whatever the length, labels do not overlap, and there is at least one.
    #[test]
    fn labels_do_not_touch() {
        for length in [30.0, 60.0, 120.0, 250.0, 700.0] {
            for count in [1, 2, 3, 7, 12, 13, 50] {
                let values: Vec<_> = (1..=count).map(|n| 1.0 / f64::from(n)).collect();
                for axis in [CellAxis::linear("", values.clone()), CellAxis::logarithmic("", values)] {
                    let strip = Strip::of_x(&axis);
                    for labels in
                        [Direction::Below, Direction::Left].map(|direction| strip.side(&axis, length, direction))
                    {
                        let half = |lines: &[String]| match labels.direction {
                            Direction::Left => LINE / 2.0,
                            _ => width(&lines[0], TEXT) / 2.0,
                        };
                        assert!(!labels.labelled.is_empty(), "{count} on {length}");
                        for pair in labels.labelled.windows(2) {
                            let gap = (pair[1].0 - pair[0].0) * length - half(&pair[0].1) - half(&pair[1].1);
                            assert!(gap >= -1e-9, "{count} on {length}: {:?}", texts(&labels));
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn words_that_do_not_fit_are_broken_or_tilted() {
        let words = |words: &[&str]| CellAxis::words("", words.iter().map(|&word| word.to_owned()).collect());
        let of = |axis: &CellAxis, length: f64| Strip::of_x(axis).side(axis, length, Direction::Below);
        let axis = words(&["leapfrog", "Blanes Moan"]);
        assert_eq!(of(&axis, 300.0).direction, Direction::Below);
        assert_eq!(of(&axis, 180.0).labelled[1].1, ["Blanes", "Moan"]);
        let tilted = of(&axis, 80.0);
        assert!(tilted.direction == Direction::Tilted && tilted.overhang(80.0) > 0.0);
        let many: Vec<_> = (0..500).map(|n| format!("w{n}")).collect();
        let labels = of(&CellAxis::words("", many), 400.0);
        assert!((8..=20).contains(&labels.labelled.len()), "{}", labels.labelled.len());
    }
}
