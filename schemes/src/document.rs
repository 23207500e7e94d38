//! TOML text → values with their places. Every fault is collected, with its place and what would be right.
//!
//! | module | what it has |
//! | --- | --- |
//! | `file` | a file → its text, up to a stated size |
//! | `fault` | a text with its name, and what is wrong at a place of it |
//! | `value` | values with their places: a text, a list, a number as it is written |
//! | `keys` | the keys that a table may have |
//! | `reader` | reads a document table by table, key by key |
//!
//! A reader takes a document apart; what it cannot read becomes a [`Fault`], and the reading goes on, so that all
//! faults are reported at once:
//!
//! ```
//! use shadowstep_schemes::document::{Faults, Key, Keys, Reader, Source, document};
//!
//! let source = Source { path: "spring.toml".to_owned(), text: "stifness = 0.5\nbodies = 0\nends = \"fixed\"".to_owned() };
//! let (table, faults) = document(&source);
//! let mut reader = Reader::new(&source, faults);
//! let keys = [Key::new("stiffness", "\"1/3\""), Key::new("bodies", "2"), Key::new("ends", "\"free\"")];
//! let table = table.unwrap();
//! let spring = reader.table(&table, 0..0, Keys::new("a spring", keys));
//!
//! let stiffness = reader.required(&spring, "stiffness").and_then(|value| reader.number(value, "1, \"1/3\""));
//! let bodies = spring.get("bodies").and_then(|value| reader.whole(value, 1..=1000, "a whole number"));
//! let ends = spring.get("ends").and_then(|value| reader.word(value, &[("free", 0), ("fixed", 1)]));
//! assert!(stiffness.is_none() && bodies.is_none() && ends.unwrap().value == 1);
//!
//! let faults = Faults::of(reader.faults).unwrap();
//! assert_eq!(
//!     faults.to_string(),
//!     "\
//! spring.toml:1:1: unknown key `stifness`
//!   1 | stifness = 0.5
//!     | ^^^^^^^^
//!   hint: did you mean `stiffness`?
//! spring.toml:2:10: 0 is out of range
//!   2 | bodies = 0
//!     |          ^
//!   hint: write a whole number from 1 to 1000"
//! );
//! ```

mod fault;
mod file;
mod keys;
mod reader;
mod value;

pub use fault::{Fault, Faults, Source, with_short_numbers};
pub use file::{LARGEST_TABLE, read_text, refuse_pipe};
pub use keys::{Key, Keys};
pub use reader::{Reader, Section, document, valid_document};
pub use value::{Placed, Text, Value, whole_number};
