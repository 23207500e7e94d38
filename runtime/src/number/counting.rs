//! What a computation costs: a number that counts its operations.

use super::{BLOCK, CorrectlyRounded, HighPrecision, Number, Precision, Real};
use crate::Rational;
use std::cell::Cell;
use std::fmt;

/// Numbers of operations on [`Counting`] numbers: the stated cost of a program of `shadowstep_schemes::symbolic` is counted in
/// the same way.
pub use shadowstep_schemes::symbolic::Operations;

thread_local! {
    /// all operations of this thread so far
    static TALLY: Cell<Operations> = const {
        Cell::new(Operations { additions: 0, multiplications: 0, divisions: 0, roots: 0, elementary: 0 })
    };
}

/// What `work` returns, and its operations on [`Counting`] numbers in this thread.
///
/// ```
/// use shadowstep::number::Number;
/// use shadowstep::number::counting::{Counting, count};
///
/// let x = Counting(3.0);
/// let (y, cost) = count(|| {
///     let mut y = x;
///     y.add_product(&x, &x);
///     y.divide_integer(4);
///     y
/// });
/// assert_eq!(y.0, 3.0);
/// assert_eq!(cost.to_string(), "1 addition, 1 multiplication, 1 division");
/// ```
pub fn count<R>(work: impl FnOnce() -> R) -> (R, Operations) {
    let before = TALLY.get();
    let result = work();
    let after = TALLY.get();
    let operations = Operations {
        additions: after.additions - before.additions,
        multiplications: after.multiplications - before.multiplications,
        divisions: after.divisions - before.divisions,
        roots: after.roots - before.roots,
        elementary: after.elementary - before.elementary,
    };
    (result, operations)
}

/// A number whose operations are counted, by [`count`].
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Counting<N>(pub N);

impl<N: fmt::Display> fmt::Display for Counting<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

fn tally(change: impl FnOnce(&mut Operations)) {
    let mut operations = TALLY.get();
    change(&mut operations);
    TALLY.set(operations);
}

/// Methods on numbers that are done by the number inside, and what each counts as.
macro_rules! delegate {
    ($($method:ident($($operand:ident),*) $($kind:ident)*;)*) => {$(
        fn $method(&mut self, $($operand: &Self),*) {
            $(tally(|operations| operations.$kind += 1);)*
            self.0.$method($(&$operand.0),*);
        }
    )*};
}

impl<N: Number> Number for Counting<N> {
    type Context = N::Context;
    type Block = [Self; BLOCK];
    type InLanes = Self;
    const LANES: usize = N::LANES;
    type Register<'a>
        = &'a mut Self
    where
        N: 'a;

    crate::number::without_derivatives!();

    fn register(&mut self) -> &mut Self {
        self
    }

    delegate! {
        assign_zero();
        assign(a);
        assign_sum(a, b) additions;
        assign_difference(a, b) additions;
        assign_product(a, b) multiplications;
        assign_quotient(a, b) divisions;
        assign_square(a) multiplications;
        assign_sqrt(a) roots;
        assign_reciprocal_sqrt(a) roots;
        assign_exp(a) elementary;
        assign_sin(a) elementary;
        assign_cos(a) elementary;
        assign_log(a) elementary;
        assign_tan(a) elementary;
        assign_sinh(a) elementary;
        assign_cosh(a) elementary;
        assign_tanh(a) elementary;
        assign_atan(a) elementary;
        assign_asin(a) elementary;
        assign_acos(a) elementary;
        add(a) additions;
        subtract(a) additions;
        multiply(a) multiplications;
        divide(a) divisions;
        add_product(a, b) multiplications additions;
        subtract_product(a, b) multiplications additions;
        negate();
        make_absolute();
        make_at_least(a);
        make_at_most(a);
        make_nan_where_square_overflows(a);
    }

    fn zero(context: &N::Context) -> Self {
        Counting(N::zero(context))
    }

    fn from_rational(value: &Rational, context: &N::Context) -> Self {
        Counting(N::from_rational(value, context))
    }

    fn context(&self) -> N::Context {
        self.0.context()
    }

    fn assign_sin_cos(sin: &mut Self, cos: &mut Self, a: &Self) {
        tally(|operations| operations.elementary += 1);
        N::assign_sin_cos(&mut sin.0, &mut cos.0, &a.0);
    }

    fn multiply_integer(&mut self, n: i32) {
        tally(|operations| operations.multiplications += 1);
        self.0.multiply_integer(n);
    }

    fn assign_root(&mut self, a: &Self, n: u32) {
        tally(|operations| operations.roots += 1);
        self.0.assign_root(&a.0, n);
    }

    fn divide_integer(&mut self, n: i32) {
        tally(|operations| operations.divisions += 1);
        self.0.divide_integer(n);
    }

    fn lane(&self, lane: usize) -> (f64, i64) {
        self.0.lane(lane)
    }

    fn set_lane(&mut self, lane: usize, m: f64, n: i64) {
        self.0.set_lane(lane, m, n);
    }

    fn assign_lane(&mut self, lane: usize, a: &Self) {
        self.0.assign_lane(lane, &a.0);
    }

    fn is_finite(&self) -> bool {
        self.0.is_finite()
    }
}

impl<N: CorrectlyRounded> CorrectlyRounded for Counting<N> {
    fn precision(context: &N::Context) -> Precision {
        N::precision(context)
    }

    fn assign_rounded(&mut self, a: &impl HighPrecision) {
        self.0.assign_rounded(a);
    }
}

impl<N: Real> Real for Counting<N> {
    fn is_below_zero(&self) -> bool {
        self.0.is_below_zero()
    }

    fn has_finite_square(&self) -> bool {
        self.0.has_finite_square()
    }

    fn to_f64(&self) -> f64 {
        self.0.to_f64()
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

    #[test]
    fn results_are_those_of_the_number_inside() {
        let [a, b, c] = [0.1, -7.3, 1e-3];
        let [x, y, z] = [a, b, c].map(Counting);
        assert_eq!(operations(&x, &y, &z), operations(&a, &b, &c).map(Counting));
        assert_eq!(products(&x, &y, &z), products(&a, &b, &c).map(Counting));
        assert_eq!(functions(&x), functions(&a).map(Counting));
        assert_eq!(y.to_text(), b.to_text());
        assert_eq!(y.to_string(), b.to_string());
        assert_eq!([y.to_f64(), y.log10_abs()], [b, b.log10_abs()]);
        assert!(y.is_below_zero() && y.is_finite() && y.has_finite_square());
    }

    #[test]
    fn each_operation_counts() {
        let [a, b, c] = [0.1, -7.3, 1e-3].map(Counting);
        let counted = [
            count(|| _ = operations(&a, &b, &c)).1,
            count(|| _ = products(&a, &b, &c)).1,
            count(|| _ = functions(&a)).1,
        ];
        assert_eq!(
            counted.map(|operations| operations.to_string()),
            [
                "4 additions, 4 multiplications, 3 divisions, 1 root",
                "2 additions, 2 multiplications",
                "1 division, 3 roots, 13 elementary functions",
            ]
        );
    }

    #[test]
    fn counts_nest_and_begin_at_zero() {
        let mut x = Counting(1.5);
        let one = |x: &mut Counting<f64>| x.multiply_integer(2);
        let (inner, outer) = count(|| {
            one(&mut x);
            count(|| one(&mut x)).1
        });
        assert_eq!([inner.multiplications, outer.multiplications], [1, 2]);
        assert_eq!(count(|| x.negate()).1.to_string(), "no operations");
    }
}
