//! The cells along an axis: their order, their borders, and the labels beside them.

use super::{CellAxis, Values};
use crate::labels::{lines, width};
use crate::picture::{LINE, TEXT};
use crate::ticks::{Scale, Ticks, has_ticks, significant};

/// Each cell has a label if there are at most this number of cells.
const MOST_LABELLED: usize = 12;

/// And if the labels have at most this number of characters.
const LONGEST_NUMBER: usize = 7;

/// More characters of a word are cut.
const LONGEST_WORD: usize = 32;

/// The cells along an axis, as they are drawn: from left to right, or upwards.
pub(super) struct Strip {
    /// The numbers of the cells in the values of the axis.
    pub(super) order: Vec<usize>,
    /// The places of the values; on a logarithmic axis the logarithms to the base 10.
    centres: Vec<f64>,
    /// One more than cells, in the same measure.
    borders: Vec<f64>,
}

impl Strip {
    pub(super) fn of_x(axis: &CellAxis) -> Strip {
        match &axis.values {
            Values::Linear(values) => Strip::of_numbers(values, |value| value),
            Values::Logarithmic(values) => Strip::of_numbers(values, f64::log10),
            Values::Words(words) => Strip {
                order: (0..words.len()).collect(),
                centres: (0..words.len()).map(|n| n as f64 + 0.5).collect(),
                borders: (0..=words.len()).map(|n| n as f64).collect(),
            },
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
        let (first, last) = (centres[0], centres[centres.len() - 1]);
        let (before, after) = match &centres[..] {
            // one cell has no neighbours that say how large it is
            [only] => (0.5 * only.abs().max(1.0), 0.5 * only.abs().max(1.0)),
            [.., last_but_one, last] => ((centres[1] - first) / 2.0, (last - last_but_one) / 2.0),
            [] => (0.5, 0.5),
        };
        let borders = std::iter::once(first - before).chain(between).chain([last + after]).collect();
        Strip { order, centres, borders }
    }

    pub(super) fn count(&self) -> usize {
        self.order.len()
    }

    /// From the first to the last border, in the measure of the axis.
    pub(super) fn range(&self) -> (f64, f64) {
        (self.borders[0], self.borders[self.borders.len() - 1])
    }

    /// The part of the length before a place, from 0 to 1.
    fn part(&self, place: f64) -> f64 {
        let (first, last) = self.range();
        (place - first) / (last - first)
    }

    /// The borders of the cells, from 0 to 1.
    pub(super) fn borders(&self) -> Vec<f64> {
        self.borders.iter().map(|&border| self.part(border)).collect()
    }

    /// Whether each border is where it would be between cells of one size, to within a part of the length.
    pub(super) fn is_even(&self, tolerance: f64) -> bool {
        let of_one_size = |n: usize| n as f64 / self.count() as f64;
        self.borders().iter().enumerate().all(|(n, border)| (border - of_one_size(n)).abs() <= tolerance)
    }
}

/// Which way the labels of an axis stand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Direction {
    /// Below the cells, side by side.
    Across,
    /// Below the cells, falling to the left.
    Tilted,
    /// At the left of the cells, one above the other.
    Up,
}

/// The cosine and the sine of the angle of tilted labels are both this.
pub(super) const TILT: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Labels and ticks along an axis, at parts of its length.
pub(super) struct Labels {
    /// Each with its lines.
    pub(super) labelled: Vec<(f64, Vec<String>)>,
    pub(super) minor: Vec<f64>,
    pub(super) direction: Direction,
}

impl Labels {
    /// Of the horizontal axis, of this length.
    pub(super) fn across(axis: &CellAxis, strip: &Strip, length: f64) -> Labels {
        match &axis.values {
            Values::Words(words) => words_across(words, strip, length),
            _ => Labels::of_numbers(axis, strip, length, Direction::Across),
        }
    }

    /// Of the vertical axis, of this length.
    pub(super) fn up(axis: &CellAxis, strip: &Strip, length: f64) -> Labels {
        match &axis.values {
            Values::Words(words) => {
                let every = (LINE / (length / words.len() as f64)).ceil() as usize;
                one_line(words, strip, every, Direction::Up)
            }
            _ => Labels::of_numbers(axis, strip, length, Direction::Up),
        }
    }

