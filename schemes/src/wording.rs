//! What the proof finds of the claims of a table → sentences with places.

use std::fmt;

use num_traits::Signed;

use crate::claims::Kinetic;
use crate::conditions::Family;
use crate::digits::digits_of;
use crate::document::{Fault, Placed};
use crate::map_kind::MapKind;
use crate::order::Condition;
use crate::proof::{Finding, Of, Order, Proof};
use crate::rounding::{Off, Unexplained};
use crate::scheme::ExactScheme;
use crate::symbolic::Rational;
use crate::symbolic::decimal::{to_significant, to_text};
use crate::table::{Table, Weights};

/// More decimals than these are counted, not named.
const MOST_NAMED: usize = 4;

/// A finding as a sentence at the place of the claim.
pub(crate) fn worded(finding: &Finding<'_>, scheme: &ExactScheme, proof: &Proof) -> Fault {
    let table = &scheme.table;
    match finding {
        Finding::Sum { kind, found, needed } => wrong_sum(table, *kind, found, needed),
        Finding::LowerOrder { of, family, claimed, proved } => {
            lower_order(table, proof, (*of, *family), claimed, proved)
        }
        Finding::HigherOrder { of, family, claimed, holds } => {
            let message = format!("{of} {} is claimed, {of} {holds} holds {}", claimed.value, of.what(*family));
            let hint = match family {
                Family::Kinetic(_) => format!("write `order = {holds}`"),
                Family::Power(_) => format!("write {holds}"),
            };
            table.source.fault(&claimed.at, message).hint(hint)
        }
        Finding::NotSymmetric { claim } => not_a_palindrome(scheme, claim),
        Finding::Symmetric { claim } => {
            table.source.fault(&claim.at, "the scheme is a palindrome").hint("write `symmetric = true`")
        }
        Finding::FewerDigits { claimed, hold } => {
            let message = format!("{} digits are claimed, the order conditions hold to {hold}", claimed.value);
            let hint = format!(
                "some digits of the weights may be wrong: write `digits = {hold}`, or look for a better source"
            );
            table.source.fault(&claimed.at, message).hint(hint)
        }
        Finding::Unexplained { claimed, unexplained, .. } => match unexplained {
            Unexplained::OneOf(off) if off.len() == 1 => not_rounding(&off[0]),
            Unexplained::OneOf(off) => not_decided(off),
            Unexplained::Several(off) => several_off(off, *claimed),
        },
    }
}

/// What the order is of.
impl fmt::Display for Family {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Family::Kinetic(kinetic) => write!(f, "for {kinetic}"),
            Family::Power(power) => write!(f, "for the terms of {power}"),
        }
    }
}

impl Of {
    /// What an order of a family is for.
    fn what(self, family: Family) -> String {
        match self {
            Of::NestedStep => "for slow forces, fast forces and T".to_owned(),
            Of::Step | Of::ProcessedStep => family.to_string(),
        }
    }
}

/// What is claimed, and holds.
impl fmt::Display for Of {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Of::Step | Of::NestedStep => "order",
            Of::ProcessedStep => "effective order",
        })
    }
}

fn wrong_sum(table: &Table, kind: MapKind, found: &Rational, needed: &Rational) -> Fault {
    let (what, at) = match (&table.weights, kind) {
        (Some(Weights::Stages { kick, .. }), MapKind::Kick) => ("kicks", &kick.at),
        (Some(Weights::Stages { drift, .. }), MapKind::Drift) => ("drifts", &drift.at),
        (Some(Weights::Composition { gamma, .. }), _) => ("weights gamma", &gamma.at),
        (Some(Weights::Stages { .. }), MapKind::GradientKick) => unreachable!("no sum of gradient kicks is needed"),
        (None, _) => unreachable!("a scheme has weights"),
    };
    let message = format!("the {what} do not sum to 1, so not even order 1 holds");
    let fault = table.source.fault(at, message).values(beside(found, needed), "1");
    with_rounding_hint(fault, table, &(found - needed))
}

fn lower_order(
    table: &Table,
    proof: &Proof,
    (of, family): (Of, Family),
    claimed: &Placed<u32>,
    proved: &Order,
) -> Fault {
    let (failed, found) = proved.failed.as_ref().expect("a higher order would hold");
    let what = of.what(family);
    if let Some(digits) = table.digits.as_ref().filter(|_| proved.undecided) {
        let message =
            format!("{} digits are too few to decide whether {of} {} holds {what}", digits.value, failed.order);
        return table.source.fault(&digits.at, message).hint("take the weights from a source with more digits");
    }
    let fault = failed_condition(table, (of, &what), claimed, proved.order, failed, found);
    let quadratic = match (of, &proof.effective) {
        (Of::ProcessedStep, Some(effective)) => effective.quadratic.order,
        _ => proof.quadratic.order,
    };
    match family {
        Family::Kinetic(Kinetic::Any) if quadratic >= claimed.value && of != Of::NestedStep => {
            fault.hint(format!("{of} {quadratic} holds for quadratic T: write `kinetic = \"quadratic\"`"))
        }
        _ => with_rounding_hint(fault, table, &(found - &failed.needed)),
    }
}

