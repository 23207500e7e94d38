//! Tokens by their places.

use crate::sources::language::Language;
use crate::sources::token::{Kind, Token};

/// The tokens of a text of a language.
#[derive(Clone, Copy)]
pub(super) struct Cursor<'a> {
    pub(super) tokens: &'a [Token],
    pub(super) language: Language,
}

impl<'a> Cursor<'a> {
    pub(super) fn kind(self, place: usize) -> Option<&'a Kind> {
        self.tokens.get(place).map(|token| &token.kind)
    }

    pub(super) fn is(self, place: usize, symbol: &str) -> bool {
        matches!(self.kind(place), Some(Kind::Symbol(found)) if *found == symbol)
    }

    pub(super) fn is_any(self, place: usize, symbols: &[&str]) -> bool {
        matches!(self.kind(place), Some(Kind::Symbol(found)) if symbols.contains(found))
    }

    pub(super) fn name(self, place: usize) -> Option<&'a str> {
        match self.kind(place) {
            Some(Kind::Name(name)) => Some(name),
            _ => None,
        }
    }
}
