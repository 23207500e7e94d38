//! Exact numbers: rationals, their rounding, and rational bounds of roots, functions and π.

pub(crate) mod ball;
pub(crate) mod divisor;
pub(crate) mod elementary;
pub(crate) mod fraction;
pub(crate) mod function;
pub(crate) mod interval;
pub(crate) mod power;
pub(crate) mod ratio;
pub(crate) mod rational;
pub(crate) mod rounding;
pub(crate) mod series;
