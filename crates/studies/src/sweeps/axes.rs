//! All axes: the number of runs, and the values of each run from its number.

use shadowstep_scenes::family::Meaning;
use shadowstep_scenes::readable::{LONGEST_NUMBER, shortened};
use shadowstep_scenes::reserved_names::quantities;
use shadowstep_scenes::schema::texts;
use shadowstep_schemes::document::{Placed, Reader, Text, Value};
use toml::de::DeTable;

use crate::sweeps::axis::Axis;

/// The most runs of a sweep.
pub(crate) const MOST_RUNS: u64 = 1_000_000_000_000_000;

/// Axes, some of which advance together. Runs are numbered from 0; the last axis varies fastest.
#[derive(Clone, Debug)]
pub struct Axes {
    axes: Vec<Axis>,
    /// Groups of axes that advance together, by their places; the last group varies fastest.
    groups: Vec<Vec<usize>>,
    runs: u64,
}

impl Axes {
    /// Reads \[axes\] and `zip`.
    pub(crate) fn read(reader: &mut Reader<'_>, root: &DeTable<'_>) -> Option<Axes> {
        const ADD: &str = "a name and its values, such as h = [\"1/10\", \"1/20\"]";
        let Some((key, value)) = root.get_key_value("axes") else {
            return reader.wrong(&(0..0), "the section [axes] is missing", format!("add [axes] with {ADD}"));
        };
        let table = value.get_ref().as_table()?;
        if table.is_empty() {
            return reader.wrong(&key.span(), "[axes] is empty", format!("add {ADD}"));
        }
        if !reader.has_at_most(value, MOST_AXES, "axes") {
            return None;
        }
        // in the order of the text
        let mut entries: Vec<_> = table.iter().map(|(key, value)| (Text::of_key(key), value)).collect();
        entries.sort_by_key(|(name, _)| name.at.start);
        let read: Vec<_> = entries.iter().map(|(name, value)| axis(reader, name, value)).collect();
        let names: Vec<&str> = entries.iter().map(|(name, _)| name.value.as_str()).collect();
        let zips = zips(reader, root, &names);
        let axes: Vec<Axis> = read.into_iter().collect::<Option<_>>()?;
        let groups = groups(reader, &axes, zips?)?;
        let count = |group: &Vec<usize>| axes[group[0]].count();
        let runs = groups.iter().map(count).try_fold(1_u64, u64::checked_mul).filter(|runs| *runs <= MOST_RUNS);
        match runs {
            Some(runs) => Some(Axes { axes, groups, runs }),
            None => reader.wrong(&key.span(), "these axes give more than 1e15 runs", "use fewer values"),
        }
    }

    /// The axes in the order of the text.
    pub(crate) fn all(&self) -> &[Axis] {
        &self.axes
    }

    /// The axis of a name.
    pub(crate) fn find(&self, name: &str) -> Option<&Axis> {
        self.axes.iter().find(|axis| axis.name == name)
    }

    /// How many runs there are.
    pub fn runs(&self) -> u64 {
        self.runs
    }

    /// For each axis, which of its values the run has.
    pub(crate) fn numbers(&self, run: u64) -> Vec<u64> {
        let mut numbers = vec![0; self.axes.len()];
        let mut rest = run;
        for group in self.groups.iter().rev() {
            let count = self.axes[group[0]].count();
            group.iter().for_each(|&axis| numbers[axis] = rest % count);
            rest /= count;
        }
        numbers
    }

    /// The names with their values in a run.
    pub(crate) fn values(&self, run: u64) -> Vec<(String, Meaning)> {
        let numbers = self.numbers(run);
        self.axes.iter().zip(numbers).map(|(axis, number)| (axis.name.clone(), axis.value(number))).collect()
    }

