//! Tokens → formulas of numbers: the expressions of all languages that are read, as far as weights are written in them.

use std::collections::BTreeMap;

use crate::sources::cursor::Cursor;
use crate::sources::language::Language;
use crate::sources::numbers::{Formula, Id, name};
use crate::sources::token::{Kind, Token};

/// Deeper expressions are not weights.
const DEEPEST: usize = 50;

/// Functions of one number that give this number in another type.
const CONVERSIONS: [&str; 31] = [
    "array",
    "asarray",
    "big",
    "bigfloat",
    "convert",
    "dble",
    "decimal",
    "double",
    "f32",
    "f64",
    "float",
    "float32",
    "float64",
    "float128",
    "fraction",
    "from",
    "from_f64",
    "from_str",
    "longdouble",
    "mp_real",
    "mpf",
    "mpfr",
    "mpreal",
    "new",
    "parse",
    "qreal",
    "rational",
    "real",
    "scalar",
    "sympify",
    "t",
];

/// Methods after which a number is the same.
const SAME: [&str; 8] = ["expect", "unwrap", "into", "clone", "to_f64", "item", "unwrap_or", "evalf"];

/// Functions that our formulas have, by the names of theirs.
const FUNCTIONS: [(&str, &str); 9] = [
    ("sqrt", "sqrt"),
    ("dsqrt", "sqrt"),
    ("cbrt", "cbrt"),
    ("exp", "exp"),
    ("log", "log"),
    ("sin", "sin"),
    ("cos", "cos"),
    ("atan", "atan"),
    ("acos", "acos"),
];

const POWERS: [&str; 5] = ["pow", "powf", "powi", "power", "pown"];

/// What names stand for.
#[derive(Default)]
pub(super) struct Names {
    pub(super) scalars: BTreeMap<String, Id>,
    /// Lists, by the index of each element.
    pub(super) lists: BTreeMap<String, BTreeMap<i64, Id>>,
    /// Variables of loops.
    pub(super) wholes: BTreeMap<String, i64>,
}

/// Reads an expression from a place on.
pub(super) struct Expressions<'a> {
    cursor: Cursor<'a>,
    pub(super) next: usize,
    names: &'a Names,
    depth: usize,
}

