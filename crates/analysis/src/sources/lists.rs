//! Tokens → lists of numbers with their names: literal lists, elements that are set one by one, lists that loops append
//! to, and constants with one name and an index.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::sources::cursor::Cursor;
use crate::sources::expression::{Expressions, Names};
use crate::sources::groups::Group;
use crate::sources::language::Language;
use crate::sources::left::Left;
use crate::sources::list::{List, index};
use crate::sources::loops::{Loop, Value};
use crate::sources::numbers::{Id, Numbers};
use crate::sources::token::{Kind, Tokens};

/// Longer lists are data.
const LONGEST: usize = 300;

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
        cursor: Cursor { tokens: &tokens, language },
        names: Names::default(),
        numbers: Numbers::default(),
        lists: Vec::new(),
        orders: Vec::new(),
        targets: Vec::new(),
        depth: 0,
        owner: String::new(),
        built: BTreeMap::new(),
        group: Group::default(),
    };
    let mut next = 0;
    while next < tokens.len() {
        next = reader.statement(next);
    }
    let ended = reader.group.end(&reader.numbers, &reader.owner);
    reader.lists.extend(ended);
    reader.end_built(|_| true);
    let Reader { mut lists, numbers, orders, .. } = reader;
    lists.sort_by_key(|list| (list.is_group, list.at.start));
    index(&mut lists);
    Found { lists, numbers, comments, orders }
}

struct Reader<'a> {
    cursor: Cursor<'a>,
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
    group: Group,
}

