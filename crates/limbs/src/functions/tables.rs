//! Tables, computed at first use: in fixed point of 18 limbs, to a few units of the last one.

use crate::fixed;
use std::sync::LazyLock;

const WIDTH: usize = 18;

/// A fraction Σ x\[i\] 2^(64 (i − 18)).
pub(super) type Fraction = [u64; WIDTH];

/// A coefficient of a power series, and how many of its highest limbs are 0.
pub(super) struct Coefficient {
    pub(super) value: Fraction,
    pub(super) zeros: usize,
}

/// 1/(2n + 1)!
pub(super) static INVERSE_FACTORIALS: LazyLock<Vec<Coefficient>> =
    LazyLock::new(|| inverse_factorials().into_iter().skip(1).step_by(2).map(Coefficient::of).collect());

/// 1/(2n + 1)
pub(super) static INVERSES: LazyLock<Vec<Coefficient>> =
    LazyLock::new(|| (0..40).map(|n| Coefficient::of(over(&[u64::MAX; WIDTH], 2 * n + 1))).collect());

/// Sine and cosine of i/64 up to π/4, the latter below 1.
pub(super) static SINES: LazyLock<Vec<[Fraction; 2]>> = LazyLock::new(|| {
    let powers = powers_of_a_64th();
    let series = |first: usize| {
        let terms = powers.iter().enumerate().skip(first).step_by(2);
        terms.fold([0; WIDTH], |mut sum, (n, term)| {
            if n % 4 < 2 {
                fixed::add(&mut sum, term)
            } else {
                fixed::subtract(&mut sum, term)
            };
            sum
        })
    };
    let (sin, mut cos) = (series(1), series(2));
    fixed::add(&mut cos, &[u64::MAX; WIDTH]); // cos 1/64, the sum after its first term
    let next = |[s, c]: &[Fraction; 2]| {
        let mut sum = product(s, &cos);
        fixed::add(&mut sum, &product(c, &sin));
        Some([sum, fixed::difference(&product(c, &cos), &product(s, &sin))])
    };
    std::iter::successors(Some([[0; WIDTH], [u64::MAX; WIDTH]]), next).take(52).collect()
});

/// e^(i/64)/2 up to i = 44.
pub(super) static EXPONENTIALS: LazyLock<Vec<Fraction>> = LazyLock::new(|| {
    let mut growth = [0; WIDTH]; // e^(1/64) − 1
    powers_of_a_64th().iter().skip(1).for_each(|term| {
        fixed::add(&mut growth, term);
    });
    let next = |value: &Fraction| {
        let mut next = *value;
        fixed::add(&mut next, &product(value, &growth));
        Some(next)
    };
    let mut half = [0; WIDTH];
    half[WIDTH - 1] = 1 << 63;
    std::iter::successors(Some(half), next).take(45).collect()
});

impl Coefficient {
    fn of(value: Fraction) -> Coefficient {
        Coefficient { value, zeros: (fixed::leading_zeros(&value) / 64) as usize }
    }
}

/// 1/n!, the first two below 1.
fn inverse_factorials() -> Vec<Fraction> {
    let mut value = [u64::MAX; WIDTH];
    let mut next = |n| {
        value = over(&value, n);
        value
    };
    (0..180).map(|n| next(n.max(1))).collect()
}

/// 64^-n/n!
fn powers_of_a_64th() -> Vec<Fraction> {
    inverse_factorials().iter().enumerate().map(|(n, value)| fixed::shift_down(value, 6 * n as u32)).collect()
}

fn over(x: &Fraction, n: u64) -> Fraction {
    let mut quotient = *x;
    fixed::divide_limb(&mut quotient, n);
    quotient
}

fn product(a: &Fraction, b: &Fraction) -> Fraction {
    fixed::high_product(a, b).0
}
