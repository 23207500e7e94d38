//! Formulas: what they mean, their derivatives, and the programs that compute them.

mod calculus;
mod cost;
mod graph;
mod pair;
mod random;
mod support;
