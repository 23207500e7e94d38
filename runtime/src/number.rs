//! Numbers of every kind behind one trait: `f64`, several of them in lanes, numbers of some limbs, MPFR numbers of any
//! precision, and wrappers.

mod block;
mod correctly_rounded;
#[cfg(feature = "formulas")]
#[doc(hidden)]
pub mod counting;
mod double;
mod double_double;
mod dual;
mod epsilon;
mod fused;
mod high_precision;
#[doc(hidden)]
pub mod instructions;
mod lane_access;
mod lanes;
mod limb_access;
mod limbs;
#[cfg(feature = "mpfr")]
mod multiprecision;
pub(crate) mod partial_sums;
mod precision;
pub mod saved;
mod scaled;
pub(crate) mod value;

pub use block::{BLOCK, Block};
pub use correctly_rounded::CorrectlyRounded;
pub use high_precision::{HighPrecision, ScaledInteger};
pub use precision::{Precision, PrecisionError};

/// Numbers of 64-bit limbs, whose number is part of the type or chosen at run time: `shadowstep_limbs`.
pub use shadowstep_limbs::{AnyLimbs, LimbCount, Limbs};

/// MPFR's numbers, of the version that implements [`Number`].
#[cfg(feature = "mpfr")]
pub use rug::Float;

pub use double_double::{DoubleDouble, Machine};

#[doc(hidden)]
pub use dual::DualBlock;
pub use dual::{Dual, ParameterError, with_parameter};
pub(crate) use epsilon::epsilon;
pub use fused::Fused;
#[doc(hidden)]
pub use lane_access::LaneAccess;
pub use lanes::Lanes;
#[doc(hidden)]
pub use limb_access::{LimbAccess, Parts};
pub(crate) use scaled::scaled;

use crate::Rational;
use std::fmt;
use std::ops::DerefMut;

/// The [parts](Number::dual_parts) of a number that has no derivatives.
macro_rules! without_derivatives {
    () => {
        type Plain = Self;

        #[inline(always)]
        fn dual_parts(&self) -> (&Self, &[Self]) {
            (self, &[])
        }

        #[inline(always)]
        fn dual_parts_mut(&mut self) -> (&mut Self, &mut [Self]) {
            (self, &mut [])
        }
    };
}
pub(crate) use without_derivatives;

/// A real number that computes in place.
///
/// A big number owns memory, so `a * b + c` would allocate for each intermediate result.  Here
/// every operation writes into a number that exists already, in one of two forms:
///
/// - `x.assign_sum(a, b)` forgets `x` and writes a result of other numbers: x ← a + b;
/// - `x.add(a)`, a verb, changes `x`: x ← x + a.
///
/// Nothing allocates, except for MPFR inside its elementary functions (exp, sin, cos) and, above
/// some 3000 bits, wherever it needs much room.  Each operation rounds once, to nearest with ties
/// to even, unless its documentation says otherwise.  Nothing panics: as IEEE 754 has it, 1/0 is
/// an infinity and 0/0 is not a number (NaN).
///
/// Apart from the elementary functions, whose `f64` versions come from the platform, the same
/// input gives the same bits on every machine.
///
/// All numbers of one computation share a [context](Number::Context), thus a precision.  (MPFR
/// rounds to the precision of the number that it writes to.)
///
/// ```
/// use shadowstep::number::Number;
///
/// /// out ← (x² + y²)/2
/// fn harmonic<N: Number>(x: &N, y: &N, out: &mut N) {
///     out.assign_square(x);
///     out.add_product(y, y);
///     out.divide_integer(2);
/// }
///
/// let mut potential = f64::zero(&());
/// harmonic(&3.0, &4.0, &mut potential);
/// assert_eq!(potential, 12.5);
/// ```
///
/// There is no order, and no text: a number may be several at once, as in lanes. What compares, searches or prints
/// needs an [`Real`] number; potentials, kinetic energies and steps do not.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a type of numbers that systems and steps have",
    note = "write `[1.0, 0.0]` for `f64`; many digits are those of `Motion::exact`"
)]
pub trait Number: Clone + fmt::Debug {
    /// What a new number needs: `()` for `f64` and [`Limbs`], the number of limbs for [`AnyLimbs`], the precision for
    /// MPFR.
    type Context: Clone + PartialEq + fmt::Debug;

