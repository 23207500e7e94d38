//! What a run writes: rows under a head, into a file that is whole or can be resumed.

mod checkpoint;
mod metadata;
mod resumable;
mod rows;
mod target;

pub(crate) use checkpoint::{Checkpoint, SavedState};
pub(crate) use metadata::Metadata;
pub(crate) use rows::{Columns, ModifiedEnergy, Row, Rows};
pub(crate) use target::Target;
