//! Dual numbers: a number with its derivatives along some directions.

mod block;
mod columns;
mod constants;
mod real;

pub use block::DualBlock;
pub use constants::{ParameterError, with_parameter};

use super::{LaneAccess, Number};
use crate::Rational;

/// A dual number x + Σ ẋ_k ε_k with ε_j ε_k = 0: a number x and its derivatives ẋ_1, …, ẋ_K along K directions.
///
/// Every operation is that of `N` on the numbers, and its derivative on the derivatives. So a step of a splitting
/// scheme, whatever the system, advances q and p with the bits that they have in `N`, and with them K tangent vectors
/// by the derivative of the step: by the *tangent map*. See [`tangent`](crate::tangent).
///
/// A derivative is rounded as `N` is, so that it is as exact as the condition of the formula allows. Where a function
/// has no derivative, as √x at 0, derivatives are infinite or NaN. |x|, the larger and the smaller of two numbers have
/// the derivative of the branch that is taken.
///
/// Comparisons and texts are those of x.
///
/// ```
/// use shadowstep::number::{Dual, Number};
///
/// let x = Dual::new(2.0, [1.0]);
/// let mut y = x;
/// y.assign_product(&x, &x);
/// y.multiply(&x);
/// assert_eq!((y.value, y.derivatives), (8.0, [12.0])); // x³ and 3x²
/// ```
///
/// W. K. Clifford, *Preliminary sketch of biquaternions*, Proc. London Math. Soc. 4 (1873) 381; as a way to derivatives
/// R. E. Wengert, *A simple automatic derivative evaluation program*, Comm. ACM 7 (1964) 463.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Dual<N, const K: usize = 1> {
    /// x
    pub value: N,
    /// ẋ_1, …, ẋ_K
    pub derivatives: [N; K],
}

impl<N: Number, const K: usize> Dual<N, K> {
    /// The number with these derivatives.
    #[inline(always)]
    pub fn new(value: N, derivatives: [N; K]) -> Self {
        Dual { value, derivatives }
    }

    /// The number with derivatives 0.
    #[inline(always)]
    pub fn constant(value: N) -> Self {
        let zero = N::zero(&value.context());
        Dual { value, derivatives: std::array::from_fn(|_| zero.clone()) }
    }

    /// Derivatives ← f(derivative, derivative of a)
    #[inline(always)]
    fn each(&mut self, a: &Self, f: impl Fn(&mut N, &N)) {
        for k in 0..K {
            f(&mut self.derivatives[k], &a.derivatives[k]);
        }
    }

    /// Derivatives ← those of a times a factor
    #[inline(always)]
    fn chain(&mut self, a: &Self, factor: &N) {
        self.each(a, |own, a| own.assign_product(a, factor));
    }

    /// x ← f(a), and the factor of the derivatives: `factor` assigns it, from f(a) and a.
    #[inline(always)]
    fn function(&mut self, a: &Self, f: impl FnOnce(&mut N, &N), factor: impl FnOnce(&mut N, &N, &N)) {
        f(&mut self.value, &a.value);
        let mut slope = a.value.clone();
        factor(&mut slope, &self.value, &a.value);
        self.chain(a, &slope);
    }
}

/// With derivatives 0.
impl<N: Number, const K: usize> From<N> for Dual<N, K> {
    fn from(value: N) -> Self {
        Dual::constant(value)
    }
}

/// x ← 1 + sign·a²
fn assign_one_and_square<N: Number>(x: &mut N, a: &N, sign: i32) {
    x.assign_square(a);
    x.multiply_integer(sign);
    x.add(&N::from_rational(&Rational::from_integer(1.into()), &a.context()));
}

/// x ← 1/x
fn invert<N: Number>(x: &mut N) {
    let denominator = x.clone();
    x.assign_quotient(&N::from_rational(&Rational::from_integer(1.into()), &denominator.context()), &denominator);
}

/// x ← 1/√(1 − a²)
fn assign_slope_of_arcsine<N: Number>(x: &mut N, a: &N) {
    let mut square = a.clone();
    assign_one_and_square(&mut square, a, -1);
    x.assign_reciprocal_sqrt(&square);
}