    /// The values of the cells, if they are few and short; else round numbers.
    fn of_numbers(axis: &CellAxis, strip: &Strip, length: f64, direction: Direction) -> Labels {
        let (values, scale) = match &axis.values {
            Values::Linear(values) => (values, Scale::Linear),
            Values::Logarithmic(values) => (values, Scale::Log10),
            Values::Words(_) => return Labels { labelled: Vec::new(), minor: Vec::new(), direction },
        };
        let of_cells = strip.order.iter().zip(&strip.centres).map(|(&i, &at)| (at, significant(values[i], 4)));
        let of_cells: Vec<_> = of_cells.take(MOST_LABELLED + 1).collect();
        let are_short = of_cells.iter().all(|(_, text)| text.chars().count() <= LONGEST_NUMBER);
        let are_different = of_cells.windows(2).all(|pair| pair[0].1 != pair[1].1);
        let is_each_labelled = strip.count() <= MOST_LABELLED && are_short && are_different;
        if strip.count() == 1 || is_each_labelled && fit(&of_cells, strip, length, direction) {
            return Labels::new(of_cells, Vec::new(), strip, direction);
        }
        let steps = if has_ticks(strip.range(), scale) { [7.0, 5.0, 4.0, 3.0, 2.0, 1.0].as_slice() } else { &[] };
        let tried = steps.iter().map(|&steps| Ticks::of_at_most(steps, scale, strip.range()));
        let ticks = tried
            .filter(|ticks| !ticks.labelled.is_empty())
            .find(|ticks| fit(&ticks.labelled, strip, length, direction));
        match ticks {
            Some(ticks) => Labels::new(ticks.labelled, ticks.minor, strip, direction),
            // not even two fit, or the values hardly differ
            None => Labels::new(of_cells.into_iter().take(1).collect(), Vec::new(), strip, direction),
        }
    }

    fn new(labelled: Vec<(f64, String)>, minor: Vec<f64>, strip: &Strip, direction: Direction) -> Labels {
        Labels {
            labelled: labelled.into_iter().map(|(at, text)| (strip.part(at), vec![text])).collect(),
            minor: minor.into_iter().map(|at| strip.part(at)).collect(),
            direction,
        }
    }

    /// The widest line.
    pub(super) fn width(&self) -> f64 {
        self.labelled.iter().flat_map(|(_, lines)| lines).map(|line| width(line, TEXT)).fold(0.0, f64::max)
    }

    /// What the labels need below the cells.
    pub(super) fn height(&self) -> f64 {
        match self.direction {
            Direction::Tilted => TILT * (self.width() + LINE),
            _ => self.labelled.iter().map(|(_, lines)| lines.len()).max().unwrap_or(0) as f64 * LINE,
        }
    }

    /// How far the labels reach to the left of the axis, of this length.
    pub(super) fn overhang(&self, length: f64) -> f64 {
        let reach = |(part, lines): &(f64, Vec<String>)| {
            let widest = lines.iter().map(|line| width(line, TEXT)).fold(0.0, f64::max);
            let left = if self.direction == Direction::Tilted { TILT * (widest + LINE / 2.0) } else { widest / 2.0 };
            left - part * length
        };
        self.labelled.iter().map(reach).fold(0.0, f64::max)
    }
}

/// Whether neighbouring labels do not touch.
fn fit(labels: &[(f64, String)], strip: &Strip, length: f64, direction: Direction) -> bool {
    let half =
        |text: &str| if direction == Direction::Up { LINE / 2.0 } else { (width(text, TEXT) + 0.6 * TEXT) / 2.0 };
    labels.windows(2).all(|pair| {
        let [(a, left), (b, right)] = [&pair[0], &pair[1]].map(|(at, text)| (strip.part(*at) * length, half(text)));
        b - a >= left + right
    })
}