impl<'a> Expressions<'a> {
    pub(super) fn at(place: usize, cursor: Cursor<'a>, names: &'a Names) -> Expressions<'a> {
        Expressions { cursor, next: place, names, depth: 0 }
    }

    fn kind(&self) -> Option<&'a Kind> {
        self.cursor.kind(self.next)
    }

    pub(super) fn takes(&mut self, symbol: &str) -> bool {
        let is_it = matches!(self.kind(), Some(Kind::Symbol(found)) if *found == symbol);
        self.next += usize::from(is_it);
        is_it
    }

    /// A sum.
    pub(super) fn sum(&mut self) -> Option<Formula> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return None;
        }
        let mut left = self.product()?;
        while let Some(Kind::Symbol(sign @ ("+" | "-"))) = self.kind() {
            self.next += 1;
            let right = self.product()?;
            let whole = left.whole.zip(right.whole);
            let whole = whole.and_then(|(a, b)| if *sign == "+" { a.checked_add(b) } else { a.checked_sub(b) });
            left = joined(left, sign, right, whole);
        }
        self.depth -= 1;
        Some(left)
    }

    fn product(&mut self) -> Option<Formula> {
        let mut left = self.signed()?;
        loop {
            let sign = match self.kind() {
                Some(Kind::Symbol("*")) => "*",
                Some(Kind::Symbol("/")) => "/",
                Some(Kind::Symbol("//")) if self.cursor.language == Language::Julia => "//",
                _ => break,
            };
            self.next += 1;
            let right = self.signed()?;
            left = match left.whole.zip(right.whole) {
                Some((a, b)) if sign == "/" && self.cursor.language.truncates() => whole_number(a.checked_div(b)?),
                Some((a, b)) if sign == "*" => joined(left, "*", right, a.checked_mul(b)),
                _ => joined(left, if sign == "*" { "*" } else { "/" }, right, None),
            };
        }
        Some(left)
    }

    fn signed(&mut self) -> Option<Formula> {
        if self.takes("+") {
            return self.signed();
        }
        if !self.takes("-") {
            return self.power();
        }
        self.depth += 1;
        let inner = if self.depth > DEEPEST { None } else { self.signed() }?;
        self.depth -= 1;
        Some(Formula { text: format!("(-{})", inner.text), whole: inner.whole.and_then(i64::checked_neg), ..inner })
    }

    fn power(&mut self) -> Option<Formula> {
        let base = self.postfix()?;
        let has_power = match self.cursor.language {
            Language::C | Language::Rust | Language::Json => false,
            _ => self.takes("**") || (self.cursor.language == Language::Julia && self.takes("^")),
        };
        if !has_power {
            return Some(base);
        }
        let exponent = self.signed()?;
        Some(joined(base, "^", exponent, None))
    }

    /// A number with the methods that are called of it.
    fn postfix(&mut self) -> Option<Formula> {
        let mut value = self.primary()?;
        loop {
            if self.takes("?") {
                continue;
            }
            let Some(
                [
                    Token { kind: Kind::Symbol("."), .. },
                    Token { kind: Kind::Name(method), .. },
                    Token { kind: Kind::Symbol("("), .. },
                ],
            ) = self.cursor.tokens.get(self.next..self.next + 3)
            else {
                return Some(value);
            };
            self.next += 2;
            let arguments = self.arguments()?;
            value = method_of(value, method, &arguments)?;
        }
    }

    /// The arguments in brackets that begin here, those that are numbers.
    fn arguments(&mut self) -> Option<Vec<Option<Formula>>> {
        let close = if self.takes("(") {
            ")"
        } else if self.takes("{") {
            "}"
        } else {
            return None;
        };
        let mut found = Vec::new();
        while !self.takes(close) {
            let (from, depth) = (self.next, self.depth);
            let value = self.sum();
            let ends = matches!(self.kind(), Some(Kind::Symbol(end)) if *end == "," || *end == close);
            if !ends {
                (self.next, self.depth) = (from, depth);
                self.skip(close)?;
            }
            found.push(value.filter(|_| ends));
            self.takes(",");
        }
        Some(found)
    }

    /// To the comma or the bracket that ends this argument.
    fn skip(&mut self, close: &str) -> Option<()> {
        let mut open = 0;
        loop {
            match self.kind()? {
                Kind::Symbol(",") if open == 0 => return Some(()),
                Kind::Symbol(found) if open == 0 && *found == close => return Some(()),
                Kind::Symbol("(" | "[" | "{" | "(/") => open += 1,
                Kind::Symbol(")" | "]" | "}" | "/)") if open == 0 => return None,
                Kind::Symbol(")" | "]" | "}" | "/)") => open -= 1,
                Kind::Symbol(";") if open == 0 => return None,
                _ => {}
            }
            self.next += 1;
        }
    }

    fn primary(&mut self) -> Option<Formula> {
        match self.kind()? {
            Kind::Number(literal) => {
                self.next += 1;
                let number = of_literal(literal);
                let implied = self.cursor.language == Language::Julia
                    && matches!(self.kind(), Some(Kind::Name(_) | Kind::Symbol("(")));
                if !implied {
                    return Some(number);
                }
                let factor = self.power()?;
                Some(joined(number, "*", factor, None))
            }
            Kind::Text(text) => {
                self.next += 1;
                let is_number = !text.is_empty() && text.chars().all(|c| c.is_ascii_digit() || ".eE+-/ ".contains(c));
                is_number.then(|| Formula { text: format!("({text})"), ..Formula::default() })
            }
            Kind::Symbol("(") => {
                self.next += 1;
                if let Some(cast) = self.cast() {
                    return Some(cast);
                }
                let inner = self.sum()?;
                self.takes(")").then_some(Formula { text: format!("({})", inner.text), ..inner })
            }
            Kind::Symbol("&") if self.cursor.language == Language::Rust => {
                self.next += 1;
                self.primary()
            }
            Kind::Name(_) => self.named(),
            _ => None,
        }
    }

    /// A number after `(double)`.
    fn cast(&mut self) -> Option<Formula> {
        let Some([Token { kind: Kind::Name(kind), .. }, Token { kind: Kind::Symbol(")"), .. }, after]) =
            self.cursor.tokens.get(self.next..self.next + 3)
        else {
            return None;
        };
        let is_cast = self.cursor.language == Language::C
            && !self.names.scalars.contains_key(kind)
            && matches!(after.kind, Kind::Number(_) | Kind::Name(_) | Kind::Symbol("("));
        if !is_cast {
            return None;
        }
        self.next += 2;
        self.postfix().map(|value| Formula { whole: None, ..value })
    }

    /// What begins with a name: a number, an element of a list, a call.
    fn named(&mut self) -> Option<Formula> {
        let mut path = Vec::new();
        loop {
            let Some(Kind::Name(part)) = self.kind() else { return None };
            path.push(part.as_str());
            self.next += 1;
            let joins = match self.kind() {
                Some(Kind::Symbol("." | "::" | "->")) => true,
                Some(Kind::Symbol("%")) => self.cursor.language.is_fortran(),
                _ => false,
            };
            // a method of a number that is known
            let is_method =
                matches!(self.cursor.tokens.get(self.next + 2).map(|token| &token.kind), Some(Kind::Symbol("(")));
            if !joins || (is_method && self.scalar(&path).is_some()) {
                break;
            }
            self.next += 1;
        }
        let last = path[path.len() - 1];
        if last.ends_with("_cast") && self.takes("<") {
            while !self.takes(">") {
                self.kind().filter(|kind| matches!(kind, Kind::Name(_) | Kind::Symbol("::")))?;
                self.next += 1;
            }
        }
        match self.kind() {
            Some(Kind::Text(text)) if last == "big" => {
                self.next += 1;
                Some(of_literal(text))
            }
            Some(Kind::Symbol("[")) => self.element(&path, "]"),
            Some(Kind::Symbol("(")) if self.names.lists.contains_key(&joined_path(&path)) => self.element(&path, ")"),
            Some(Kind::Symbol("(" | "{")) if self.scalar(&path).is_none() => {
                let arguments = self.arguments()?;
                call(last, &arguments)
            }
            _ => self.scalar(&path),
        }
    }

    fn scalar(&self, path: &[&str]) -> Option<Formula> {
        if let [only] = path
            && let Some(whole) = self.names.wholes.get(*only)
        {
            return Some(whole_number(*whole));
        }
        let id = self.names.scalars.get(&joined_path(path)).or_else(|| self.names.scalars.get(path[path.len() - 1]))?;
        Some(Formula { text: name(*id), uses: [*id].into(), whole: None })
    }

    fn element(&mut self, path: &[&str], close: &str) -> Option<Formula> {
        let list = self.names.lists.get(&joined_path(path)).or_else(|| self.names.lists.get(path[path.len() - 1]))?;
        self.next += 1;
        let index = self.sum()?.whole?;
        if !self.takes(close) {
            return None;
        }
        let (first, last) = (*list.keys().next()?, *list.keys().next_back()?);
        // −1 is the last one
        let index = if index < 0 && self.cursor.language == Language::Python {
            last.checked_add(1)?.checked_add(index)?
        } else {
            index
        };
        let id = list.get(&index).filter(|_| index >= first)?;
        Some(Formula { text: name(*id), uses: [*id].into(), whole: None })
    }
}