/// x ← f(a) with the derivative's factor as a function of x and a.
macro_rules! functions {
    ($($method:ident: |$slope:ident, $x:ident, $a:ident| $factor:expr;)*) => {$(
        #[inline(always)]
        fn $method(&mut self, a: &Self) {
            self.function(a, N::$method, |$slope, $x, $a| $factor);
        }
    )*};
}

/// Linear operations, which do the same with numbers and derivatives.
macro_rules! linear {
    ($($method:ident($($operand:ident),*);)*) => {$(
        #[inline(always)]
        fn $method(&mut self, $($operand: &Self),*) {
            self.value.$method($(&$operand.value),*);
            for k in 0..K {
                self.derivatives[k].$method($(&$operand.derivatives[k]),*);
            }
        }
    )*};
}

impl<N: Number, const K: usize> Number for Dual<N, K> {
    type Context = N::Context;
    const KEEPS_INCREMENTS: bool = N::KEEPS_INCREMENTS;
    const IN_VECTORS: bool = N::IN_VECTORS;
    const LANES: usize = N::LANES;
    const HAS_DERIVATIVES: bool = true;
    type Block = DualBlock<N::Block, K>;
    type InLanes = Dual<N::InLanes, K>;
    const LANE_ACCESS: Option<LaneAccess<Self, Self::InLanes>> = match N::LANE_ACCESS {
        None => None,
        Some(_) => Some(LaneAccess { set: Self::set_in_lanes, number: Self::in_lane }),
    };
    type Register<'a>
        = &'a mut Self
    where
        N: 'a;

    type Plain = N;

    #[inline(always)]
    fn dual_parts(&self) -> (&N, &[N]) {
        (&self.value, &self.derivatives)
    }

    #[inline(always)]
    fn dual_parts_mut(&mut self) -> (&mut N, &mut [N]) {
        (&mut self.value, &mut self.derivatives)
    }

    #[inline(always)]
    fn register(&mut self) -> &mut Self {
        self
    }

    #[inline(always)]
    fn in_widest_instructions<R>(work: impl FnOnce() -> R) -> R {
        N::in_widest_instructions(work)
    }

    #[inline(always)]
    fn zero(context: &N::Context) -> Self {
        Dual::constant(N::zero(context))
    }

    fn from_rational(value: &Rational, context: &N::Context) -> Self {
        let mut constant = Dual::constant(N::from_rational(value, context));
        if let (Some(derivative), Some(own)) = (constants::derivative(value), constant.derivatives.first_mut()) {
            *own = N::from_rational(&derivative, context);
        }
        constant
    }

    fn context(&self) -> N::Context {
        self.value.context()
    }

    fn coarser(context: &N::Context, bits: u32) -> N::Context {
        N::coarser(context, bits)
    }

    linear! {
        assign_zero();
        assign(a);
        assign_sum(a, b);
        assign_difference(a, b);
        add(a);
        subtract(a);
        negate();
    }

    #[inline(always)]
    fn assign_product(&mut self, a: &Self, b: &Self) {
        self.value.assign_product(&a.value, &b.value);
        for k in 0..K {
            let own = &mut self.derivatives[k];
            own.assign_product(&a.value, &b.derivatives[k]);
            own.add_product(&a.derivatives[k], &b.value);
        }
    }

    #[inline(always)]
    fn assign_square(&mut self, a: &Self) {
        self.value.assign_square(&a.value);
        self.each(a, |own, of_a| {
            own.assign_product(&a.value, of_a);
            own.multiply_integer(2);
        });
    }

    #[inline(always)]
    fn assign_quotient(&mut self, a: &Self, b: &Self) {
        self.value.assign_quotient(&a.value, &b.value);
        for k in 0..K {
            let own = &mut self.derivatives[k];
            own.assign(&a.derivatives[k]);
            own.subtract_product(&self.value, &b.derivatives[k]);
            own.divide(&b.value);
        }
    }

    #[inline(always)]
    fn multiply(&mut self, a: &Self) {
        for k in 0..K {
            let own = &mut self.derivatives[k];
            own.multiply(&a.value);
            own.add_product(&self.value, &a.derivatives[k]);
        }
        self.value.multiply(&a.value);
    }

