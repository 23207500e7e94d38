//! The numbers of a source: formulas over earlier ones, with their exact values and the decimals that they print.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use num_traits::ToPrimitive;
use shadowstep_schemes::decimal::PrintedDecimal;
use shadowstep_schemes::symbolic::{Budget, Exact, evaluate_within, parse};

/// A number of a source by its place among them.
pub(super) type Id = usize;

/// Digits to which irrational numbers are computed.
const DIGITS: u32 = 60;

/// Decimals of as many digits are not written by accident.
const TELLING: u32 = 6;

/// The longest formula: what is longer is not a weight.
const LONGEST: usize = 2000;

#[derive(Debug)]
pub(super) struct Number {
    /// In our language, where `n7` is the number 7.
    pub(super) formula: String,
    /// Its value, and whether it is rounded.
    pub(super) exact: Exact,
    pub(super) float: f64,
    /// Where it stands.
    pub(super) at: Range<usize>,
    /// The numbers that it names.
    uses: BTreeSet<Id>,
    /// The decimals that its formula prints.
    decimals: Vec<PrintedDecimal>,
}

/// A formula that is not yet a number.
#[derive(Clone, Debug, Default)]
pub(super) struct Formula {
    pub(super) text: String,
    pub(super) uses: BTreeSet<Id>,
    /// Its value as a whole number of the language.
    pub(super) whole: Option<i64>,
}

/// All numbers; each names earlier ones only.
#[derive(Default)]
pub(super) struct Numbers {
    numbers: Vec<Number>,
    budget: Budget,
}

impl Numbers {
    pub(super) fn get(&self, id: Id) -> &Number {
        &self.numbers[id]
    }

    /// The number of a formula; `None` if it has no value, or takes too long.
    pub(super) fn add(&mut self, formula: Formula, at: Range<usize>) -> Option<Id> {
        if let [id] = *formula.uses.iter().copied().collect::<Vec<_>>()
            && formula.text == name(id)
        {
            return Some(id);
        }
        if formula.text.len() > LONGEST {
            return None;
        }
        let expression = parse(&formula.text).ok()?;
        let known: BTreeMap<_, _> =
            formula.uses.iter().map(|id| (name(*id), self.numbers[*id].exact.clone())).collect();
        let exact = evaluate_within(&expression, &known, DIGITS, &self.budget).ok()?;
        let float = exact.value.to_f64().filter(|value| value.is_finite())?;
        let words = formula.text.split([' ', '(', ')']).map(|word| word.trim_start_matches('-'));
        let decimals = words.filter_map(PrintedDecimal::of).collect();
        self.numbers.push(Number { formula: formula.text, exact, float, at, uses: formula.uses, decimals });
        Some(self.numbers.len() - 1)
    }

    /// These and all numbers that they name, in their order.
    pub(super) fn closure(&self, ids: impl IntoIterator<Item = Id>) -> BTreeSet<Id> {
        let mut found = BTreeSet::new();
        let mut next: Vec<_> = ids.into_iter().collect();
        while let Some(id) = next.pop() {
            if found.insert(id) {
                next.extend(&self.numbers[id].uses);
            }
        }
        found
    }

    /// The digits that the decimals of these numbers have, of the shortest that is more than half as long as the
    /// longest; `None` without decimals.
    ///
    /// Digits are counted as those of tables: of numbers below 1 from the point on.
    pub(super) fn digits(&self, ids: &BTreeSet<Id>) -> Option<u32> {
        let count = |decimal: &PrintedDecimal| {
            u32::try_from(i64::from(decimal.significant).max(decimal.places)).unwrap_or(decimal.significant)
        };
        let decimals = ids.iter().flat_map(|id| &self.numbers[*id].decimals);
        let counts: Vec<_> = decimals.filter(|decimal| decimal.significant > 3).map(count).collect();
        let most = counts.iter().copied().max()?;
        counts.into_iter().filter(|digits| 2 * digits > most).min()
    }

    /// Whether some of them are roots, or have more digits than numbers that are written by accident.
    pub(super) fn are_telling(&self, ids: &BTreeSet<Id>) -> bool {
        let telling = |number: &Number| {
            number.exact.rounded || number.decimals.iter().any(|decimal| decimal.significant >= TELLING)
        };
        ids.iter().any(|id| telling(&self.numbers[*id]))
    }

    /// Constants of a table for these numbers.
    pub(super) fn constants(&self, ids: &BTreeSet<Id>) -> String {
        ids.iter().map(|id| format!("{} = \"{}\"\n", name(*id), self.numbers[*id].formula)).collect()
    }
}

/// The name of a number in formulas.
pub(super) fn name(id: Id) -> String {
    format!("n{id}")
}
