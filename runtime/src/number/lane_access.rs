//! Several numbers at once in lanes, for what computes them together.

use super::Number;

/// How numbers are put into lanes, and taken from them.
pub struct LaneAccess<N: Number> {
    /// The number in a lane ← x
    pub set: fn(&mut N::InLanes, usize, &N),
    /// The number in a lane.
    pub number: fn(&N::InLanes, usize) -> N,
}