    #[inline(always)]
    fn divide(&mut self, a: &Self) {
        self.value.divide(&a.value);
        for k in 0..K {
            let own = &mut self.derivatives[k];
            own.subtract_product(&self.value, &a.derivatives[k]);
            own.divide(&a.value);
        }
    }

    #[inline(always)]
    fn add_product(&mut self, a: &Self, b: &Self) {
        self.value.add_product(&a.value, &b.value);
        for k in 0..K {
            let own = &mut self.derivatives[k];
            own.add_product(&a.value, &b.derivatives[k]);
            own.add_product(&a.derivatives[k], &b.value);
        }
    }

    #[inline(always)]
    fn subtract_product(&mut self, a: &Self, b: &Self) {
        self.value.subtract_product(&a.value, &b.value);
        for k in 0..K {
            let own = &mut self.derivatives[k];
            own.subtract_product(&a.value, &b.derivatives[k]);
            own.subtract_product(&a.derivatives[k], &b.value);
        }
    }

    #[inline(always)]
    fn assign_sum_with_product(&mut self, c: &Self, product: &Self, a: &Self, b: &Self) {
        self.value.assign_sum_with_product(&c.value, &product.value, &a.value, &b.value);
        for k in 0..K {
            self.derivatives[k].assign_sum(&product.derivatives[k], &c.derivatives[k]);
        }
    }

    #[inline(always)]
    fn assign_difference_with_product(&mut self, c: &Self, product: &Self, a: &Self, b: &Self) {
        self.value.assign_difference_with_product(&c.value, &product.value, &a.value, &b.value);
        for k in 0..K {
            self.derivatives[k].assign_difference(&c.derivatives[k], &product.derivatives[k]);
        }
    }

    #[inline(always)]
    fn add_to_product(&mut self, c: &Self, a: &Self, b: &Self) {
        self.value.add_to_product(&c.value, &a.value, &b.value);
        self.each(c, N::add);
    }

    #[inline(always)]
    fn assign_sqrt(&mut self, a: &Self) {
        self.value.assign_sqrt(&a.value);
        for k in 0..K {
            let own = &mut self.derivatives[k];
            own.assign_quotient(&a.derivatives[k], &self.value);
            own.divide_integer(2);
        }
    }

    #[inline(always)]
    fn assign_reciprocal_sqrt(&mut self, a: &Self) {
        self.value.assign_reciprocal_sqrt(&a.value);
        for k in 0..K {
            // −½ ȧ a^(−3/2), of which no factor overflows before the others are there
            let own = &mut self.derivatives[k];
            own.assign_product(&a.derivatives[k], &self.value);
            own.multiply(&self.value);
            own.multiply(&self.value);
            own.divide_integer(-2);
        }
    }

    #[inline(always)]
    fn assign_root(&mut self, a: &Self, n: u32) {
        self.function(
            a,
            |x, a| x.assign_root(a, n),
            |slope, x, a| {
                slope.assign_quotient(x, a);
                slope.divide_integer(n.try_into().expect("the order of a root is below 2³¹"));
            },
        );
    }

    functions! {
        assign_exp: |slope, x, _a| slope.assign(x);
        assign_log: |slope, _x, a| { slope.assign(a); invert(slope) };
        assign_sin: |slope, _x, a| slope.assign_cos(a);
        assign_cos: |slope, _x, a| { slope.assign_sin(a); slope.negate() };
        assign_tan: |slope, x, _a| assign_one_and_square(slope, x, 1);
        assign_sinh: |slope, _x, a| slope.assign_cosh(a);
        assign_cosh: |slope, _x, a| slope.assign_sinh(a);
        assign_tanh: |slope, x, _a| assign_one_and_square(slope, x, -1);
        assign_atan: |slope, _x, a| { assign_one_and_square(slope, a, 1); invert(slope) };
        assign_asin: |slope, _x, a| assign_slope_of_arcsine(slope, a);
        assign_acos: |slope, _x, a| { assign_slope_of_arcsine(slope, a); slope.negate() };
    }

    #[inline(always)]
    fn assign_sin_cos(sin: &mut Self, cos: &mut Self, a: &Self) {
        N::assign_sin_cos(&mut sin.value, &mut cos.value, &a.value);
        sin.chain(a, &cos.value);
        cos.chain(a, &sin.value);
        cos.derivatives.iter_mut().for_each(N::negate);
    }

