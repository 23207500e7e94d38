//! Exact rationals.

pub use num_rational::BigRational as Rational;
