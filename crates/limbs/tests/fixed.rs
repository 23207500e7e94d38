//! Fixed-point arithmetic of arrays of limbs beside GMP's integers.

use super::mpfr::Random;
use rug::Integer;
use rug::integer::Order;
use rug::ops::RemRounding;
use shadowstep_limbs::fixed;

fn integer(limbs: &[u64]) -> Integer {
    Integer::from_digits(limbs, Order::Lsf)
}

fn check<const N: usize>(random: &mut Random) {
    let one = Integer::from(1) << (64 * N as u32);
    let modulo = |x: Integer| x.rem_euc(&one);
    let (a, b) = (*random.mantissa::<N>().mantissa(), *random.mantissa::<N>().mantissa());
    let b = fixed::shift_down(&b, random.below(64 * N as u64) as u32);
    let n = random.next() >> random.below(64);
    let (x, y) = (integer(&a), integer(&b));

    let mut sum = a;
    assert_eq!(fixed::add(&mut sum, &b), Integer::from(&x + &y) >= one);
    assert_eq!(integer(&sum), modulo(Integer::from(&x + &y)));
    let mut difference = b;
    assert_eq!(fixed::subtract(&mut difference, &a), y < x);
    assert_eq!(difference, fixed::difference(&b, &a));
    assert_eq!(integer(&difference), modulo(Integer::from(&y - &x)));
    assert_eq!(fixed::compare(&a, &b), x.cmp(&y));
    fixed::negate(&mut difference);
    assert_eq!(integer(&difference), modulo(Integer::from(&x - &y)));
    let mut carried = a;
    assert_eq!(fixed::add_limb(&mut carried, n), Integer::from(&x + n) >= one);
    assert_eq!(integer(&carried), modulo(Integer::from(&x + n)));

    let (low, high) = fixed::product(&a, &b);
    assert_eq!(integer(&high) * &one + integer(&low), Integer::from(&x * &y));
    check_high(fixed::high_product(&a, &b), &Integer::from(&x * &y));
    check_high(fixed::high_square(&a), &Integer::from(x.square_ref()));

    let mut product = a;
    let above = fixed::multiply_limb(&mut product, n);
    assert_eq!(integer(&product) + Integer::from(above) * &one, Integer::from(&x * n));
    let mut product = b;
    let above = fixed::add_product_limb(&mut product, &a, n);
    assert_eq!(integer(&product) + Integer::from(above) * &one, Integer::from(&x * n) + &y);
    let mut product = b;
    let below = fixed::subtract_product_limb(&mut product, &a, n);
    assert_eq!(integer(&product) - Integer::from(below) * &one, &y - Integer::from(&x * n));
    let mut quotient = a;
    let (below, more) = fixed::divide_limb(&mut quotient, n.max(1));
    let (exact, remainder) = Integer::from(&x << 64).div_rem(Integer::from(n.max(1)));
    assert_eq!(((integer(&quotient) << 64) + below, more), (exact, remainder != 0));

    let shift = random.below(64 * N as u64 + 70) as u32;
    assert_eq!(integer(&fixed::shift_down(&a, shift)), Integer::from(&x >> shift));
    assert_eq!(integer(&fixed::shift_up(&a, shift)), modulo(Integer::from(&x << shift)));
    assert_eq!((fixed::limb_down(&a), fixed::limb_up(&a)), (fixed::shift_down(&a, 64), fixed::shift_up(&a, 64)));
    assert_eq!(fixed::leading_zeros(&b), 64 * N as u32 - y.significant_bits());
}

/// Checks that the product is too small by less than 2 N units of the limb below its upper half.
fn check_high<const N: usize>((high, below): ([u64; N], u64), exact: &Integer) {
    let own = (integer(&high) << 64) + below;
    let error = Integer::from(exact >> (64 * N as u32 - 64)) - own;
    assert!(error >= 0 && error < 2 * N as u32, "{error} units");
}

#[test]
fn arrays_of_limbs_are_integers() {
    let random = &mut Random(7);
    for _ in 0..3000 {
        check::<2>(random);
        check::<3>(random);
        check::<4>(random);
        check::<7>(random);
        check::<8>(random);
    }
}