impl Reader<'_> {
    /// Takes what begins at a token; the next one.
    fn statement(&mut self, place: usize) -> usize {
        match &self.cursor.tokens[place].kind {
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
                if let Some(name) = self.cursor.name(place + 1) {
                    self.owner = name.to_owned();
                }
            }
            Kind::Name(word) if word == "for" => {
                if let Some(end) = self.appending_loop(place) {
                    return end;
                }
            }
            Kind::Name(_) if self.cursor.is(place + 1, ".") => {
                if let Some(end) = self.append(place) {
                    return end;
                }
            }
            Kind::Name(word)
                if self.cursor.language == Language::C && self.depth <= 1 && self.cursor.is(place + 1, "(") =>
            {
                self.owner = word.clone();
            }
            // double a{0.5}, std::array<double, 3> a{…}
            Kind::Name(_) if self.cursor.language == Language::C && self.cursor.is(place + 1, "{") => {
                let is_declared =
                    matches!(self.cursor.kind(place.wrapping_sub(1)), Some(Kind::Name(_) | Kind::Symbol(">")));
                if is_declared {
                    let name = self.cursor.name(place).unwrap_or_default().to_owned();
                    self.target(name.clone());
                    self.scalar(&name, place + 2);
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
        match self.cursor.kind(colon.checked_sub(1)?)? {
            Kind::Text(key) if key.len() < 100 => Some(key.clone()),
            Kind::Name(key) if self.depth > 0 && matches!(self.cursor.language, Language::Python | Language::Rust) => {
                Some(key.clone())
            }
            Kind::Number(key) if self.depth > 0 && self.cursor.language == Language::Python => Some(key.clone()),
            _ => None,
        }
    }

    fn assignment(&mut self, equals: usize) -> usize {
        let Some(Left { names, index }) = Left::of(self.cursor, equals, self.depth > 0) else { return equals + 1 };
        // a = b = 0.5
        let mut value = equals + 1;
        while self.cursor.name(value).is_some() && self.cursor.is(value + 1, "=") {
            value += 2;
        }
        let place = self.cursor.tokens[equals].at.start;
        if let [name] = &*names {
            self.target(name.clone());
            if let Some(Kind::Number(order)) = self.cursor.kind(value)
                && name.to_ascii_lowercase().ends_with("order")
                && let Ok(order) = order.parse()
            {
                self.orders.push((order, place));
            }
            match index {
                Some(open) => self.set_element(name, open, value),
                None => self.scalar(name, value),
            }
        } else {
            self.several(&names, value);
        }
        equals + 1
    }

    /// The number at a place, and the token after it, if it ends there.
    fn number(&mut self, place: usize) -> Option<(Id, usize)> {
        let mut expression = Expressions::at(place, self.cursor, &self.names);
        let formula = expression.sum()?;
        let next = expression.next;
        let ends = match self.cursor.kind(next) {
            None | Some(Kind::LineEnd | Kind::Symbol("," | ";" | ")" | "]" | "}" | "/)" | "/")) => true,
            Some(Kind::Name(word)) => self.cursor.language == Language::Python && word == "if",
            _ => false,
        };
        let last = self.cursor.tokens.get(next.checked_sub(1)?)?.at.end;
        let id = self
            .numbers
            .add(formula, self.cursor.tokens[place].at.start..last.max(self.cursor.tokens[place].at.end))
            .filter(|_| ends)?;
        Some((id, next))
    }

    /// `name = number`
    fn scalar(&mut self, name: &str, value: usize) {
        self.names.lists.remove(name);
        self.end_built(|built| built == name);
        let Some((id, _)) = self.number(value) else {
            self.names.scalars.remove(name);
            return;
        };
        self.names.scalars.insert(name.to_owned(), id);
        let ended = self.group.add(name, id, &self.numbers, &self.owner);
        self.lists.extend(ended);
    }

    /// `a, b = 0.5, 0.25`
    fn several(&mut self, names: &[String], value: usize) {
        let mut place = value + usize::from(self.cursor.is(value, "(") || self.cursor.is(value, "["));
        for name in names {
            let Some((id, next)) = self.number(place) else { return };
            self.names.scalars.insert(name.clone(), id);
            place = next + 1;
        }
    }

    /// `a[1] = 0.5`
    fn set_element(&mut self, name: &str, open: usize, value: usize) {
        let mut index = Expressions::at(open + 1, self.cursor, &self.names);
        let Some(index) = index.sum().and_then(|index| index.whole) else { return };
        let Some((id, next)) = self.number(value) else { return };
        let at = self.cursor.tokens[open.saturating_sub(1)].at.start..self.cursor.tokens[next.saturating_sub(1)].at.end;
        // the first element again begins another list
        if self.names.lists.get(name).is_some_and(|list| list.keys().next() == Some(&index)) {
            self.names.lists.remove(name);
            self.end_built(|built| built == name);
        }
        self.names.lists.entry(name.to_owned()).or_default().insert(index, id);
        let list = self.grown(name, &at);
        list.at.end = at.end;
        let entries: Vec<_> = self.names.lists[name].values().copied().take(LONGEST).collect();
        self.grown(name, &at).entries = entries;
    }

    fn grown(&mut self, name: &str, at: &Range<usize>) -> &mut List {
        let owner = self.owner.clone();
        let name_or_type = if name == "this" { &self.owner } else { name };
        let new = || List {
            name: name_or_type.to_owned(),
            owner,
            entries: Vec::new(),
            at: at.clone(),
            is_group: false,
            rows: 1,
        };
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
        let close = match self.cursor.kind(open) {
            Some(Kind::Symbol("[")) if !self.is_index(open) => "]",
            Some(Kind::Symbol("{")) if matches!(self.cursor.language, Language::C) => "}",
            Some(Kind::Symbol("(/")) => "/)",
            Some(Kind::Symbol("(")) if self.begins_tuple(open) => ")",
            _ => return None,
        };
        let mut place = open + 1;
        // [real(dp) :: …]
        if self.cursor.language.is_fortran()
            && let Some(colons) = (place..place + 6).find(|i| self.cursor.is(*i, "::"))
        {
            place = colons + 1;
        }
        let mut entries = Vec::new();
        while !self.cursor.is(place, close) {
            let (id, next) = self.number(place)?;
            entries.push(id);
            place = next;
            while self.cursor.is(place, ",")
                || (self.cursor.is(place, ";") && self.cursor.language == Language::Julia)
                || matches!(self.cursor.kind(place), Some(Kind::LineEnd))
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
        let at = self.cursor.tokens[open].at.start..self.cursor.tokens[place].at.end;
        if let Some((target, _)) = self.targets.last() {
            let from = self.cursor.language.first_index();
            self.names.lists.insert(target.clone(), (from..).zip(entries.iter().copied()).collect());
            self.names.scalars.remove(target);
        }
        self.lists.push(List { name, owner: self.owner.clone(), entries, at, is_group: false, rows: 1 });
        Some(place + 1)
    }

    /// Whether brackets are those of an element; in Julia a type may stand before a list.
    fn is_index(&self, open: usize) -> bool {
        match open.checked_sub(1).and_then(|before| self.cursor.kind(before)) {
            Some(Kind::Name(name)) => {
                let is_typed = self.cursor.language == Language::Julia && name.starts_with(char::is_uppercase);
                !is_typed && !["in", "return", "and", "else"].contains(&&**name)
            }
            Some(Kind::Symbol(")" | "]")) => true,
            _ => false,
        }
    }

    /// Whether brackets are a tuple, not those of a call.
    fn begins_tuple(&self, open: usize) -> bool {
        let before = open.checked_sub(1).and_then(|before| self.cursor.kind(before));
        let is_tuple = matches!(before, Some(Kind::Symbol("=" | "(" | ":" | "," | "[")));
        is_tuple && matches!(self.cursor.language, Language::Python | Language::Julia | Language::Rust)
    }

    /// `name.push(number)`: the token after it.
    fn append(&mut self, place: usize) -> Option<usize> {
        let is_append = matches!(self.cursor.name(place + 2), Some("push" | "append" | "push_back"))
            && self.cursor.is(place + 3, "(");
        let name = self.cursor.name(place).filter(|_| is_append)?.to_owned();
        let (id, next) = self.number(place + 4)?;
        if !self.cursor.is(next, ")") {
            return None;
        }
        let at = self.cursor.tokens[place].at.start..self.cursor.tokens[next].at.end;
        let list = self.grown(&name, &at);
        if list.entries.len() < LONGEST {
            list.entries.push(id);
        }
        list.at.end = list.at.end.max(at.end);
        Some(next + 1)
    }

    /// A loop that appends an expression for each value of its variable: the token after it.
    fn appending_loop(&mut self, place: usize) -> Option<usize> {
        let Loop { variable, values, body } = Loop::of(self.cursor, &self.names, place)?;
        let (scalar, whole) = (self.names.scalars.get(&variable).copied(), self.names.wholes.get(&variable).copied());
        let mut end = None;
        for value in values {
            match value {
                Value::Whole(whole) => drop(self.names.wholes.insert(variable.clone(), whole)),
                Value::Element(id) => drop(self.names.scalars.insert(variable.clone(), id)),
            }
            end = self.append(body);
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
}
