//! The values at the places of a picture, of which several runs may share one.

use shadowstep::{Number, Rational};
use shadowstep_schemes::symbolic::decimal::from_text;

use crate::sweeps::axes::Axes;
use crate::sweeps::picture::drawn::{OfSeveral, Picture};
use crate::sweeps::record::Record;

/// The most places: their values are kept in memory.
const MOST: u64 = 1 << 22;

/// The values of a picture.
#[derive(Clone, Debug)]
pub(crate) struct Cells {
    /// How many values the axes of x, of y or of the curves, and of the panels have.
    pub(crate) counts: [usize; 3],
    /// By panel, then y or curve, then x.
    pub(crate) values: Vec<Value>,
}

/// What is shown at a place.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum Value {
    /// No run has a value there.
    #[default]
    None,
    /// A number, and of how many runs it is made.
    Number(f64, u64),
    /// A word.
    Word(String),
}

impl Cells {
    /// For the runs of these axes; `None` if there are too many places.
    pub(crate) fn new(picture: &Picture, axes: &Axes) -> Option<Cells> {
        let count = |axis: Option<usize>| axis.map_or(1, |axis| axes.all()[axis].count());
        let counts = [count(Some(picture.x)), count(picture.y.or(picture.curves)), count(picture.panels)];
        let all = counts.iter().try_fold(1_u64, |all, count| all.checked_mul(*count)).filter(|all| *all <= MOST)?;
        Some(Cells { counts: counts.map(|count| count as usize), values: vec![Value::None; all as usize] })
    }

    /// Takes the value of a run, whose axes have these numbers.
    pub(crate) fn include(&mut self, picture: &Picture, numbers: &[u64], record: &Record) {
        let number = |axis: Option<usize>| axis.map_or(0, |axis| numbers[axis] as usize);
        let [x, y, panel] = [number(Some(picture.x)), number(picture.y.or(picture.curves)), number(picture.panels)];
        let place = (panel * self.counts[1] + y) * self.counts[0] + x;
        let Some(Some(text)) = record.values.get(picture.value) else { return };
        let cell = &mut self.values[place];
        *cell = match (number_of(text), &*cell) {
            (Some(new), Value::Number(old, count)) => {
                Value::Number(picture.of_several.of(*old, *count, new), count + 1)
            }
            (Some(new), _) => Value::Number(new, 1),
            // of several words the first one is shown
            (None, Value::Word(_)) => return,
            (None, _) => Value::Word(text.clone()),
        };
    }

    /// The numbers at all places.
    pub(super) fn numbers(&self) -> impl Iterator<Item = f64> {
        self.values.iter().filter_map(|value| if let Value::Number(number, _) = value { Some(*number) } else { None })
    }

    /// The different words, the most frequent first; of equally frequent ones that which comes first.
    pub(super) fn words(&self) -> Vec<String> {
        let mut words: Vec<(usize, String)> = Vec::new();
        for value in &self.values {
            let Value::Word(word) = value else { continue };
            match words.iter_mut().find(|(_, known)| known == word) {
                Some((count, _)) => *count += 1,
                None => words.push((1, word.clone())),
            }
        }
        words.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
        words.into_iter().map(|(_, word)| word).collect()
    }
}

/// The double nearest to a text such as `7/24` or `1.5e-30`; `None` for a word.
pub(crate) fn number_of(text: &str) -> Option<f64> {
    text.parse().ok().or_else(|| Some(double(&from_text(text).ok()?)))
}

/// The double nearest to a number.
pub(crate) fn double(number: &Rational) -> f64 {
    Number::from_rational(number, &())
}

impl OfSeveral {
    /// Of the value of `count` runs and that of another one.
    fn of(self, old: f64, count: u64, new: f64) -> f64 {
        match self {
            OfSeveral::Mean => old + (new - old) / (count + 1) as f64,
            OfSeveral::Largest => old.max(new),
            OfSeveral::Least => old.min(new),
        }
    }
}
