//! Numbers with as many limbs as are chosen at run time.

use crate::Limbs;
use std::cmp::Ordering;
use std::fmt;
use std::ops::{AddAssign, DivAssign, MulAssign, Neg, SubAssign};

/// A number of 2 to 17 limbs; the number of limbs is chosen when it is made.
///
/// It has the bits of [`Limbs`] of as many limbs, whose operations this chooses at run time. A program that offers any
/// number of digits compiles what it computes for this one type. With the feature `precompiled` the operations are
/// compiled in this crate; without it, in each crate that uses them.
///
/// ```
/// use shadowstep_limbs::{AnyLimbs, LimbCount};
///
/// let limbs = LimbCount::of_bits(400).unwrap(); // 7 limbs, 448 bits
/// let two = AnyLimbs::from_f64(2.0, limbs);
/// assert_eq!(two.sqrt().resized(LimbCount::of_bits(64).unwrap()).to_text(), "1.41421356237309504880168872420969807857");
/// ```
///
/// # Panics
/// All numbers of an operation have to have the same number of limbs.
#[derive(Clone, Copy)]
pub struct AnyLimbs(Any);

/// How many limbs of 64 bits a number has: from 2 to 17.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct LimbCount(usize);

impl LimbCount {
    /// 17 limbs.
    pub const MOST: LimbCount = LimbCount(17);

    /// The fewest limbs with this number of bits; none beyond 17 limbs, 1088 bits.
    pub const fn of_bits(bits: u32) -> Option<LimbCount> {
        match bits.div_ceil(u64::BITS) as usize {
            0..=2 => Some(LimbCount(2)),
            limbs @ 3..=17 => Some(LimbCount(limbs)),
            _ => None,
        }
    }

    /// The number of limbs.
    pub const fn get(self) -> usize {
        self.0
    }

    /// The bits of a number of limbs.
    pub const fn bits(self) -> u32 {
        u64::BITS * self.0 as u32
    }
}

/// Calls a macro with its arguments and all numbers of limbs.
macro_rules! all_sizes {
    ($name:ident!($($argument:tt)*)) => {
        $name! { $($argument)* [
            Limbs2 2, Limbs3 3, Limbs4 4, Limbs5 5, Limbs6 6, Limbs7 7, Limbs8 8, Limbs9 9, Limbs10 10, Limbs11 11, Limbs12 12,
            Limbs13 13, Limbs14 14, Limbs15 15, Limbs16 16, Limbs17 17
        ] }
    };
}

macro_rules! define {
    ([$($Size:ident $limbs:literal),+]) => {
        #[derive(Clone, Copy)]
        #[allow(clippy::large_enum_variant, reason = "without allocation")]
        enum Any {
            $($Size(Limbs<$limbs>),)+
        }

        impl AnyLimbs {
            /// 0 with this number of limbs.
            pub const fn zero(count: LimbCount) -> AnyLimbs {
                match count.0 {
                    $($limbs => AnyLimbs(Any::$Size(Limbs::ZERO)),)+
                    _ => unreachable!(),
                }
            }

            /// How many limbs it has.
            pub const fn count(&self) -> LimbCount {
                match self.0 {
                    $(Any::$Size(_) => LimbCount($limbs),)+
                }
            }
        }
    };
}
all_sizes! { define!() }

/// An expression with numbers of the same number of limbs: `same_size!(x = &mut self.0, a = &a.0 => *x += a)`.
macro_rules! same_size {
    ($($name:ident = $value:expr),+ => $result:expr) => {
        all_sizes! { same_size!(@match ($($name)+) ($($value,)+), $result,) }
    };
    (@match $names:tt $values:expr, $result:expr, [$($Size:ident $limbs:literal),+]) => {
        match $values {
            $(same_size!(@pattern $Size $names) => $result,)+
            #[allow(unreachable_patterns, reason = "a single number")]
            _ => different_sizes(),
        }
    };
    (@pattern $Size:ident ($($name:ident)+)) => { ($(Any::$Size($name),)+) };
}

#[cold]
fn different_sizes() -> ! {
    panic!("the numbers of an operation have different numbers of limbs: make them with one context")
}

/// Methods of [`Limbs`] with the same meaning: those that change the number, that give another, and that describe it.
macro_rules! methods {
    (changes { $($change:ident($($a:ident),*);)+ } gives { $($give:ident($($n:ident)?);)+ } is { $($is:ident -> $result:ty;)+ }) => {
        $(
            precompiled! {
                #[doc = concat!("See [`Limbs::", stringify!($change), "`].")]
                pub fn $change(&mut self, $($a: &AnyLimbs),*) {
                    same_size!(x = &mut self.0 $(, $a = &$a.0)* => x.$change($($a),*))
                }
            }
        )+
        $(
            precompiled! {
                #[doc = concat!("See [`Limbs::", stringify!($give), "`].")]
                #[must_use]
                pub fn $give(&self $(, $n: i32)?) -> AnyLimbs {
                    let mut result = *self;
                    same_size!(result = &mut result.0, x = &self.0 => *result = x.$give($($n)?));
                    result
                }
            }
        )+
        $(
            precompiled! {
                #[doc = concat!("See [`Limbs::", stringify!($is), "`].")]
                pub fn $is(&self) -> $result {
                    same_size!(x = &self.0 => x.$is())
                }
            }
        )+
    };
}

