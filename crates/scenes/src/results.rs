//! What a run writes: a head and rows, to a writer, to a file that is complete or absent, or to one that can be
//! resumed.
//!
//! | module | what it is |
//! | --- | --- |
//! | `row`, `rows`, `numpy` | rows and their formats |
//! | `metadata`, `functions` | what the head of a file says |
//! | `options`, `target`, `origin` | where rows go, and whether what is there is from the same inputs |
//! | `moment`, `checkpoint`, `resumable` | from where a run can be resumed; the file of such a run |

mod checkpoint;
mod functions;
mod metadata;
pub(crate) mod moment;
mod numpy;
mod options;
mod origin;
mod resumable;
mod row;
mod rows;
mod target;

pub(crate) use checkpoint::{Checkpoint, Identity};
pub use functions::elementary_functions;
pub use metadata::hexadecimal;
pub(crate) use metadata::sha256;
pub(crate) use metadata::{Metadata, file_hashes};
pub(crate) use numpy::records;
pub use options::FileOptions;
pub(crate) use origin::Origin;
pub(crate) use resumable::Begun;
pub(crate) use row::{Cell, Name};
pub(crate) use rows::Rows;
pub(crate) use target::{Target, no_file, prolonged};