fn failed_condition(
    table: &Table,
    (of, what): (Of, &str),
    claimed: &Placed<u32>,
    holds: u32,
    failed: &Condition,
    found: &Rational,
) -> Fault {
    let message = format!(
        "{of} {} is claimed, {of} {holds} holds {what}: the condition of {} fails",
        claimed.value, failed.functional
    );
    table.source.fault(&claimed.at, message).values(beside(found, &failed.needed), short(&failed.needed))
}

/// Adds a hint at `digits` where the condition is off by little, as it is with rounded weights.
fn with_rounding_hint(fault: Fault, table: &Table, distance: &Rational) -> Fault {
    if digits_of(&distance.abs()).is_none_or(|digits| digits < 6) {
        return fault;
    }
    let off = format!("the condition is off by {}", to_significant(&distance.abs(), 2));
    fault.hint(match &table.digits {
        None => format!("{off}: if the weights are rounded, add `digits = …`"),
        Some(digits) => format!("{off}, more than {} digits of the weights can account for", digits.value),
    })
}

/// One decimal has to move beyond rounding.
fn not_rounding(off: &Off) -> Fault {
    let Off { decimal, units } = off;
    let message = format!(
        "rounding does not explain the digits of `{}`: the order conditions hold if it changes by {} units of its \
            last digit",
        decimal.name,
        in_units(*units)
    );
    let hint = match decimal.transposed(*units) {
        Some(text) => format!("two digits may be transposed: {text}"),
        None => "compare it with its source".to_owned(),
    };
    let fault = decimal.source.fault(&decimal.at, message);
    fault.values(&decimal.text, format!("about {}", decimal.moved(*units))).hint(hint)
}

/// One of several decimals has to move beyond rounding; at the first of them.
fn not_decided(off: &[Off]) -> Fault {
    let first = &off[0].decimal;
    let which = match off.len() {
        count if count > MOST_NAMED => format!("one of {count} decimals changes"),
        _ => {
            let by = |Off { decimal, units }: &Off| format!("`{}` by {}", decimal.name, in_units(*units));
            let others: Vec<_> = off[1..].iter().map(by).collect();
            let by = in_units(off[0].units);
            format!("either `{}` changes by {by} units of its last digit, or {}", first.name, others.join(", or "))
        }
    };
    let message =
        format!("rounding does not explain the digits: the order conditions hold if {which}; they do not decide which");
    let transposed = off.iter().filter_map(|off| Some((&off.decimal.name, off.decimal.transposed(off.units)?)));
    let transposed: Vec<_> = transposed.map(|(name, text)| format!("`{name}` = {text}")).collect();
    first.source.fault(&first.at, message).hint(match transposed.len() {
        1..=MOST_NAMED => format!("two digits may be transposed: {}", transposed.join(", or ")),
        _ => "compare them with their source".to_owned(),
    })
}

/// Several decimals have to move beyond rounding; at the one that is off by most.
fn several_off(off: &Off, claimed: u32) -> Fault {
    let Off { decimal, units } = off;
    let message = format!(
        "rounding does not explain the digits: the nearest weights that meet the order conditions differ by up to {} \
         units of the last digit, most in `{}`",
        in_units(*units),
        decimal.name
    );
    let lost = (units.abs().log10() - (decimal.places - decimal.rounded) as f64).ceil();
    let holding = (f64::from(claimed) - lost).max(1.0);
    let hint = format!("write `digits = {holding}`, or look for a better source");
    decimal.source.fault(&decimal.at, message).hint(hint)
}

/// The size of a change in units, as people read it.
fn in_units(units: f64) -> String {
    match units.abs() {
        size if size < 100.0 => format!("{size:.1}"),
        size if size < 1e6 => format!("{size:.0}"),
        size => format!("{size:.2e}"),
    }
}

fn not_a_palindrome(scheme: &ExactScheme, claim: &Placed<bool>) -> Fault {
    let maps = scheme.maps();
    let message = "a palindrome is claimed, the maps do not read the same backwards";
    let fault = scheme.table.source.fault(&claim.at, message);
    let pair = maps.iter().zip(maps.iter().rev()).enumerate().find(|(_, (a, b))| a != b);
    match pair {
        Some((i, (from_start, from_end))) => fault
            .values(
                format!("{} {} as map {} from the start", from_start.kind, short(&from_start.weight), i + 1),
                format!("{} {}, the map {} from the end", from_end.kind, short(&from_end.weight), i + 1),
            )
            .hint("correct the weights, or leave `symmetric` out"),
        None => fault,
    }
}

/// A value for people; one whose shown digits agree with the value needed is shown as that value and the difference.
fn beside(found: &Rational, needed: &Rational) -> String {
    let off = found - needed;
    if to_text(found).len() <= 20 || to_significant(found, 16) != to_significant(needed, 16) {
        return short(found);
    }
    let sign = if off.is_negative() { '-' } else { '+' };
    format!("{} {sign} {}", short(needed), to_significant(&off.abs(), 2))
}

/// A value for people: exact if short, else rounded.
fn short(value: &Rational) -> String {
    let exact = to_text(value);
    if exact.len() <= 20 { exact } else { format!("{}…", to_significant(value, 16)) }
}