    /// Whether a system keeps the increments of q and p, from which estimators then take the differences of states.
    ///
    /// This keeps the round-off of the states out of the differences, which `f64` needs; with more digits it is not
    /// necessary.
    const KEEPS_INCREMENTS: bool = false;

    /// Whether several of these numbers fit into a vector of the processor, so that sums over pairs of bodies take
    /// blocks of bodies.
    const IN_VECTORS: bool = false;

    /// How many numbers this is: those in lanes, else 1.
    const LANES: usize = 1;

    /// Whether a number has derivatives beside its value, as a [`Dual`] has.
    const HAS_DERIVATIVES: bool = false;

    /// For a number made of 64-bit limbs, with which estimators then compute in fixed point; without it they compute
    /// with numbers.
    #[doc(hidden)]
    const LIMBS: Option<LimbAccess<Self>> = None;

    /// For a number of which a system computes several at once, with the same bits, how they are put into
    /// [lanes](Number::InLanes).
    #[doc(hidden)]
    const LANE_ACCESS: Option<LaneAccess<Self, Self::InLanes>> = None;

    /// What a [dual number](Dual) consists of; another number itself.
    #[doc(hidden)]
    type Plain: Number<Context = Self::Context>;

    /// Its value, and its derivatives.
    #[doc(hidden)]
    fn dual_parts(&self) -> (&Self::Plain, &[Self::Plain]);

    /// The same, to be changed.
    #[doc(hidden)]
    fn dual_parts_mut(&mut self) -> (&mut Self::Plain, &mut [Self::Plain]);

    /// Several of these numbers at once; the number itself where there are none.
    #[doc(hidden)]
    type InLanes: Number<Context = Self::Context>;

    /// Numbers side by side, in the form that loops over pairs compute with: `[Self; BLOCK]` unless a number has parts.
    type Block: Block<Self>;

    /// Holds an intermediate result: for a big number, `&mut Self`; for one of a few bytes a copy, which can stay in
    /// the processor's registers.
    type Register<'a>: DerefMut<Target = Self>
    where
        Self: 'a;

    /// This number, or a copy of it, as a place for an intermediate result: its value is lost.
    fn register(&mut self) -> Self::Register<'_>;

    /// Does some work, of numbers in lanes in the widest vector instructions that the processor has: of the whole loop,
    /// as all that is not inlined into it is not compiled for them. See `number::instructions`.
    #[inline(always)]
    fn in_widest_instructions<R>(work: impl FnOnce() -> R) -> R {
        work()
    }

    /// A new 0.
    fn zero(context: &Self::Context) -> Self;

    /// The number nearest to a rational one: a single rounding, whatever the size of its parts.
    fn from_rational(value: &Rational, context: &Self::Context) -> Self;

    /// The context that makes more numbers like this one.
    fn context(&self) -> Self::Context;

    /// A context of at most this number of bits whose numbers take those of the given one as operands, and round them;
    /// the given one where all numbers of a computation need the same context.
    fn coarser(context: &Self::Context, bits: u32) -> Self::Context {
        let _ = bits;
        context.clone()
    }

    /// x ← 0
    fn assign_zero(&mut self);

    /// x ← a
    fn assign(&mut self, a: &Self);

    /// x ← a + b
    fn assign_sum(&mut self, a: &Self, b: &Self);

    /// x ← a − b
    fn assign_difference(&mut self, a: &Self, b: &Self);

    /// x ← a b
    fn assign_product(&mut self, a: &Self, b: &Self);

    /// x ← a / b
    fn assign_quotient(&mut self, a: &Self, b: &Self);

    /// x ← a²
    #[inline(always)]
    fn assign_square(&mut self, a: &Self) {
        self.assign_product(a, a);
    }

    /// x ← √a
    fn assign_sqrt(&mut self, a: &Self);

    /// x ← 1/√a, in `f64` with two roundings
    fn assign_reciprocal_sqrt(&mut self, a: &Self);

    /// x ← the real root of a of an order n ≥ 1; of a negative a only if n is odd, else NaN
    fn assign_root(&mut self, a: &Self, n: u32);

    /// x ← exp a
    fn assign_exp(&mut self, a: &Self);

