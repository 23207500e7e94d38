//! Text of a language → numbers, names, symbols and comments with their bytes.
//!
//! Tokens are distinguished only as far as lists of numbers need it. Any other character is a symbol, so that every
//! text has tokens.

use std::ops::Range;

use crate::sources::language::Language;

/// What a token is.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    /// A number as a decimal literal of ours: `0.5d0`, `0.5_f64`, `0'5` are `0.5e0`, `0.5`, `05`.
    Number(String),
    Name(String),
    /// The content of a string.
    Text(String),
    Symbol(&'static str),
    /// The end of a statement that ends with its line.
    LineEnd,
}

#[derive(Clone, Debug)]
pub(super) struct Token {
    pub(super) kind: Kind,
    pub(super) at: Range<usize>,
}

/// The tokens of a text, and the bytes of its comments.
pub(super) struct Tokens {
    pub(super) tokens: Vec<Token>,
    pub(super) comments: Vec<Range<usize>>,
}

/// Symbols of two characters and more, longer ones first, then single ones.
const SYMBOLS: [&str; 48] = [
    "..=", "**", "::", "->", "==", "!=", "<=", ">=", "=>", ":=", "+=", "-=", "*=", "/=", "..", "//", "&&", "||", "(/",
    "/)", "(", ")", "[", "]", "{", "}", "+", "-", "*", "/", "^", "=", ",", ";", ":", ".", "<", ">", "%", "&", "!", "?",
    "@", "~", "|", "$", "\\", "`",
];

/// A character that no language uses between numbers.
const OTHER: &str = "\u{0}";

impl Tokens {
    pub(super) fn of(text: &str, language: Language) -> Tokens {
        let mut lexer =
            Lexer { text, language, at: 0, depth: 0, found: Tokens { tokens: Vec::new(), comments: Vec::new() } };
        while lexer.at < text.len() {
            lexer.next();
        }
        lexer.found
    }
}

struct Lexer<'a> {
    text: &'a str,
    language: Language,
    at: usize,
    /// Brackets that are open: within them a line does not end a statement.
    depth: usize,
    found: Tokens,
}

