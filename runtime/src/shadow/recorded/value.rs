//! An estimate of the modified energy beside the energy.

/// The modified energy at a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// n of the state.
    pub n: i64,
    /// H̄
    pub modified: f64,
    /// Its estimated error.
    pub error: f64,
    /// H
    pub energy: f64,
}
