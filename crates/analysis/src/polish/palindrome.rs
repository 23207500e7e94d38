//! Decimals that are one unknown: two that mirror each other in a palindrome, and those that are printed alike.

use num_bigint::BigInt;
use num_traits::{Signed, Zero};
use shadowstep_schemes::symbolic::Rational;
use shadowstep_schemes::symbolic::decimal::to_significant;

use crate::polish::unknowns::{Cell, Mirrored, Model, Unknown};
use shadowstep_schemes::document::Faults;
use shadowstep_schemes::table::{self, Table};

/// Decimals with at least this number of digits that are printed alike are equal by more than chance.
const DIGITS_OF_ONE_NUMBER: u32 = 6;

impl Model {
    /// Unites decimals with the same text, as Suzuki's four equal steps are; not the free parameters of a family.
    pub(super) fn unite_alike(&mut self, table: &Table) {
        let text = |unknown: &Unknown| table.source.text[unknown.at.clone()].trim().to_owned();
        let is_free = |unknown: &Unknown| table.free.iter().any(|name| name.value == unknown.name);
        let mut second = 1;
        while let Some(unknown) = self.unknowns.get(second) {
            let first = self.unknowns[..second].iter().position(|other| text(other) == text(unknown));
            let is_one = unknown.decimal.significant >= DIGITS_OF_ONE_NUMBER && !is_free(unknown);
            match first.filter(|&first| is_one && !is_free(&self.unknowns[first])) {
                Some(first) => self.replace(second, Cell::Unknown(first), Mirrored::Unknown(first)),
                None => second += 1,
            }
        }
    }

    /// Unites what mirrors each other, if everything does.
    pub(super) fn find_palindrome(&mut self, table: &Table, texts: &[&[table::Cell]]) -> Result<(), Faults> {
        let claimed = table.symmetric.as_ref().map(|claim| claim.value);
        if claimed == Some(false) {
            return Ok(());
        }
        let digits = shadowstep_schemes::exact::DIGITS;
        let values = self.weights(&self.printed(), digits).expect("the cells have been evaluated");
        let stages = self.lists[0].len();
        // gradient kicks act with the kicks, and mirror each other by themselves between the drifts
        let sequences: &[&[usize]] = match self.kernel_lists {
            1 => &[&[0]],
            2 => &[&[0, 1]],
            _ => &[&[0, 1], &[2, 1]],
        };
        let pairs = sequences.iter().flat_map(|lists| {
            let all = (0..stages).flat_map(|stage| lists.iter().map(move |list| (*list, stage)));
            let places: Vec<_> = all.filter(|&(list, stage)| !values[list][stage].is_zero()).collect();
            (0..places.len() / 2).map(move |i| (places[i], places[places.len() - 1 - i]))
        });
        let pairs: Vec<_> = pairs.collect();
        for &((list, stage), (other_list, other)) in &pairs {
            let (a, b) = (&values[list][stage], &values[other_list][other]);
            let unit = self.unit((list, stage)).max(self.unit((other_list, other)));
            if list == other_list && (a - b).abs() <= unit {
                continue;
            }
            return match claimed {
                Some(true) => Err(unlike(table, &texts[other_list][other], a, b)),
                _ => Ok(()),
            };
        }
        self.symmetric = true;
        pairs.into_iter().for_each(|(a, b)| self.unite(a, b, texts));
        Ok(())
    }

    /// One unit of a cell's last digit; for formulas one of 250 digits.
    fn unit(&self, (list, stage): (usize, usize)) -> Rational {
        match &self.lists[list][stage] {
            Cell::Unknown(unknown) => self.unknowns[*unknown].decimal.unit(),
            Cell::Formula(_) => Rational::new(1.into(), BigInt::from(10).pow(250)),
        }
    }

    fn unite(&mut self, first: (usize, usize), second: (usize, usize), texts: &[&[table::Cell]]) {
        let cell = |(list, stage): (usize, usize)| self.lists[list][stage].clone();
        match (cell(first), cell(second)) {
            (Cell::Unknown(a), Cell::Unknown(b)) if a != b => {
                // constants keep their names; of two alike the upper one stays
                let stays = |u: usize| (!self.unknowns[u].is_constant, self.unknowns[u].at.start);
                let (kept, gone) = if stays(a) <= stays(b) { (a, b) } else { (b, a) };
                self.replace(gone, Cell::Unknown(kept), Mirrored::Unknown(kept));
            }
            (Cell::Unknown(unknown), formula @ Cell::Formula(_)) if !self.unknowns[unknown].is_constant => {
                self.replace(unknown, formula, Mirrored::Formula(texts[second.0][second.1].value.clone()));
            }
            (formula @ Cell::Formula(_), Cell::Unknown(unknown)) if !self.unknowns[unknown].is_constant => {
                self.replace(unknown, formula, Mirrored::Formula(texts[first.0][first.1].value.clone()));
            }
            _ => {}
        }
    }

    /// Takes an unknown away that follows from another cell.
    fn replace(&mut self, gone: usize, by: Cell, text: Mirrored) {
        let removed = self.unknowns.remove(gone);
        let renumbered = |unknown: usize| if unknown > gone { unknown - 1 } else { unknown };
        let by = match by {
            Cell::Unknown(kept) => Cell::Unknown(renumbered(kept)),
            formula => formula,
        };
        let new = |unknown: usize| if unknown == gone { by.clone() } else { Cell::Unknown(renumbered(unknown)) };
        for cell in self.constants.iter_mut().map(|(_, cell)| cell).chain(self.lists.iter_mut().flatten()) {
            if let Cell::Unknown(unknown) = *cell {
                *cell = new(unknown);
            }
        }
        let text_then = text.clone();
        self.mirrored.push((removed.at, text));
        for (_, text) in &mut self.mirrored {
            if let Mirrored::Unknown(unknown) = *text {
                *text = match new(unknown) {
                    Cell::Unknown(unknown) => Mirrored::Unknown(unknown),
                    Cell::Formula(_) => text_then.clone(),
                };
            }
        }
        if removed.is_constant {
            self.names.insert(removed.name, gone);
        }
        self.names.retain(|_, unknown| match new(*unknown) {
            Cell::Unknown(kept) => {
                *unknown = kept;
                true
            }
            Cell::Formula(_) => false,
        });
    }
}

fn unlike(table: &Table, cell: &table::Cell, first: &Rational, second: &Rational) -> Faults {
    let fault = table
        .source
        .fault(&cell.at, "a palindrome is claimed, this weight is not what it mirrors")
        .values(to_significant(second, 25), to_significant(first, 25))
        .hint("correct the weights, or write `symmetric = false`");
    Faults(vec![fault])
}
