//! Expressions.

use super::{Due, Group};
use crate::at::{At, Place};
use crate::error::Error;
use crate::evaluator::Evaluator;
use crate::results::{Cell, Name};
use crate::run_number::RunNumber;
use crate::scene::{NamedExpression, System};

/// Columns of expressions with one period.
pub(crate) struct Values<'a, N: RunNumber> {
    every: u64,
    columns: &'a [NamedExpression],
    evaluators: Vec<Evaluator<N>>,
}

impl<'a, N: RunNumber> Values<'a, N> {
    pub(crate) fn new((columns, every): (&'a [NamedExpression], u64), system: &System, context: &N::Context) -> Self {
        let evaluators = columns.iter().map(|named| named.evaluator(system, context)).collect();
        Values { every, columns, evaluators }
    }
}

impl<N: RunNumber> Group<N> for Values<'_, N> {
    fn names(&self) -> Vec<Name> {
        self.columns.iter().map(|column| Name::from(&*column.name)).collect()
    }

    fn due(&self) -> Due {
        Due { every: Some(self.every), places: &[Place::Crossing, Place::PhysicalEnd] }
    }

    /// There is no cell of a value that is not finite.
    fn append(&mut self, at: &mut At<'_, '_, N>, cells: &mut Vec<Cell<N>>) -> Result<(), Error> {
        let needs_energy = self.columns.iter().any(|column| column.expression.has_energy);
        let energy = if needs_energy { Some(at.energy()?.clone()) } else { None };
        let time = at.time();
        for evaluator in &mut self.evaluators {
            let energy = || energy.clone().expect("it is computed where a formula has it");
            let value = evaluator.value_at(at.state(), &time, energy);
            cells.push(if value.is_finite() { Cell::Number(value.clone()) } else { Cell::NotDue });
        }
        Ok(())
    }
}
