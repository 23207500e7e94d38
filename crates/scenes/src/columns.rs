//! The columns of rows in the order of a file. Each file here has a group of columns: their names, when they are due,
//! and their cells at a state.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`at`] | a state as columns see it |
//! | [`mod@column`] | what takes states |
//! | `group`, `names` | a group of columns of rows; the names of all |
//! | `states`, `energy`, `modified_energy`, `chaos`, `values` | these groups |
//! | [`evaluator`], `quantity_of_bodies` | expressions and conditions in the numbers of a run |
//! | `extremes`, [`extremum`] | the least and greatest values of expressions along a run |

pub mod at;
mod chaos;
pub mod column;
mod energy;
pub mod evaluator;
pub(crate) mod extremes;
pub mod extremum;
mod group;
mod modified_energy;
mod names;
pub(crate) mod quantity_of_bodies;
mod states;
mod values;

pub(crate) use group::Group;
pub use names::fixed_names;
pub(crate) use values::Values;

use self::group::Due;
use self::names::OF_EACH_ROW;
use crate::columns::at::At;
use crate::columns::column::next_multiple;
use crate::results::{Cell, Name};
use crate::scene::{Outputs, Scene, SceneNumber, System};
use crate::texts::error::Error;

/// The columns of a scene in the numbers of its run.
pub(crate) struct Columns<'a, N>(Vec<Placed<'a, N>>);

/// A group in a row.
struct Placed<'a, N> {
    group: Box<dyn Group<N> + 'a>,
    due: Due,
    /// The number of cells up to its end.
    end: usize,
}

impl<'a, N: SceneNumber> Columns<'a, N> {
    pub(crate) fn of(output: &'a Outputs, system: &'a System) -> Self {
        let fixed = [energy::of(output), modified_energy::of(output), chaos::of(output)].into_iter().flatten();
        let values = output.values.iter().map(|own| Values::new(&own.expressions, own.every));
        let mut groups: Vec<Box<dyn Group<N>>> = fixed.map(|group| Box::new(group) as _).collect();
        groups.extend(values.map(|group| Box::new(group) as _));
        groups.extend(states::of(output, system).map(|group| Box::new(group) as _));
        let mut end = OF_EACH_ROW.len();
        let placed = groups.into_iter().map(|group| {
            end += group.names().len();
            Placed { due: group.due(), group, end }
        });
        Columns(placed.collect())
    }

    fn names(&self) -> Vec<Name> {
        let own = self.0.iter().flat_map(|placed| placed.group.names());
        OF_EACH_ROW.into_iter().map(Name::from).chain(own).collect()
    }

    /// The n of the next state after n at which something is due.
    pub(crate) fn next(&self, n: i64) -> i64 {
        let periods = self.0.iter().filter_map(|placed| placed.due.every);
        periods.map(|every| next_multiple(n, every)).min().unwrap_or(i64::MAX)
    }

    /// The cells of a state; none where nothing is due.
    pub(crate) fn cells(&mut self, at: &mut At<'_, '_, N>, cells: &mut Vec<Cell<N>>) -> Result<(), Error> {
        cells.clear();
        if !self.0.iter().any(|placed| placed.due.is_at(at)) {
            return Ok(());
        }
        cells.extend([Cell::Step(at.n), Cell::Number(at.time())]);
        for Placed { group, due, end } in &mut self.0 {
            if due.is_at(at) {
                group.append(at, cells)?;
            }
            cells.resize_with(*end, || Cell::NotDue);
        }
        Ok(())
    }
}

impl Scene {
    /// The names of its columns, which do not depend on the number type.
    pub(crate) fn names(&self) -> Vec<Name> {
        Columns::<f64>::of(&self.output, &self.system).names()
    }
}
