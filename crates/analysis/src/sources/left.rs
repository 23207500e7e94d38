//! What stands before a `=`: the names that are given a value.

use crate::sources::cursor::Cursor;
use crate::sources::expression::joined_path;
use crate::sources::language::Language;
use crate::sources::token::Kind;

/// The most tokens before a `=` that are looked at.
const MOST: usize = 30;

/// The left side of an assignment.
pub(super) struct Left {
    /// One name, or several of a tuple.
    pub(super) names: Vec<String>,
    /// The bracket of an index.
    pub(super) index: Option<usize>,
}

impl Left {
    /// The left side of the `=` at a place, within brackets or not.
    pub(super) fn of(cursor: Cursor<'_>, equals: usize, is_inside: bool) -> Option<Left> {
        let language = cursor.language;
        let first = begin(cursor, equals, is_inside);
        // behind `real, parameter ::`, `let mut`, `const`; before a type
        let colons = (first..equals).rev().find(|i| cursor.is(*i, "::")).filter(|_| language.is_fortran());
        let first = colons.map_or(first, |colons| colons + 1);
        let is_type = |i: &usize| cursor.is(*i, ":") || (language == Language::Julia && cursor.is(*i, "::"));
        let mut end = (first..equals).find(is_type).unwrap_or(equals);
        let mut index = None;
        while end > first && cursor.is_any(end - 1, &["]", ")"]) {
            let open = (first..end).rev().find(|i| cursor.is_any(*i, &["[", "("]))?;
            (index, end) = (Some(open), open);
        }
        // the sizes of a C array are not an index
        let before = cursor.kind(end.wrapping_sub(2));
        if language == Language::C
            && end > first + 1
            && matches!(before, Some(Kind::Name(_) | Kind::Symbol(">" | "*" | "&")))
        {
            index = None;
        }
        let names = names(cursor, first, end)?;
        Some(Left { names, index })
    }
}

/// Where the statement or the argument begins.
fn begin(cursor: Cursor<'_>, equals: usize, is_inside: bool) -> usize {
    let ends_with_comma = is_inside || cursor.language.is_fortran() || cursor.language == Language::C;
    let (mut first, mut open) = (equals, 0);
    while first > 0 && equals - first <= MOST {
        match cursor.kind(first - 1) {
            Some(Kind::Symbol("]" | ")")) => open += 1,
            Some(Kind::Symbol("[" | "(")) if open > 0 => open -= 1,
            _ if open > 0 => {}
            Some(Kind::LineEnd | Kind::Symbol(";" | "{" | "}" | "=" | ":=" | "[" | "(")) => break,
            Some(Kind::Symbol(",")) if ends_with_comma => break,
            _ => {}
        }
        first -= 1;
    }
    first
}

/// The names before a place, those of a tuple with commas between them.
fn names(cursor: Cursor<'_>, first: usize, end: usize) -> Option<Vec<String>> {
    let mut names = Vec::new();
    let mut place = end;
    while place > first {
        let mut from = place - 1;
        cursor.name(from)?;
        while from > first + 1 && cursor.is_any(from - 1, &[".", "->", "%"]) && cursor.name(from - 2).is_some() {
            from -= 2;
        }
        let path: Vec<_> = (from..place).filter_map(|i| cursor.name(i)).collect();
        names.push(joined_path(&path));
        if from == first || !cursor.is(from - 1, ",") {
            break;
        }
        place = from - 1;
    }
    names.reverse();
    // `let (a, b) = …`
    (!names.is_empty() && !names.iter().any(|name| name == "let")).then_some(names)
}
