//! `f64` with fused products.

use std::fmt;
use std::ops::{Deref, DerefMut};

use super::scaled::scaled;
use super::{BLOCK, Number, Real};
use crate::Rational;
use crate::number::instructions;

/// An `f64` whose sums with a product, such as [`add_product`](Number::add_product), round once, as [`f64::mul_add`]
/// does.
///
/// Results have other bits than in `f64`, the same on all machines apart from elementary functions.
///
/// The instruction of the processor is used by [`Stepper::steps`](crate::Stepper::steps), wherever the program runs,
/// and by all loops in a program that is built for such a processor (`-C target-cpu=native`) or for ARM64. Elsewhere,
/// as in a loop of [`Stepper::step`](crate::Stepper::step), each product is a call of a function: the results are the
/// same, but it is slower than `f64`.
///
/// ```
/// use shadowstep::number::Fused;
/// use shadowstep::{Motion, Stepper, UnitMasses, problems::HenonHeiles, tables::shipped};
///
/// let stepper = Stepper::new(shipped("yoshida4").unwrap(), "1/20")?;
/// let mut motion = Motion::new(HenonHeiles, UnitMasses, [0.1, 0.2].map(Fused), [0.1, 0.0].map(Fused))?;
/// let start = motion.energy().0;
/// stepper.steps(std::slice::from_mut(&mut motion), 10_000);
/// assert!((motion.energy().0 - start).abs() < 1e-8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Fused(pub f64);

impl fmt::Display for Fused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// A number of its own.
#[derive(Debug)]
pub struct Copied(Fused);

impl Deref for Copied {
    type Target = Fused;

    #[inline(always)]
    fn deref(&self) -> &Fused {
        &self.0
    }
}

impl DerefMut for Copied {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut Fused {
        &mut self.0
    }
}

/// Methods taken from `f64`.
macro_rules! delegate {
    ($($method:ident($($operand:ident),*);)*) => {$(
        #[inline(always)]
        fn $method(&mut self, $($operand: &Self),*) {
            self.0.$method($(&$operand.0),*);
        }
    )*};
}

impl Number for Fused {
    type Context = ();
    type Block = [Self; BLOCK];
    type InLanes = Self;
    const KEEPS_INCREMENTS: bool = true;
    const IN_VECTORS: bool = true;
    type Register<'a> = Copied;

    crate::number::without_derivatives!();

    #[inline(always)]
    fn register(&mut self) -> Copied {
        Copied(*self)
    }

    #[inline(always)]
    fn in_widest_instructions<R>(work: impl FnOnce() -> R) -> R {
        instructions::widest(work)
    }

    #[inline(always)]
    fn zero((): &()) -> Self {
        Fused(0.0)
    }

    fn from_rational(value: &Rational, (): &()) -> Self {
        Fused(f64::from_rational(value, &()))
    }

    fn context(&self) {}

    /// x ← x + a b, with one rounding
    #[inline(always)]
    fn add_product(&mut self, a: &Self, b: &Self) {
        self.0 = a.0.mul_add(b.0, self.0);
    }

    /// x ← x − a b, with one rounding
    #[inline(always)]
    fn subtract_product(&mut self, a: &Self, b: &Self) {
        self.0 = (-a.0).mul_add(b.0, self.0);
    }

    /// x ← c + a b, with one rounding
    #[inline(always)]
    fn assign_sum_with_product(&mut self, c: &Self, _: &Self, a: &Self, b: &Self) {
        self.0 = a.0.mul_add(b.0, c.0);
    }

    /// x ← c − a b, with one rounding
    #[inline(always)]
    fn assign_difference_with_product(&mut self, c: &Self, _: &Self, a: &Self, b: &Self) {
        self.0 = (-a.0).mul_add(b.0, c.0);
    }

    /// x ← a b + c, with one rounding
    #[inline(always)]
    fn add_to_product(&mut self, c: &Self, a: &Self, b: &Self) {
        self.0 = a.0.mul_add(b.0, c.0);
    }

    delegate! {
        assign_zero();
        assign(a);
        assign_sum(a, b);
        assign_difference(a, b);
        assign_product(a, b);
        assign_quotient(a, b);
        assign_square(a);
        assign_sqrt(a);
        assign_reciprocal_sqrt(a);
        assign_exp(a);
        assign_sin(a);
        assign_cos(a);
        assign_log(a);
        assign_tan(a);
        assign_sinh(a);
        assign_cosh(a);
        assign_tanh(a);
        assign_atan(a);
        assign_asin(a);
        assign_acos(a);
        add(a);
        subtract(a);
        multiply(a);
        divide(a);
        negate();
        make_absolute();
        make_at_least(a);
        make_at_most(a);
        make_nan_where_square_overflows(a);
    }

    #[inline(always)]
    fn multiply_integer(&mut self, n: i32) {
        self.0.multiply_integer(n);
    }

    #[inline(always)]
    fn divide_integer(&mut self, n: i32) {
        self.0.divide_integer(n);
    }

    fn assign_root(&mut self, a: &Self, n: u32) {
        self.0.assign_root(&a.0, n);
    }

