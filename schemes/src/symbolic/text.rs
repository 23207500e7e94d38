//! Text in and out: tokens, the syntax tree, literals and decimals, names and the words that are near to them.

pub mod decimal;
pub(crate) mod error;
pub(crate) mod literal;
pub(crate) mod names;
pub(crate) mod near_names;
pub(crate) mod syntax;
pub(crate) mod token;