impl AnyLimbs {
    methods! {
        changes {
            set_zero();
            set_nan();
            set_sum(a, b);
            set_difference(a, b);
            set_product(a, b);
            set_quotient(a, b);
            set_square(a);
            add_product(a, b);
            subtract_product(a, b);
        }
        gives {
            abs();
            times_integer(n);
            over_integer(n);
            times_power_of_two(n);
            square();
            sqrt();
            reciprocal_sqrt();
            exp();
            log();
            sin();
            cos();
            tan();
            sinh();
            cosh();
            tanh();
            atan();
            asin();
            acos();
        }
        is {
            is_finite -> bool;
            is_nan -> bool;
            is_zero -> bool;
            is_sign_negative -> bool;
            is_below_zero -> bool;
            has_finite_square -> bool;
            exponent -> Option<i32>;
            to_f64 -> f64;
            to_f64_exponent -> (f64, i32);
            to_text -> String;
        }
    }

    precompiled! {
        /// See [`Limbs::root`].
        #[must_use]
        pub fn root(&self, n: u32) -> AnyLimbs {
            let mut root = *self;
            same_size!(root = &mut root.0, x = &self.0 => *root = x.root(n));
            root
        }

        /// See [`Limbs::sin_cos`].
        #[must_use]
        pub fn sin_cos(&self) -> (AnyLimbs, AnyLimbs) {
            let (mut sin, mut cos) = (*self, *self);
            same_size!(sin = &mut sin.0, cos = &mut cos.0, x = &self.0 => (*sin, *cos) = x.sin_cos());
            (sin, cos)
        }

        /// See [`Limbs::mantissa`].
        pub fn mantissa(&self) -> &[u64] {
            same_size!(x = &self.0 => x.mantissa())
        }

        /// The nearest number with this number of limbs.
        #[must_use]
        pub fn resized(&self, count: LimbCount) -> AnyLimbs {
            match self.exponent() {
                Some(exponent) => {
                    let exponent = i64::from(exponent) - i64::from(self.count().bits());
                    AnyLimbs::from_magnitude(self.is_sign_negative(), self.mantissa(), exponent, false, count)
                }
                None => AnyLimbs::from_f64(self.to_f64(), count),
            }
        }

        /// See [`Limbs::from_magnitude`].
        pub fn from_magnitude(negative: bool, magnitude: &[u64], exponent: i64, more: bool, count: LimbCount) -> AnyLimbs {
            let mut x = AnyLimbs::zero(count);
            same_size!(x = &mut x.0 => *x = Limbs::from_magnitude(negative, magnitude, exponent, more));
            x
        }

        /// The number nearest to an `f64`, which is that number.
        pub fn from_f64(value: f64, count: LimbCount) -> AnyLimbs {
            let mut x = AnyLimbs::zero(count);
            same_size!(x = &mut x.0 => *x = Limbs::from(value));
            x
        }
    }
}

/// Operators in place.
macro_rules! operators {
    ($($Operator:ident, $operator:ident;)+) => {$(
        impl $Operator<&AnyLimbs> for AnyLimbs {
            precompiled! {
                fn $operator(&mut self, a: &AnyLimbs) {
                    same_size!(x = &mut self.0, a = &a.0 => x.$operator(a))
                }
            }
        }
    )+};
}

operators! {
    AddAssign, add_assign;
    SubAssign, sub_assign;
    MulAssign, mul_assign;
    DivAssign, div_assign;
}

impl Neg for AnyLimbs {
    type Output = AnyLimbs;

    precompiled! {
        fn neg(mut self) -> AnyLimbs {
            same_size!(x = &mut self.0 => *x = -*x);
            self
        }
    }
}

impl PartialEq for AnyLimbs {
    precompiled! {
        fn eq(&self, b: &AnyLimbs) -> bool {
            same_size!(a = &self.0, b = &b.0 => a == b)
        }
    }
}

impl PartialOrd for AnyLimbs {
    precompiled! {
        fn partial_cmp(&self, b: &AnyLimbs) -> Option<Ordering> {
            same_size!(a = &self.0, b = &b.0 => a.partial_cmp(b))
        }
    }
}

impl fmt::Debug for AnyLimbs {
    precompiled! {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            same_size!(x = &self.0 => fmt::Debug::fmt(x, f))
        }
    }
}

impl fmt::Display for AnyLimbs {
    precompiled! {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            same_size!(x = &self.0 => fmt::Display::fmt(x, f))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn third(bits: u32) -> AnyLimbs {
        AnyLimbs::from_f64(1.0, LimbCount::of_bits(bits).unwrap()).over_integer(3)
    }

    #[test]
    fn another_number_of_limbs_is_rounded_once() {
        let resized = |bits, other| third(bits).resized(LimbCount::of_bits(other).unwrap());
        assert_eq!(resized(1024, 192), third(192));
        assert_eq!(resized(128, 320).resized(third(128).count()), third(128));
        assert_ne!(resized(128, 320), third(320));
        let mut infinite = third(256);
        infinite /= &AnyLimbs::zero(infinite.count());
        assert_eq!(infinite.resized(third(128).count()).to_text(), "inf");
    }

    #[test]
    #[should_panic(expected = "different numbers of limbs")]
    fn different_numbers_of_limbs_are_refused() {
        let mut x = third(192);
        x += &third(256);
    }

    #[test]
    fn fewest_limbs_with_so_many_bits() {
        let limbs = |bits| LimbCount::of_bits(bits).map(LimbCount::get);
        for (bits, expected) in
            [(0, Some(2)), (128, Some(2)), (129, Some(3)), (400, Some(7)), (1088, Some(17)), (1089, None)]
        {
            assert_eq!(limbs(bits), expected, "{bits} bits");
        }
        assert_eq!(limbs(u32::MAX), None);
    }
}
