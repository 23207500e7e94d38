//! Hamiltonian systems, their states, and the exact flows of their parts.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`system`], `state`, `increments`, `coordinates` | a system, its state q and p, and the increments of a step |
//! | `maps`, `turn`, [`summation`] | the maps of a scheme; turns of systems; how increments are added |
//! | [`potential`](mod@potential), [`pairs`], [`kinetic`](mod@kinetic), [`formula`] | U(q) and T(p), from code or from text |
//! | [`potential_check`] | derivatives that are compared with differences |
//! | [`motion`] | H = T(p) + U(q) |
//! | `evaluated`, `gradient_kicks`, [`displaced`] | kicks by a force that is kept; those by its derivative, or by displaced forces |
//! | [`linear_part`] | oscillations solved exactly: H = A + B with a quadratic form as A |
//! | [`many_parts`] | H = H_1 + … + H_n of parts whose flows have formulas |
//! | [`kepler_drift`], [`wisdom_holman`] | the exact flow of Kepler's problem; planets: H = A + B with Kepler orbits as A |
//! | [`explicit_time`] | H(q, p, t), with t as a coordinate |
//! | [`transformed_time`] | H′ with steps that become short in close encounters |
//! | [`problems`] | the shipped problems, some with their exact solution |

pub(crate) mod coordinates;
pub mod displaced;
pub(crate) mod evaluated;
pub mod explicit_time;
#[cfg(feature = "formulas")]
pub mod formula;
pub(crate) mod gradient_kicks;
pub(crate) mod increments;
#[cfg(feature = "formulas")]
pub(crate) mod interpreter;
pub mod kepler_drift;
pub(crate) mod kept;
pub mod kinetic;
pub mod linear_part;
pub mod many_parts;
pub(crate) mod maps;
pub(crate) mod matrix;
pub mod motion;
pub mod pairs;
pub mod potential;
pub mod potential_check;
pub mod problems;
pub(crate) mod state;
pub mod summation;
pub mod system;
pub mod transformed_time;
pub(crate) mod turn;
pub mod wisdom_holman;

pub use matrix::QUADRATIC_FLOW_DIGITS;