/// Side by side if they fit, on several lines if these do, or tilted.
fn words_across(words: &[String], strip: &Strip, length: f64) -> Labels {
    let room = length / words.len() as f64 - 0.6 * TEXT;
    let broken: Vec<_> = words.iter().map(|word| lines(&shortened(word), room, TEXT)).collect();
    let fits = |lines: &Vec<String>| lines.len() <= 3 && lines.iter().all(|line| width(line, TEXT) <= room);
    if broken.iter().all(fits) {
        let labelled = strip.centres.iter().map(|&at| strip.part(at)).zip(broken).collect();
        return Labels { labelled, minor: Vec::new(), direction: Direction::Across };
    }
    let every = (LINE / TILT / (length / words.len() as f64)).ceil() as usize;
    one_line(words, strip, every, Direction::Tilted)
}

/// Every word, or of many narrow cells every n-th.
fn one_line(words: &[String], strip: &Strip, every: usize, direction: Direction) -> Labels {
    let of_cells = strip.order.iter().zip(&strip.centres).step_by(every.max(1));
    let labelled = of_cells.map(|(&i, &at)| (strip.part(at), vec![shortened(&words[i])])).collect();
    Labels { labelled, minor: Vec::new(), direction }
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
        assert_eq!(
            (strip.order.as_slice(), strip.borders.as_slice()),
            ([1, 2, 0].as_slice(), [0.5, 1.5, 3.0, 5.0].as_slice())
        );
        assert_eq!(strip.borders(), [0.0, 1.0 / 4.5, 2.5 / 4.5, 1.0]);
        assert!(!strip.is_even(1e-3));
    }

    /// Between 1 and 100 the border is 10, not 50.5.
    #[test]
    fn borders_of_logarithmic_axes_are_geometric_means() {
        let strip = Strip::of_x(&CellAxis::logarithmic("", vec![1.0, 100.0, 1e4]));
        assert_eq!(strip.borders, [-1.0, 1.0, 3.0, 5.0]);
        assert!(strip.is_even(1e-12));
    }

    #[test]
    fn one_value_has_a_cell_about_it() {
        for axis in
            [CellAxis::linear("", vec![0.0]), CellAxis::linear("", vec![-7.0]), CellAxis::logarithmic("", vec![1.0])]
        {
            let strip = Strip::of_x(&axis);
            let (first, last) = strip.range();
            assert!(first < last && f64::midpoint(first, last) == strip.centres[0]);
        }
    }

    #[test]
    fn words_are_read_downwards() {
        let axis = CellAxis::words("", ["a", "b", "c"].map(str::to_owned).to_vec());
        assert_eq!((Strip::of_x(&axis).order, Strip::of_y(&axis).order), (vec![0, 1, 2], vec![2, 1, 0]));
        let labels = Labels::up(&axis, &Strip::of_y(&axis), 300.0);
        assert_eq!(labels.labelled[0], (0.5 / 3.0, vec!["c".to_owned()]));
    }

    fn texts(labels: &Labels) -> Vec<String> {
        labels.labelled.iter().map(|(_, lines)| lines.join(" ")).collect()
    }

    #[test]
    fn few_cells_are_labelled_with_their_values_and_many_with_round_numbers() {
        let across = |values: Vec<f64>, length: f64| {
            let axis = CellAxis::linear("", values);
            texts(&Labels::across(&axis, &Strip::of_x(&axis), length))
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
                    for labels in [Labels::across(&axis, &strip, length), Labels::up(&axis, &strip, length)] {
                        let half = |lines: &[String]| match labels.direction {
                            Direction::Up => LINE / 2.0,
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
        let of = |axis: &CellAxis, length: f64| Labels::across(axis, &Strip::of_x(axis), length);
        let axis = words(&["leapfrog", "Blanes Moan"]);
        assert_eq!(of(&axis, 300.0).direction, Direction::Across);
        assert_eq!(of(&axis, 180.0).labelled[1].1, ["Blanes", "Moan"]);
        let tilted = of(&axis, 80.0);
        assert!(tilted.direction == Direction::Tilted && tilted.overhang(80.0) > 0.0);
        let many: Vec<_> = (0..500).map(|n| format!("w{n}")).collect();
        let labels = of(&CellAxis::words("", many), 400.0);
        assert!((8..=20).contains(&labels.labelled.len()), "{}", labels.labelled.len());
    }
}
