//! Several numbers at once in lanes, for what computes them together.

/// How numbers are put into lanes L, and taken from them.
pub struct LaneAccess<N, L> {
    /// The number in a lane ← x
    pub set: fn(&mut L, usize, &N),
    /// The number in a lane.
    pub number: fn(&L, usize) -> N,
}