    #[inline(always)]
    fn lane(&self, _: usize) -> (f64, i64) {
        (self.0, 0)
    }

    fn set_lane(&mut self, _: usize, m: f64, n: i64) {
        *self = Fused(scaled(m, n));
    }

    #[inline(always)]
    fn assign_lane(&mut self, _: usize, a: &Self) {
        *self = *a;
    }

    #[inline(always)]
    fn is_finite(&self) -> bool {
        self.0.is_finite()
    }
}

impl Real for Fused {
    fn is_below_zero(&self) -> bool {
        self.0.is_below_zero()
    }

    fn has_finite_square(&self) -> bool {
        self.0.has_finite_square()
    }

    fn to_f64(&self) -> f64 {
        self.0
    }

    fn log10_abs(&self) -> f64 {
        self.0.log10_abs()
    }

    fn to_text(&self) -> String {
        self.0.to_text()
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{functions, operations, products};
    use super::*;
    use crate::number::instructions::Instructions;
    use crate::steps::tables::shipped;
    use crate::systems::problems::HenonHeiles;
    use crate::{Motion, Stepper, UnitMasses};

    #[test]
    fn operations_are_those_of_f64_but_for_products() {
        let [a, b, c] = [0.1, -7.3, 1e-3];
        let [x, y, z] = [a, b, c].map(Fused);
        assert_eq!(operations(&x, &y, &z), operations(&a, &b, &c).map(Fused));
        assert_eq!(functions(&x), functions(&a).map(Fused));
        assert_eq!(products(&x, &y, &z), [a.mul_add(b, c), (-a).mul_add(b, c)].map(Fused));
        assert_eq!([y.to_f64(), y.log10_abs()], [b, b.log10_abs()]);
        assert!(y.is_below_zero() && y.is_finite() && y.has_finite_square() && y.to_text() == "-7.3");
    }

    #[test]
    fn products_round_once() {
        // a² = 1 + 2ε + ε², and rounded 1 + 2ε
        let a = Fused(1.0 + f64::EPSILON);
        let mut square = a;
        square.assign_square(&a);
        assert_eq!(products(&a, &a, &square)[1], Fused(-f64::EPSILON * f64::EPSILON));
    }

    #[test]
    fn sums_with_known_products_round_once() {
        let a = Fused(1.0 + f64::EPSILON);
        let [mut product, mut sum, mut difference] = [a; 3];
        product.assign_square(&a);
        let minus = Fused(-product.0);
        sum.assign_sum_with_product(&minus, &product, &a, &a);
        difference.assign_difference_with_product(&product, &product, &a, &a);
        let mut in_place = product;
        in_place.add_to_product(&minus, &a, &a);
        assert_eq!([sum, difference, in_place].map(|x| x.0 / f64::EPSILON.powi(2)), [1.0, -1.0, 1.0]);
        // of other numbers they are sums of two numbers
        let (a, product) = (a.0, product.0);
        let [mut sum, mut difference, mut in_place] = [a, a, product];
        sum.assign_sum_with_product(&-product, &product, &a, &a);
        difference.assign_difference_with_product(&product, &product, &a, &a);
        in_place.add_to_product(&-product, &a, &a);
        assert_eq!([sum, difference, in_place], [0.0; 3]);
    }

    #[test]
    fn plain_and_augmented_steps_have_the_same_bits() {
        let stepper = Stepper::new(shipped("yoshida4").unwrap(), "1/20").unwrap();
        let mut plain = Motion::new(HenonHeiles, UnitMasses, [0.1, 0.2].map(Fused), [0.1, 0.0].map(Fused)).unwrap();
        let mut augmented = plain.clone();
        for _ in 0..100 {
            stepper.step(&mut plain);
            stepper.step_augmented(&mut augmented);
            assert_eq!((plain.q(), plain.p()), (augmented.q(), augmented.p()));
        }
    }

    /// With instructions for products and without them.
    #[test]
    fn steps_have_the_same_bits_in_all_instructions() {
        let stepper = Stepper::new(shipped("yoshida4").unwrap(), "1/20").unwrap();
        let start = Motion::new(HenonHeiles, UnitMasses, [0.1, 0.2].map(Fused), [0.1, 0.0].map(Fused)).unwrap();
        let mut one_by_one = start.clone();
        (0..1000).for_each(|_| stepper.step(&mut one_by_one));
        for instructions in Instructions::available() {
            let mut motion = start.clone();
            instructions.only(|| stepper.steps(std::slice::from_mut(&mut motion), 1000));
            assert_eq!((motion.q(), motion.p()), (one_by_one.q(), one_by_one.p()), "{instructions:?}");
        }
        let mut unfused = Motion::new(HenonHeiles, UnitMasses, [0.1, 0.2], [0.1, 0.0]).unwrap();
        let stepper = Stepper::new(shipped("yoshida4").unwrap(), "1/20").unwrap();
        stepper.steps(std::slice::from_mut(&mut unfused), 1000);
        assert_ne!(unfused.q().to_vec(), one_by_one.q().iter().map(|q| q.0).collect::<Vec<_>>());
    }
}
