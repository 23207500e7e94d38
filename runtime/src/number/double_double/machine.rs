//! The machine numbers that a double-double consists of: `f64`, or lanes of it.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::product::error_of_product;

/// A machine number, or several in lanes, with the operations that double-double arithmetic is made of.
///
/// Each operation rounds to nearest. There is no order: what depends on values is chosen lane by lane.
pub trait Machine:
    Copy + Debug + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// How many lanes it has: 1 of `f64`.
    const LANES: usize;

    /// Does some work, of lanes in the widest vector instructions that the processor has.
    #[inline(always)]
    fn in_widest_instructions<R>(work: impl FnOnce() -> R) -> R {
        work()
    }

    /// The same number in every lane.
    fn every(x: f64) -> Self;

    /// √x
    fn sqrt(self) -> Self;

    /// (p, e) with p = a b, rounded, and p + e = a b exactly, unless p overflows or 0 < |a b| < 2⁻⁹⁶⁹.
    fn two_product(self, b: Self) -> (Self, Self);

    /// The pair in lanes where `test` is finite; else the plain result and 0.
    fn if_finite(test: Self, pair: (Self, Self), plain: Self) -> (Self, Self);

    /// `less` in lanes where a < b, else `otherwise`; pairs are compared by their first numbers, then by their second
    /// ones.
    fn where_less(a: (Self, Self), b: (Self, Self), less: (Self, Self), otherwise: (Self, Self)) -> (Self, Self);

    /// Applies functions to the pair of each lane.
    fn each<const N: usize>(pair: (Self, Self), functions: impl Fn((f64, f64)) -> [(f64, f64); N])
    -> [(Self, Self); N];

    /// The number in a lane.
    fn lane(&self, lane: usize) -> f64;

    /// The number in a lane ← value
    fn set_lane(&mut self, lane: usize, value: f64);

    /// Whether it is neither infinite nor NaN, in every lane.
    fn is_finite(self) -> bool;
}

impl Machine for f64 {
    const LANES: usize = 1;

    #[inline(always)]
    fn every(x: f64) -> f64 {
        x
    }

    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn two_product(self, b: f64) -> (f64, f64) {
        let product = self * b;
        (product, error_of_product(self, b, product))
    }

    #[inline(always)]
    fn if_finite(test: f64, pair: (f64, f64), plain: f64) -> (f64, f64) {
        if test.is_finite() { pair } else { (plain, 0.0) }
    }

    #[inline(always)]
    fn where_less(a: (f64, f64), b: (f64, f64), less: (f64, f64), otherwise: (f64, f64)) -> (f64, f64) {
        if a < b { less } else { otherwise }
    }

    #[inline(always)]
    fn each<const N: usize>(pair: (f64, f64), functions: impl Fn((f64, f64)) -> [(f64, f64); N]) -> [(f64, f64); N] {
        functions(pair)
    }

    #[inline(always)]
    fn lane(&self, _: usize) -> f64 {
        *self
    }

    #[inline(always)]
    fn set_lane(&mut self, _: usize, value: f64) {
        *self = value;
    }

    #[inline(always)]
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
}
