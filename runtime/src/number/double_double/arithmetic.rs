//! Sums, products, quotients and square roots. u = 2⁻⁵³; the table of bounds and sources is at [`DoubleDouble`].

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{DoubleDouble, Machine};

/// Knuth's 2Sum: (s, e) with s = a + b, rounded, and s + e = a + b exactly.
#[inline(always)]
pub(super) fn two_sum<T: Machine>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    let from_b = sum - a;
    (sum, (a - (sum - from_b)) + (b - from_b))
}

/// Dekker's Fast2Sum: the same if |a| ≥ |b|, if a = 0, or if a is a multiple of the last place of b.
#[inline(always)]
fn fast_two_sum<T: Machine>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// AccurateDWPlusDW
#[inline(always)]
fn sum<T: Machine>((ah, al): (T, T), (bh, bl): (T, T)) -> (T, T) {
    let (sh, sl) = two_sum(ah, bh);
    let (th, tl) = two_sum(al, bl);
    let (vh, vl) = fast_two_sum(sh, sl + th);
    fast_two_sum(vh, tl + vl)
}

/// DWTimesDW1 without its last sum: (p, e) with |e| ≤ 3.1u |p|.
#[inline(always)]
fn product<T: Machine>((ah, al): (T, T), (bh, bl): (T, T)) -> (T, T) {
    let (product, error) = ah.two_product(bh);
    (product, error + (ah * bl + al * bh))
}

impl<T: Machine> DoubleDouble<T> {
    /// The sum of two machine numbers, exactly.
    ///
    /// ```
    /// use shadowstep::number::DoubleDouble;
    /// assert_eq!(DoubleDouble::new(1e-20, 1.0).parts(), (1.0, 1e-20));
    /// ```
    #[inline]
    pub fn new(a: T, b: T) -> Self {
        DoubleDouble::of(two_sum(a, b))
    }

    /// a + b c; the product enters the sum without being a double word.
    #[inline(always)]
    pub(super) fn plus_product(self, b: Self, c: Self) -> Self {
        let product = product(b.parts(), c.parts());
        let plain = self.high + product.0;
        DoubleDouble::of(T::if_finite(plain, sum(self.parts(), product), plain))
    }

    /// a − b c
    #[inline(always)]
    pub(super) fn minus_product(self, b: Self, c: Self) -> Self {
        let (high, low) = product(b.parts(), c.parts());
        let plain = self.high - high;
        DoubleDouble::of(T::if_finite(plain, sum(self.parts(), (-high, -low)), plain))
    }

    /// a²
    #[inline(always)]
    pub(super) fn square(self) -> Self {
        let (square, error) = self.high.two_product(self.high);
        let mixed = self.high * self.low;
        DoubleDouble::of(T::if_finite(square, fast_two_sum(square, error + (mixed + mixed)), square))
    }

    /// √a by SQRTDWtoDW
    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        let root = self.high.sqrt();
        let (square, error) = root.two_product(root);
        let rest = (self.high - square) - error; // exact
        let low = (rest + self.low) / (root + root); // NaN if the root is 0 or not finite
        DoubleDouble::of(T::if_finite(low, fast_two_sum(root, low), root))
    }

    /// a b by DWTimesFP2
    #[inline(always)]
    pub(super) fn times(self, b: T) -> Self {
        let (product, error) = self.high.two_product(b);
        DoubleDouble::of(T::if_finite(product, fast_two_sum(product, error + self.low * b), product))
    }

    /// a / b by DWDivFP3
    #[inline(always)]
    pub(super) fn over(self, b: T) -> Self {
        let quotient = self.high / b;
        let (product, error) = quotient.two_product(b);
        let rest = ((self.high - product) - error) + self.low;
        DoubleDouble::of(T::if_finite(product, fast_two_sum(quotient, rest / b), quotient))
    }

    /// a b for a power of two b: exact
    #[inline(always)]
    pub(super) fn scaled(self, b: T) -> Self {
        DoubleDouble { high: self.high * b, low: self.low * b }
    }
}

impl<T: Machine> Neg for DoubleDouble<T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        DoubleDouble { high: -self.high, low: -self.low }
    }
}

impl<T: Machine> Add for DoubleDouble<T> {
    type Output = Self;

    #[inline(always)]
    fn add(self, b: Self) -> Self {
        let plain = self.high + b.high;
        DoubleDouble::of(T::if_finite(plain, sum(self.parts(), b.parts()), plain))
    }
}

impl<T: Machine> Sub for DoubleDouble<T> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl<T: Machine> Mul for DoubleDouble<T> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        let (high, low) = product(self.parts(), b.parts());
        DoubleDouble::of(T::if_finite(high, fast_two_sum(high, low), high))
    }
}

impl<T: Machine> Div for DoubleDouble<T> {
    type Output = Self;

    /// DWDivDW2
    #[inline(always)]
    fn div(self, b: Self) -> Self {
        let quotient = self.high / b.high;
        let (product, error) = b.high.two_product(quotient);
        let (rh, rl) = times_quotient(product, error, b.low * quotient);
        let rest = (self.high - rh) + (self.low - rl);
        // where b is infinite or 0, so is the product, or it is NaN
        DoubleDouble::of(T::if_finite(product, fast_two_sum(quotient, rest / b.high), quotient))
    }
}

/// The end of DWTimesFP1: the product with its error, and the product of the low part.
#[inline(always)]
fn times_quotient<T: Machine>(product: T, error: T, low: T) -> (T, T) {
    let (high, rest) = fast_two_sum(product, low);
    fast_two_sum(high, rest + error)
}
