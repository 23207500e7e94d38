//! The tables of constants against MPFR.

use rug::Float;
use rug::float::Constant;

use super::super::DoubleDouble;
use super::super::constants::*;
use crate::number::{CorrectlyRounded, Number};

const BITS: u32 = 2000;

fn rounded(x: &Float) -> (f64, f64) {
    let mut rounded = DoubleDouble::zero(&());
    rounded.assign_rounded(x);
    rounded.parts()
}

fn pi() -> Float {
    Float::with_val(BITS, Constant::Pi)
}

/// The bits of a significand up to the last that is not 0.
fn bits(x: f64) -> u32 {
    53 - x.to_bits().trailing_zeros().min(52)
}

#[test]
fn entries_are_nearest() {
    let one = Float::with_val(BITS, 1);
    let log_2 = Float::with_val(BITS, Constant::Log2);
    let Tables { powers, sines, logarithms } = &*TABLES;
    let mut factorial = one.clone();
    for (n, entry) in INVERSE_FACTORIALS.iter().enumerate() {
        factorial *= n.max(1) as u32;
        assert_eq!(*entry, rounded(&factorial.clone().recip()), "1/{n}!");
    }
    for (n, entry) in (1_u32..).zip(&INVERSES) {
        assert_eq!(*entry, rounded(&(one.clone() / n)), "1/{n}");
    }
    for (j, entry) in (0_u32..).zip(powers) {
        assert_eq!(*entry, rounded(&(log_2.clone() * j / 32_u32).exp()), "2^({j}/32)");
    }
    for (j, entry) in (0_u32..).zip(sines) {
        assert_eq!(*entry, rounded(&(pi() * j / 256_u32).sin()), "sin({j} π/256)");
    }
    for (i, (c, entry)) in (45_u32..).zip(logarithms) {
        assert!((c * f64::from(i) / 64.0 - 1.0).abs() < 0.003 && bits(*c) <= 9, "{c}");
        assert_eq!(*entry, rounded(&-Float::with_val(BITS, *c).ln()), "−log {c}");
    }
    assert_eq!(HALF_PI, rounded(&(pi() / 2_u32)));
    let digits = (pi() << 1400_u32).floor().to_integer().unwrap();
    assert_eq!(PI_TIMES_2_1400, digits.to_string_radix(16));
}

/// The first parts have so few bits that multiples are exact.
#[test]
fn parts_of_reductions() {
    let log_2 = Float::with_val(BITS, Constant::Log2);
    for ((a, b), whole, most) in [(LOG_2_32, log_2.clone() / 32_u32, 37), (LOG_2, log_2, 42)] {
        assert!(bits(a) <= most);
        assert_eq!(b, rounded(&(whole - a)));
    }
    let ([a, b], c) = PI_256;
    assert!(bits(a) <= 30 && bits(b) <= 30);
    assert_eq!(c, rounded(&(pi() / 256_u32 - a - b)));
}
