//! Loops that append to a list: what their variable goes through.

use std::ops::Range;

use crate::sources::cursor::Cursor;
use crate::sources::expression::{Expressions, Names};
use crate::sources::numbers::Id;
use crate::sources::token::Kind;

/// Longer loops do not make weights.
const LONGEST: usize = 300;

/// What the variable of a loop is.
#[derive(Clone, Copy)]
pub(super) enum Value {
    Whole(i64),
    Element(Id),
}

/// A loop over whole numbers or the elements of a list.
pub(super) struct Loop {
    pub(super) variable: String,
    pub(super) values: Vec<Value>,
    /// Where its body begins.
    pub(super) body: usize,
}

impl Loop {
    /// The loop whose `for` is at a place.
    pub(super) fn of(cursor: Cursor<'_>, names: &Names, place: usize) -> Option<Loop> {
        let name_at = place + 1 + usize::from(cursor.is(place + 1, "&"));
        let variable = cursor.name(name_at)?.to_owned();
        if cursor.name(name_at + 1) != Some("in") {
            return None;
        }
        let begins = |i: &usize| {
            let is_block = cursor.is(*i, ":") && matches!(cursor.kind(i + 1), Some(Kind::LineEnd | Kind::Name(_)));
            cursor.is(*i, "{") || is_block
        };
        let head = (name_at..name_at + 30).find(begins)?;
        let body = (head + 1..).find(|i| !matches!(cursor.kind(*i), Some(Kind::LineEnd)))?;
        let iterated = name_at + 2..head;
        let mut values = range(cursor, names, &iterated).or_else(|| elements(cursor, names, &iterated))?;
        if iterated.into_iter().any(|i| matches!(cursor.name(i), Some("rev" | "reversed"))) {
            values.reverse();
        }
        Some(Loop { variable, values, body })
    }
}

/// `0..7`, `range(7)`, with its step.
fn range(cursor: Cursor<'_>, names: &Names, tokens: &Range<usize>) -> Option<Vec<Value>> {
    let whole = |place: usize| {
        let mut expression = Expressions::at(place, cursor, names);
        let value = expression.sum()?.whole?;
        Some((value, expression.next))
    };
    let wholes: Vec<i64> = if let Some(dots) = tokens.clone().find(|i| cursor.is_any(*i, &["..", "..="])) {
        let first = whole((tokens.start..dots).find(|i| !cursor.is(*i, "("))?)?.0;
        let last = whole(dots + 1)?.0.checked_add(i64::from(cursor.is(dots, "..=")))?;
        (first..last).take(LONGEST).collect()
    } else {
        let range = tokens.clone().find(|i| cursor.name(*i) == Some("range") && cursor.is(i + 1, "("))?;
        let (mut numbers, mut place) = (Vec::new(), range + 2);
        while numbers.len() < 3 && !cursor.is(place, ")") {
            let (value, next) = whole(place)?;
            numbers.push(value);
            place = next + usize::from(cursor.is(next, ","));
        }
        let (first, last, step) = match *numbers {
            [last] => (0, last, 1),
            [first, last] => (first, last, 1),
            [first, last, step] if step != 0 => (first, last, step),
            _ => return None,
        };
        let values = std::iter::successors(Some(first), |value: &i64| value.checked_add(step));
        values.take_while(|value| if step > 0 { *value < last } else { *value > last }).take(LONGEST).collect()
    };
    Some(wholes.into_iter().map(Value::Whole).collect())
}

/// The elements of a list.
fn elements(cursor: Cursor<'_>, names: &Names, tokens: &Range<usize>) -> Option<Vec<Value>> {
    let is_other =
        |i: usize| matches!(cursor.name(i), Some("enumerate" | "zip" | "skip" | "take")) || cursor.is(i, "[");
    if tokens.clone().any(is_other) {
        return None;
    }
    let list = tokens.clone().find_map(|i| names.lists.get(cursor.name(i)?))?;
    Some(list.values().copied().map(Value::Element).collect())
}
