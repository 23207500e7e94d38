//! The decimals that a table prints, and how the weights depend on them.
//!
//! A decimal with `digits` in its table is a rounded number: it stands for any value within a unit of its last place.
//! One with at most half as many digits is a number that was chosen, such as 0.25, and a constant that the table calls
//! free is exact; neither moves. Decimals that are printed alike are one number.

use std::collections::BTreeMap;
use std::ops::Range;

use num_bigint::BigInt;
use num_traits::{FromPrimitive, Signed, ToPrimitive};

use crate::decimal::PrintedDecimal;
use crate::document::Source;
use crate::map_kind::MapKind;
use crate::scheme::{ExactScheme, Held};
use crate::symbolic::{Budget, Exact, Expression, ExpressionKind, Rational, evaluate_within, parse};
use crate::table::{Cell, Table, Weights};

/// A printed decimal.
#[derive(Clone, Debug)]
pub(crate) struct Decimal {
    /// The constant's name, or a place such as `kick[2]`.
    pub(crate) name: String,
    /// The table that prints it.
    pub(crate) source: Source,
    /// Where it stands.
    pub(crate) at: Range<usize>,
    /// The digits as printed, without a sign.
    pub(crate) text: String,
    /// Decimal places behind the point; less than 0 for `1.5e20`.
    pub(crate) places: i64,
    /// Decimal places to which it is rounded, by the number of digits that the table claims.
    pub(crate) rounded: i64,
}

impl Decimal {
    /// The text of the decimal that is nearest after a change by some units of the last place.
    pub(crate) fn moved(&self, units: f64) -> String {
        let digits = self.digits() + BigInt::from_f64(units.round()).unwrap_or_default();
        let (sign, size) = (if digits.is_negative() { "-" } else { "" }, digits.magnitude());
        match usize::try_from(self.places) {
            Err(_) | Ok(0) => format!("{sign}{size}e{}", -self.places),
            Ok(places) => {
                let digits = format!("{size:0>width$}", width = places + 1);
                let (whole, fraction) = digits.split_at(digits.len() - places);
                format!("{sign}{whole}.{fraction}")
            }
        }
    }

    /// The decimal with two neighbouring digits exchanged whose change is nearest to this many units, if it is close.
    pub(crate) fn transposed(&self, units: f64) -> Option<String> {
        let mantissa = self.text.find(['e', 'E']).unwrap_or(self.text.len());
        let exchanged = |i: usize| {
            let mut bytes = self.text.clone().into_bytes();
            bytes.swap(i, i + 1);
            let text = String::from_utf8(bytes).ok()?;
            let decimal = Decimal { text, ..self.clone() };
            let change = (decimal.digits() - self.digits()).to_f64()?;
            Some(((change - units).abs(), decimal.text)).filter(|_| change != 0.0)
        };
        let places = (0..mantissa.saturating_sub(1)).filter(|i| !self.text[*i..*i + 2].contains('.'));
        let nearest = places.filter_map(exchanged).min_by(|a, b| a.0.total_cmp(&b.0))?;
        // the others are rounded, too
        let close = CLOSE * 10_f64.powi((self.places - self.rounded) as i32) + 1e-3 * units.abs();
        (nearest.0 <= close.min(units.abs() / 5.0)).then_some(nearest.1)
    }

    /// The digits as a whole number.
    fn digits(&self) -> BigInt {
        let mantissa = self.text.split(['e', 'E']).next().unwrap_or_default();
        let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
        digits.parse().unwrap_or_default()
    }
}

/// A weight in f64 and its derivative with respect to each decimal.
#[derive(Clone, Debug)]
pub(crate) struct Sloped {
    pub(crate) value: f64,
    pub(crate) slopes: Vec<f64>,
}

/// The maps of a scheme as functions of the decimals that its table, and the tables of its bases, print.
pub(crate) struct Printed {
    pub(crate) decimals: Vec<Decimal>,
    pub(crate) maps: Vec<(MapKind, Sloped)>,
}

/// How far an exchange of digits may be from what is needed to be named, in units of the last of the claimed digits.
const CLOSE: f64 = 5.0;

/// The most decimals that are examined: the work grows with their square.
const MOST_DECIMALS: usize = 200;

/// The most products of maps and decimals: a long composition has few decimals, or few maps.
const MOST_SLOPES: usize = 20_000;

/// Digits to which derivatives are computed: as differences with a step of a third of them.
const DIGITS: u32 = 60;

