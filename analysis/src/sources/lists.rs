//! Tokens → lists of numbers with their names: literal lists, elements that are set one by one, lists that loops append to, and constants with one
//! name and an index.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use crate::sources::expression::{Expressions, Names, joined_path};
use crate::sources::language::Language;
use crate::sources::numbers::{Id, Numbers};
use crate::sources::token::{Kind, Token, Tokens};

/// Longer lists are data.
const LONGEST: usize = 300;

/// A list of numbers.
#[derive(Clone, Debug)]
pub(super) struct List {
    /// Its name in the source, such as `scheme.gamma`; empty where it has none.
    pub(super) name: String,
    /// The function or type in which it stands.
    pub(super) owner: String,
    pub(super) entries: Vec<Id>,
    pub(super) at: Range<usize>,
    /// The constants of a group, each of which is a name of its own.
    pub(super) is_group: bool,
}

/// What a source has.
pub(super) struct Found {
    pub(super) lists: Vec<List>,
    pub(super) numbers: Numbers,
    pub(super) comments: Vec<Range<usize>>,
    /// Numbers that are called `order`, and where.
    pub(super) orders: Vec<(i64, usize)>,
}

/// Words before the name of a function or a type.
const DEFINITIONS: [&str; 12] =
    ["fn", "def", "function", "subroutine", "class", "struct", "module", "impl", "enum", "namespace", "case", "elif"];

/// Reads a source.
pub(super) fn lists(text: &str, language: Language) -> Found {
    let Tokens { tokens, comments } = Tokens::of(text, language);
    let mut reader = Reader {
        tokens: &tokens,
        language,
        names: Names::default(),
        numbers: Numbers::default(),
        lists: Vec::new(),
        orders: Vec::new(),
        targets: Vec::new(),
        depth: 0,
        owner: String::new(),
        built: BTreeMap::new(),
        group: Vec::new(),
    };
    let mut next = 0;
    while next < tokens.len() {
        next = reader.statement(next);
    }
    reader.end_group();
    reader.end_built(|_| true);
    let Reader { mut lists, numbers, orders, .. } = reader;
    lists.sort_by_key(|list| (list.is_group, list.at.start));
    index(&mut lists);
    Found { lists, numbers, comments, orders }
}

/// Lists of one name, as the rows of a table are, are named by their index.
fn index(lists: &mut [List]) {
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for list in lists.iter().filter(|list| !list.is_group) {
        *counts.entry(list.name.clone()).or_default() += 1;
    }
    let mut seen: BTreeMap<String, usize> = BTreeMap::new();
    for list in lists.iter_mut().filter(|list| !list.is_group && !list.name.is_empty()) {
        if counts[&list.name] > 1 {
            let seen = seen.entry(list.name.clone()).or_default();
            list.name += &format!("[{seen}]");
            *seen += 1;
        }
    }
}

struct Reader<'a> {
    tokens: &'a [Token],
    language: Language,
    names: Names,
    numbers: Numbers,
    lists: Vec<List>,
    orders: Vec<(i64, usize)>,
    /// What is being given a value, with the brackets open then.
    targets: Vec<(String, usize)>,
    depth: usize,
    owner: String,
    /// Lists that grow.
    built: BTreeMap<String, List>,
    /// Constants that were set one after the other.
    group: Vec<(String, Id)>,
}

