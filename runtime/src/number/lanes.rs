//! Several `f64` at once: one trajectory a lane.

mod functions;

use super::scaled::scaled;
use super::{BLOCK, Number};
use crate::{Rational, number::instructions};
use functions::{cos_each, exp_each, log_each, sin_cos_each, sin_each};
use std::ops::{Deref, DerefMut};

/// W numbers of a kind, `f64`, on which every operation works at once: W trajectories of one system, one a lane.
///
/// Steps, potentials, kinetic energies, sums and the estimators of a fixed order work on lanes as on any [`Number`].
/// The compiler makes vector operations of them, the widest that a function may use.
///
/// **Bits.** A lane has the bits that `f64` has in its place, for arithmetic and roots and for tan, sinh, cosh, tanh,
/// arctan, arcsin and arccos, which are the platform's. exp, log, sin and cos are functions of vectors of this crate:
/// they have the same bits on every processor, but not always the bits of the platform's functions, which `f64` has.
/// Their errors are below 0.9 units in the last place, and below 1.01 where exp is subnormal; beyond |x| = 1 647 099,
/// which is 2²⁰·π/2, sin and cos are the platform's. A number does not depend on the numbers in other lanes, nor on the
/// instructions.
///
/// Lanes are aligned to 64 bytes, so that four lanes take the memory of eight.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Lanes<const W: usize>(pub [f64; W]);

impl<const W: usize> Lanes<W> {
    /// The same number in all lanes.
    #[inline(always)]
    pub fn all(x: f64) -> Self {
        Lanes([x; W])
    }

    /// x ← f(x) in each lane
    #[inline(always)]
    fn change(&mut self, f: impl Fn(f64) -> f64) {
        for x in &mut self.0 {
            *x = f(*x);
        }
    }

    // loops: in a long function the compiler does not inline `from_fn`, and calls it for each lane
    #[inline(always)]
    pub(super) fn of(a: &Self, f: impl Fn(f64) -> f64) -> Self {
        let mut found = *a;
        for i in 0..W {
            found.0[i] = f(a.0[i]);
        }
        found
    }

    #[inline(always)]
    pub(super) fn of_two(a: &Self, b: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut found = *a;
        for i in 0..W {
            found.0[i] = f(a.0[i], b.0[i]);
        }
        found
    }

    #[inline(always)]
    pub(super) fn of_three(x: &Self, a: &Self, b: &Self, f: impl Fn(f64, f64, f64) -> f64) -> Self {
        let mut found = *x;
        for i in 0..W {
            found.0[i] = f(x.0[i], a.0[i], b.0[i]);
        }
        found
    }
}

/// A copy, which can stay in the processor's registers.
#[derive(Debug)]
pub struct Copied<const W: usize>(Lanes<W>);

impl<const W: usize> Deref for Copied<W> {
    type Target = Lanes<W>;

    #[inline(always)]
    fn deref(&self) -> &Lanes<W> {
        &self.0
    }
}

impl<const W: usize> DerefMut for Copied<W> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut Lanes<W> {
        &mut self.0
    }
}

/// x ← f(a) in each lane, for methods of this form.
macro_rules! of_one {
    ($($method:ident: $f:expr;)*) => {$(
        #[inline(always)]
        fn $method(&mut self, a: &Self) {
            *self = Self::of(a, $f);
        }
    )*};
}

/// x ← f(a, b)
macro_rules! of_two {
    ($($method:ident: $f:expr;)*) => {$(
        #[inline(always)]
        fn $method(&mut self, a: &Self, b: &Self) {
            *self = Self::of_two(a, b, $f);
        }
    )*};
}

/// x ← f(x, a)
macro_rules! change_by_one {
    ($($method:ident: $f:expr;)*) => {$(
        #[inline(always)]
        fn $method(&mut self, a: &Self) {
            *self = Self::of_two(self, a, $f);
        }
    )*};
}

/// x ← f(x, a, b)
macro_rules! change_by_two {
    ($($method:ident: $f:expr;)*) => {$(
        #[inline(always)]
        fn $method(&mut self, a: &Self, b: &Self) {
            *self = Self::of_three(self, a, b, $f);
        }
    )*};
}

impl<const W: usize> Number for Lanes<W> {
    type Context = ();
    type Block = [Self; BLOCK];
    type InLanes = Self;
    const KEEPS_INCREMENTS: bool = true;
    const LANES: usize = W;
    type Register<'a> = Copied<W>;

    #[inline(always)]
    fn in_widest_instructions<R>(work: impl FnOnce() -> R) -> R {
        instructions::widest(work)
    }

    crate::number::without_derivatives!();

    #[inline(always)]
    fn register(&mut self) -> Copied<W> {
        Copied(*self)
    }

    #[inline(always)]
    fn zero((): &()) -> Self {
        Lanes::all(0.0)
    }

    fn from_rational(value: &Rational, (): &()) -> Self {
        Lanes::all(f64::from_rational(value, &()))
    }

    fn context(&self) {}

    #[inline(always)]
    fn assign_zero(&mut self) {
        *self = Lanes::all(0.0);
    }

    #[inline(always)]
    fn assign(&mut self, a: &Self) {
        *self = *a;
    }

    of_two! {
        assign_sum: |a, b| a + b;
        assign_difference: |a, b| a - b;
        assign_product: |a, b| a * b;
        assign_quotient: |a, b| a / b;
    }

