//! Double-doubles as [`Number`]s.

use std::fmt;

use super::nearest::nearest;
use super::{DoubleDouble, Machine, decimal, exponential, root, trigonometric};
use crate::Rational;
use crate::number::double::{Copied, LARGEST_SQUARED};
use crate::number::scaled::scaled;
use crate::number::{BLOCK, Number, Real};

impl<T: Machine> DoubleDouble<T> {
    /// Applies a function of one number to each lane.
    #[inline(always)]
    fn assign_each(&mut self, a: &Self, function: impl Fn(DoubleDouble) -> DoubleDouble) {
        let [result] = T::each(a.parts(), |pair| [function(DoubleDouble::of(pair)).parts()]);
        *self = DoubleDouble::of(result);
    }
}

/// Functions of one number, applied to each lane.
macro_rules! functions {
    ($($assign:ident: $function:path;)*) => {$(
        #[inline(always)]
        fn $assign(&mut self, a: &Self) {
            self.assign_each(a, $function);
        }
    )*};
}

/// Increments are not kept. Without them, E_8 of Kepler's problem (e = 0.6) scatters by 0.15 u²/h from step to step: by
/// 2e-31 with h = 1/100, 2e-30 with h = 1/1000. To keep them would cost two more sums a coordinate and map.
impl<T: Machine> Number for DoubleDouble<T> {
    type Context = ();
    type Block = [Self; BLOCK];
    type InLanes = Self;
    const LANES: usize = T::LANES;
    type Register<'a>
        = Copied<Self>
    where
        T: 'a;

    /// For lanes; for one number the instruction for exact products is chosen where it is needed.
    #[inline(always)]
    fn in_widest_instructions<R>(work: impl FnOnce() -> R) -> R {
        T::in_widest_instructions(work)
    }

    crate::number::without_derivatives!();

    #[inline(always)]
    fn register(&mut self) -> Copied<Self> {
        Copied(*self)
    }

    fn zero((): &()) -> Self {
        DoubleDouble::every(0.0)
    }

    fn from_rational(value: &Rational, (): &()) -> Self {
        let (high, low) = nearest(value).parts();
        DoubleDouble { high: T::every(high), low: T::every(low) }
    }

    fn context(&self) {}

    #[inline(always)]
    fn assign_zero(&mut self) {
        *self = DoubleDouble::every(0.0);
    }

    #[inline(always)]
    fn assign(&mut self, a: &Self) {
        *self = *a;
    }

    #[inline(always)]
    fn assign_sum(&mut self, a: &Self, b: &Self) {
        *self = *a + *b;
    }

    #[inline(always)]
    fn assign_difference(&mut self, a: &Self, b: &Self) {
        *self = *a - *b;
    }

    #[inline(always)]
    fn assign_product(&mut self, a: &Self, b: &Self) {
        *self = *a * *b;
    }

    #[inline(always)]
    fn assign_quotient(&mut self, a: &Self, b: &Self) {
        *self = *a / *b;
    }

    #[inline(always)]
    fn assign_square(&mut self, a: &Self) {
        *self = a.square();
    }

    #[inline(always)]
    fn assign_sqrt(&mut self, a: &Self) {
        *self = a.sqrt();
    }

    #[inline(always)]
    fn assign_reciprocal_sqrt(&mut self, a: &Self) {
        *self = DoubleDouble::every(1.0) / a.sqrt();
    }

    #[inline(always)]
    fn assign_root(&mut self, a: &Self, n: u32) {
        self.assign_each(a, |a| root::root(a, n));
    }

    functions! {
        assign_exp: exponential::exp;
        assign_log: exponential::log;
        assign_sinh: exponential::sinh;
        assign_cosh: exponential::cosh;
        assign_tanh: exponential::tanh;
        assign_sin: trigonometric::sin;
        assign_cos: trigonometric::cos;
        assign_tan: trigonometric::tan;
        assign_atan: trigonometric::atan;
        assign_asin: trigonometric::asin;
        assign_acos: trigonometric::acos;
    }

