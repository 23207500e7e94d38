//! exp, log, sin and cos of several `f64` at once: without branches, so that the compiler makes vector operations of
//! the loops.
//!
//! Polynomials and reductions are taken from fdlibm (Copyright (C) 1993 by Sun Microsystems, Inc.; permission to use,
//! copy, modify, and distribute is freely granted, provided that this notice is preserved), with every case of an
//! argument computed and the right one selected. No operation is fused: the bits are the same on all processors.

use crate::number::instructions;

/// x + 2⁵²·1.5 has the integer that is nearest to x in its last bits.
const ROUNDS: f64 = 1.5 / f64::EPSILON;

/// The largest |x| whose sine and cosine are computed here: 2²⁰·π/2, rounded down.
const LARGEST_ANGLE: f64 = 1_647_099.0;

/// Functions of all lanes. A call costs some nanoseconds, as the loop is compiled for each kind of instructions.
macro_rules! each {
    ($($(#[$doc:meta])* $each:ident: $function:ident;)*) => {$(
        $(#[$doc])*
        #[inline(never)]
        pub(super) fn $each<const W: usize>(x: &mut [f64; W]) {
            instructions::widest(
                #[inline(always)]
                || {
                    for x in x.iter_mut() {
                        *x = $function(*x);
                    }
                },
            );
        }
    )*};
}

each! {
    /// x ← exp x
    exp_each: exp;
    /// x ← log x
    log_each: log;
    sin_of_small: sin;
    cos_of_small: cos;
}

/// x ← sin x
pub(super) fn sin_each<const W: usize>(x: &mut [f64; W]) {
    let all = *x;
    sin_of_small(x);
    replace_large(x, &all, f64::sin);
}

/// x ← cos x
pub(super) fn cos_each<const W: usize>(x: &mut [f64; W]) {
    let all = *x;
    cos_of_small(x);
    replace_large(x, &all, f64::cos);
}

/// x ← sin x, cos ← cos x
pub(super) fn sin_cos_each<const W: usize>(x: &mut [f64; W], cos: &mut [f64; W]) {
    *cos = *x;
    sin_each(x);
    cos_each(cos);
}

/// Replaces the values at large angles, and at angles that are not finite, by the platform's function.
#[inline]
fn replace_large<const W: usize>(values: &mut [f64; W], angles: &[f64; W], function: impl Fn(f64) -> f64) {
    let is_large = |x: &f64| x.abs() > LARGEST_ANGLE;
    if angles.iter().any(is_large) {
        for (value, angle) in values.iter_mut().zip(angles).filter(|(_, angle)| is_large(angle)) {
            *value = function(*angle);
        }
    }
}

/// exp x = 2ᵏ exp r, |r| ≤ log(2)/2; exp r by a rational function of r (fdlibm, `e_exp.c`).
#[inline(always)]
#[allow(clippy::excessive_precision, reason = "as in the source")]
pub(super) fn exp(x: f64) -> f64 {
    const LOG2_HIGH: f64 = 6.93147180369123816490e-01;
    const LOG2_LOW: f64 = 1.90821492927058770002e-10;
    const P: [f64; 5] = [
        1.66666666666666019037e-01,
        -2.77777777770155933842e-03,
        6.61375632143793436117e-05,
        -1.65339022054652515390e-06,
        4.13813679705723846039e-08,
    ];
    // beyond these the result is infinite or 0; a NaN stays
    let x = if x > 710.0 { 710.0 } else { x };
    let x = if x < -746.0 { -746.0 } else { x };
    let k = (x * std::f64::consts::LOG2_E + ROUNDS) - ROUNDS;
    let (high, low) = (x - k * LOG2_HIGH, k * LOG2_LOW);
    let r = high - low;
    let t = r * r;
    let c = r - t * (P[0] + t * (P[1] + t * (P[2] + t * (P[3] + t * P[4]))));
    let of_r = 1.0 - ((low - (r * c) / (2.0 - c)) - high);
    // in two factors, as 2ᵏ alone may overflow or underflow
    let half = k * 0.5 + ROUNDS;
    let other = (k - (half - ROUNDS)) + ROUNDS;
    of_r * power_of_two(half) * power_of_two(other)
}

/// 2ⁿ of an integer n to which `ROUNDS` is added.
#[inline(always)]
fn power_of_two(n: f64) -> f64 {
    f64::from_bits((n.to_bits() << 52).wrapping_add(1.0_f64.to_bits()))
}

/// log x = k log 2 + log(1 + f), √½ < 1 + f < √2; the last by a polynomial of (f/(2 + f))² (fdlibm, `e_log.c`).
#[inline(always)]
#[allow(clippy::excessive_precision, reason = "as in the source")]
pub(super) fn log(x: f64) -> f64 {
    const LOG2_HIGH: f64 = 6.93147180369123816490e-01;
    const LOG2_LOW: f64 = 1.90821492927058770002e-10;
    const L: [f64; 7] = [
        6.666666666666735130e-01,
        3.999999999940941908e-01,
        2.857142874366239149e-01,
        2.222219843214978396e-01,
        1.818357216161805012e-01,
        1.531383769920937332e-01,
        1.479819860511658591e-01,
    ];
    /// The first 32 bits of √½.
    const ROOT_OF_HALF: u64 = 0x3fe6_a09e_0000_0000;
    const MANTISSA: u64 = (1 << 52) - 1;
    const TWO_52: f64 = 4_503_599_627_370_496.0;
    let subnormal = x < f64::MIN_POSITIVE;
    let (normal, below) = if subnormal { (x * 18_014_398_509_481_984.0, 1023.0 + 54.0) } else { (x, 1023.0) };
    let bits = normal.to_bits().wrapping_add(1.0_f64.to_bits() - ROOT_OF_HALF);
    // the exponent as a number, by the bits of 2⁵² + exponent
    let k = f64::from_bits((bits >> 52) | TWO_52.to_bits()) - TWO_52 - below;
    let f = f64::from_bits((bits & MANTISSA).wrapping_add(ROOT_OF_HALF)) - 1.0;
    let half_square = 0.5 * f * f;
    let s = f / (2.0 + f);
    let z = s * s;
    let w = z * z;
    let even = w * (L[1] + w * (L[3] + w * L[5]));
    let odd = z * (L[0] + w * (L[2] + w * (L[4] + w * L[6])));
    let value = s * (half_square + (odd + even)) + k * LOG2_LOW - half_square + f + k * LOG2_HIGH;
    let value = if x < f64::INFINITY { value } else { x }; // also NaN
    let value = if x == 0.0 { f64::NEG_INFINITY } else { value };
    if x < 0.0 { f64::NAN } else { value }
}

/// sin x, |x| ≤ 2²⁰·π/2
#[inline(always)]
pub(super) fn sin(x: f64) -> f64 {
    let (n, r) = reduced(x);
    let value = selected(n, sin_of_reduced(r), cos_of_reduced(r));
    if x == 0.0 { x } else { value }
}

/// cos x, |x| ≤ 2²⁰·π/2
#[inline(always)]
pub(super) fn cos(x: f64) -> f64 {
    let (n, r) = reduced(x);
    selected(n.wrapping_add(1), sin_of_reduced(r), cos_of_reduced(r))
}

/// The sine of n π/2 + r, from the sine and cosine of r; the last two bits of n are used.
#[inline(always)]
fn selected(n: u64, sin: f64, cos: f64) -> f64 {
    let cos_is_it = (n & 1).wrapping_neg();
    let value = (sin.to_bits() & !cos_is_it) | (cos.to_bits() & cos_is_it);
    f64::from_bits(value ^ ((n & 2) << 62))
}

/// x = n π/2 + r₀ + r₁, |r₀| ≤ π/4; of n only the last bits. π/2 is taken in parts of 33 bits, whose products with n
/// are exact.
#[inline(always)]
#[allow(clippy::excessive_precision, reason = "as in the source")]
fn reduced(x: f64) -> (u64, [f64; 2]) {
    const HALF_PI: [f64; 4] = [
        1.57079632673412561417e+00,
        6.07710050630396597660e-11,
        2.02226624871116645580e-21,
        8.47842766036889956997e-32,
    ];
    let rounded = x * std::f64::consts::FRAC_2_PI + ROUNDS;
    let n = rounded - ROUNDS;
    let first = x - n * HALF_PI[0]; // exact
    let (second, lost) = difference(first, n * HALF_PI[1]);
    let (third, lost_again) = difference(second, n * HALF_PI[2]);
    let rest = (lost + lost_again) - n * HALF_PI[3];
    let r = third + rest;
    (rounded.to_bits(), [r, (third - r) + rest])
}

/// a − b and what its rounding took away (Knuth).
#[inline(always)]
fn difference(a: f64, b: f64) -> (f64, f64) {
    let rounded = a - b;
    let of_b = rounded - a;
    (rounded, (a - (rounded - of_b)) - (b + of_b))
}

/// sin(r₀ + r₁), |r₀| ≤ π/4 (fdlibm, `k_sin.c`)
#[inline(always)]
#[allow(clippy::excessive_precision, reason = "as in the source")]
fn sin_of_reduced([r, rest]: [f64; 2]) -> f64 {
    const S: [f64; 6] = [
        -1.66666666666666324348e-01,
        8.33333333332248946124e-03,
        -1.98412698298579493134e-04,
        2.75573137070700676789e-06,
        -2.50507602534068634195e-08,
        1.58969099521155010221e-10,
    ];
    let z = r * r;
    let w = z * z;
    let tail = S[1] + z * (S[2] + z * S[3]) + z * w * (S[4] + z * S[5]);
    let cube = z * r;
    r - ((z * (0.5 * rest - cube * tail) - rest) - cube * S[0])
}

/// cos(r₀ + r₁), |r₀| ≤ π/4 (FreeBSD's fdlibm, `k_cos.c`)
#[inline(always)]
#[allow(clippy::excessive_precision, reason = "as in the source")]
fn cos_of_reduced([r, rest]: [f64; 2]) -> f64 {
    const C: [f64; 6] = [
        4.16666666666666019037e-02,
        -1.38888888888741095749e-03,
        2.48015872894767294178e-05,
        -2.75573143513906633035e-07,
        2.08757232129817482790e-09,
        -1.13596475577881948265e-11,
    ];
    let z = r * r;
    let w = z * z;
    let tail = z * (C[0] + z * (C[1] + z * C[2])) + w * w * (C[3] + z * (C[4] + z * C[5]));
    let half = 0.5 * z;
    let rounded = 1.0 - half;
    rounded + (((1.0 - rounded) - half) + (z * tail - r * rest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::instructions::Instructions;

    /// Numbers that look random: the same in every run.
    struct Random(u64);

    impl Random {
        fn bits(&mut self) -> u64 {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 7;
            self.0 ^= self.0 << 17;
            self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
        }

        /// Between 0 and 1.
        fn number(&mut self) -> f64 {
            (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    #[test]
    fn special_values() {
        let nan = f64::NAN;
        let inf = f64::INFINITY;
        let check = |name, function: fn(f64) -> f64, cases: &[(f64, f64)]| {
            for &(x, expected) in cases {
                let found = function(x);
                let same = found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan();
                assert!(same, "{name} {x:e}: {found:e}, not {expected:e}");
            }
        };
        let tiny = f64::from_bits(1);
        let of_exp = [
            (0.0, 1.0),
            (-0.0, 1.0),
            (inf, inf),
            (-inf, 0.0),
            (nan, nan),
            (709.79, inf),
            (-745.1, tiny),
            (-745.2, 0.0),
        ];
        check("exp", exp, &of_exp);
        check("log", log, &[(0.0, -inf), (-0.0, -inf), (-tiny, nan), (inf, inf), (-inf, nan), (nan, nan), (1.0, 0.0)]);
        let through = |each: fn(&mut [f64; 1]), x| {
            let mut x = [x];
            each(&mut x);
            x[0]
        };
        for (x, of_cos) in [(0.0, 1.0), (-0.0, 1.0), (tiny, 1.0), (-tiny, 1.0), (inf, nan), (-inf, nan), (nan, nan)] {
            let expected = if of_cos == 1.0 { x } else { nan };
            let [sin, cos] = [sin_each, cos_each].map(|each| through(each, x));
            assert!(sin.to_bits() == expected.to_bits() || sin.is_nan() && expected.is_nan(), "sin {x:e}: {sin:e}");
            assert!(cos == of_cos || cos.is_nan() && of_cos.is_nan(), "cos {x:e}: {cos:e}");
        }
        for x in [1_647_098.0, 1_647_100.0, 1e22, f64::MAX] {
            assert!((through(sin_each, x) - x.sin()).abs() < 2e-16 && (through(cos_each, -x) - x.cos()).abs() < 2e-16);
        }
    }

    #[test]
    fn instructions_and_lanes_do_not_change_the_bits() {
        let mut random = Random(7);
        for _ in 0..2000 {
            let x: [f64; 8] =
                std::array::from_fn(|_| (random.number() - 0.5) * 10.0_f64.powi((random.bits() % 9) as i32 - 2));
            for (each, one) in [
                (exp_each as fn(&mut [f64; 8]), exp as fn(f64) -> f64),
                (log_each, log),
                (sin_of_small, sin),
                (cos_of_small, cos),
            ] {
                for instructions in Instructions::available() {
                    let mut found = x;
                    instructions.only(|| each(&mut found));
                    for (x, found) in x.iter().zip(found) {
                        let expected = one(*x);
                        assert!(found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan(), "{x:e}");
                    }
                }
            }
        }
    }

    /// Against MPFR: random arguments of all sizes, those next to multiples of π/2, next to 1, subnormal ones.
    #[cfg(feature = "mpfr")]
    mod errors {
        use super::*;
        use rug::Float;

        const COUNT: usize = 20_000;

        /// |y − right| in units of the last place of the right value.
        fn error(y: f64, right: &Float) -> f64 {
            let nearest = right.to_f64();
            let size = nearest.abs().max(f64::MIN_POSITIVE);
            let unit = size.next_up() - size;
            Float::with_val(200, right - y).to_f64().abs() / unit
        }

        fn largest(one: fn(f64) -> f64, exact: fn(Float) -> Float, mut x: impl FnMut() -> f64) -> f64 {
            let of = |x: f64| error(one(x), &exact(Float::with_val(200, x)));
            (0..COUNT).map(|_| of(x())).fold(0.0, f64::max)
        }

        #[test]
        fn of_exp() {
            let mut r = Random(1);
            let mut check = |bound, x: &mut dyn FnMut(&mut Random) -> f64| {
                let found = largest(exp, Float::exp, || x(&mut r));
                assert!(found < bound, "{found}");
            };
            check(0.9, &mut |r| (r.number() - 0.5) * 1416.0);
            check(0.9, &mut |r| r.number() - 0.5);
            check(0.9, &mut |r| (r.number() - 0.5) * 2.0_f64.powf(-60.0 * r.number()));
            check(1.01, &mut |r| -708.0 - 38.0 * r.number());
        }

        #[test]
        fn of_log() {
            let mut r = Random(2);
            let mut check = |x: &mut dyn FnMut(&mut Random) -> f64| {
                let found = largest(log, Float::ln, || x(&mut r));
                assert!(found < 0.9, "{found}");
            };
            check(&mut |r| f64::from_bits(r.bits() % f64::INFINITY.to_bits()));
            check(&mut |r| f64::from_bits(r.bits() >> 12));
            check(&mut |r| 0.5 + 1.5 * r.number());
            check(&mut |r| 1.0 + (r.number() - 0.5) * 2.0_f64.powf(-50.0 * r.number()));
        }

        #[test]
        fn of_sin_and_cos() {
            for (one, exact) in [(sin as fn(f64) -> f64, Float::sin as fn(Float) -> Float), (cos, Float::cos)] {
                let mut r = Random(3);
                let mut check = |x: &mut dyn FnMut(&mut Random) -> f64| {
                    let found = largest(one, exact, || x(&mut r));
                    assert!(found < 0.9, "{found}");
                };
                check(&mut |r| (r.number() - 0.5) * 6.3);
                check(&mut |r| (r.number() - 0.5) * 2.0 * LARGEST_ANGLE);
                check(&mut |r| (r.number() - 0.5) * LARGEST_ANGLE * 2.0_f64.powf(-60.0 * r.number()));
                // the next numbers to multiples of π/2
                check(&mut |r| {
                    let near = (r.number() * 1_048_570.0).floor() * std::f64::consts::FRAC_PI_2;
                    f64::from_bits(near.to_bits() + r.bits() % 9).next_down().next_down()
                });
            }
        }
    }
}