    /// The values of a run for messages: `h = 1/10, e = 0`.
    pub fn described(&self, run: u64) -> String {
        let values = self.values(run);
        let short = |value: &Meaning| match value {
            Meaning::Number(number) => shortened(number, LONGEST_NUMBER),
            Meaning::Word(word) => word.clone(),
        };
        values.iter().map(|(name, value)| format!("{name} = {}", short(value))).collect::<Vec<_>>().join(", ")
    }
}

fn axis(reader: &mut Reader<'_>, name: &Text, value: &Value<'_>) -> Option<Axis> {
    let word = &name.value;
    let is_name = word.starts_with(|c: char| c.is_ascii_alphabetic())
        && word.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    if !is_name || word == "pi" {
        let hint = "a name consists of letters, digits and _, and begins with a letter";
        reader.fault(&name.at, format!("`{word}` is not a name of an axis"), hint);
    } else if reserved().any(|name| name == word) {
        let hint = format!("give it another name; reserved are {}", reserved().collect::<Vec<_>>().join(", "));
        reader.fault(&name.at, format!("an axis cannot be named `{word}`"), hint);
    }
    Axis::read(reader, name, value)
}

/// Names of columns, and of quantities in expressions.
fn reserved() -> impl Iterator<Item = &'static str> {
    ["run", "failure"].into_iter().chain(quantities().map(|(name, _)| name))
}

/// The most axes.
const MOST_AXES: usize = 100;

/// The lists of names in `zip`, as places of axes.
fn zips(reader: &mut Reader<'_>, root: &DeTable<'_>, names: &[&str]) -> Option<Vec<Placed<Vec<usize>>>> {
    let Some(value) = root.get("zip") else { return Some(Vec::new()) };
    let mut zips = Vec::new();
    let mut taken: Vec<usize> = Vec::new();
    for list in value.get_ref().as_array()?.iter().filter_map(|list| texts(reader.source, list)) {
        let first = taken.len();
        for name in &list.value {
            match names.iter().position(|known| *known == name.value) {
                Some(place) if taken.contains(&place) => {
                    return reader.wrong(&name.at, format!("`{}` is in zip twice", name.value), "keep one of the two");
                }
                Some(place) => taken.push(place),
                None => {
                    let hint = format!("the axes are {}", names.join(", "));
                    return reader.wrong(&name.at, format!("there is no axis `{}`", name.value), hint);
                }
            }
        }
        zips.push(Placed { value: taken[first..].to_vec(), at: list.at });
    }
    Some(zips)
}

