//! The language of documents: what a scene can say.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`schema`], [`keys`] | a row for each key, by which documents are checked |
//! | `explain`, `template` | what is made of the rows: the explanation, the JSON Schema, scenes of shipped problems |
//! | `shipped` | shipped scenes |
//! | [`expression`], `quantity` | formulas in the numbers of a state, and conditions on them; the quantities in them |
//! | [`reserved_names`] | names with a meaning of their own: in such formulas, as columns, in emitted code |
//! | [`library`] | schemes by their names: shipped ones and files |

pub(crate) mod explain;
pub mod expression;
pub mod keys;
pub mod library;
pub(crate) mod quantity;
pub mod reserved_names;
pub mod schema;
pub(crate) mod shipped;
pub(crate) mod template;