impl<'a> Lexer<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn push(&mut self, kind: Kind, length: usize) {
        self.found.tokens.push(Token { kind, at: self.at..self.at + length });
        self.at += length;
    }

    fn comment(&mut self, length: usize) {
        self.found.comments.push(self.at..self.at + length);
        self.at += length;
    }

    fn next(&mut self) {
        let rest = self.rest();
        let first = rest.chars().next().expect("something is left");
        let line = rest.find('\n').unwrap_or(rest.len());
        if first == '\n' {
            return self.line_end();
        }
        if self.is_line_comment() {
            return self.comment(line);
        }
        if first.is_whitespace() {
            self.at += first.len_utf8();
        } else if let Some(length) = self.block_comment() {
            self.comment(length);
        } else if rest.starts_with("(*this)") && self.language == Language::C {
            self.push(Kind::Name("this".to_owned()), "(*this)".len());
        } else if first == '#' && self.language == Language::C {
            self.directive(line);
        } else if matches!(first, '"' | '\'') && !self.is_transpose() {
            self.quoted(first);
        } else if self.begins_number(first) {
            self.number();
        } else if first.is_alphabetic() || first == '_' {
            let length = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
            let name = &rest[..length];
            let name = if self.language.is_fortran() { name.to_ascii_lowercase() } else { name.to_owned() };
            self.push(Kind::Name(name), length);
        } else {
            self.symbol(first);
        }
    }

    fn symbol(&mut self, first: char) {
        let is_ours = |symbol: &&&str| match **symbol {
            "(/" | "/)" => self.language.is_fortran(),
            _ => true,
        };
        let symbol = SYMBOLS.iter().filter(is_ours).find(|symbol| self.rest().starts_with(**symbol));
        match symbol {
            Some(&("(" | "[" | "{" | "(/")) => self.depth += 1,
            Some(&(")" | "]" | "}" | "/)")) => self.depth = self.depth.saturating_sub(1),
            _ => {}
        }
        match symbol {
            Some(symbol) => self.push(Kind::Symbol(symbol), symbol.len()),
            None => self.push(Kind::Symbol(OTHER), first.len_utf8()),
        }
    }

    fn line_end(&mut self) {
        let tokens = &mut self.found.tokens;
        let continued = tokens.last().is_some_and(|last| {
            matches!(last.kind, Kind::Symbol("\\"))
                || (self.language.is_fortran() && matches!(last.kind, Kind::Symbol("&")))
        });
        let next = self.text[self.at + 1..].lines().next().unwrap_or("");
        let is_sixth = self.language == Language::FixedFortran
            && next.get(..5).is_some_and(|blank| blank.trim().is_empty())
            && next[5..].starts_with(|c: char| c != ' ' && c != '0');
        if continued {
            tokens.pop();
        } else if self.language.ends_with_line() && self.depth == 0 && !is_sixth {
            tokens.push(Token { kind: Kind::LineEnd, at: self.at..self.at + 1 });
        }
        self.at += 1;
        if is_sixth {
            self.at += 5 + next[5..].chars().next().map_or(0, char::len_utf8);
        } else if continued && self.language == Language::Fortran {
            // a line may begin with the same sign
            let blank = next.len() - next.trim_start().len();
            self.at += if next.trim_start().starts_with('&') { blank + 1 } else { 0 };
        }
    }

    fn is_line_comment(&self) -> bool {
        let rest = self.rest();
        match self.language {
            Language::C | Language::Rust | Language::Json => rest.starts_with("//"),
            Language::Python => rest.starts_with('#'),
            Language::Julia => rest.starts_with('#') && !rest.starts_with("#="),
            Language::Fortran => rest.starts_with('!'),
            Language::FixedFortran => {
                let is_first = self.at == 0 || self.text[..self.at].ends_with('\n');
                rest.starts_with('!') || (is_first && rest.starts_with(['c', 'C', '*']))
            }
        }
    }

    /// The length of a comment or a docstring of several lines that begins here.
    fn block_comment(&self) -> Option<usize> {
        let rest = self.rest();
        let (begin, end) = match self.language {
            Language::C | Language::Rust => ("/*", "*/"),
            Language::Julia if rest.starts_with("#=") => ("#=", "=#"),
            Language::Python if rest.starts_with("'''") => ("'''", "'''"),
            Language::Python | Language::Julia => ("\"\"\"", "\"\"\""),
            _ => return None,
        };
        let inside = rest.strip_prefix(begin)?;
        Some(inside.find(end).map_or(rest.len(), |length| begin.len() + length + end.len()))
    }

    /// `#define NAME value` is an assignment; other lines for the preprocessor are skipped.
    fn directive(&mut self, line: usize) {
        let rest = self.rest();
        let Some(definition) = rest[..line].strip_prefix("#define") else { return self.comment(line) };
        let name = definition.trim_start();
        let length = name.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(name.len());
        if length == 0 || name[length..].starts_with('(') {
            return self.comment(line);
        }
        self.at += rest[..line].len() - name.len();
        self.push(Kind::Name(name[..length].to_owned()), length);
        self.push(Kind::Symbol("="), 0);
        let end = self.at + name.len() - length;
        while self.at < end {
            self.next();
        }
        self.push(Kind::Symbol(";"), 0);
    }

    /// Whether a quote is Julia's transpose or a lifetime of Rust.
    fn is_transpose(&self) -> bool {
        let rest = self.rest();
        match self.language {
            Language::Julia => {
                rest.starts_with('\'')
                    && self.text[..self.at].ends_with(|c: char| c.is_alphanumeric() || ")]}_".contains(c))
            }
            Language::Rust => rest.starts_with('\'') && !rest.starts_with("'\\") && rest.chars().nth(2) != Some('\''),
            _ => false,
        }
    }

    fn quoted(&mut self, quote: char) {
        let inside = &self.rest()[1..];
        let escapes = !self.language.is_fortran();
        let mut escaped = false;
        let end = inside.find(|c: char| {
            let ends = !escaped && (c == quote || (c == '\n' && self.language != Language::Rust));
            escaped = escapes && c == '\\' && !escaped;
            ends
        });
        let length = end.unwrap_or(inside.len());
        let closed = usize::from(inside[length..].starts_with(quote));
        self.push(Kind::Text(inside[..length].to_owned()), 1 + length + closed);
    }

    fn begins_number(&self, first: char) -> bool {
        let after_point = || self.rest()[1..].starts_with(|c: char| c.is_ascii_digit());
        let is_field = || self.text[..self.at].ends_with(|c: char| c.is_alphanumeric() || ")]_".contains(c));
        first.is_ascii_digit() || (first == '.' && after_point() && !is_field())
    }

    fn number(&mut self) {
        let rest = self.rest();
        let separator = match self.language {
            Language::C => Some('\''),
            Language::Python | Language::Rust | Language::Julia => Some('_'),
            _ => None,
        };
        let digits = |from: usize| {
            let is_inside = |i: usize, c: char| {
                Some(c) == separator && rest[i + 1..].starts_with(|next: char| next.is_ascii_digit())
            };
            let end = rest[from..].char_indices().find(|(i, c)| !c.is_ascii_digit() && !is_inside(from + i, *c));
            end.map_or(rest.len(), |(i, _)| from + i)
        };
        let mut end = digits(0);
        if rest[end..].starts_with('.') && self.is_point(&rest[end + 1..]) {
            end = digits(end + 1);
        }
        let mut literal: String = rest[..end].chars().filter(|c| Some(*c) != separator).collect();
        if let Some(length) = self.exponent(&rest[end..]) {
            literal += "e";
            literal += &rest[end + 1..end + length];
            end += length;
        }
        let suffix = rest[end..].find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len() - end);
        let takes_suffix = match self.language {
            Language::C | Language::Rust => suffix > 0,
            Language::Fortran | Language::FixedFortran => rest[end..].starts_with('_'),
            _ => false,
        };
        // such as 0x1p3
        let is_hexadecimal = literal == "0" && rest[end..].starts_with(['x', 'X']);
        let end = if takes_suffix { end + suffix } else { end };
        let kind = if is_hexadecimal { Kind::Symbol(OTHER) } else { Kind::Number(literal) };
        self.push(kind, end);
    }

    /// Whether the point before this text belongs to the number, not to a range, a method or an operator.
    fn is_point(&self, after: &str) -> bool {
        match after.chars().next() {
            Some('.') => false,
            Some('*' | '/' | '^' | '+' | '-') if self.language == Language::Julia => false,
            Some(c) if c.is_alphabetic() || c == '_' => {
                self.exponent(after).is_some()
                    || (self.language == Language::C && after.starts_with(['f', 'F', 'l', 'L']))
                    || (self.language.is_fortran() && after.starts_with('_'))
            }
            _ => true,
        }
    }

    /// The length of an exponent that begins here.
    fn exponent(&self, text: &str) -> Option<usize> {
        let letters: &[char] = match self.language {
            Language::Fortran | Language::FixedFortran => &['e', 'E', 'd', 'D', 'q', 'Q'],
            Language::Julia => &['e', 'E', 'f'],
            _ => &['e', 'E'],
        };
        let power = text.strip_prefix(letters)?;
        let digits = power.strip_prefix(['+', '-']).unwrap_or(power);
        let count = digits.bytes().take_while(u8::is_ascii_digit).count();
        (count > 0).then(|| text.len() - digits.len() + count)
    }
}
