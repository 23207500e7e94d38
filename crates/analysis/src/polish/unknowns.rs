//! Table → its printed decimals as unknowns, and the weights as functions of them.
//!
//! A decimal that stands alone, as a constant or in a list of weights, is an unknown; fractions, whole numbers and
//! formulas stay what they are. In a palindrome two decimals that mirror each other are one unknown, and so are
//! decimals that are printed alike.

use std::collections::BTreeMap;
use std::ops::Range;

use num_bigint::BigInt;
use num_traits::{Signed, Zero};
use shadowstep_schemes::symbolic::{Exact, Expression, Rational, SemanticError, evaluate, parse};

use crate::polish::dual::{Dual, Duals};
use crate::polish::formulas;
use shadowstep_schemes::ExactScheme;
use shadowstep_schemes::decimal::PrintedDecimal;
use shadowstep_schemes::document::Faults;
use shadowstep_schemes::table::{self, Table};

/// A printed decimal.
#[derive(Clone, Debug)]
pub(crate) struct Unknown {
    /// The constant's name, or the place in a list such as `kick[2]`.
    pub(crate) name: String,
    /// Whether it is a constant with a name.
    pub(super) is_constant: bool,
    /// Where the decimal stands.
    pub(super) at: Range<usize>,
    /// The decimal itself.
    pub(super) decimal: PrintedDecimal,
}

impl Unknown {
    /// The most leading digits k for which the printed value is within 0.55 units of the k-th digit: half a unit is
    /// rounding, a tenth of that more a rounding of a rounding.
    pub(super) fn right_digits(&self, value: &Rational) -> u32 {
        let distance = (&self.decimal.value - value).abs();
        let mut allowed = self.decimal.unit() * Rational::new(11.into(), 20.into());
        let mut right = self.decimal.significant;
        while right > 0 && distance > allowed {
            allowed *= Rational::from_integer(10.into());
            right -= 1;
        }
        right
    }
}

/// A constant or a weight as a function of the unknowns.
#[derive(Clone, Debug)]
pub(crate) enum Cell {
    Unknown(usize),
    Formula(Expression),
}

/// What is written in place of a decimal that mirrors another cell.
#[derive(Clone, Debug)]
pub(crate) enum Mirrored {
    /// The unknown that both are.
    Unknown(usize),
    /// The formula of the other cell.
    Formula(String),
}

/// The weights of a table as functions of its unknowns.
pub(crate) struct Model {
    pub(crate) unknowns: Vec<Unknown>,
    /// Decimals that follow from another cell, by the palindrome or because they are printed alike.
    pub(super) mirrored: Vec<(Range<usize>, Mirrored)>,
    /// Whether the cells are a palindrome.
    pub(super) symmetric: bool,
    /// The base of a composition.
    pub(super) base: Option<ExactScheme>,
    /// Lists of weights: kicks, drifts and gradient kicks, or γ's; then those of the processor, if there is one.
    pub(crate) lists: Vec<Vec<Cell>>,
    /// How many of the lists are those of the scheme, or of the kernel.
    pub(super) kernel_lists: usize,
    pub(super) constants: Vec<(String, Cell)>,
    /// Other names of unknowns, such as `kick[6]`.
    pub(super) names: BTreeMap<String, usize>,
    /// The places of weights that are fractions or formulas.
    exact: Vec<String>,
    /// The constants on which no weight depends: their decimals are not unknowns.
    pub(super) unused: Vec<String>,
}

impl Model {
    /// The unknowns of a table whose cells can be evaluated.
    pub(crate) fn of(table: &Table, base: Option<ExactScheme>) -> Result<Model, Faults> {
        let mut model = Model {
            unknowns: Vec::new(),
            mirrored: Vec::new(),
            symmetric: false,
            base,
            lists: Vec::new(),
            kernel_lists: 0,
            constants: Vec::new(),
            names: BTreeMap::new(),
            exact: Vec::new(),
            unused: formulas::unused_constants(table).into_iter().map(str::to_owned).collect(),
        };
        for (name, cell) in &table.constants {
            let cell = if model.unused.contains(&name.value) {
                Cell::Formula(parse(&cell.value).expect("the cells have been evaluated"))
            } else {
                model.cell(cell, &name.value, true)
            };
            model.constants.push((name.value.clone(), cell));
        }
        let [kernel, processor] = formulas::lists(table);
        model.kernel_lists = kernel.len();
        for (list, cells) in kernel.iter().chain(&processor) {
            let named = |i: usize| format!("{list}[{}]", i + 1);
            let cells = cells.value.iter().enumerate().map(|(i, cell)| model.cell(cell, &named(i), false)).collect();
            model.lists.push(cells);
        }
        model.find_palindrome(table, &kernel.iter().map(|(_, cells)| cells.value.as_slice()).collect::<Vec<_>>())?;
        model.unite_alike(table);
        for (list, (name, _)) in kernel.iter().chain(&processor).enumerate() {
            for (i, cell) in model.lists[list].iter().enumerate() {
                let place = format!("{name}[{}]", i + 1);
                match cell {
                    Cell::Unknown(unknown) => drop(model.names.insert(place, *unknown)),
                    Cell::Formula(_) => model.exact.push(place),
                }
            }
        }
        Ok(model)
    }

