//! What a splitting scheme is: a table of exact numbers, and the proof of what the table claims.
//!
//! The files are the pipeline, in order:
//!
//! | file | from → to |
//! | --- | --- |
//! | [`table`], `reader` | TOML text → cells with their places |
//! | [`exact`] | cells → exact rationals |
//! | [`scheme`] | weights a_s, b_s → the sequence of kicks and drifts |
//! | [`order`], [`nystrom`], [`near_integrable`] | kicks and drifts → order conditions, for every T(p), for quadratic T, for H = A + εB |
//! | [`proof`] | claims against conditions → a proved scheme, or faults |
//! | [`stage`] | proved scheme → the plan of a step: maps, shared constants, cost |
//! | [`analysis`] | proved scheme → leading errors, stability, phase |
//!
//! ```
//! use shadowstep_schemes::{read, shipped};
//!
//! let proved = read(&shipped("yoshida4").unwrap(), &|name, _| shipped(name)).unwrap();
//! assert_eq!(proved.proof.general.order, 4);
//! assert_eq!(proved.plan().evaluations, 3);
//! ```

pub mod analysis;
mod arithmetic;
pub mod claims;
mod digits;
pub mod document;
pub mod exact;
pub mod map;
pub mod near_integrable;
pub mod nystrom;
pub mod order;
pub mod parse;
pub mod polish;
pub mod proof;
pub mod scheme;
mod shipped;
mod spelling;
pub mod stage;
pub mod table;

pub use analysis::Analysis;
pub use claims::Kinetic;
pub use document::{Fault, Faults, Source};
pub use map::{First, Map, MapKind};
pub use proof::{Proof, Proved, prove, read, read_first};
pub use scheme::Scheme;
pub use shadowstep_symbolic::decimal::{to_significant, to_text};
pub use shadowstep_symbolic::{Rational, nearest};
pub use shipped::{shipped, shipped_hint, shipped_names, shipped_proved};
pub use stage::{Cost, Plan};