    #[inline(always)]
    fn multiply_integer(&mut self, n: i32) {
        self.value.multiply_integer(n);
        self.derivatives.iter_mut().for_each(|own| own.multiply_integer(n));
    }

    #[inline(always)]
    fn divide_integer(&mut self, n: i32) {
        self.value.divide_integer(n);
        self.derivatives.iter_mut().for_each(|own| own.divide_integer(n));
    }

    #[inline(always)]
    fn make_absolute(&mut self) {
        for lane in 0..N::LANES {
            if self.value.lane(lane).0 < 0.0 {
                self.negate_derivatives(lane);
            }
        }
        self.value.make_absolute();
    }

    #[inline(always)]
    fn make_at_least(&mut self, a: &Self) {
        self.take_derivatives_where(a, |difference| difference > 0.0);
        self.value.make_at_least(&a.value);
    }

    #[inline(always)]
    fn make_at_most(&mut self, a: &Self) {
        self.take_derivatives_where(a, |difference| difference < 0.0);
        self.value.make_at_most(&a.value);
    }

    #[inline(always)]
    fn make_nan_where_square_overflows(&mut self, a: &Self) {
        self.value.make_nan_where_square_overflows(&a.value);
    }

    #[inline(always)]
    fn assign_derivatives(&mut self, a: &Self) {
        self.each(a, N::assign);
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> (f64, i64) {
        self.value.lane(lane)
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, m: f64, n: i64) {
        self.value.set_lane(lane, m, n);
        self.derivatives.iter_mut().for_each(|own| own.set_lane(lane, 0.0, 0));
    }

    #[inline(always)]
    fn assign_lane(&mut self, lane: usize, a: &Self) {
        self.value.assign_lane(lane, &a.value);
        self.each(a, |own, a| own.assign_lane(lane, a));
    }

    /// Whether x is so: derivatives do not decide what happens to x.
    #[inline(always)]
    fn is_finite(&self) -> bool {
        self.value.is_finite()
    }
}

impl<N: Number, const K: usize> Dual<N, K> {
    #[inline(always)]
    fn set_in_lanes(lanes: &mut Dual<N::InLanes, K>, lane: usize, x: &Self) {
        let Some(LaneAccess { set, .. }) = N::LANE_ACCESS else { return };
        set(&mut lanes.value, lane, &x.value);
        for (lanes, derivative) in lanes.derivatives.iter_mut().zip(&x.derivatives) {
            set(lanes, lane, derivative);
        }
    }

    #[inline(always)]
    fn in_lane(lanes: &Dual<N::InLanes, K>, lane: usize) -> Self {
        let LaneAccess { number, .. } = N::LANE_ACCESS.expect("numbers are in lanes");
        let derivatives = std::array::from_fn(|k| number(&lanes.derivatives[k], lane));
        Dual { value: number(&lanes.value, lane), derivatives }
    }

    fn negate_derivatives(&mut self, lane: usize) {
        for own in &mut self.derivatives {
            let mut opposite = own.clone();
            opposite.negate();
            own.assign_lane(lane, &opposite);
        }
    }

