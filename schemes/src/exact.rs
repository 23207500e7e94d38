//! Cells → exact rationals: constants, dependent weights, compositions.
//!
//! A closed form such as `1/(2 - 2^(1/3))` is rounded once, to a rational of [`DIGITS`] digits, or of more where a run
//! has more; whatever is derived from it by `1 - 2*g1` is exact again, so that the weights sum to exactly 1.

use std::collections::BTreeMap;
use std::ops::Range;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use crate::document::Placed;
use crate::document::{Fault, Source};
use crate::library::Library;
use crate::map::Stages;
use crate::parse;
use crate::scheme::{ExactInner, ExactProcessor, ExactScheme, Held};
use crate::shipped::shipped_hint;
use crate::symbolic::decimal::to_significant;
use crate::symbolic::{Budget, Exact, Rational, evaluate, evaluate_within, parse as formula};
use crate::table::{Cell, MOST_STAGES, Table, Weights};

/// Digits to which an irrational constant is rounded, unless more are asked for.
pub const DIGITS: u32 = 300;

/// The largest weight that is accepted; a larger one is surely a mistake.
const LARGEST_WEIGHT: u32 = 1000;

/// The most bits of a weight's numerator or denominator: 1500 digits.
const LONGEST_WEIGHT: u64 = 5000;

/// The most bits of the common denominator of exact weights, with which their conditions are proved.
const LONGEST_DENOMINATOR: u64 = 20_000;

/// The most stages of a composition before neighbours are merged: what is refused must not be written out first.
const MOST_UNMERGED: usize = 10 * MOST_STAGES;

/// The most compositions within each other: a chain of `../a/b` need not come back to a path it has had.
const MOST_NESTED: usize = 20;

/// Reads a table and evaluates its cells; nothing is proved yet. The faults are in the text and the cells, for
/// a composition also in its base; without a fault in the cells there is a scheme.
pub fn scheme(source: &Source, library: Library<'_>) -> (Option<ExactScheme>, Vec<Fault>) {
    scheme_to_digits(source, library, DIGITS)
}

/// The same with irrational constants rounded to this number of digits.
pub(crate) fn scheme_to_digits(
    source: &Source,
    library: Library<'_>,
    digits: u32,
) -> (Option<ExactScheme>, Vec<Fault>) {
    scheme_within(source, library, digits, &[])
}

fn scheme_within(
    source: &Source,
    library: Library<'_>,
    digits: u32,
    above: &[String],
) -> (Option<ExactScheme>, Vec<Fault>) {
    let (table, mut faults) = parse::table(source);
    let Some(table) = table else { return (None, faults) };
    let (known, budget) = (BTreeMap::new(), Budget::default());
    let mut cells = Cells { table: &table, digits, known, rounded: false, budget, faults: Vec::new() };
    cells.constants();
    cells.free();
    let found = |base: &Placed<String>| base_scheme(&table, base, library, digits, above);
    let weights = cells.stages(found);
    let processor = weights.as_ref().and_then(|(_, held, base)| cells.processor(*held, base.as_deref()));
    cells.check_length(weights.as_ref(), processor.as_ref());
    let inner = weights.as_ref().and_then(|(stages, ..)| cells.inner(stages, found));
    let good = cells.faults.is_empty();
    faults.extend(cells.faults);
    let scheme = weights.filter(|_| good).map(|(stages, held, base)| {
        let held = inner.as_ref().map_or(held, |inner| held.weaker(inner.scheme.held));
        ExactScheme { table, stages, held, base, processor, inner }
    });
    (scheme, faults)
}

/// The stages of a table, to which digits they hold, and the base of a composition.
type Weighted = (Stages, Held, Option<Box<ExactScheme>>);

