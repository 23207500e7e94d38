//! Files that are written, and those that may be read.
//!
//! | module | what it is |
//! | --- | --- |
//! | `whole_file`, `temporary` | files that get their names when they are complete |
//! | [`lock`] | files that one process has alone |
//! | [`outside`] | the files that a text names |

pub mod lock;
pub mod outside;
pub(crate) mod temporary;
pub(crate) mod whole_file;