impl Printed {
    /// The decimals of a scheme; `None` where there are none, or too many.
    pub(crate) fn of(scheme: &ExactScheme) -> Option<Printed> {
        let mut decimals = Vec::new();
        let weights = weights(scheme, &mut decimals)?;
        let count = decimals.len();
        if count == 0 || count > MOST_DECIMALS || count * weights.len() > MOST_SLOPES {
            return None;
        }
        let mut maps: Vec<(MapKind, Sloped)> = Vec::new();
        for (kind, mut weight) in weights {
            weight.slopes.resize(count, 0.0);
            let run = maps.iter().rposition(|(last, _)| !last.commutes_with(kind)).map_or(0, |before| before + 1);
            match maps[run..].iter_mut().find(|(last, _)| *last == kind) {
                Some((_, sum)) => sum.add(&weight, 1.0),
                None => maps.push((kind, weight)),
            }
        }
        let written = scheme.maps();
        // the roles of kick and drift may have been exchanged
        if written[0].kind != maps[0].0 {
            maps.iter_mut().for_each(|(kind, _)| *kind = kind.other());
        }
        (written.len() == maps.len()).then_some(Printed { decimals, maps })
    }
}

impl Sloped {
    fn constant(value: f64) -> Sloped {
        Sloped { value, slopes: Vec::new() }
    }

    fn add(&mut self, other: &Sloped, factor: f64) {
        self.value += factor * other.value;
        self.add_slopes(other, factor);
    }

    fn add_slopes(&mut self, other: &Sloped, factor: f64) {
        self.slopes.resize(self.slopes.len().max(other.slopes.len()), 0.0);
        self.slopes.iter_mut().zip(&other.slopes).for_each(|(slope, other)| *slope += factor * other);
    }

    fn product(&self, other: &Sloped) -> Sloped {
        let mut product = Sloped::constant(self.value * other.value);
        product.add_slopes(self, other.value);
        product.add_slopes(other, self.value);
        product
    }
}

/// The weights of all stages in their order that are not 0, before neighbours merge.
fn weights(scheme: &ExactScheme, decimals: &mut Vec<Decimal>) -> Option<Vec<(MapKind, Sloped)>> {
    let mut cells = Cells::of(&scheme.table, decimals);
    let mut weights = match scheme.table.weights.as_ref()? {
        Weights::Stages { kick, gradient_kick, drift } => {
            let (kicks, drifts) = (cells.list("kick", &kick.value)?, cells.list("drift", &drift.value)?);
            let gradient_kicks = match gradient_kick {
                Some(list) => cells.list("gradient_kick", &list.value)?,
                None => vec![Sloped::constant(0.0); kicks.len()],
            };
            let stages = kicks.into_iter().zip(gradient_kicks).zip(drifts);
            let maps = |((kick, gradient_kick), drift)| {
                [(MapKind::Kick, kick), (MapKind::GradientKick, gradient_kick), (MapKind::Drift, drift)]
            };
            stages.flat_map(maps).collect::<Vec<_>>()
        }
        Weights::Composition { gamma, .. } => {
            let gamma = cells.list("gamma", &gamma.value)?;
            let base = weights(scheme.base.as_deref()?, decimals)?;
            let scaled = |gamma: &Sloped, kind: MapKind, weight: &Sloped| {
                (0..kind.power()).fold(weight.clone(), |weight, _| gamma.product(&weight))
            };
            let step =
                |gamma: &Sloped| base.iter().map(|(kind, weight)| (*kind, scaled(gamma, *kind, weight))).collect();
            gamma.iter().flat_map(|gamma| -> Vec<_> { step(gamma) }).collect()
        }
    };
    weights.retain(|(_, weight)| weight.value != 0.0);
    Some(weights)
}

/// Evaluates the cells of a table with their derivatives.
struct Cells<'a> {
    table: &'a Table,
    digits: Option<u32>,
    decimals: &'a mut Vec<Decimal>,
    /// Decimals of this table begin here.
    first: usize,
    exact: BTreeMap<String, Exact>,
    sloped: BTreeMap<String, Sloped>,
    budget: Budget,
}

