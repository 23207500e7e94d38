//! Runs are made.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`posed`] | a run with all that determines it |
//! | `follow` | the one loop of runs |
//! | `passing`, `pace` | states that are made at once, and how many |
//! | `crossings` | where a run crosses a surface of section |
//! | [`computation`] | computations, such as this loop, in the number type of a run |
//! | `execute`, `engine` | the run of a scene into rows, which can be resumed |
//! | [`integrate`] | a run into memory |

pub mod computation;
pub(crate) mod crossings;
pub(crate) mod engine;
pub(crate) mod execute;
pub(crate) mod follow;
pub mod integrate;
pub(crate) mod pace;
pub(crate) mod passing;
pub mod posed;
