//! The table's text with polished decimals: everything else stays as its author wrote it.

use std::collections::BTreeSet;
use std::ops::Range;

use num_traits::{One, Signed, Zero};
use shadowstep_schemes::symbolic::Rational;
use shadowstep_schemes::symbolic::decimal::to_text;

use crate::polish::unknowns::{Mirrored, Model};
use shadowstep_schemes::document::Faults;
use shadowstep_schemes::table::{Table, Weights};

/// How an unknown is written in the new table.
#[derive(Clone, Debug)]
pub(super) enum Written {
    /// The decimal as printed.
    AsPrinted,
    /// A decimal.
    Decimal(String),
    /// A formula that makes a sum exactly 1.
    Formula(String),
}

/// The name of each unknown in the new table: decimals in lists become constants.
pub(super) fn names(table: &Table, model: &Model) -> Vec<String> {
    let mut names: Vec<String> = table.constants.iter().map(|(name, _)| name.value.clone()).collect();
    let name = |unknown: &crate::polish::unknowns::Unknown| {
        if unknown.is_constant {
            return unknown.name.clone();
        }
        let letter = match unknown.name.split('[').next().unwrap_or_default() {
            "kick" => 'a',
            "drift" => 'b',
            "gradient_kick" => 'c',
            "processor.kick" => 'y',
            "processor.drift" => 'z',
            "processor.gamma" => 'p',
            _ => 'g',
        };
        let index = unknown.name.trim_matches(|c: char| !c.is_ascii_digit());
        let mut name = format!("{letter}{index}");
        while names.contains(&name) {
            name.push('_');
        }
        names.push(name.clone());
        name
    };
    model.unknowns.iter().map(name).collect()
}

/// (1 − rest − Σ c·x) / c_d as a formula.
pub(super) fn remainder(divisor: &Rational, rest: &Rational, terms: &[(Rational, &str)]) -> String {
    let head = to_text(&((Rational::one() - rest) / divisor));
    let terms: Vec<_> = terms.iter().map(|(c, name)| (c / divisor, *name)).collect();
    let Some((first, _)) = terms.first() else { return head };
    if terms.iter().all(|(c, _)| c == first) && first.is_positive() {
        let names: Vec<_> = terms.iter().map(|(_, name)| *name).collect();
        let sum = if names.len() == 1 { names[0].to_owned() } else { format!("({})", names.join(" + ")) };
        return if first.is_one() { format!("{head} - {sum}") } else { format!("{head} - {}*{sum}", to_text(first)) };
    }
    let term = |(c, name): &(Rational, &str)| {
        let sign = if c.is_positive() { '-' } else { '+' };
        if c.abs().is_one() { format!(" {sign} {name}") } else { format!(" {sign} {}*{name}", to_text(&c.abs())) }
    };
    head + &terms.iter().filter(|(c, _)| !c.is_zero()).map(term).collect::<String>()
}

/// The new text.
pub(super) fn text(
    table: &Table,
    model: &Model,
    names: &[String],
    written: &[Written],
    digits: u32,
) -> Result<String, Faults> {
    let source = &table.source.text;
    let end = line_end(source);
    let mut edits: Vec<(Range<usize>, String)> = Vec::new();
    let (mut decimals, mut formulas) = (String::new(), String::new());
    for ((unknown, name), written) in model.unknowns.iter().zip(names).zip(written) {
        let value = match written {
            Written::AsPrinted => source[unknown.at.clone()].trim().to_owned(),
            Written::Decimal(text) | Written::Formula(text) => text.clone(),
        };
        if unknown.is_constant {
            edits.push(quoted(source, &unknown.at, &value));
        } else {
            edits.push(quoted(source, &unknown.at, name));
            let block = if matches!(written, Written::Formula(_)) { &mut formulas } else { &mut decimals };
            *block += &format!("{name} = \"{value}\"{end}");
        }
    }
    for (at, mirrored) in &model.mirrored {
        edits.push(match mirrored {
            Mirrored::Unknown(unknown) => quoted(source, at, &names[*unknown]),
            Mirrored::Formula(text) => quoted(source, at, text),
        });
    }
    if !decimals.is_empty() || !formulas.is_empty() {
        edits.push(constants(table, &(decimals + &formulas))?);
    }
    let new_key = |line: String| below(source, table.order.at.end, &line);
    edits.push(match &table.digits {
        Some(old) => (old.at.clone(), digits.to_string()),
        None => new_key(format!("digits = {digits}{end}")),
    });
    let as_printed = names.iter().zip(written).filter(|(_, written)| matches!(written, Written::AsPrinted));
    edits.extend(free(table, as_printed.map(|(name, _)| name)).map(|(at, list)| match at {
        Some(at) => (at, list),
        None => new_key(format!("free = [{list}]{end}")),
    }));
    edits.sort_by_key(|(at, _)| at.start);
    let mut text = source.clone();
    edits.iter().rev().for_each(|(at, new)| text.replace_range(at.clone(), new));
    Ok(text)
}

