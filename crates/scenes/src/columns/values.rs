//! Expressions.

use super::group::{Due, Group};
use super::names::fixed_names;
use crate::columns::at::{At, Place};
use crate::columns::evaluator::{Evaluator, alone};
use crate::document::expression::Expression;
use crate::results::{Cell, Name};
use crate::scene::{NamedExpression, SceneNumber, System};
use crate::texts::error::Error;

/// Columns of expressions with one period.
pub(crate) struct Values<'a, N: SceneNumber> {
    every: u64,
    columns: &'a [NamedExpression],
    /// From the first row on: of many columns they take long to make.
    evaluators: Vec<Evaluator<N>>,
}

impl<'a, N: SceneNumber> Values<'a, N> {
    pub(crate) fn new(columns: &'a [NamedExpression], every: u64) -> Self {
        Values { every, columns, evaluators: Vec::new() }
    }
}

impl System {
    /// A formula that stands alone, whose values are a column of this name.
    ///
    /// # Errors
    /// A text that is not a formula in the numbers of the system's states, with the column of the fault; the name of
    /// another column.
    pub fn column(&self, name: &str, text: &str) -> Result<NamedExpression, Error> {
        if fixed_names().any(|other| other == name) || self.columns().any(|other| other == name) {
            return Err(Error::usage(format!("there is another column `{name}`"), "give this one another name"));
        }
        alone(name, text, |text, reader| {
            let expression = Expression::new(text);
            self.check(&expression, reader)?;
            Some(NamedExpression { name: name.to_owned(), at: 0..0, expression })
        })
    }
}

impl<N: SceneNumber> Group<N> for Values<'_, N> {
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
        if self.evaluators.len() < self.columns.len() {
            self.evaluators = self.columns.iter().map(|named| named.evaluator(at.system, at.context)).collect();
        }
        for evaluator in &mut self.evaluators {
            let energy = || energy.clone().expect("it is computed where a formula has it");
            let value = evaluator.value_at(at.state(), &time, energy);
            cells.push(if value.is_finite() { Cell::Number(value.clone()) } else { Cell::NotDue });
        }
        Ok(())
    }
}
