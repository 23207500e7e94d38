//! The columns of rows in the order of a file. Each file here has a group of columns: their names, when they are due, and their cells at a state.

mod chaos;
mod energy;
mod modified_energy;
mod states;
mod values;

pub(crate) use values::Values;

use crate::at::{At, Place};
use crate::column::next_multiple;
use crate::computation::{Computation, FollowedNumber, RunNumber};
use crate::error::Error;
use crate::results::{Cell, Name};
use crate::scene::{Outputs, Scene, System};

/// The names of the columns of n and t, which each row has.
const OF_EACH_ROW: [&str; 2] = ["n", "t"];

/// The names that columns of every system may have; no coordinate and no column of a formula has one of them.
pub fn fixed_names() -> impl Iterator<Item = &'static str> {
    let groups: [&[&str]; 4] = [&OF_EACH_ROW, &energy::NAMES, &modified_energy::NAMES, &chaos::NAMES];
    groups.into_iter().flatten().copied()
}

/// Columns that are due together.
pub(crate) trait Group<N: RunNumber> {
    /// Their names.
    fn names(&self) -> Vec<Name>;

    /// When they are due.
    fn due(&self) -> Due;

    /// Appends a cell for each name.
    fn append(&mut self, at: &mut At<'_, '_, N>, cells: &mut Vec<Cell<N>>) -> Result<(), Error>;
}

/// When columns are due.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Due {
    /// At the states whose n is a multiple of this.
    pub(crate) every: Option<u64>,
    /// And at all of these places.
    pub(crate) places: &'static [Place],
}

impl Due {
    fn is_at<N: RunNumber>(self, at: &At<'_, '_, N>) -> bool {
        let is_multiple = |every: u64| at.is_met || at.n.unsigned_abs().is_multiple_of(every);
        self.places.contains(&at.place) || (at.place == Place::State && self.every.is_some_and(is_multiple))
    }
}

/// The columns of a scene in the numbers of its run.
pub(crate) struct Columns<'a, N> {
    groups: Vec<(Box<dyn Group<N> + 'a>, Due)>,
    /// The number of cells up to the end of each group.
    ends: Vec<usize>,
}

impl<'a, N: RunNumber> Columns<'a, N> {
    pub(crate) fn of(output: &'a Outputs, system: &'a System, context: &N::Context) -> Self {
        let values =
            output.values.iter().map(|columns| Values::new((&columns.expressions, columns.every), system, context));
        let groups = [energy::of(output), modified_energy::of(output), chaos::of(output)].into_iter().flatten();
        let groups = groups.chain(values.map(|values| Box::new(values) as Box<_>)).chain(states::of(output, system));
        let mut columns = Columns {
            groups: groups
                .map(|group| {
                    let due = group.due();
                    (group, due)
                })
                .collect(),
            ends: Vec::new(),
        };
        columns.ends = columns
            .groups
            .iter()
            .scan(OF_EACH_ROW.len(), |end, (group, _)| {
                *end += group.names().len();
                Some(*end)
            })
            .collect();
        columns
    }

    fn names(&self) -> Vec<Name> {
        let own = self.groups.iter().flat_map(|(group, _)| group.names());
        OF_EACH_ROW.into_iter().map(Name::from).chain(own).collect()
    }

    /// The n of the next state after n at which something is due.
    pub(crate) fn next(&self, n: i64) -> i64 {
        let periods = self.groups.iter().filter_map(|(_, due)| due.every);
        periods.map(|every| next_multiple(n, every)).min().unwrap_or(i64::MAX)
    }

    /// The cells of a state; none where nothing is due.
    pub(crate) fn cells(&mut self, at: &mut At<'_, '_, N>, cells: &mut Vec<Cell<N>>) -> Result<(), Error> {
        cells.clear();
        if !self.groups.iter().any(|(_, due)| due.is_at(at)) {
            return Ok(());
        }
        cells.extend([Cell::Step(at.n), Cell::Number(at.time())]);
        for ((group, due), end) in self.groups.iter_mut().zip(&self.ends) {
            if due.is_at(at) {
                group.append(at, cells)?;
            }
            cells.resize_with(*end, || Cell::NotDue);
        }
        Ok(())
    }
}

impl Scene {
    /// The names of its columns.
    pub(crate) fn names(&self) -> Vec<Name> {
        self.arithmetic.compute(Names(self))
    }
}

struct Names<'a>(&'a Scene);

impl Computation for Names<'_> {
    type Output = Vec<Name>;

    fn compute<N: FollowedNumber>(self, context: &N::Context) -> Vec<Name> {
        Columns::<N>::of(&self.0.output, &self.0.system, context).names()
    }
}