    of_one! {
        assign_sqrt: f64::sqrt;
        assign_reciprocal_sqrt: |a| a.sqrt().recip();
        assign_tan: f64::tan;
        assign_sinh: f64::sinh;
        assign_cosh: f64::cosh;
        assign_tanh: f64::tanh;
        assign_atan: f64::atan;
        assign_asin: f64::asin;
        assign_acos: f64::acos;
    }

    change_by_one! {
        add: |x, a| x + a;
        subtract: |x, a| x - a;
        multiply: |x, a| x * a;
        divide: |x, a| x / a;
        make_at_least: |x, a| if x < a { a } else { x };
        make_at_most: |x, a| if x > a { a } else { x };
    }

    change_by_two! {
        add_product: |x, a, b| x + a * b;
        subtract_product: |x, a, b| x - a * b;
    }

    fn assign_exp(&mut self, a: &Self) {
        *self = *a;
        exp_each(&mut self.0);
    }

    fn assign_log(&mut self, a: &Self) {
        *self = *a;
        log_each(&mut self.0);
    }

    fn assign_sin(&mut self, a: &Self) {
        *self = *a;
        sin_each(&mut self.0);
    }

    fn assign_cos(&mut self, a: &Self) {
        *self = *a;
        cos_each(&mut self.0);
    }

    fn assign_sin_cos(sin: &mut Self, cos: &mut Self, a: &Self) {
        *sin = *a;
        sin_cos_each(&mut sin.0, &mut cos.0);
    }

    fn assign_root(&mut self, a: &Self, n: u32) {
        for (x, a) in self.0.iter_mut().zip(&a.0) {
            x.assign_root(a, n);
        }
    }

    #[inline(always)]
    fn multiply_integer(&mut self, n: i32) {
        let n = f64::from(n);
        self.change(|x| x * n);
    }

    #[inline(always)]
    fn divide_integer(&mut self, n: i32) {
        let n = f64::from(n);
        self.change(|x| x / n);
    }

    #[inline(always)]
    fn negate(&mut self) {
        self.change(|x| -x);
    }

    #[inline(always)]
    fn make_absolute(&mut self) {
        self.change(f64::abs);
    }

    fn make_nan_where_square_overflows(&mut self, a: &Self) {
        for (x, a) in self.0.iter_mut().zip(&a.0) {
            x.make_nan_where_square_overflows(a);
        }
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> (f64, i64) {
        (self.0[lane], 0)
    }

    fn set_lane(&mut self, lane: usize, m: f64, n: i64) {
        self.0[lane] = scaled(m, n);
    }

    #[inline(always)]
    fn assign_lane(&mut self, lane: usize, a: &Self) {
        self.0[lane] = a.0[lane];
    }

    fn is_finite(&self) -> bool {
        self.0.iter().all(|x| x.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{functions, operations, products};
    use super::*;
    use crate::number::instructions::Instructions;
    use proptest::prelude::*;
    use std::array::from_fn;

    /// The bits, of which a NaN has one kind only.
    fn bits(x: f64) -> u64 {
        if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() }
    }

    /// The results of operations on lanes, by lanes.
    fn by_lane<const W: usize, const K: usize>(results: [Lanes<W>; K]) -> [[u64; K]; W] {
        from_fn(|lane| results.map(|result| bits(result.0[lane])))
    }

    fn check<const W: usize>(a: &[f64], b: &[f64], c: &[f64]) -> Result<(), TestCaseError> {
        let [x, y, z] = [a, b, c].map(|list| Lanes::<W>(from_fn(|lane| list[lane])));
        for instructions in Instructions::available() {
            let found = instructions.only(|| {
                Lanes::<W>::in_widest_instructions(
                    #[inline(always)]
                    || (by_lane(operations(&x, &y, &z)), by_lane(products(&x, &y, &z))),
                )
            });
            for lane in 0..W {
                let [a, b, c] = [a, b, c].map(|list| list[lane]);
                prop_assert_eq!(found.0[lane], operations(&a, &b, &c).map(bits), "{:?}", instructions);
                prop_assert_eq!(found.1[lane], products(&a, &b, &c).map(bits), "{:?}", instructions);
            }
        }
        Ok(())
    }

    fn any_bits() -> impl Strategy<Value = Vec<f64>> {
        let special =
            prop::sample::select(vec![0.0, -0.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 5e-324, 3.9e153]);
        let moderate = (-1e3..1e3_f64).boxed();
        let one = prop_oneof![any::<u64>().prop_map(f64::from_bits), special, moderate];
        prop::collection::vec(one, 16)
    }

    proptest! {
        #[test]
        fn lanes_have_the_bits_of_f64(a in any_bits(), b in any_bits(), c in any_bits()) {
            check::<4>(&a, &b, &c)?;
            check::<8>(&a, &b, &c)?;
            check::<16>(&a, &b, &c)?;
        }

        #[test]
        fn a_lane_does_not_depend_on_the_others(a in any_bits(), b in any_bits()) {
            let together = by_lane(functions(&Lanes::<16>(from_fn(|lane| a[lane]))));
            let others = by_lane(functions(&Lanes::<16>(from_fn(|lane| if lane % 2 == 0 { a[lane] } else { b[lane] }))));
            for lane in 0..16 {
                prop_assert_eq!(together[lane], by_lane(functions(&Lanes([a[lane]])))[0], "{}", a[lane]);
                prop_assert!(lane % 2 == 1 || others[lane] == together[lane]);
            }
        }
    }
}
