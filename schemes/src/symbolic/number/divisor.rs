//! The greatest common divisor of long numbers.
//!
//! The binary algorithm of `num_integer` takes a pass over both numbers for every bit or two of the longer one, even
//! beside a number of one digit. Here a division comes first, and numbers lose 30 bits in a pass (D. H. Lehmer, Amer.
//! Math. Monthly 45 (1938) 227; D. E. Knuth, The Art of Computer Programming 2, 4.5.2, Algorithm L) until they are of
//! the machine's size.

use num_bigint::{BigInt, BigUint};
use num_integer::Integer;
use num_traits::{One, ToPrimitive, Zero};

/// Numbers of these bits need no allocation.
const SHORT: u64 = 128;

/// For numbers whose lengths differ by more bits than this, a division takes less time than subtractions.
const MUCH_LONGER: u64 = 32;

/// The bits of both numbers that decide the next quotients.
const LEADING: u64 = 62;

/// The greatest common divisor, positive unless both are 0.
pub(crate) fn common_divisor(a: &BigInt, b: &BigInt) -> BigInt {
    let [a, b] = [a, b].map(BigInt::magnitude);
    // most numbers are as short: no allocation
    if let (Some(a), Some(b)) = (a.to_u64(), b.to_u64()) {
        return a.gcd(&b).into();
    }
    if let (Some(a), Some(b)) = (a.to_u128(), b.to_u128()) {
        return a.gcd(&b).into();
    }
    let (long, short) = if a >= b { (a, b) } else { (b, a) };
    match () {
        () if short.is_zero() => long.clone().into(),
        () if short.is_one() => BigInt::one(),
        () if long.bits() - short.bits() > MUCH_LONGER => of_long(short.clone(), long % short).into(),
        () => of_long(long.clone(), short.clone()).into(),
    }
}

/// The greatest common divisor of a number and one that is not larger.
fn of_long(mut a: BigUint, mut b: BigUint) -> BigUint {
    while b.bits() > SHORT {
        #[cfg(test)]
        tests::PASSES.set(tests::PASSES.get() + 1);
        let quotients = match a.bits() - b.bits() > MUCH_LONGER {
            true => None,
            false => Quotients::of(&a, &b),
        };
        (a, b) = match quotients {
            Some(quotients) => quotients.applied(&a, &b),
            None => {
                let rest = a % &b;
                (b, rest)
            }
        };
    }
    match b.is_zero() {
        true => a,
        // one division, so that both are short
        false => {
            let [b, rest] = [&b, &(a % &b)].map(|short| short.to_u128().expect("at most 128 bits"));
            b.gcd(&rest).into()
        }
    }
}

/// Several steps of Euclid's algorithm at once: a ← |u a + v b|, b ← |w a + x b|, where u and v, w and x differ in
/// sign.
struct Quotients {
    u: i64,
    v: i64,
    w: i64,
    x: i64,
}

impl Quotients {
    /// The steps that the leading bits decide; `None` if there are none.
    fn of(a: &BigUint, b: &BigUint) -> Option<Quotients> {
        let shift = a.bits() - LEADING;
        let leading = |number: &BigUint| (number >> shift).to_i64();
        let (mut high, mut low) = (leading(a)?, leading(b)?);
        let Quotients { mut u, mut v, mut w, mut x } = Quotients { u: 1, v: 0, w: 0, x: 1 };
        // the quotient of the whole numbers is between these two
        while low + w != 0 && low + x != 0 {
            let quotient = (high + u) / (low + w);
            if quotient != (high + v) / (low + x) {
                break;
            }
            (u, w) = (w, u - quotient * w);
            (v, x) = (x, v - quotient * x);
            (high, low) = (low, high - quotient * low);
        }
        (v != 0).then_some(Quotients { u, v, w, x })
    }

    fn applied(&self, a: &BigUint, b: &BigUint) -> (BigUint, BigUint) {
        let combined = |of_a: i64, of_b: i64| {
            let (a, b) = (a * of_a.unsigned_abs(), b * of_b.unsigned_abs());
            if of_a < 0 || of_b > 0 { b - a } else { a - b }
        };
        (combined(self.u, self.v), combined(self.w, self.x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::cell::Cell;

    thread_local! {
        /// Passes over long numbers.
        pub(super) static PASSES: Cell<u64> = const { Cell::new(0) };
    }

    /// 1e-9999 in a formula: the binary algorithm took 30 000 passes beside 7, and as many beside another long number.
    #[test]
    fn passes_are_few() {
        let passes = |a: &BigInt, b: &BigInt| {
            PASSES.set(0);
            common_divisor(a, b);
            PASSES.get()
        };
        let ten = |n: u32| BigInt::from(10).pow(n);
        assert_eq!(passes(&ten(9999), &7.into()), 0);
        assert!(passes(&ten(9999), &(ten(9000) + 7)) < 1500, "{}", passes(&ten(9999), &(ten(9000) + 7)));
        assert!(passes(&(ten(9999) - 7), &(ten(9999) / 3 + 1)) < 1500);
    }

    fn number(longest: usize) -> impl Strategy<Value = BigInt> {
        (any::<bool>(), prop::collection::vec(any::<u32>(), 0..longest)).prop_map(|(negative, digits)| {
            let number = BigInt::from(BigUint::new(digits));
            if negative { -number } else { number }
        })
    }

    proptest! {
        #[test]
        fn it_is_that_of_the_binary_algorithm(a in number(400), b in number(400), common in number(300)) {
            let [a, b] = [a * &common, b * &common];
            prop_assert_eq!(common_divisor(&a, &b), a.gcd(&b));
            prop_assert_eq!(common_divisor(&a, &common), a.gcd(&common));
        }
    }

    #[test]
    fn numbers_of_fibonacci_take_the_most_steps() {
        let (mut a, mut b) = (BigInt::one(), BigInt::one());
        for _ in 0..20_000 {
            (a, b) = (&a + &b, a);
        }
        assert!(a.bits() > 100 * SHORT && common_divisor(&a, &b).is_one());
        let common = BigInt::from(10).pow(5000);
        assert_eq!(common_divisor(&(&a * &common), &(-&b * &common)), common);
        assert_eq!(common_divisor(&BigInt::zero(), &-&a), a);
    }
}