/// A name of several parts, without the object that a method is of.
pub(super) fn joined_path(path: &[&str]) -> String {
    let path = match path {
        ["self" | "this" | "cls", rest @ ..] if !rest.is_empty() => rest,
        _ => path,
    };
    path.join(".")
}

fn of_literal(literal: &str) -> Formula {
    let whole = literal.bytes().all(|b| b.is_ascii_digit()).then(|| literal.parse().ok()).flatten();
    let text = if literal.ends_with('.') { format!("{literal}0") } else { literal.replace(".e", ".0e") };
    Formula { text, whole, ..Formula::default() }
}

fn whole_number(value: i64) -> Formula {
    Formula { text: format!("({value})"), whole: Some(value), ..Formula::default() }
}

fn joined(left: Formula, sign: &str, right: Formula, whole: Option<i64>) -> Formula {
    let mut uses = left.uses;
    uses.extend(right.uses);
    Formula { text: format!("({} {sign} {})", left.text, right.text), uses, whole }
}

fn function(function: &str, argument: Formula) -> Formula {
    Formula { text: format!("{function}({})", argument.text), whole: None, ..argument }
}

fn method_of(value: Formula, method: &str, arguments: &[Option<Formula>]) -> Option<Formula> {
    if SAME.contains(&method) {
        return Some(value);
    }
    match (method, arguments) {
        ("recip", []) => Some(joined(whole_number(1), "/", Formula { whole: None, ..value }, None)),
        (_, [Some(exponent)]) if POWERS.contains(&method) => Some(joined(value, "^", exponent.clone(), None)),
        (_, []) => Some(function(FUNCTIONS.iter().find(|(theirs, _)| *theirs == method)?.1, value)),
        _ => None,
    }
}

fn call(callee: &str, arguments: &[Option<Formula>]) -> Option<Formula> {
    let callee = callee.to_ascii_lowercase();
    if let Some((_, ours)) = FUNCTIONS.iter().find(|(theirs, _)| *theirs == callee) {
        let [Some(argument)] = arguments else { return None };
        return Some(function(ours, argument.clone()));
    }
    match arguments {
        [] if callee == "one" => Some(whole_number(1)).map(|one| Formula { whole: None, ..one }),
        [Some(base), Some(exponent)] if POWERS.contains(&&*callee) => {
            Some(joined(base.clone(), "^", exponent.clone(), None))
        }
        [Some(numerator), Some(denominator)] if matches!(&*callee, "fraction" | "rational" | "mpq") => {
            Some(joined(numerator.clone(), "/", denominator.clone(), None))
        }
        // a kind or a type beside it, before or behind
        [Some(value), ..] | [None, Some(value)]
            if CONVERSIONS.contains(&&*callee) || callee.ends_with("_cast") || callee.len() == 1 =>
        {
            Some(Formula { whole: None, ..value.clone() })
        }
        _ => None,
    }
}
