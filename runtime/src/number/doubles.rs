//! Numbers that are `f64`s, for what computes several of them at once.

/// How numbers are seen as the `f64`s that they are, and back.
pub struct Doubles<N> {
    /// Numbers as `f64`s.
    pub of: fn(&[N]) -> &[f64],
    /// `f64`s as numbers.
    pub numbers: fn(&[f64]) -> &[N],
}