    /// The derivatives are those of a in the lanes where a − x is as asked for.
    #[inline(always)]
    fn take_derivatives_where(&mut self, a: &Self, asked: impl Fn(f64) -> bool) {
        let mut difference = a.value.clone();
        difference.subtract(&self.value);
        for lane in (0..N::LANES).filter(|lane| asked(difference.lane(*lane).0)) {
            self.each(a, |own, a| own.assign_lane(lane, a));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{functions, operations, products};
    use super::*;
    use crate::number::{CorrectlyRounded as _, Real as _};
    use crate::number::{DoubleDouble, Lanes, Limbs};

    /// Values have the bits of plain numbers.
    #[test]
    fn values_are_those_of_plain_numbers() {
        for [a, b, c] in [[0.1, -7.3, 1e-3], [0.7, 3.0, -2.0], [1e-3, 1e3, 0.0]] {
            let [x, y, z] = [a, b, c].map(|x| Dual::new(x, [1.0, -0.3]));
            assert_eq!(operations(&x, &y, &z).map(|x| x.value.to_bits()), operations(&a, &b, &c).map(f64::to_bits));
            assert_eq!(products(&x, &y, &z).map(|x| x.value.to_bits()), products(&a, &b, &c).map(f64::to_bits));
            assert_eq!(functions(&x).map(|x| x.value.to_bits()), functions(&a).map(f64::to_bits));
        }
    }

    /// Central differences of 2⁻⁴⁰ in numbers of 128 bits have an error of the size 2⁻⁸⁰ and a round-off of 2⁻⁸⁸.
    #[test]
    fn derivatives_are_limits_of_differences() {
        type N = Limbs<2>;
        let number = |text: &str| N::from_rational(&crate::exact(text).unwrap(), &());
        let [a, b, c] = ["1/10", "-73/10", "1/1000"].map(number);
        let directions = [number("3/5"), number("-4/5"), number("1/3")];
        let at = |sign: i32| {
            let mut distance = number("1/1099511627776");
            distance.multiply_integer(sign);
            let mut moved = [a, b, c];
            moved.iter_mut().zip(&directions).for_each(|(x, direction)| x.add_product(&distance, direction));
            let [a, b, c] = moved;
            (operations(&a, &b, &c), products(&a, &b, &c), functions(&a))
        };
        let [x, y, z] = [0, 1, 2].map(|i| Dual::new([a, b, c][i], [directions[i]]));
        let found = (operations(&x, &y, &z), products(&x, &y, &z), functions(&x));
        let (plus, minus) = (at(1), at(-1));
        let check = |plus: &N, minus: &N, found: &Dual<N>| {
            let mut difference = *plus;
            difference.subtract(minus);
            difference.divide(&number("1/549755813888"));
            difference.subtract(&found.derivatives[0]);
            let size = 1.0 + found.derivatives[0].to_f64().abs();
            assert!(difference.to_f64().abs() < 1e-21 * size, "{found:?}: {}", difference.to_f64());
        };
        for i in 0..plus.0.len() {
            check(&plus.0[i], &minus.0[i], &found.0[i]);
        }
        for i in 0..plus.1.len() {
            check(&plus.1[i], &minus.1[i], &found.1[i]);
        }
        for i in 0..plus.2.len() {
            check(&plus.2[i], &minus.2[i], &found.2[i]);
        }
    }

    #[test]
    fn lanes_and_other_numbers_have_derivatives() {
        let [a, b, c] = [0.1, -7.3, 1e-3].map(|x| Dual::new(x, [1.0]));
        let wide = |x: Dual<f64>| Dual::new(Lanes::<4>::all(x.value), x.derivatives.map(Lanes::all));
        let lanes = operations(&wide(a), &wide(b), &wide(c));
        for (lanes, plain) in lanes.iter().zip(operations(&a, &b, &c)) {
            assert_eq!(lanes.derivatives[0], Lanes::all(plain.derivatives[0]));
        }
        let mut root = Dual::new(DoubleDouble::from(-8.0), [DoubleDouble::from(1.0)]);
        let negative = root;
        root.assign_root(&negative, 3);
        assert_eq!(root.value.to_f64(), -2.0);
        assert!((root.derivatives[0].to_f64() - 1.0 / 12.0).abs() < 1e-17);
    }

    #[test]
    fn branches_have_the_derivative_of_what_is_taken() {
        let number = |x: f64, derivative: f64| Dual::new(x, [derivative]);
        let mut x = number(-2.0, 3.0);
        x.make_absolute();
        assert_eq!((x.value, x.derivatives), (2.0, [-3.0]));
        x.make_at_least(&number(5.0, 7.0));
        assert_eq!((x.value, x.derivatives), (5.0, [7.0]));
        x.make_at_most(&number(6.0, 1.0));
        assert_eq!((x.value, x.derivatives), (5.0, [7.0]));
        x.set_lane(0, 1.5, 1);
        assert_eq!((x.value, x.derivatives), (3.0, [0.0]));
        x.assign_rounded(&crate::number::AnyLimbs::from_f64(0.5, crate::number::LimbCount::of_bits(64).unwrap()));
        assert_eq!((x.value, x.derivatives), (0.5, [0.0]));
    }
}
