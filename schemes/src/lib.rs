//! What a splitting scheme is: a table of exact numbers, and the proof of what the table claims.
//!
//! The files are the pipeline; [`read_first`] in `pipeline` is the whole of it:
//!
//! | file | from → to |
//! | --- | --- |
//! | [`document`] | TOML text → values with their places |
//! | [`parse`], [`table`], [`claims`] | values → the cells and the claims of a table |
//! | [`exact`], [`scheme`], [`map`] | cells → exact weights a_s, b_s → the sequence of kicks and drifts |
//! | [`library`], `shipped`, `spelling` | the name of a table → its text |
//! | [`order`], [`nystrom`], [`near_integrable`] | kicks and drifts → order conditions, for every T(p), for quadratic T, for H = A + εB |
//! | [`arithmetic`], `conditions`, `digits` | the values of the conditions, exactly or with bounds, and how exactly they must be met |
//! | [`decimal`], `printed`, `rounding`, `least_change` | printed decimals → whether their rounding explains how far the conditions are off |
//! | [`proof`] | conditions → what is true of the scheme → the claims that differ from it |
//! | [`many_parts`], `part_words` | scheme for two parts → steps for three and more, and their order conditions |
//! | `wording` | such a claim → a sentence with its place |
//! | [`plan`] | scheme → the plan of a step: maps, shared constants, cost |
//! | `pipeline` | the text of a table → [`Proved`]: scheme, proof and plan, or all faults |
//!
//! ```
//! use shadowstep_schemes::{read, shipped};
//!
//! let proved = read(&shipped("yoshida4").unwrap(), &|name, _| shipped(name)).unwrap();
//! assert_eq!(proved.proof.general.order, 4);
//! assert_eq!(proved.plan.evaluations, 3);
//! ```

pub mod arithmetic;
pub mod claims;
mod conditions;
pub mod decimal;
mod digits;
pub mod document;
pub mod exact;
mod least_change;
pub mod library;
pub mod many_parts;
pub mod map;
pub mod near_integrable;
pub mod nystrom;
pub mod order;
pub mod parse;
mod part_words;
mod pipeline;
pub mod plan;
mod printed;
pub mod proof;
mod rounding;
pub mod scheme;
mod shipped;
mod spelling;
pub mod table;
mod wording;

pub use claims::Kinetic;
pub use document::{Fault, Faults, Source};
pub use many_parts::NotForManyParts;
pub use map::{First, Map, MapKind};
pub use pipeline::{Proved, read, read_first, shipped_proved};
pub use plan::{StepCost, StepPlan};
pub use proof::{Proof, prove};
pub use scheme::ExactScheme;
pub use shadowstep_symbolic::decimal::{to_significant, to_text};
pub use shadowstep_symbolic::{Rational, nearest};
pub use shipped::{shipped, shipped_hint, shipped_names};