/// The list of the free parameters and its place: the free parameters of the table, and the decimals that stay as
/// printed.
fn free<'a>(table: &'a Table, as_printed: impl Iterator<Item = &'a String>) -> Option<(Option<Range<usize>>, String)> {
    let mut names: Vec<_> = table.free.iter().map(|name| &name.value).collect();
    let known = names.len();
    names.extend(as_printed);
    let mut seen = BTreeSet::new();
    names.retain(|name| seen.insert(*name));
    if names.len() == known {
        return None;
    }
    let at = table.free.first().zip(table.free.last()).map(|(first, last)| first.at.start..last.at.end);
    Some((at, names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ")))
}

/// The cell's new text, in quotes if it has none.
fn quoted(source: &str, at: &Range<usize>, text: &str) -> (Range<usize>, String) {
    let has_quotes = source[..at.start].ends_with(['"', '\'']);
    (at.clone(), if has_quotes { text.to_owned() } else { format!("\"{text}\"") })
}

/// Where new constants go: after the last one, or in a new section before the weights.
fn constants(table: &Table, lines: &str) -> Result<(Range<usize>, String), Faults> {
    let source = &table.source.text;
    let header = |name: &str| {
        let mut start = 0;
        source.split_inclusive('\n').find_map(|line| {
            let here = start;
            start += line.len();
            line.trim_start().starts_with(name).then_some(here)
        })
    };
    let section = if matches!(table.weights, Some(Weights::Stages { .. })) { "[stages]" } else { "[composition]" };
    match (header("[constants]"), table.constants.last(), header(section)) {
        (Some(_), Some((_, last)), _) => Ok(below(source, last.at.end, lines)),
        (Some(start), None, _) => Ok(below(source, start, lines)),
        (None, None, Some(start)) => {
            let end = line_end(source);
            Ok((start..start, format!("[constants]{end}{lines}{end}")))
        }
        _ => {
            let at = match table.weights.as_ref().expect("what is polished has weights") {
                Weights::Stages { kick, .. } => &kick.at,
                Weights::Composition { gamma, .. } => &gamma.at,
            };
            let hint = format!("write [constants] and {section} on separate lines, the keys below them");
            let fault = table.source.fault(at, "there is no place for the polished constants");
            Err(Faults(vec![fault.hint(hint)]))
        }
    }
}

/// New lines below the line of a place.
fn below(source: &str, place: usize, lines: &str) -> (Range<usize>, String) {
    match source[place..].find('\n') {
        Some(i) => (place + i + 1..place + i + 1, lines.to_owned()),
        None => (source.len()..source.len(), format!("{}{lines}", line_end(source))),
    }
}

/// How the text ends its lines.
fn line_end(source: &str) -> &'static str {
    let first = source.split_inclusive('\n').next().unwrap_or("");
    if first.ends_with("\r\n") { "\r\n" } else { "\n" }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn remainders_read_as_people_write_them() {
        let n = |n: i64, d: i64| Rational::new(n.into(), d.into());
        let two = [(n(2, 1), "a1"), (n(2, 1), "a2")];
        assert_eq!(remainder(&n(1, 1), &n(0, 1), &two), "1 - 2*(a1 + a2)");
        assert_eq!(remainder(&n(2, 1), &n(0, 1), &two), "1/2 - (a1 + a2)");
        assert_eq!(remainder(&n(2, 1), &n(0, 1), &two[..1]), "1/2 - a1");
        assert_eq!(remainder(&n(1, 1), &n(1, 3), &[(n(2, 1), "a1"), (n(-1, 1), "a2")]), "2/3 - 2*a1 + a2");
        assert_eq!(remainder(&n(1, 1), &n(1, 2), &[]), "1/2");
    }
}
