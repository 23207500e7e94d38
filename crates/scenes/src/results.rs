//! What a run writes: a head and rows, to a writer, to a file that is complete or absent, or to one that can be
//! resumed.

mod checkpoint;
mod functions;
mod metadata;
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
