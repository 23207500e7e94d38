//! Texts for people and for programs.
//!
//! | module | what it is |
//! | --- | --- |
//! | `error`, `refusal` | what can go wrong |
//! | [`readable`] | numbers and texts for people |
//! | [`object`] | objects of JSON whose keys keep their order |
//! | [`spreadsheet`] | cells of CSV that spreadsheets would compute |
//! | `shell` | words of commands that users copy |

pub(crate) mod error;
pub mod object;
pub mod readable;
pub(crate) mod refusal;
pub(crate) mod shell;
pub mod spreadsheet;
