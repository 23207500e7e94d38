//! Every operation beside MPFR's, which rounds correctly: the same bits for random numbers and for those that are hard
//! to round.
//!
//! `cargo test --release -p shadowstep-limbs arithmetic -- --ignored` runs 10⁷ cases.

use super::mpfr::{Random, float, same};
use rug::Float;
use rug::ops::CompleteRound;
use shadowstep_limbs::Limbs;

/// Two numbers whose sum, product or quotient may be hard to round.
fn pair<const L: usize>(random: &mut Random) -> [Limbs<L>; 2] {
    let a = random.number::<L>();
    let b = match random.below(8) {
        0 => a,
        1 => -a,
        2 => random.neighbour(&a),
        3 => a.times_power_of_two(random.distance(L)),
        4 => random.neighbour(&-a).times_power_of_two(random.distance(L)),
        _ => random.number(),
    };
    [a, b]
}

/// A number whose root, or reciprocal root, is close to the middle between two numbers.
fn close_to_a_tie<const L: usize>(random: &mut Random) -> Limbs<L> {
    let bits = 64 * L as u32;
    let half = Float::with_val(bits + 1, 1) >> (bits as i32);
    let middle = Float::with_val(bits + 1, float(&random.mantissa::<L>()) + half);
    let power = if random.below(2) == 0 { middle.square() } else { middle.square().recip() };
    let rounded = Float::with_val(bits, power);
    let (digits, exponent) = rounded.to_integer_exp().unwrap();
    let exponent = exponent + 2 * random.below(100) as i32;
    Limbs::from_magnitude(false, &digits.to_digits(rug::integer::Order::Lsf), exponent.into(), false)
}

fn check<const L: usize>(random: &mut Random) {
    let bits = 64 * L as u32;
    let [a, b] = pair::<L>(random);
    let [x, y] = [float(&a), float(&b)];
    same("+", &(&a + &b), &(&x + &y).complete(bits), &[&a, &b]);
    same("−", &(&a - &b), &(&x - &y).complete(bits), &[&a, &b]);
    same("×", &(&a * &b), &(&x * &y).complete(bits), &[&a, &b]);
    same("÷", &(&a / &b), &(&x / &y).complete(bits), &[&a, &b]);
    same("square", &a.square(), &x.square_ref().complete(bits), &[&a]);
    assert_eq!(a.partial_cmp(&b), x.partial_cmp(&y), "{a:?} {b:?}");
    assert_eq!(a == b, x == y, "{a:?} {b:?}");
    let n = random.integer();
    same("times n", &a.times_integer(n), &(&x * n).complete(bits), &[&a, &Limbs::from(n)]);
    same("over n", &a.over_integer(n), &(&x / n).complete(bits), &[&a, &Limbs::from(n)]);
    for a in [a, close_to_a_tie(random)] {
        let x = float(&a);
        same("√", &a.sqrt(), &x.sqrt_ref().complete(bits), &[&a]);
        same("1/√", &a.reciprocal_sqrt(), &x.recip_sqrt_ref().complete(bits), &[&a]);
        same("f64", &Limbs::<L>::from(a.to_f64()), &Float::with_val(bits, x.to_f64()), &[&a]);
    }
    let short = a.resized::<2>();
    same("resized", &short, &Float::with_val(128, &x), &[&short]);
    same("resized", &short.resized::<L>(), &Float::with_val(bits, float(&short)), &[&short]);
}

fn check_all(cases: u64) {
    let random = &mut Random(1);
    for _ in 0..cases {
        check::<2>(random);
        check::<3>(random);
        check::<4>(random);
        check::<5>(random);
        check::<7>(random);
        check::<9>(random);
        check::<12>(random);
        check::<16>(random);
        check::<17>(random);
    }
}

#[test]
fn operations_have_the_bits_of_mpfr() {
    check_all(2000);
}

#[test]
#[ignore = "10⁷ cases take minutes"]
fn operations_have_the_bits_of_mpfr_in_ten_million_cases() {
    check_all(10_000_000 / 9);
}

#[test]
fn special_values() {
    let values: Vec<Limbs<3>> =
        [0.0, -0.0, 1.0, -2.5, f64::INFINITY, f64::NEG_INFINITY, f64::NAN].map(Limbs::from).into();
    for a in &values {
        for b in &values {
            let [x, y] = [float(a), float(b)];
            same("+", &(a + b), &(&x + &y).complete(192), &[a, b]);
            same("−", &(a - b), &(&x - &y).complete(192), &[a, b]);
            same("×", &(a * b), &(&x * &y).complete(192), &[a, b]);
            same("÷", &(a / b), &(&x / &y).complete(192), &[a, b]);
            assert_eq!(a.partial_cmp(b), x.partial_cmp(&y));
        }
        let x = float(a);
        same("√", &a.sqrt(), &x.sqrt_ref().complete(192), &[a]);
        same("1/√", &a.reciprocal_sqrt(), &x.recip_sqrt_ref().complete(192), &[a]);
        same("resized", &a.resized::<2>(), &Float::with_val(128, &x), &[a]);
        for n in [0, 1, -1, 3, -8] {
            same("times n", &a.times_integer(n), &(&x * n).complete(192), &[a]);
            same("over n", &a.over_integer(n), &(&x / n).complete(192), &[a]);
        }
    }
}