    /// The unknown that a person names.
    pub(super) fn unknown(&self, name: &str) -> Option<usize> {
        self.unknowns.iter().position(|u| u.name == name).or_else(|| self.names.get(name).copied())
    }

    /// Whether this is the name of a constant or weight without a decimal of its own.
    pub(super) fn is_exact(&self, name: &str) -> bool {
        self.constants.iter().any(|(constant, _)| constant == name) || self.exact.iter().any(|place| place == name)
    }

    /// The printed decimals.
    pub(crate) fn printed(&self) -> Vec<Rational> {
        self.unknowns.iter().map(|u| u.decimal.value.clone()).collect()
    }

    /// How many lists of weights have the sum 1: kicks and drifts, not gradient kicks.
    pub(super) fn lists_of_weights(&self) -> usize {
        self.kernel_lists.min(2)
    }

    /// The lists of weights at values of the unknowns; closed forms to `digits` digits.
    pub(super) fn weights(&self, x: &[Rational], digits: u32) -> Result<Vec<Vec<Rational>>, SemanticError> {
        let mut known = BTreeMap::new();
        for (name, cell) in &self.constants {
            let value = value(cell, x, &known, digits)?;
            known.insert(name.clone(), value);
        }
        let list = |list: &Vec<Cell>| list.iter().map(|cell| Ok(value(cell, x, &known, digits)?.value)).collect();
        self.lists.iter().map(list).collect()
    }

    /// The lists of weights with their derivatives.
    ///
    /// The derivatives are differences with a step of a few units of the arithmetic's square root: exact where the
    /// cells are linear in the unknowns, as all but a few tables' are, and else with half of the digits, which Newton's
    /// iteration needs.
    pub(super) fn duals(&self, x: &[Rational], arithmetic: Duals) -> Result<Vec<Vec<Dual>>, SemanticError> {
        let digits = (f64::from(arithmetic.bits) * std::f64::consts::LOG10_2).ceil() as u32 + 5;
        let at_x = self.weights(x, digits)?;
        let shift = arithmetic.bits / 2;
        let step = Rational::new(1.into(), BigInt::from(1) << shift);
        let mut duals: Vec<Vec<Dual>> = at_x
            .iter()
            .map(|list| {
                let dual = |w| Dual { value: arithmetic.units(w), slopes: vec![BigInt::zero(); x.len()] };
                list.iter().map(dual).collect()
            })
            .collect();
        for unknown in 0..x.len() {
            let mut moved = x.to_vec();
            moved[unknown] += &step;
            let at_moved = self.weights(&moved, digits)?;
            let changes = at_moved.iter().flatten().zip(at_x.iter().flatten()).map(|(moved, fixed)| moved - fixed);
            for (dual, change) in duals.iter_mut().flatten().zip(changes) {
                if !change.is_zero() {
                    dual.slopes[unknown] = arithmetic.units(&change) << shift;
                }
            }
        }
        Ok(duals)
    }

    fn cell(&mut self, cell: &table::Cell, name: &str, is_constant: bool) -> Cell {
        if let Some(decimal) = PrintedDecimal::of(&cell.value) {
            self.unknowns.push(Unknown { name: name.to_owned(), is_constant, at: cell.at.clone(), decimal });
            return Cell::Unknown(self.unknowns.len() - 1);
        }
        match self.constants.iter().find(|(constant, _)| *constant == cell.value.trim()) {
            Some((_, Cell::Unknown(unknown))) => Cell::Unknown(*unknown),
            _ => Cell::Formula(parse(&cell.value).expect("the cells have been evaluated")),
        }
    }
}

fn value(cell: &Cell, x: &[Rational], known: &BTreeMap<String, Exact>, digits: u32) -> Result<Exact, SemanticError> {
    match cell {
        Cell::Unknown(unknown) => Ok(Exact { value: x[*unknown].clone(), rounded: false }),
        Cell::Formula(expression) => evaluate(expression, known, digits),
    }
}

#[cfg(test)]
mod tests {
    use shadowstep_schemes::symbolic::decimal::from_text;

    use super::*;

    fn right_digits(printed: &str, value: &str) -> u32 {
        let (value, decimal) = (from_text(value).unwrap(), PrintedDecimal::of(printed).unwrap());
        Unknown { name: "w".to_owned(), is_constant: true, at: 0..0, decimal }.right_digits(&value)
    }

    #[test]
    fn right_digits_are_counted_by_their_units() {
        // Yoshida's solution D, w4: log10 of the relative distance is -11.5
        assert_eq!(right_digits("-0.158240635368502468458", "-0.158240635368052436"), 12);
        // all digits, by rounding and by a rounding of a rounding
        assert_eq!(right_digits("0.12345", "0.1234549"), 5);
        assert_eq!(right_digits("0.12345", "0.1234555"), 5);
        assert_eq!(right_digits("0.12345", "0.1234556"), 4);
        // digits that differ but for half a unit: 1.000 is 0.9996, rounded
        assert_eq!(right_digits("1.0000", "0.9996"), 4);
        assert_eq!(right_digits("9.99e-5", "9.99e-5"), 3);
        assert_eq!(right_digits("0.5", "-0.5"), 0);
    }
}
