//! Floating-point numbers of a fixed number of 64-bit limbs: correctly rounded arithmetic without allocation, C or
//! `unsafe`.
//!
//! [`Limbs<L>`](Limbs) has a significand of 64 L bits, for L from 2 to 16 (38 to 307 decimal digits), and exponents up
//! to 2^30 in magnitude. It is `Copy`, and all loops over its limbs have a fixed length.
//!
//! ```
//! use shadowstep_limbs::Limbs;
//!
//! let two: Limbs<7> = Limbs::from(2); // 134 digits
//! let root = two.sqrt();
//! let error = &root.square() - &two;
//! assert!(error.abs() <= two.times_power_of_two(-447));
//! ```
//!
//! [`AnyLimbs`] has as many limbs as are chosen at run time.
//!
//! With the feature `precompiled`, [`AnyLimbs`] and the elementary functions are compiled in this crate, once for all
//! crates of a program; without it, in each crate that uses them, and not at all where none does.
//!
//! Elementary functions are there for up to 16 limbs ([`exp`](Limbs::exp) and those after it), and decimal text that
//! reads back ([`to_text`](Limbs::to_text)). Arithmetic never allocates; functions do so for their tables, at first
//! use, and for sines of arguments above 2^2112.
//!
//! # Rounding
//!
//! Sums, differences, products, squares, quotients, square roots and their reciprocals, and conversions round to
//! nearest with ties to even: as MPFR does for 64 L bits. The same input gives the same bits on every machine.
//!
//! Elementary functions err by less than (1/2 + 2^-20) ulp. Some begin at a value of the platform's `f64` functions:
//! where that differs, so may the last bit, if a result is that close to the middle between two numbers.
//!
//! Zeros and infinities have signs, 1/0 is an infinity, and 0/0 is not a number (NaN): as IEEE 754 has it. A result of
//! magnitude 2^(2^30 − 1) or more is infinite. One below 2^−2^30, the smallest number other than 0, is that number or
//! 0, whichever is nearer: there are no denormal numbers.

#![forbid(unsafe_code)]

/// Functions that are compiled in this crate with the feature `precompiled`, and else in each crate that uses them.
macro_rules! precompiled {
    ($($function:item)*) => {$(
        #[cfg_attr(not(feature = "precompiled"), inline)]
        $function
    )*};
}

mod any;
mod convert;
mod decimal;
pub mod fixed;
mod functions;
mod natural;
mod newton;
mod order;
mod product;
mod quotient;
mod root;
mod round;
mod sum;

pub use any::{AnyLimbs, LimbCount};
pub use decimal::ParseError;

/// A floating-point number with a significand of L 64-bit limbs.
#[derive(Clone, Copy)]
pub struct Limbs<const L: usize> {
    /// the lowest limb first; the highest bit is 1, or all are 0 where the exponent says what this is
    mantissa: [u64; L],
    /// of 2: the number is mantissa / 2^(64 L) 2^exponent
    exponent: i32,
    negative: bool,
}

/// The exponents of finite numbers other than 0 have a smaller magnitude.
const EXPONENTS: i32 = 1 << 30;
const ZERO: i32 = i32::MIN;
const INFINITE: i32 = i32::MAX - 1;
const NAN: i32 = i32::MAX;

impl<const L: usize> Limbs<L> {
    const SUPPORTED: () = assert!(2 <= L && L <= 17, "the number of limbs has to be from 2 to 17");

    /// +0
    pub const ZERO: Self = Self::of_kind(false, ZERO);
    /// 1
    pub const ONE: Self = Self::power_of_two(1);
    /// +∞
    pub(crate) const INFINITY: Self = Self::of_kind(false, INFINITE);
    /// Not a number.
    pub(crate) const NAN: Self = Self::of_kind(false, NAN);

    /// The bits of the significand.
    pub const BITS: u32 = 64 * L as u32;

    const fn of_kind(negative: bool, kind: i32) -> Self {
        let () = Self::SUPPORTED;
        Limbs { mantissa: [0; L], exponent: kind, negative }
    }

    /// 2^(exponent − 1)
    const fn power_of_two(exponent: i32) -> Self {
        let mut mantissa = [0; L];
        mantissa[L - 1] = 1 << 63;
        Limbs { mantissa, exponent, negative: false }
    }

    /// x ← 0
    #[inline]
    pub const fn set_zero(&mut self) {
        *self = Self::ZERO;
    }

    /// x ← NaN
    #[inline]
    pub const fn set_nan(&mut self) {
        *self = Self::NAN;
    }

    /// Whether the number is finite and not 0.
    #[inline(always)]
    const fn is_regular(&self) -> bool {
        self.exponent.unsigned_abs() < EXPONENTS as u32
    }

    /// Whether the number is neither infinite nor NaN.
    #[inline]
    pub const fn is_finite(&self) -> bool {
        self.exponent < EXPONENTS
    }

    /// Whether r² of two points in space with such coordinates is finite: 3 (2x)² < (4x)².
    #[inline]
    pub const fn has_finite_square(&self) -> bool {
        self.is_zero() || self.is_regular() && self.exponent < EXPONENTS / 2 - 2
    }

    /// Whether the number is NaN.
    #[inline]
    pub const fn is_nan(&self) -> bool {
        self.exponent == NAN
    }

    /// Whether the number is infinite.
    #[inline]
    pub(crate) const fn is_infinite(&self) -> bool {
        self.exponent == INFINITE
    }

    /// Whether the number is 0 or −0.
    #[inline]
    pub const fn is_zero(&self) -> bool {
        self.exponent == ZERO
    }

    /// Whether the sign is −, also of −0.
    #[inline]
    pub const fn is_sign_negative(&self) -> bool {
        self.negative
    }

    /// |x|
    #[inline]
    pub const fn abs(self) -> Self {
        Limbs { negative: false, ..self }
    }

    /// e of |x| in [2^(e − 1), 2^e); none of 0, infinities and NaN.
    #[inline]
    pub const fn exponent(&self) -> Option<i32> {
        if self.is_regular() { Some(self.exponent) } else { None }
    }

    /// x 2^n
    #[inline]
    pub fn times_power_of_two(self, n: i32) -> Self {
        if !self.is_regular() {
            return self;
        }
        Self::in_range(self.negative, i64::from(self.exponent) + i64::from(n), self.mantissa)
    }
}
