//! The limbs of a number, for estimators, which compute with them in fixed point.

use std::fmt;

/// How the limbs of a number are read and written.
pub struct LimbAccess<N> {
    /// How many limbs the significand of a number has, also of 0.
    pub limbs: fn(&N) -> usize,
    /// The number in parts.
    pub parts: fn(&N) -> Parts<'_>,
    /// x ← the number nearest to Σ magnitude\[i\] 2^(64 i + exponent), or to its opposite:
    /// `assign(x, negative, magnitude, exponent)`.
    pub assign: fn(&mut N, bool, &[u64], i64),
    /// x ← NaN
    pub assign_nan: fn(&mut N),
}

impl<N> Clone for LimbAccess<N> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<N> Copy for LimbAccess<N> {}

impl<N> fmt::Debug for LimbAccess<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("LimbAccess")
    }
}

/// A number as its sign, limbs of 64 bits, the lowest first, and an exponent.
#[derive(Clone, Copy, Debug)]
pub enum Parts<'a> {
    /// 0 or −0
    Zero,
    /// ± Σ significand\[i\] 2^(64 i) 2^(exponent − 64 limbs); the highest bit of the last limb is 1.
    Regular {
        /// Whether it is below 0.
        negative: bool,
        /// e of |x| in [2^(e − 1), 2^e).
        exponent: i64,
        /// As many limbs as [`LimbAccess::limbs`] says.
        significand: &'a [u64],
    },
    /// An infinity or NaN.
    NotFinite,
}