/// The axes that advance together, and others alone, in the order of their first ones.
fn groups(reader: &mut Reader<'_>, axes: &[Axis], zips: Vec<Placed<Vec<usize>>>) -> Option<Vec<Vec<usize>>> {
    let mut alone: Vec<usize> = (0..axes.len()).collect();
    let mut groups = Vec::new();
    for Placed { value: zip, at } in zips {
        let first = &axes[zip[0]];
        if let Some(other) = zip.iter().map(|&place| &axes[place]).find(|axis| axis.count() != first.count()) {
            let values = [first, other].map(|axis| format!("{} has {}", axis.name, axis.count())).join(", ");
            let message = format!("axes of a zip need equally many values: {values}");
            return reader.wrong(&at, message, "give them equally many values, or remove one from zip");
        }
        alone.retain(|place| !zip.contains(place));
        groups.push(zip);
    }
    groups.extend(alone.into_iter().map(|place| vec![place]));
    groups.sort_by_key(|group| group.iter().min().copied());
    Some(groups)
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowstep_schemes::document::{Source, document};
    use std::collections::BTreeSet;

    fn read(text: &str) -> Result<Axes, String> {
        let source = Source { path: "test.toml".to_owned(), text: text.to_owned() };
        let (document, _) = document(&source);
        let mut reader = Reader::new(&source, Vec::new());
        Axes::read(&mut reader, &document.unwrap()).ok_or_else(|| reader.faults[0].message.clone())
    }

    fn described(text: &str) -> Vec<String> {
        let axes = read(text).unwrap();
        (0..axes.runs()).map(|run| axes.described(run)).collect()
    }

    #[test]
    fn the_last_axis_varies_fastest() {
        let found = described("[axes]\nb = [1, 2]\na = [\"x\", \"y\", \"z\"]");
        assert_eq!(
            found,
            ["b = 1, a = x", "b = 1, a = y", "b = 1, a = z", "b = 2, a = x", "b = 2, a = y", "b = 2, a = z"]
        );
    }

    #[test]
    fn axes_of_a_zip_advance_together() {
        let text = "zip = [[\"c\", \"a\"]]\n[axes]\na = [1, 2]\nb = [0, 1]\nc = [\"x\", \"y\"]";
        let wanted = ["a = 1, b = 0, c = x", "a = 1, b = 1, c = x", "a = 2, b = 0, c = y", "a = 2, b = 1, c = y"];
        assert_eq!(described(text), wanted);
    }

    #[test]
    fn every_combination_is_there_once() {
        let text = "zip = [[\"b\", \"e\"], [\"d\", \"f\"]]\n[axes]\na = [1, 2, 3]\nb = \"1 … 2 in 5 values\"\nc = [7]\n\
                    d = { draws = 2, uniform = [0, 1], seed = 1 }\ne = \"1 … 100 in 4 steps of log\"\nf = \
                    [\"x\", \"y\"]";
        let axes = read(text).unwrap();
        assert_eq!(axes.runs(), 3 * 5 * 2);
        let numbers: BTreeSet<Vec<u64>> = (0..axes.runs()).map(|run| axes.numbers(run)).collect();
        assert_eq!(numbers.len() as u64, axes.runs());
        for numbers in &numbers {
            assert!(numbers.iter().zip(axes.all()).all(|(number, axis)| *number < axis.count()));
            assert_eq!((numbers[1], numbers[3]), (numbers[4], numbers[5]));
        }
        // runs are in the order of the numbers
        assert!((1..axes.runs()).all(|run| axes.numbers(run - 1) < axes.numbers(run)));
    }

    #[test]
    fn values_of_very_many_runs_are_made_one_at_a_time() {
        let axes =
            read("[axes]\na = \"0 … 1 in 99999 steps\"\nb = \"0 … 1 in 99999 steps\"\nc = \"0 … 1 in 99999 steps\"")
                .unwrap();
        assert_eq!((axes.runs(), MOST_RUNS), (1_000_000_000_000_000, 1_000_000_000_000_000));
        assert_eq!(axes.described(0), "a = 0, b = 0, c = 0");
        assert_eq!(axes.described(MOST_RUNS - 1), "a = 1, b = 1, c = 1");
        assert_eq!(axes.described(33_333), "a = 0, b = 0, c = 1/3");
        let fault = read("[axes]\na = \"0 … 1 in 99999 steps\"\nb = \"0 … 1 in 10000000001 values\"").unwrap_err();
        assert_eq!(fault, "these axes give more than 1e15 runs");
        // also where the product overflows
        let huge = "\"0 … 1 in 1000000000000 values\"";
        let fault = read(&format!("[axes]\na = {huge}\nb = {huge}")).unwrap_err();
        assert_eq!(fault, "these axes give more than 1e15 runs");
    }

    #[test]
    fn a_list_has_numbers_or_words() {
        let axes = read("[axes]\na = [1, \"1/3\", 0.25, \"sqrt(4)\"]\nb = [\"double\", 30]").unwrap();
        let text = |name: &str, number| axes.find(name).unwrap().value(number).text();
        assert!(axes.all()[0].is_numeric() && !axes.all()[1].is_numeric());
        assert_eq!([0, 1, 2, 3].map(|number| text("a", number)), ["1", "1/3", "1/4", "2"]);
        assert_eq!([0, 1].map(|number| text("b", number)), ["double", "30"]);
    }
}
