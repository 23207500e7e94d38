//! Lists of tasks of an array, in the form that `sbatch --array=` takes.

use std::collections::BTreeSet;
use std::fmt;

use crate::collect::ranges;

/// Numbers of tasks, each once, in order; displayed as `3,7-9`.
///
/// ```
/// use shadowstep_sweeps::slurm::TaskList;
///
/// let tasks: TaskList = [9, 3, 8, 7].into_iter().collect();
/// assert_eq!(tasks.to_string(), "3,7-9");
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TaskList(BTreeSet<u64>);

impl TaskList {
    /// The tasks 1 … count.
    #[cfg(test)]
    pub(crate) fn all(count: u64) -> Self {
        (1..=count).collect()
    }

    /// The tasks of a text such as `3,7-9`; `None` of other texts.
    pub(crate) fn read(text: &str) -> Option<Self> {
        let mut tasks = BTreeSet::new();
        for part in text.split(',') {
            let (first, last) = part.split_once('-').unwrap_or((part, part));
            let (first, last) = (first.parse::<u64>().ok()?, last.parse::<u64>().ok()?);
            if first > last || last - first > MOST_TASKS {
                return None;
            }
            tasks.extend(first..=last);
        }
        Some(TaskList(tasks))
    }

    /// The numbers in order.
    pub fn numbers(&self) -> impl Iterator<Item = u64> {
        self.0.iter().copied()
    }

    /// How many tasks there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether a task is one of these.
    #[cfg(test)]
    pub(crate) fn contains(&self, task: u64) -> bool {
        self.0.contains(&task)
    }

    /// The tasks of this list that `other` lacks.
    pub(crate) fn without(&self, other: &TaskList) -> TaskList {
        TaskList(self.0.difference(&other.0).copied().collect())
    }
}

impl FromIterator<u64> for TaskList {
    fn from_iter<I: IntoIterator<Item = u64>>(numbers: I) -> Self {
        TaskList(numbers.into_iter().collect())
    }
}

impl fmt::Display for TaskList {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&ranges(&self.numbers().collect::<Vec<_>>()))
    }
}

/// More tasks than Slurm allows in an array, 4 000 000.
const MOST_TASKS: u64 = 4_000_001;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_of_numbers_are_ranges() {
        for text in ["1", "1-16", "3,7-9", "1-2", "1,3,5", "2-4,6-7,9-12"] {
            assert_eq!(TaskList::read(text).unwrap().to_string(), text);
        }
        assert_eq!(TaskList::default().to_string(), "");
    }

    #[test]
    fn other_texts_are_refused() {
        for text in ["", "a", "1-", "-1", "9-3", "1-16%4", "1-16:2", "1,,2", "0-99999999999"] {
            assert_eq!(TaskList::read(text), None, "{text}");
        }
    }

    #[test]
    fn tasks_are_taken_out() {
        let rest = TaskList::all(16).without(&TaskList::read("3,7-9").unwrap());
        assert_eq!(rest.to_string(), "1-2,4-6,10-16");
        assert_eq!(rest.len(), 12);
        assert!(rest.contains(16) && !rest.contains(8));
    }
}