    #[inline(always)]
    fn assign_sin_cos(sin: &mut Self, cos: &mut Self, a: &Self) {
        let sin_cos = |pair| {
            let (sin, cos) = trigonometric::sin_cos(DoubleDouble::of(pair));
            [sin.parts(), cos.parts()]
        };
        [*sin, *cos] = T::each(a.parts(), sin_cos).map(DoubleDouble::of);
    }

    #[inline(always)]
    fn add(&mut self, a: &Self) {
        *self = *self + *a;
    }

    #[inline(always)]
    fn subtract(&mut self, a: &Self) {
        *self = *self - *a;
    }

    #[inline(always)]
    fn multiply(&mut self, a: &Self) {
        *self = *self * *a;
    }

    #[inline(always)]
    fn divide(&mut self, a: &Self) {
        *self = *self / *a;
    }

    #[inline(always)]
    fn add_product(&mut self, a: &Self, b: &Self) {
        *self = self.plus_product(*a, *b);
    }

    #[inline(always)]
    fn subtract_product(&mut self, a: &Self, b: &Self) {
        *self = self.minus_product(*a, *b);
    }

    #[inline(always)]
    fn multiply_integer(&mut self, n: i32) {
        let factor = T::every(f64::from(n));
        *self = if n.unsigned_abs().is_power_of_two() { self.scaled(factor) } else { self.times(factor) };
    }

    #[inline(always)]
    fn divide_integer(&mut self, n: i32) {
        let divisor = f64::from(n);
        *self = if n.unsigned_abs().is_power_of_two() {
            self.scaled(T::every(divisor.recip()))
        } else {
            self.over(T::every(divisor))
        };
    }

    #[inline(always)]
    fn negate(&mut self) {
        *self = -*self;
    }

    #[inline(always)]
    fn make_absolute(&mut self) {
        *self = self.absolute();
    }

    #[inline(always)]
    fn make_at_least(&mut self, a: &Self) {
        *self = DoubleDouble::where_less(*self, *a, *a, *self);
    }

    #[inline(always)]
    fn make_at_most(&mut self, a: &Self) {
        *self = DoubleDouble::where_less(*a, *self, *a, *self);
    }

    fn make_nan_where_square_overflows(&mut self, a: &Self) {
        let [limit, infinity, nan] = [LARGEST_SQUARED.next_up(), f64::INFINITY, f64::NAN].map(DoubleDouble::every);
        let checked = DoubleDouble::where_less(a.absolute(), limit, *self, nan);
        *self = DoubleDouble::where_less(self.absolute(), infinity, checked, *self);
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> (f64, i64) {
        (self.high.lane(lane), 0)
    }

    fn set_lane(&mut self, lane: usize, m: f64, n: i64) {
        self.high.set_lane(lane, scaled(m, n));
        self.low.set_lane(lane, 0.0);
    }

    #[inline(always)]
    fn assign_lane(&mut self, lane: usize, a: &Self) {
        self.high.set_lane(lane, a.high.lane(lane));
        self.low.set_lane(lane, a.low.lane(lane));
    }

    #[inline(always)]
    fn is_finite(&self) -> bool {
        self.high.is_finite()
    }
}

impl From<f64> for DoubleDouble {
    fn from(x: f64) -> Self {
        DoubleDouble { high: x, low: 0.0 }
    }
}

impl Real for DoubleDouble {
    fn is_below_zero(&self) -> bool {
        self.high < 0.0
    }

    fn has_finite_square(&self) -> bool {
        self.high.has_finite_square()
    }

    fn to_f64(&self) -> f64 {
        self.high
    }

    fn log10_abs(&self) -> f64 {
        self.high.log10_abs()
    }

    fn to_text(&self) -> String {
        decimal::text(*self)
    }
}

impl fmt::Display for DoubleDouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.to_text())
    }
}