impl Cells<'_> {
    /// The stages; `found` gives a base with its faults.
    fn stages(&mut self, found: impl Fn(&Placed<String>) -> (Option<ExactScheme>, Vec<Fault>)) -> Option<Weighted> {
        match self.table.weights.as_ref()? {
            Weights::Stages { kick, gradient_kick, drift } => {
                let stages = Stages {
                    kick: self.weights(&kick.value),
                    gradient_kick: gradient_kick.as_ref().map_or_else(Vec::new, |list| self.weights(&list.value)),
                    drift: self.weights(&drift.value),
                };
                Some((stages, self.held(), None))
            }
            Weights::Composition { base, gamma } => {
                let gamma = self.weights(&gamma.value);
                let (scheme, faults) = found(base);
                self.faults.extend(faults);
                let scheme = scheme?;
                let size = gamma.len() * scheme.stages.kick.len();
                if size > MOST_UNMERGED {
                    self.faults.push(self.table.too_long(size));
                }
                if scheme.inner.is_some() {
                    let message = format!("{} has an inner scheme, which a base cannot have", scheme.table.name.value);
                    let fault = self.table.source.fault(&base.at, message);
                    self.faults.push(fault.hint("compose its outer scheme, and write [inner] here"));
                }
                if size > MOST_UNMERGED {
                    return None;
                }
                let stages = Stages::of(&scheme.stages.repeated(&gamma).maps());
                Some((stages, self.held().weaker(scheme.held), Some(Box::new(scheme))))
            }
        }
    }

    /// Refuses too many stages, and exact weights that are too long.
    fn check_length(&mut self, weights: Option<&Weighted>, processor: Option<&ExactProcessor>) {
        let Some((Stages { kick, gradient_kick, drift }, held, _)) = weights else { return };
        if kick.len() > MOST_STAGES {
            self.faults.push(self.table.too_long(kick.len()));
        }
        let weights = kick.iter().chain(gradient_kick).chain(drift).chain(weights_of(processor));
        if *held == Held::Exactly && self.faults.is_empty() && !have_short_denominator(weights) {
            let digits = LONGEST_DENOMINATOR * 3 / 10;
            let message = format!("the common denominator of the weights has more than {digits} digits");
            let hint = "round the weights, and write `digits = …`";
            self.faults.push(self.table.source.fault(&self.table.name.at, message).hint(hint));
        }
    }

    /// The scheme of fast forces within these stages.
    fn inner(
        &mut self,
        stages: &Stages,
        found: impl Fn(&Placed<String>) -> (Option<ExactScheme>, Vec<Fault>),
    ) -> Option<ExactInner> {
        let claim = self.table.inner.as_ref()?;
        let (scheme, faults) = found(&claim.base);
        self.faults.extend(faults);
        let inner = ExactInner { scheme: Box::new(scheme?), substeps: claim.substeps };
        self.faults.extend(inner.refused(self.table, claim, stages));
        Some(inner)
    }
}

fn weights_of(processor: Option<&ExactProcessor>) -> impl Iterator<Item = &Rational> {
    processor.into_iter().flat_map(|processor| &processor.post).map(|map| &map.weight)
}

fn have_short_denominator<'a>(mut weights: impl Iterator<Item = &'a Rational>) -> bool {
    let mut denominator = BigInt::one();
    weights.all(|weight| {
        denominator = denominator.lcm(weight.denom());
        denominator.bits() <= LONGEST_DENOMINATOR
    })
}

fn base_scheme(
    table: &Table,
    base: &Placed<String>,
    library: Library<'_>,
    digits: u32,
    above: &[String],
) -> (Option<ExactScheme>, Vec<Fault>) {
    let source = &table.source;
    let fault = |message: String, help: String| (None, vec![source.fault(&base.at, message).hint(help)]);
    let Some(found) = library(&base.value, source) else {
        let help = match base.value.contains(std::path::is_separator) {
            true => "give the name of a file beside this table, without folders, or of a shipped table".to_owned(),
            false => shipped_hint(&base.value),
        };
        return fault(format!("there is no table `{}`", base.value), help);
    };
    let mut chain = above.to_vec();
    chain.push(source.path.clone());
    if chain.len() > MOST_NESTED {
        let help = "write the stages out, or compose them in fewer tables";
        return fault(format!("{} compositions within each other are too many", chain.len()), help.into());
    }
    if chain.contains(&found.path) {
        let help = "a composition must end at a table with [stages]";
        return fault(format!("this composition is cyclic: {} → {}", chain.join(" → "), found.path), help.into());
    }
    scheme_within(&found, library, digits, &chain)
}

/// Evaluates cells in the order of the text, collecting faults.
struct Cells<'a> {
    table: &'a Table,
    /// Irrational values are rounded to these.
    digits: u32,
    known: BTreeMap<String, Exact>,
    rounded: bool,
    budget: Budget,
    faults: Vec<Fault>,
}

