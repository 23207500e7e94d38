//! Text to tokens: numbers, names and symbols, each with its bytes.

use std::ops::Range;

use crate::symbolic::number::rational::Rational;
use crate::symbolic::text::error::SyntaxError;
use crate::symbolic::text::literal::{self, LARGEST_EXPONENT};

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Token {
    Number(Rational),
    Name,
    /// One of `+ - * / ^ ( ) ,`.
    Symbol(char),
}

/// The tokens of a text and their bytes in it.
pub(crate) fn tokens(text: &str) -> Result<Vec<(Token, Range<usize>)>, SyntaxError> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(first) = text[at..].chars().next() {
        if first.is_whitespace() {
            at += first.len_utf8();
            continue;
        }
        let (token, length) = token(first, text, at)?;
        found.push((token, at..at + length));
        at += length;
    }
    Ok(found)
}

/// The token that begins with the character `first` at byte `at`, and its length.
fn token(first: char, text: &str, at: usize) -> Result<(Token, usize), SyntaxError> {
    let rest = &text[at..];
    let number = literal::length(rest);
    if number > 0 {
        return match literal::value(&rest[..number]) {
            Some(value) => Ok((Token::Number(value), number)),
            None => {
                let message = format!(
                    "the exponent of this number is out of range: -{LARGEST_EXPONENT} to {LARGEST_EXPONENT} is allowed"
                );
                Err(SyntaxError { message, range: at..at + number })
            }
        };
    }
    match first {
        'A'..='Z' | 'a'..='z' | '_' => {
            let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_');
            Ok((Token::Name, end.unwrap_or(rest.len())))
        }
        '*' if rest.starts_with("**") => {
            let message = "`**` is not an operator; write `^` for a power".to_string();
            Err(SyntaxError { message, range: at..at + 2 })
        }
        '+' | '-' | '*' | '/' | '^' | '(' | ')' | ',' => Ok((Token::Symbol(first), 1)),
        _ => Err(SyntaxError { message: unknown(first), range: at..at + first.len_utf8() }),
    }
}

/// The message for an invalid character, with the ASCII text for it.
fn unknown(character: char) -> String {
    let ascii = match character {
        '×' | '·' | '⋅' | '∗' => "*",
        '÷' | '∕' | ':' => "/",
        '−' | '–' | '—' => "-",
        '[' | '{' => "(",
        ']' | '}' => ")",
        '√' => "sqrt(x)",
        '∛' => "cbrt(x)",
        '²' => "^2",
        '³' => "^3",
        '½' => "1/2",
        '.' => return "a `.` without digits".to_string(),
        _ => return format!("unknown character `{}`", character.escape_debug()),
    };
    format!("unknown character `{character}`; write `{ascii}`")
}
