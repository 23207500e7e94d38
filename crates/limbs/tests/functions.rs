//! Elementary functions beside MPFR's of more bits, for random arguments and for those that are hard to reduce or to
//! round.
//!
//! `cargo test --release -p shadowstep-limbs functions -- --ignored` runs 10⁶ cases.

use super::mpfr::{Random, float};
use rug::Float;
use rug::float::Constant;
use shadowstep_limbs::Limbs;

type Function<const L: usize> = (&'static str, fn(&Limbs<L>) -> Limbs<L>, fn(Float) -> Float);

/// Functions of any argument, and of one whose exponential is a number.
fn functions<const L: usize>() -> [Function<L>; 13] {
    [
        ("exp", Limbs::exp, Float::exp),
        ("log", Limbs::log, Float::ln),
        ("sin", Limbs::sin, Float::sin),
        ("cos", Limbs::cos, Float::cos),
        ("tan", Limbs::tan, Float::tan),
        ("sinh", Limbs::sinh, Float::sinh),
        ("cosh", Limbs::cosh, Float::cosh),
        ("tanh", Limbs::tanh, Float::tanh),
        ("atan", Limbs::atan, Float::atan),
        ("asin", Limbs::asin, Float::asin),
        ("acos", Limbs::acos, Float::acos),
        ("cube root", |x| x.root(3), |x| x.root(3)),
        ("root of order 1000", |x| x.root(1000), |x| x.root(1000)),
    ]
}

/// An argument that is easy, tiny, large, close to 1, or close to a multiple of π/4 or to such a power of e.
fn argument<const L: usize>(random: &mut Random) -> Limbs<L> {
    let multiple = |random: &mut Random, x: Float| {
        let bits = 1 + random.below(40);
        let n = 1 + random.below(1 << bits);
        let (digits, exponent) = Float::with_val(64 * L as u32, x * n).to_integer_exp().unwrap();
        Limbs::from_magnitude(false, &digits.to_digits(rug::integer::Order::Lsf), exponent.into(), false)
    };
    let bits = 64 * L as u32 + 64;
    let x = match random.below(8) {
        0 => random.mantissa::<L>().times_power_of_two(-(random.below(2000) as i32)),
        1 => random.mantissa::<L>().times_power_of_two(random.below(25) as i32),
        2 => random.neighbour(&Limbs::ONE),
        3 => {
            let rest = random.mantissa::<L>().times_power_of_two(-(random.below(64 * L as u64 + 5) as i32));
            if random.below(2) == 0 { &Limbs::ONE + &rest } else { &Limbs::ONE - &rest }
        }
        4 => multiple(random, Float::with_val(bits, Constant::Pi) >> 2),
        5 => multiple(random, Float::with_val(bits, Constant::Log2) >> 2),
        _ => random.mantissa::<L>().times_power_of_two(random.below(8) as i32 - 4),
    };
    if random.below(2) == 0 { -x } else { x }
}

/// Checks that the error is at most (1/2 + 2^-20) ulp.
#[track_caller]
fn check_error<const L: usize>(name: &str, result: &Limbs<L>, exact: &Float, x: &Limbs<L>) {
    let own = float(result);
    if own.is_nan() || own.is_infinite() || own.is_zero() || exact.is_zero() {
        assert!(own == *exact || own.is_nan() && exact.is_nan(), "{name} {x:?}: {own}, not {exact}");
        return;
    }
    let ulp = exact.get_exp().unwrap() - 64 * L as i32;
    let error = (Float::with_val(64, &own - exact) >> ulp).abs();
    assert!(error <= 0.500001, "{name} {x:?}: {own} errs by {error} ulp, the result is {exact}");
    assert_eq!(own.is_sign_negative(), exact.is_sign_negative());
}

fn check<const L: usize>(random: &mut Random) {
    let x = argument::<L>(random);
    let bits = 64 * L as u32 + 64;
    for (name, function, exact) in functions::<L>() {
        check_error(name, &function(&x), &exact(Float::with_val(bits, float(&x))), &x);
    }
}

fn check_all(cases: u64) {
    let random = &mut Random(4);
    for _ in 0..cases {
        check::<2>(random);
        check::<3>(random);
        check::<4>(random);
        check::<5>(random);
        check::<7>(random);
        check::<9>(random);
        check::<12>(random);
        check::<16>(random);
    }
}

#[test]
fn functions_err_by_half_an_ulp() {
    check_all(200);
}

#[test]
#[ignore = "10⁶ cases take minutes"]
fn functions_err_by_half_an_ulp_in_a_million_cases() {
    check_all(1_000_000 / 8);
}

#[test]
fn sines_of_huge_arguments() {
    let random = &mut Random(5);
    for exponent in [1000, 1024, 2100, 2112, 2113, 5000, 65_536] {
        let x = random.mantissa::<4>().times_power_of_two(exponent);
        let (sin, cos) = x.sin_cos();
        let (sine, cosine) = Float::with_val(320, float(&x)).sin_cos(Float::new(320));
        check_error("sin", &sin, &sine, &x);
        check_error("cos", &cos, &cosine, &x);
    }
    assert!(Limbs::<4>::ONE.times_power_of_two(65_537).sin().is_nan());
}

#[test]
fn exponentials_at_the_ends_of_the_range() {
    let random = &mut Random(6);
    let largest = Float::with_val(300, Constant::Log2) * ((1 << 30) - 1);
    for _ in 0..20 {
        let shift = Float::with_val(300, random.below(1 << 40)) >> 20;
        for x in [Float::with_val(128, &largest - &shift), Float::with_val(128, &largest + &shift)] {
            let (digits, exponent) = x.to_integer_exp().unwrap();
            let x =
                Limbs::<2>::from_magnitude(false, &digits.to_digits(rug::integer::Order::Lsf), exponent.into(), false);
            for x in [x, -x] {
                for (name, function, exact) in
                    functions::<2>().into_iter().filter(|(name, ..)| name.starts_with(['e', 's', 'c']))
                {
                    if name.contains('h') || name == "exp" {
                        check_error(name, &function(&x), &exact(Float::with_val(192, float(&x))), &x);
                    }
                }
            }
        }
    }
}

#[test]
fn pi_is_nearest() {
    assert_eq!(float(&Limbs::<2>::pi()), Float::with_val(128, Constant::Pi));
    assert_eq!(float(&Limbs::<5>::pi()), Float::with_val(320, Constant::Pi));
    assert_eq!(float(&Limbs::<16>::pi()), Float::with_val(1024, Constant::Pi));
}

#[test]
fn special_values() {
    for value in [0.0, -0.0, 1.0, -1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 2.5] {
        let x = Limbs::<3>::from(value);
        for (name, function, exact) in functions::<3>() {
            check_error(name, &function(&x), &exact(Float::with_val(256, value)), &x);
            let [own, expected] = [function(&x).to_f64(), exact(Float::with_val(64, value)).to_f64()];
            assert!(
                own.is_nan() || own.is_sign_negative() == expected.is_sign_negative(),
                "the sign of {name} {value}"
            );
        }
    }
}

#[test]
fn roots_of_powers_are_exact() {
    for n in 1..40 {
        for base in [-3i32, 2, 7] {
            let power = (0..n).fold(Limbs::<3>::ONE, |power, _| power.times_integer(base));
            let expected = if n % 2 == 0 { base.abs() } else { base };
            assert_eq!(power.root(n), Limbs::from(expected), "{base}^{n}");
        }
    }
}
