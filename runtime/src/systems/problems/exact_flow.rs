//! How the exact flow of a problem is computed, where a solution of its equations of motion is known.

pub(crate) mod points;
pub(crate) mod solution;
pub(crate) mod solver;