impl Reader<'_> {
    fn kind(&self, place: usize) -> Option<&Kind> {
        self.tokens.get(place).map(|token| &token.kind)
    }

    fn is(&self, place: usize, symbol: &str) -> bool {
        matches!(self.kind(place), Some(Kind::Symbol(found)) if *found == symbol)
    }

    fn name(&self, place: usize) -> Option<&str> {
        match self.kind(place) {
            Some(Kind::Name(name)) => Some(name),
            _ => None,
        }
    }

    /// Takes what begins at a token; the next one.
    fn statement(&mut self, place: usize) -> usize {
        match &self.tokens[place].kind {
            Kind::LineEnd | Kind::Symbol(";") => self.targets.retain(|(_, depth)| *depth < self.depth),
            Kind::Symbol("=" | ":=") => return self.assignment(place),
            Kind::Symbol(":") => {
                if let Some(key) = self.key(place) {
                    self.target(key);
                }
            }
            Kind::Symbol("(" | "[" | "{" | "(/") => {
                if let Some(end) = self.literal(place) {
                    return end;
                }
                self.depth += 1;
            }
            Kind::Symbol(")" | "]" | "}" | "/)") => {
                self.depth = self.depth.saturating_sub(1);
                self.targets.retain(|(_, depth)| *depth <= self.depth);
            }
            Kind::Name(word) if DEFINITIONS.contains(&word.as_str()) => {
                if let Some(name) = self.name(place + 1) {
                    self.owner = name.to_owned();
                }
            }
            Kind::Name(word) if word == "for" => {
                if let Some(end) = self.appending_loop(place) {
                    return end;
                }
            }
            Kind::Name(_) if self.is(place + 1, ".") => {
                if let Some(end) = self.append(place) {
                    return end;
                }
            }
            Kind::Name(word) if self.language == Language::C && self.depth <= 1 && self.is(place + 1, "(") => {
                self.owner = word.clone();
            }
            // double a{0.5}, std::array<double, 3> a{…}
            Kind::Name(_) if self.language == Language::C && self.is(place + 1, "{") => {
                let is_declared = matches!(self.kind(place.wrapping_sub(1)), Some(Kind::Name(_) | Kind::Symbol(">")));
                if is_declared {
                    let name = self.name(place).unwrap_or_default().to_owned();
                    self.target(name.clone());
                    self.scalar(name, place + 2, place);
                }
            }
            _ => {}
        }
        place + 1
    }

    fn target(&mut self, name: String) {
        self.targets.retain(|(_, depth)| *depth < self.depth);
        self.targets.push((name, self.depth));
    }

    /// The key before a colon: of a dictionary, an object of JSON or a structure.
    fn key(&self, colon: usize) -> Option<String> {
        match self.kind(colon.checked_sub(1)?)? {
            Kind::Text(key) if key.len() < 100 => Some(key.clone()),
            Kind::Name(key) if self.depth > 0 && matches!(self.language, Language::Python | Language::Rust) => {
                Some(key.clone())
            }
            Kind::Number(key) if self.depth > 0 && self.language == Language::Python => Some(key.clone()),
            _ => None,
        }
    }

    /// What stands before a `=`: the names with their places, one or several; and an index.
    fn left(&self, equals: usize) -> Option<(Vec<String>, Option<usize>)> {
        let (mut first, mut inside) = (equals, 0);
        while first > 0 {
            let ends = match self.kind(first - 1) {
                Some(Kind::Symbol("]" | ")")) => {
                    inside += 1;
                    false
                }
                Some(Kind::Symbol("[" | "(")) if inside > 0 => {
                    inside -= 1;
                    false
                }
                _ if equals - first > 30 => true,
                Some(Kind::LineEnd | Kind::Symbol(";" | "{" | "}" | "=" | ":=" | "[" | "(")) => inside == 0,
                Some(Kind::Symbol(",")) => {
                    inside == 0 && (self.depth > 0 || self.language.is_fortran() || self.language == Language::C)
                }
                _ => false,
            };
            if ends {
                break;
            }
            first -= 1;
        }
        // behind `real, parameter ::`, `let mut`, `const`; before a type
        let mut end = equals;
        let colons = (first..equals).rev().find(|i| self.is(*i, "::")).filter(|_| self.language.is_fortran());
        let first = colons.map_or(first, |colons| colons + 1);
        if let Some(colon) =
            (first..equals).find(|i| self.is(*i, ":") || (self.language == Language::Julia && self.is(*i, "::")))
        {
            end = colon;
        }
        let mut index = None;
        while end > first && (self.is(end - 1, "]") || self.is(end - 1, ")")) {
            let open = (first..end).rev().find(|i| self.is(*i, "[") || self.is(*i, "("))?;
            (index, end) = (Some(open), open);
        }
        // the sizes of a C array are not an index
        let is_declared = matches!(self.kind(end.wrapping_sub(2)), Some(Kind::Name(_) | Kind::Symbol(">" | "*" | "&")));
        if self.language == Language::C && end > first + 1 && is_declared {
            index = None;
        }
        let mut names = Vec::new();
        let mut place = end;
        while place > first {
            let mut from = place - 1;
            self.name(from)?;
            while from > first + 1
                && (self.is(from - 1, ".") || self.is(from - 1, "->") || self.is(from - 1, "%"))
                && self.name(from - 2).is_some()
            {
                from -= 2;
            }
            let path: Vec<_> = (from..place).filter_map(|i| self.name(i)).collect();
            names.push(joined_path(&path));
            if from > first && self.is(from - 1, ",") {
                place = from - 1;
            } else {
                break;
            }
        }
        names.reverse();
        (!names.is_empty()).then_some((names, index))
    }

    fn assignment(&mut self, equals: usize) -> usize {
        let Some((names, index)) = self.left(equals) else { return equals + 1 };
        // a = b = 0.5
        let mut value = equals + 1;
        while self.name(value).is_some() && self.is(value + 1, "=") {
            value += 2;
        }
        let place = self.tokens[equals].at.start;
        if let [name] = &*names {
            self.target(name.clone());
            if let Some(Kind::Number(order)) = self.kind(value)
                && name.to_ascii_lowercase().ends_with("order")
                && let Ok(order) = order.parse()
            {
                self.orders.push((order, place));
            }
            match index {
                Some(open) => self.set_element(name.clone(), open, value),
                None => self.scalar(name.clone(), value, equals),
            }
        } else {
            self.several(&names, value);
        }
        equals + 1
    }

    /// The number at a place, and the token after it, if it ends there.
    fn number(&mut self, place: usize) -> Option<(Id, usize)> {
        let mut expression = Expressions::at(place, self.tokens, self.language, &self.names);
        let formula = expression.sum()?;
        let next = expression.next;
        let ends = match self.kind(next) {
            None | Some(Kind::LineEnd | Kind::Symbol("," | ";" | ")" | "]" | "}" | "/)" | "/")) => true,
            Some(Kind::Name(word)) => self.language == Language::Python && word == "if",
            _ => false,
        };
        let last = self.tokens.get(next.checked_sub(1)?)?.at.end;
        let id = self
            .numbers
            .add(formula, self.tokens[place].at.start..last.max(self.tokens[place].at.end))
            .filter(|_| ends)?;
        Some((id, next))
    }

    /// `name = number`
    fn scalar(&mut self, name: String, value: usize, place: usize) {
        self.names.lists.remove(&name);
        self.end_built(|built| built == name);
        let Some((id, _)) = self.number(value) else {
            self.names.scalars.remove(&name);
            return;
        };
        self.names.scalars.insert(name.clone(), id);
        let (stem, index) = stem(&name);
        let follows = self.group.last().is_some_and(|(last, id)| {
            let (before, last) = self::stem(last);
            let near = self.tokens[place].at.start < self.numbers.get(*id).at.end + 600;
            stem == before
                && near
                && index.zip(last).is_some_and(|(index, last)| index == last + 1 || index + 1 == last)
        });
        if !follows {
            self.interleaved(&name, stem, index);
        }
        self.group.push((name, id));
    }

    /// A constant that does not go on with the last one may go on with one before: a1, b1, a2, b2.
    fn interleaved(&mut self, name: &str, stem: &str, index: Option<u64>) {
        let stems: BTreeSet<_> = self.group.iter().map(|(name, _)| self::stem(name).0).collect();
        let goes_on =
            index.is_some() && self.group.len() < LONGEST && !self.group.iter().any(|(known, _)| known == name);
        let is_near = self.group.last().is_some_and(|(_, id)| {
            self.numbers.get(*id).at.end + 600 > self.numbers.get(self.names.scalars[name]).at.start
        });
        if !(goes_on && is_near && (stems.contains(stem) || stems.len() < 2)) {
            self.end_group();
        }
    }

    /// Makes lists of the constants of one stem that were set one after the other.
    fn end_group(&mut self) {
        let mut stems: Vec<(&str, Vec<(u64, Id)>)> = Vec::new();
        for (name, id) in &self.group {
            let (stem, index) = stem(name);
            let index = index.unwrap_or(0);
            match stems.iter_mut().find(|(known, _)| *known == stem) {
                Some((_, members)) => members.push((index, *id)),
                None => stems.push((stem, vec![(index, *id)])),
            }
        }
        for (stem, members) in stems {
            let entries: Vec<_> = members.iter().map(|(_, id)| *id).collect();
            if !self.numbers.are_telling(&entries.iter().copied().collect()) {
                continue;
            }
            let ranges = entries.iter().map(|id| &self.numbers.get(*id).at);
            let at = ranges.clone().map(|at| at.start).min().unwrap_or(0)..ranges.map(|at| at.end).max().unwrap_or(0);
            let name = match &*members {
                [_] => self
                    .group
                    .iter()
                    .find(|(_, id)| *id == entries[0])
                    .map_or(stem.to_owned(), |(name, _)| name.clone()),
                [first, .., last] => format!("{stem}{} … {stem}{}", first.0, last.0),
                [] => continue,
            };
            self.lists.push(List { name, owner: self.owner.clone(), entries, at, is_group: true });
        }
        self.group.clear();
    }

    /// `a, b = 0.5, 0.25`
    fn several(&mut self, names: &[String], value: usize) {
        let mut place = value + usize::from(self.is(value, "(") || self.is(value, "["));
        for name in names {
            let Some((id, next)) = self.number(place) else { return };
            self.names.scalars.insert(name.clone(), id);
            place = next + 1;
        }
    }

    /// `a[1] = 0.5`
    fn set_element(&mut self, name: String, open: usize, value: usize) {
        let mut index = Expressions::at(open + 1, self.tokens, self.language, &self.names);
        let Some(index) = index.sum().and_then(|index| index.whole) else { return };
        let Some((id, next)) = self.number(value) else { return };
        let at = self.tokens[open.saturating_sub(1)].at.start..self.tokens[next.saturating_sub(1)].at.end;
        // the first element again begins another list
        if self.names.lists.get(&name).is_some_and(|list| list.keys().next() == Some(&index)) {
            self.names.lists.remove(&name);
            self.end_built(|built| built == name);
        }
        self.names.lists.entry(name.clone()).or_default().insert(index, id);
        let list = self.grown(&name, &at);
        list.at.end = at.end;
        let entries: Vec<_> = self.names.lists[&name].values().copied().take(LONGEST).collect();
        self.grown(&name, &at).entries = entries;
    }

    fn grown(&mut self, name: &str, at: &Range<usize>) -> &mut List {
        let owner = self.owner.clone();
        let name_or_type = if name == "this" { &self.owner } else { name };
        let new =
            || List { name: name_or_type.to_owned(), owner, entries: Vec::new(), at: at.clone(), is_group: false };
        self.built.entry(name.to_owned()).or_insert_with(new)
    }

    /// Takes the lists that have grown under these names.
    fn end_built(&mut self, ends: impl Fn(&str) -> bool) {
        let built = std::mem::take(&mut self.built);
        let (ended, rest) = built.into_iter().partition(|(name, _)| ends(name));
        self.built = rest;
        self.lists.extend(ended.into_values().filter(|list| list.entries.len() > 1 && list.entries.len() < LONGEST));
    }

    /// A list in brackets that begins here: the token after it.
    fn literal(&mut self, open: usize) -> Option<usize> {
        let close = match self.kind(open) {
            Some(Kind::Symbol("[")) if !self.is_index(open) => "]",
            Some(Kind::Symbol("{")) if matches!(self.language, Language::C) => "}",
            Some(Kind::Symbol("(/")) => "/)",
            Some(Kind::Symbol("(")) if self.begins_tuple(open) => ")",
            _ => return None,
        };
        let mut place = open + 1;
        // [real(dp) :: …]
        if self.language.is_fortran()
            && let Some(colons) = (place..place + 6).find(|i| self.is(*i, "::"))
        {
            place = colons + 1;
        }
        let mut entries = Vec::new();
        while !self.is(place, close) {
            let (id, next) = self.number(place)?;
            entries.push(id);
            place = next;
            while self.is(place, ",")
                || (self.is(place, ";") && self.language == Language::Julia)
                || matches!(self.kind(place), Some(Kind::LineEnd))
            {
                place += 1;
            }
            if entries.len() > LONGEST {
                return None;
            }
        }
        if entries.is_empty() || (entries.len() < 2 && self.targets.is_empty()) {
            return None;
        }
        let name = self.targets.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(".");
        let at = self.tokens[open].at.start..self.tokens[place].at.end;
        if let Some((target, _)) = self.targets.last() {
            let from = self.language.first_index();
            self.names.lists.insert(target.clone(), (from..).zip(entries.iter().copied()).collect());
            self.names.scalars.remove(target);
        }
        self.lists.push(List { name, owner: self.owner.clone(), entries, at, is_group: false });
        Some(place + 1)
    }

    /// Whether brackets are those of an element; in Julia a type may stand before a list.
    fn is_index(&self, open: usize) -> bool {
        match open.checked_sub(1).and_then(|before| self.kind(before)) {
            Some(Kind::Name(name)) => {
                !(self.language == Language::Julia && name.starts_with(char::is_uppercase))
                    && !["in", "return", "and", "else"].contains(&&**name)
            }
            Some(Kind::Symbol(")" | "]")) => true,
            _ => false,
        }
    }

    /// Whether brackets are a tuple, not those of a call.
    fn begins_tuple(&self, open: usize) -> bool {
        let before = open.checked_sub(1).and_then(|before| self.kind(before));
        let is_tuple = matches!(before, Some(Kind::Symbol("=" | "(" | ":" | "," | "[")));
        is_tuple && matches!(self.language, Language::Python | Language::Julia | Language::Rust)
    }

    /// `name.push(number)`: the token after it.
    fn append(&mut self, place: usize) -> Option<usize> {
        let is_append =
            matches!(self.name(place + 2), Some("push" | "append" | "push_back")) && self.is(place + 3, "(");
        let name = self.name(place).filter(|_| is_append)?.to_owned();
        let (id, next) = self.number(place + 4)?;
        if !self.is(next, ")") {
            return None;
        }
        let at = self.tokens[place].at.start..self.tokens[next].at.end;
        let list = self.grown(&name, &at);
        if list.entries.len() < LONGEST {
            list.entries.push(id);
        }
        list.at.end = list.at.end.max(at.end);
        Some(next + 1)
    }

    /// A loop that appends an expression for each element of a list or each whole number of a range: the token after it.
    fn appending_loop(&mut self, place: usize) -> Option<usize> {
        let name_at = place + 1 + usize::from(self.is(place + 1, "&"));
        let variable = self.name(name_at)?.to_owned();
        let body = (name_at..name_at + 30).find(|i| {
            self.is(*i, "{") || (self.is(*i, ":") && matches!(self.kind(i + 1), Some(Kind::LineEnd | Kind::Name(_))))
        })?;
        if self.name(name_at + 1) != Some("in") {
            return None;
        }
        let iterated = name_at + 2..body;
        let begin = (body + 1..).find(|i| !matches!(self.kind(*i), Some(Kind::LineEnd)))?;
        let values = self.range(iterated.clone()).map(|wholes| wholes.into_iter().map(Value::Whole).collect());
        let values = values.or_else(|| self.elements(iterated))?;
        let (scalar, whole) = (self.names.scalars.get(&variable).copied(), self.names.wholes.get(&variable).copied());
        let mut end = None;
        for value in values {
            match value {
                Value::Whole(whole) => drop(self.names.wholes.insert(variable.clone(), whole)),
                Value::Element(id) => drop(self.names.scalars.insert(variable.clone(), id)),
            }
            end = self.append(begin);
            if end.is_none() {
                break;
            }
        }
        self.names.wholes.remove(&variable);
        self.names.scalars.remove(&variable);
        self.names.wholes.extend(whole.map(|whole| (variable.clone(), whole)));
        self.names.scalars.extend(scalar.map(|scalar| (variable, scalar)));
        end
    }

    /// `0..7`, `range(7)`, with its step and reversed or not.
    fn range(&self, tokens: Range<usize>) -> Option<Vec<i64>> {
        let whole = |place: usize| {
            let mut expression = Expressions::at(place, self.tokens, self.language, &self.names);
            let value = expression.sum()?.whole?;
            Some((value, expression.next))
        };
        let is_reversed = tokens.clone().any(|i| matches!(self.name(i), Some("rev" | "reversed")));
        let mut values: Vec<i64> = if let Some(dots) = tokens.clone().find(|i| self.is(*i, "..") || self.is(*i, "..="))
        {
            let first = whole((tokens.start..dots).find(|i| !self.is(*i, "("))?)?.0;
            let last = whole(dots + 1)?.0.checked_add(i64::from(self.is(dots, "..=")))?;
            (first..last).take(LONGEST).collect()
        } else {
            let range = tokens.clone().find(|i| self.name(*i) == Some("range") && self.is(i + 1, "("))?;
            let (mut numbers, mut place) = (Vec::new(), range + 2);
            while numbers.len() < 3 && !self.is(place, ")") {
                let (value, next) = whole(place)?;
                numbers.push(value);
                place = next + usize::from(self.is(next, ","));
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
        if is_reversed {
            values.reverse();
        }
        Some(values)
    }

    /// The elements of the list that a loop goes through.
    fn elements(&self, mut tokens: Range<usize>) -> Option<Vec<Value>> {
        let is_reversed = tokens.clone().any(|i| matches!(self.name(i), Some("rev" | "reversed")));
        let has_range = tokens
            .clone()
            .any(|i| matches!(self.name(i), Some("enumerate" | "zip" | "skip" | "take")) || self.is(i, "["));
        let list = tokens.find_map(|i| self.names.lists.get(self.name(i)?)).filter(|_| !has_range)?;
        let mut values: Vec<_> = list.values().copied().map(Value::Element).collect();
        if is_reversed {
            values.reverse();
        }
        Some(values)
    }
}

/// What the variable of a loop is.
#[derive(Clone, Copy)]
enum Value {
    Whole(i64),
    Element(Id),
}

/// The letters of a name and the number at its end: `w_12` is `w_` and 12.
fn stem(name: &str) -> (&str, Option<u64>) {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    (stem, name[stem.len()..].parse().ok())
}
