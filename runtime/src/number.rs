//! Numbers of every kind behind one trait: `f64`, MPFR numbers of any precision, and wrappers.

pub mod counting;
mod double;
#[cfg(feature = "mpfr")]
mod multiprecision;

#[cfg(feature = "mpfr")]
pub use multiprecision::{Precision, PrecisionError};

/// MPFR's numbers, of the version that implements [`Number`].
#[cfg(feature = "mpfr")]
pub use rug::Float;

use crate::Rational;
use std::fmt;

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
/// assert_eq!(potential.to_text(), "12.5");
/// ```
pub trait Number: Clone + PartialOrd + fmt::Debug + fmt::Display {
    /// What a new number has to know: `()` for `f64`, the precision for MPFR.
    type Context: Clone + PartialEq + fmt::Debug;

    /// A new 0.
    fn zero(context: &Self::Context) -> Self;

    /// The number nearest to a rational one: a single rounding, whatever the size of its parts.
    fn from_rational(value: &Rational, context: &Self::Context) -> Self;

    /// The context that makes more numbers like this one.
    fn context(&self) -> Self::Context;

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
    fn assign_square(&mut self, a: &Self) {
        self.assign_product(a, a);
    }

    /// x ← √a
    fn assign_sqrt(&mut self, a: &Self);

    /// x ← 1/√a, in `f64` with two roundings
    fn assign_reciprocal_sqrt(&mut self, a: &Self);

    /// x ← exp a
    fn assign_exp(&mut self, a: &Self);

    /// x ← sin a
    fn assign_sin(&mut self, a: &Self);

    /// x ← cos a
    fn assign_cos(&mut self, a: &Self);

    /// sin ← sin a and cos ← cos a, in MPFR for little more than the price of one
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

    /// x ← x + a b, in `f64` with two roundings, as not every machine can fuse them
    fn add_product(&mut self, a: &Self, b: &Self);

    /// x ← x − a b, rounded like [`add_product`](Number::add_product)
    fn subtract_product(&mut self, a: &Self, b: &Self);

    /// x ← n x
    fn multiply_integer(&mut self, n: i32);

    /// x ← x / n
    fn divide_integer(&mut self, n: i32);

    /// x ← −x
    fn negate(&mut self);

    /// x ← |x|
    fn make_absolute(&mut self);

    /// Whether x < 0: false for −0 and for NaN.
    fn is_below_zero(&self) -> bool;

    /// Whether x is neither infinite nor NaN.
    fn is_finite(&self) -> bool;

    /// The nearest `f64`; infinite or 0 where that overflows or underflows.
    fn to_f64(&self) -> f64;

    /// log₁₀|x| also where x itself over- or underflows an `f64`; −∞ for 0.  Good for plots and
    /// for digits of agreement: the error is about 10⁻¹⁶ of the larger of it and 1.
    fn log10_abs(&self) -> f64;

    /// The shortest decimal text that reads back as the same number, as JSON writes numbers:
    /// `0.1`, `-1.25e-30`.  The words `NaN`, `inf` and `-inf` stand for what is no number there.
    /// (Of MPFR's numbers, some powers of two get one digit more than the shortest.)
    fn to_text(&self) -> String;
}

#[cfg(test)]
mod tests {
    //! Lists of what a number can do, for the tests of each kind of number.

    use super::Number;

    /// Every operation that rounds once, starting from x = c.
    pub(super) fn operations<N: Number>(a: &N, b: &N, c: &N) -> [N; 16] {
        let changes: [fn(&mut N, &N, &N); 16] = [
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

    /// 1/√a, exp a, sin a, cos a, and the last two together
    pub(super) fn functions<N: Number>(a: &N) -> [N; 6] {
        let mut results = [(); 6].map(|()| N::zero(&a.context()));
        let [reciprocal_sqrt, exp, sin, cos, sin_too, cos_too] = &mut results;
        reciprocal_sqrt.assign_reciprocal_sqrt(a);
        exp.assign_exp(a);
        sin.assign_sin(a);
        cos.assign_cos(a);
        N::assign_sin_cos(sin_too, cos_too, a);
        results
    }
}