    /// x ← sin a
    fn assign_sin(&mut self, a: &Self);

    /// x ← cos a
    fn assign_cos(&mut self, a: &Self);

    /// x ← log a, the natural logarithm
    fn assign_log(&mut self, a: &Self);

    /// x ← tan a
    fn assign_tan(&mut self, a: &Self);

    /// x ← sinh a
    fn assign_sinh(&mut self, a: &Self);

    /// x ← cosh a
    fn assign_cosh(&mut self, a: &Self);

    /// x ← tanh a
    fn assign_tanh(&mut self, a: &Self);

    /// x ← arctan a
    fn assign_atan(&mut self, a: &Self);

    /// x ← arcsin a
    fn assign_asin(&mut self, a: &Self);

    /// x ← arccos a
    fn assign_acos(&mut self, a: &Self);

    /// sin ← sin a and cos ← cos a, in MPFR for little more than the price of one
    #[inline]
    fn assign_sin_cos(sin: &mut Self, cos: &mut Self, a: &Self) {
        sin.assign_sin(a);
        cos.assign_cos(a);
    }

    /// x ← x + a
    fn add(&mut self, a: &Self);

    /// x ← x − a
    fn subtract(&mut self, a: &Self);

    /// x ← x a
    fn multiply(&mut self, a: &Self);

    /// x ← x / a
    fn divide(&mut self, a: &Self);

    /// x ← x + a b, in `f64` and [`Limbs`] with two roundings
    fn add_product(&mut self, a: &Self, b: &Self);

    /// x ← x − a b, rounded like [`add_product`](Number::add_product)
    fn subtract_product(&mut self, a: &Self, b: &Self);

    /// x ← c + a b, where `product` is a b, rounded: the sum of these two, unless the number type [fuses](Fused)
    /// products
    #[inline(always)]
    fn assign_sum_with_product(&mut self, c: &Self, product: &Self, a: &Self, b: &Self) {
        let _ = (a, b);
        self.assign_sum(product, c);
    }

    /// x ← c − a b, with the same rounding
    #[inline(always)]
    fn assign_difference_with_product(&mut self, c: &Self, product: &Self, a: &Self, b: &Self) {
        let _ = (a, b);
        self.assign_difference(c, product);
    }

    /// x ← x + c, where x is a b, rounded, with the same rounding
    #[inline(always)]
    fn add_to_product(&mut self, c: &Self, a: &Self, b: &Self) {
        let _ = (a, b);
        self.add(c);
    }

    /// x ← n x
    fn multiply_integer(&mut self, n: i32);

    /// x ← x / n
    fn divide_integer(&mut self, n: i32);

    /// x ← −x
    fn negate(&mut self);

    /// x ← |x|
    fn make_absolute(&mut self);

    /// x ← a where x < a, as in the search for the largest: x stays where one of them is NaN.
    fn make_at_least(&mut self, a: &Self);

    /// x ← a where x > a, as in the search for the smallest: x stays where one of them is NaN.
    fn make_at_most(&mut self, a: &Self);

    /// x ← NaN where x is finite, but not r² of two points in space with such a coordinate a: |a| > 3.8e153 in `f64`.
    fn make_nan_where_square_overflows(&mut self, a: &Self);

    /// Derivatives of x ← those of a; x stays. Iterations end when x does not change any more, which may be before its
    /// derivatives do not.
    #[inline(always)]
    fn assign_derivatives(&mut self, a: &Self) {
        let _ = a;
    }

    /// The number in a lane as m 2ⁿ, rounded to 53 bits, for decisions that depend on sizes. n is 0 of numbers that are
    /// `f64`s.
    fn lane(&self, lane: usize) -> (f64, i64);

    /// The number in a lane ← m 2ⁿ
    fn set_lane(&mut self, lane: usize, m: f64, n: i64);

    /// The number in a lane ← the number in this lane of a
    fn assign_lane(&mut self, lane: usize, a: &Self);

    /// Whether x is neither infinite nor NaN; of several numbers in lanes, whether all are so.
    fn is_finite(&self) -> bool;
}