impl Cells<'_> {
    fn of<'a>(table: &'a Table, decimals: &'a mut Vec<Decimal>) -> Cells<'a> {
        let digits = table.digits.as_ref().map(|digits| digits.value);
        let first = decimals.len();
        Cells {
            table,
            digits,
            decimals,
            first,
            exact: BTreeMap::new(),
            sloped: BTreeMap::new(),
            budget: Budget::default(),
        }
    }

    /// The values of a list of cells, after the values of the constants.
    fn list(&mut self, name: &str, cells: &[Cell]) -> Option<Vec<Sloped>> {
        if self.exact.is_empty() {
            for (name, cell) in &self.table.constants {
                let is_free = self.table.free.iter().any(|free| free.value == name.value);
                let (exact, sloped) = self.cell(&name.value, cell, !is_free)?;
                self.exact.insert(name.value.clone(), exact);
                self.sloped.insert(name.value.clone(), sloped);
            }
        }
        cells
            .iter()
            .enumerate()
            .map(|(i, cell)| Some(self.cell(&format!("{name}[{}]", i + 1), cell, true)?.1))
            .collect()
    }

    fn cell(&mut self, name: &str, cell: &Cell, moves: bool) -> Option<(Exact, Sloped)> {
        let expression = parse(&cell.value).ok()?;
        let exact = evaluate_within(&expression, &self.exact, DIGITS, &self.budget).ok()?;
        let mut sloped = Sloped::constant(exact.value.to_f64()?);
        for input in inputs(&expression) {
            let own = match &input {
                Input::Name(name) => self.sloped.get(name).cloned(),
                Input::Literal(range) if moves => self.decimal(name, cell, range),
                Input::Literal(_) => None,
            };
            // what does not move has no slopes
            if let Some(own) = own.filter(|own| !own.slopes.is_empty()) {
                sloped.add_slopes(&own, self.derivative(&expression, &exact, &input)?);
            }
        }
        Some((exact, sloped))
    }

    /// The decimal at a place of a cell, where it is a rounded one: 1 is its derivative with respect to itself.
    fn decimal(&mut self, name: &str, cell: &Cell, range: &Range<usize>) -> Option<Sloped> {
        let text = cell.value[range.clone()].trim_matches(|c: char| "()+ \t\n".contains(c));
        let PrintedDecimal { places, significant, .. } = PrintedDecimal::of(text)?;
        let claimed = self.digits.filter(|digits| 2 * significant > *digits)?;
        let known = self.decimals[self.first..].iter().position(|decimal| decimal.text == text);
        let index = self.first + known.unwrap_or(self.decimals.len() - self.first);
        if known.is_none() {
            // of numbers below 1, the digits are counted from the point; and a digit fewer may have been printed
            let claimed = i64::from(claimed) - (i64::from(significant) - places).max(0);
            let rounded = claimed.min(places.max(claimed - 1));
            let at = cell.at.start + range.start..cell.at.start + range.end;
            let (source, name) = (self.table.source.clone(), name.to_owned());
            self.decimals.push(Decimal { name, source, at, text: text.to_owned(), places, rounded });
        }
        let mut slopes = vec![0.0; index + 1];
        slopes[index] = 1.0;
        Some(Sloped { value: 0.0, slopes })
    }

    /// ∂(expression)/∂(input)
    fn derivative(&self, expression: &Expression, at: &Exact, input: &Input) -> Option<f64> {
        match &expression.kind {
            ExpressionKind::Name(_) | ExpressionKind::Number(_) => return Some(1.0),
            _ => {}
        }
        let step = Rational::new(1.into(), BigInt::from(10).pow(DIGITS / 3));
        let moved = match input {
            Input::Name(name) => {
                let mut names = self.exact.clone();
                names.get_mut(name)?.value += &step;
                evaluate_within(expression, &names, DIGITS, &self.budget)
            }
            Input::Literal(range) => {
                evaluate_within(&with_moved(expression, range, &step), &self.exact, DIGITS, &self.budget)
            }
        };
        ((moved.ok()?.value - &at.value) / step).to_f64()
    }
}

/// What a formula depends on.
#[derive(Clone, Debug, PartialEq)]
enum Input {
    Name(String),
    Literal(Range<usize>),
}

fn inputs(expression: &Expression) -> Vec<Input> {
    let mut found = Vec::new();
    expression.visit(&mut |part| {
        let input = match &part.kind {
            ExpressionKind::Name(name) => Input::Name(name.clone()),
            ExpressionKind::Number(_) => Input::Literal(part.range.clone()),
            _ => return,
        };
        if !found.contains(&input) {
            found.push(input);
        }
    });
    found
}

/// The expression with the literal at a place moved by a step.
fn with_moved(expression: &Expression, at: &Range<usize>, step: &Rational) -> Expression {
    let moved = |inner: &Expression| Box::new(with_moved(inner, at, step));
    let kind = match &expression.kind {
        ExpressionKind::Number(value) if expression.range == *at => ExpressionKind::Number(value + step),
        ExpressionKind::Number(_) | ExpressionKind::Name(_) => expression.kind.clone(),
        ExpressionKind::Negate(inner) => ExpressionKind::Negate(moved(inner)),
        ExpressionKind::Binary(operation, left, right) => ExpressionKind::Binary(*operation, moved(left), moved(right)),
        ExpressionKind::Call { function, arguments } => ExpressionKind::Call {
            function: function.clone(),
            arguments: arguments.iter().map(|argument| with_moved(argument, at, step)).collect(),
        },
    };
    Expression { kind, range: expression.range.clone() }
}

impl ExactScheme {
    /// The fewest digits to which the weights are held, if closed forms have more.
    pub(crate) fn claimed_digits(&self) -> Option<u32> {
        match self.held {
            Held::Digits(digits) if digits < crate::exact::DIGITS - 10 => Some(digits),
            _ => None,
        }
    }
}