impl Cells<'_> {
    /// What is known of the digits of the weights so far.
    fn held(&self) -> Held {
        match &self.table.digits {
            Some(digits) => Held::Digits(digits.value),
            None if self.rounded => Held::Digits(self.digits),
            None => Held::Exactly,
        }
    }

    fn constants(&mut self) {
        for (name, cell) in &self.table.constants {
            // a constant that cannot be read stands as 1, so that the cells that use it have no further faults
            let one = Exact { value: Rational::from_integer(1.into()), rounded: false };
            let value = self.cell(cell).unwrap_or(one);
            self.known.insert(name.value.clone(), value);
        }
    }

    /// Free parameters are numbers as published, and follow from nothing.
    fn free(&mut self) {
        for name in &self.table.free {
            let Some((_, cell)) = self.table.constants.iter().find(|(constant, _)| constant.value == name.value) else {
                continue;
            };
            let Ok(expression) = formula(&cell.value) else { continue };
            let alone = evaluate(&expression, &BTreeMap::new(), DIGITS);
            if !alone.is_ok_and(|value| !value.rounded) {
                let message = format!("`{}` is not a free parameter: its value is `{}`", name.value, cell.value);
                let help = "a free parameter is a plain number, exactly as published";
                self.faults.push(self.table.source.fault(&name.at, message).hint(help));
            }
        }
    }

    /// The fault of a constant's name that is used before its definition ends.
    fn constant_below(&self, at: &Range<usize>) -> Option<Fault> {
        let word = self.table.source.text.get(at.clone())?;
        let defined = self.table.constants.iter().any(|(name, _)| name.value == word);
        let fault = || self.table.source.fault(at, format!("`{word}` is not known yet"));
        (defined && !self.known.contains_key(word)).then(|| fault().hint("a constant may use those above it only"))
    }

    fn weights(&mut self, cells: &[Cell]) -> Vec<Rational> {
        let weight = |cell| {
            let value = self.cell(cell).map_or_else(Rational::zero, |exact| {
                self.rounded |= exact.rounded;
                exact.value
            });
            if value.abs() > Rational::from_integer(LARGEST_WEIGHT.into()) {
                let message = format!("a weight of {} is too large", to_significant(&value, 6));
                let help = format!("weights are fractions of a step, at most {LARGEST_WEIGHT}");
                self.faults.push(self.table.source.fault(&cell.at, message).hint(help));
            }
            // a sum of irrational constants has a few bits more than these
            let longest = LONGEST_WEIGHT.max(4 * u64::from(self.digits));
            if value.numer().bits().max(value.denom().bits()) > longest {
                let message = format!("a weight has more than {} digits", longest * 3 / 10);
                self.faults.push(self.table.source.fault(&cell.at, message).hint("round it, and write `digits = …`"));
            }
            value
        };
        cells.iter().map(weight).collect()
    }

    /// The processor of a kernel whose weights are held so.
    fn processor(&mut self, held: Held, base: Option<&ExactScheme>) -> Option<ExactProcessor> {
        let table = self.table;
        let post = match table.processor.as_ref()?.post.as_ref()? {
            Weights::Stages { kick, drift, .. } => {
                let (kick, drift) = (self.weights(&kick.value), self.weights(&drift.value));
                Stages { kick, gradient_kick: Vec::new(), drift }.maps()
            }
            Weights::Composition { gamma, .. } => {
                let base = base?;
                if base.has_gradient_kicks() {
                    let fault =
                        table.source.fault(&gamma.at, "a processor cannot have gradient kicks, which its base has");
                    self.faults.push(fault.hint("write a kernel of a base without them"));
                    return None;
                }
                let size = gamma.value.len() * base.stages.kick.len();
                if size > MOST_UNMERGED {
                    self.faults.push(table.too_long(size));
                    return None;
                }
                base.stages.repeated(&self.weights(&gamma.value)).maps()
            }
        };
        if post.len() > 2 * MOST_STAGES {
            self.faults.push(table.too_long(post.len() / 2));
        }
        Some(ExactProcessor { post, held: self.held().weaker(held) })
    }

    fn cell(&mut self, cell: &Cell) -> Option<Exact> {
        // the cell that took the rest has its fault
        if self.budget.is_spent() {
            return None;
        }
        let place = |range: &Range<usize>| cell.at.start + range.start..cell.at.start + range.end;
        let expression = match formula(&cell.value) {
            Ok(expression) => expression,
            Err(error) => {
                self.faults.push(self.table.source.fault(&place(&error.range), error.to_string()));
                return None;
            }
        };
        match evaluate_within(&expression, &self.known, self.digits, &self.budget) {
            Ok(value) => Some(value),
            Err(error) => {
                let at = place(&error.range);
                self.faults.push(self.constant_below(&at).unwrap_or_else(|| {
                    let source = &self.table.source;
                    source.fault(&at, error.to_string())
                }));
                None
            }
        }
    }
}
