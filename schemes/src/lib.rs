//! What a splitting scheme is: a table of exact numbers, and the proof of what the table claims. Exact numbers and
//! formulas, with derivatives and programs that compute them, are in [`symbolic`].
//!
//! The files are the pipeline; [`read_first`] in `pipeline` is the whole of it:
//!
//! | module | from → to |
//! | --- | --- |
//! | [`document`] | TOML text → values with their places |
//! | [`parse`], [`table`], [`claims`] | values → the cells and the claims of a table |
//! | [`exact`], [`scheme`], [`map`], `map_kind` | cells → exact weights a_s, b_s → the sequence of kicks and drifts |
//! | [`library`], `shipped`, `spelling` | the name of a table → its text |
//! | [`order`], [`nystrom`], [`near_integrable`] | kicks and drifts → order conditions, for every T(p), for quadratic T, for H = A + εB |
//! | [`arithmetic`], `conditions`, `digits` | the values of the conditions, exactly or with bounds, and how exactly they must be met |
//! | [`decimal`], `printed`, `rounding`, `least_change` | printed decimals → whether rounding explains how far conditions are off |
//! | [`proof`] | conditions → what is true of the scheme → the claims that differ from it |
//! | [`many_parts`], [`part_words`] | scheme for two parts → steps for three and more, and their order conditions |
//! | [`inner`] | outer and inner scheme → a step of slow forces, fast forces and T |
//! | `facts` | what is proved → orders, and how they are said |
//! | `wording` | such a claim → a sentence with its place |
//! | [`plan`] | scheme → the plan of a step: maps, shared constants, cost |
//! | `pipeline` | the text of a table → [`Proved`]: scheme, proof and plan, or all faults |
//!
//! All but `map_kind` and [`symbolic`] is with the feature `tables`: a program whose schemes are generated while it
//! compiles needs none of it.
//!
//! ```
//! use shadowstep_schemes::{read, shipped};
//!
//! let proved = read(&shipped("yoshida4").unwrap(), &|name, _| shipped(name)).unwrap();
//! assert_eq!(proved.proof.general.order, 4);
//! assert_eq!(proved.plan.evaluations, 3);
//! ```

#[cfg(feature = "tables")]
pub mod arithmetic;
#[cfg(feature = "tables")]
pub mod claims;
#[cfg(feature = "tables")]
mod conditions;
#[cfg(feature = "tables")]
pub mod decimal;
#[cfg(feature = "tables")]
mod digits;
#[cfg(feature = "tables")]
pub mod document;
#[cfg(feature = "tables")]
pub mod exact;
#[cfg(feature = "tables")]
mod facts;
#[cfg(feature = "tables")]
pub mod inner;
#[cfg(feature = "tables")]
mod least_change;
#[cfg(feature = "tables")]
pub mod library;
#[cfg(feature = "tables")]
pub mod many_parts;
#[cfg(feature = "tables")]
pub mod map;
mod map_kind;
#[cfg(feature = "tables")]
pub mod near_integrable;
#[cfg(feature = "tables")]
pub mod nystrom;
#[cfg(feature = "tables")]
pub mod order;
#[cfg(feature = "tables")]
pub mod parse;
#[cfg(feature = "tables")]
pub mod part_words;
#[cfg(feature = "tables")]
mod pipeline;
#[cfg(feature = "tables")]
pub mod plan;
#[cfg(feature = "tables")]
mod printed;
#[cfg(feature = "tables")]
pub mod proof;
#[cfg(feature = "tables")]
mod rounding;
#[cfg(feature = "tables")]
pub mod scheme;
#[cfg(feature = "tables")]
mod shipped;
#[cfg(feature = "tables")]
mod spelling;
pub mod symbolic;
#[cfg(feature = "tables")]
pub mod table;
#[cfg(feature = "tables")]
mod wording;

#[cfg(feature = "tables")]
pub use claims::Kinetic;
#[cfg(feature = "tables")]
pub use digits::digits_of;
#[cfg(feature = "tables")]
pub use document::{Fault, Faults, Source};
#[cfg(feature = "tables")]
pub use facts::{Orders, counted, held};
#[cfg(feature = "tables")]
pub use many_parts::NotForManyParts;
#[cfg(feature = "tables")]
pub use map::Map;
pub use map_kind::{First, MapKind};
#[cfg(feature = "tables")]
pub use pipeline::{Proved, read, read_first, shipped_proved};
#[cfg(feature = "tables")]
pub use plan::{StepCost, StepPlan};
#[cfg(feature = "tables")]
pub use scheme::ExactScheme;
#[cfg(feature = "tables")]
pub use shipped::{shipped, shipped_hint, shipped_names};
#[cfg(feature = "tables")]
pub use symbolic::decimal::{to_significant, to_text};
#[cfg(feature = "tables")]
pub use symbolic::{Rational, nearest};