/// A number that can be compared, converted and printed: one value, as opposed to several in lanes.
///
/// ```
/// use shadowstep::number::{Number, Real};
///
/// fn third<N: Real>(context: &N::Context) -> String {
///     let mut x = N::from_rational(&shadowstep::exact("1").unwrap(), context);
///     x.divide_integer(3);
///     x.to_text()
/// }
/// assert_eq!(third::<f64>(&()), "0.3333333333333333");
/// ```
pub trait Real: Number + PartialOrd + fmt::Display {
    /// Whether x < 0: false for −0 and for NaN.
    fn is_below_zero(&self) -> bool;

    /// Whether r² of two points in space with such coordinates is finite: |x| ≤ 3.8e153 in `f64`.
    fn has_finite_square(&self) -> bool {
        self.is_finite()
    }

    /// The nearest `f64`; infinite or 0 where that overflows or underflows.
    fn to_f64(&self) -> f64;

    /// log₁₀|x| also where x itself over- or underflows an `f64`; −∞ for 0.  Good for plots and
    /// for digits of agreement: the error is about 10⁻¹⁶ of the larger of it and 1.
    fn log10_abs(&self) -> f64;

    /// The shortest decimal text that reads back as the same number, as JSON writes numbers:
    /// `0.1`, `-1.25e-30`.  Values that are not finite are `NaN`, `inf` and `-inf`.
    /// (Of MPFR's numbers, some powers of two get one digit more than the shortest.)
    fn to_text(&self) -> String;
}

#[cfg(test)]
mod tests {
    //! Lists of what a number can do, for the tests of each kind of number.

    use super::Number;

    /// Every operation that rounds once, starting from x = c.
    pub(super) fn operations<N: Number>(a: &N, b: &N, c: &N) -> [N; 19] {
        let changes: [fn(&mut N, &N, &N); 19] = [
            |x, _, _| x.assign_zero(),
            |x, a, _| x.assign(a),
            |x, a, b| x.assign_sum(a, b),
            |x, a, b| x.assign_difference(a, b),
            |x, a, b| x.assign_product(a, b),
            |x, a, b| x.assign_quotient(a, b),
            |x, a, _| x.assign_square(a),
            |x, a, _| x.assign_sqrt(a),
            |x, a, _| x.add(a),
            |x, a, _| x.subtract(a),
            |x, a, _| x.multiply(a),
            |x, a, _| x.divide(a),
            |x, _, _| x.multiply_integer(-3),
            |x, _, _| x.divide_integer(-3),
            |x, _, _| x.negate(),
            |x, _, _| x.make_absolute(),
            |x, a, _| x.make_at_least(a),
            |x, a, _| x.make_at_most(a),
            |x, a, _| x.make_nan_where_square_overflows(a),
        ];
        changes.map(|change| {
            let mut x = c.clone();
            change(&mut x, a, b);
            x
        })
    }

    /// c + a b and c − a b
    pub(super) fn products<N: Number>(a: &N, b: &N, c: &N) -> [N; 2] {
        let [mut sum, mut difference] = [c.clone(), c.clone()];
        sum.add_product(a, b);
        difference.subtract_product(a, b);
        [sum, difference]
    }

    /// Every function, of a or, where a may be too large, of b = a/100; sine and cosine together come last.
    pub(super) fn functions<N: Number>(a: &N) -> [N; 16] {
        let mut b = a.clone();
        b.divide_integer(100);
        let functions: [fn(&mut N, &N, &N); 16] = [
            |x, a, _| x.assign_reciprocal_sqrt(a),
            |x, a, _| x.assign_exp(a),
            |x, a, _| x.assign_sin(a),
            |x, a, _| x.assign_cos(a),
            |x, a, _| x.assign_log(a),
            |x, _, b| x.assign_tan(b),
            |x, _, b| x.assign_sinh(b),
            |x, _, b| x.assign_cosh(b),
            |x, _, b| x.assign_tanh(b),
            |x, a, _| x.assign_atan(a),
            |x, _, b| x.assign_asin(b),
            |x, _, b| x.assign_acos(b),
            |x, a, _| x.assign_root(a, 3),
            |x, a, _| x.assign_root(a, 7),
            |x, a, _| N::assign_sin_cos(x, &mut a.clone(), a),
            |x, a, _| N::assign_sin_cos(&mut a.clone(), x, a),
        ];
        functions.map(|function| {
            let mut x = N::zero(&a.context());
            function(&mut x, a, &b);
            x
        })
    }
}
