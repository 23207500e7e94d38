//! Arithmetic of integers of a fixed number of limbs, for fixed-point numbers.
//!
//! An integer of N limbs is an array, the lowest limb first: Σ x\[i\] 2^(64 i). All operations are modulo 2^(64 N) and
//! give what they carry out; a negative number is its two's complement.
//!
//! ```
//! use shadowstep_limbs::fixed;
//!
//! let mut x = [u64::MAX, 0, 0];
//! assert!(!fixed::add(&mut x, &[1, 0, 0]));
//! assert_eq!(x, [0, 1, 0]);
//! assert!(fixed::subtract(&mut x, &[0, 0, 1])); // borrows: x < 0
//! assert!(fixed::is_negative(&x));
//! ```

use std::cmp::Ordering;
use std::hint::select_unpredictable;

/// x ← x + a; whether it carries.
#[inline(always)]
pub fn add<const N: usize>(x: &mut [u64; N], a: &[u64; N]) -> bool {
    let mut carry = false;
    for i in 0..N {
        (x[i], carry) = x[i].carrying_add(a[i], carry);
    }
    carry
}

/// x ← x − a; whether it borrows, that is, x < a.
#[inline(always)]
pub fn subtract<const N: usize>(x: &mut [u64; N], a: &[u64; N]) -> bool {
    let mut borrow = false;
    for i in 0..N {
        (x[i], borrow) = x[i].borrowing_sub(a[i], borrow);
    }
    borrow
}

/// a − b
#[inline(always)]
pub fn difference<const N: usize>(a: &[u64; N], b: &[u64; N]) -> [u64; N] {
    let mut x = *a;
    subtract(&mut x, b);
    x
}

/// x ← x + n; whether it carries.
#[inline(always)]
pub fn add_limb<const N: usize>(x: &mut [u64; N], n: u64) -> bool {
    let mut carry = n;
    for limb in x {
        let (sum, carries) = limb.overflowing_add(carry);
        *limb = sum;
        carry = u64::from(carries);
    }
    carry != 0
}

/// x ← −x
#[inline(always)]
pub fn negate<const N: usize>(x: &mut [u64; N]) {
    let mut borrow = false;
    for limb in x {
        (*limb, borrow) = 0u64.borrowing_sub(*limb, borrow);
    }
}

/// Whether the two's complement is below 0.
#[inline(always)]
pub fn is_negative<const N: usize>(x: &[u64; N]) -> bool {
    x[N - 1] >> 63 != 0
}

/// Whether x = 0.
#[inline(always)]
pub(crate) fn is_zero<const N: usize>(x: &[u64; N]) -> bool {
    x.iter().fold(0, |any, limb| any | limb) == 0
}

/// The order of two numbers ≥ 0.
#[inline]
pub fn compare<const N: usize>(a: &[u64; N], b: &[u64; N]) -> Ordering {
    a.iter().rev().cmp(b.iter().rev())
}

/// The number of 0 bits above the highest 1: 64 N for 0.
#[inline]
pub fn leading_zeros<const N: usize>(x: &[u64; N]) -> u32 {
    let zeros = x.iter().rev().take_while(|limb| **limb == 0).count();
    zeros as u32 * 64 + if zeros < N { x[N - 1 - zeros].leading_zeros() } else { 0 }
}

/// ⌊x / 2^64⌋ of a number ≥ 0
#[inline(always)]
pub fn limb_down<const N: usize>(x: &[u64; N]) -> [u64; N] {
    let mut shifted = [0; N];
    shifted[..N - 1].copy_from_slice(&x[1..]);
    shifted
}

/// x 2^64
#[inline(always)]
pub fn limb_up<const N: usize>(x: &[u64; N]) -> [u64; N] {
    let mut shifted = [0; N];
    shifted[1..].copy_from_slice(&x[..N - 1]);
    shifted
}

/// ⌊x / 2^n⌋ of a number ≥ 0; 0 where n ≥ 64 N.
#[inline]
pub fn shift_down<const N: usize>(x: &[u64; N], n: u32) -> [u64; N] {
    let (limbs, bits) = ((n / 64) as usize, n % 64);
    let at = |i: usize| if i < N { x[i] } else { 0 };
    let mut shifted = [0; N];
    for (i, limb) in shifted.iter_mut().enumerate() {
        *limb = at(i + limbs) >> bits | at(i + limbs + 1) << 1 << (63 - bits);
    }
    shifted
}

/// x 2^n; 0 where n ≥ 64 N.
#[inline]
pub fn shift_up<const N: usize>(x: &[u64; N], n: u32) -> [u64; N] {
    let (limbs, bits) = ((n / 64) as usize, n % 64);
    let at = |i: usize| if i < N { x[i] } else { 0 }; // an index below 0 wraps: 0, too
    let mut shifted = [0; N];
    for (i, limb) in shifted.iter_mut().enumerate() {
        let i = i.wrapping_sub(limbs);
        *limb = at(i) << bits | at(i.wrapping_sub(1)) >> 1 >> (63 - bits);
    }
    shifted
}

/// x ← n x of a number x ≥ 0; what is carried out.
#[inline(always)]
pub fn multiply_limb<const N: usize>(x: &mut [u64; N], n: u64) -> u64 {
    let mut carry = 0;
    for limb in x {
        (*limb, carry) = limb.carrying_mul(n, carry);
    }
    carry
}

/// x ← x + n a of numbers ≥ 0; what is carried out.
#[inline(always)]
pub fn add_product_limb<const N: usize>(x: &mut [u64; N], a: &[u64; N], n: u64) -> u64 {
    let mut carry = 0;
    for i in 0..N {
        (x[i], carry) = a[i].carrying_mul_add(n, carry, x[i]);
    }
    carry
}

/// x ← x − n a of numbers ≥ 0; what is borrowed.
#[inline(always)]
pub fn subtract_product_limb<const N: usize>(x: &mut [u64; N], a: &[u64; N], n: u64) -> u64 {
    let mut carry = 0;
    for i in 0..N {
        let (product, high) = a[i].carrying_mul(n, carry);
        let (difference, borrow) = x[i].overflowing_sub(product);
        x[i] = difference;
        carry = high + u64::from(borrow); // high < 2^64 − 1
    }
    carry
}

/// x ← ⌊x / n⌋ of a number x ≥ 0; the limb of the quotient below that, and whether more follows.  Panics where n = 0.
#[inline]
pub fn divide_limb<const N: usize>(x: &mut [u64; N], n: u64) -> (u64, bool) {
    let shift = n.leading_zeros();
    let divisor = Divisor::new(n << shift);
    let upper = |limb: u64| limb >> 1 >> (63 - shift);
    let mut remainder = upper(x[N - 1]);
    for i in (0..N).rev() {
        let next = if i > 0 { upper(x[i - 1]) } else { 0 };
        (x[i], remainder) = divisor.divide(remainder, x[i] << shift | next);
    }
    let (below, remainder) = divisor.divide(remainder, 0);
    (below, remainder != 0)
}

/// A limb whose highest bit is 1, and its reciprocal ⌊(2^128 − 1)/d⌋ − 2^64, with which the division of two limbs is
/// two multiplications (Möller and Granlund, IEEE Transactions on Computers 60 (2011) 165, algorithm 4).
#[derive(Clone, Copy)]
pub(crate) struct Divisor {
    limb: u64,
    reciprocal: u64,
}

impl Divisor {
    #[inline(always)]
    pub(crate) fn new(limb: u64) -> Divisor {
        let above = u128::from(!limb) << 64 | u128::from(u64::MAX);
        Divisor { limb, reciprocal: (above / u128::from(limb)) as u64 }
    }

    #[inline(always)]
    pub(crate) fn reciprocal(&self) -> u64 {
        self.reciprocal
    }

    /// Quotient and remainder of high 2^64 + low, where high < d.
    #[inline(always)]
    fn divide(&self, high: u64, low: u64) -> (u64, u64) {
        let (q_low, q_high) = self.reciprocal.carrying_mul(high, low);
        let mut quotient = q_high.wrapping_add(high).wrapping_add(1);
        let mut remainder = low.wrapping_sub(quotient.wrapping_mul(self.limb));
        // as often as not, so without a branch
        let above = remainder > q_low;
        quotient = quotient.wrapping_sub(u64::from(above));
        remainder = select_unpredictable(above, remainder.wrapping_add(self.limb), remainder);
        if remainder >= self.limb {
            quotient += 1;
            remainder -= self.limb;
        }
        (quotient, remainder)
    }
}

/// The lower and the upper half of a b, of numbers ≥ 0.
#[inline(always)]
pub fn product<const N: usize>(a: &[u64; N], b: &[u64; N]) -> ([u64; N], [u64; N]) {
    let (mut low, mut high) = ([0; N], [0; N]);
    for i in 0..N {
        let mut carry = 0;
        for j in 0..N - i {
            (low[i + j], carry) = a[i].carrying_mul_add(b[j], low[i + j], carry);
        }
        for j in N - i..N {
            (high[i + j - N], carry) = a[i].carrying_mul_add(b[j], high[i + j - N], carry);
        }
        high[i] = carry;
    }
    (low, high)
}

/// a b / 2^(64 N) of numbers ≥ 0, as its integer part and the limb below that, from the products of limbs that reach so
/// far: too small by less than 2 N units of the limb below.
#[inline(always)]
pub fn high_product<const N: usize>(a: &[u64; N], b: &[u64; N]) -> ([u64; N], u64) {
    let (mut high, mut below) = ([0; N], 0);
    for i in 0..N {
        let mut carry = if i + 1 < N { upper(a[i], b[N - 2 - i]) } else { 0 };
        (below, carry) = a[i].carrying_mul_add(b[N - 1 - i], below, carry);
        for j in N - i..N {
            (high[i + j - N], carry) = a[i].carrying_mul_add(b[j], high[i + j - N], carry);
        }
        high[i] = carry;
    }
    (high, below)
}

/// a² / 2^(64 N) of a number ≥ 0, like [`high_product`].
#[inline(always)]
pub fn high_square<const N: usize>(a: &[u64; N]) -> ([u64; N], u64) {
    let (mut high, mut below) = ([0; N], 0);
    for i in N / 2..N {
        let mut carry = if 1 <= i && i + 1 < N { upper(a[i], a[N - 2 - i]) } else { 0 };
        if 2 * i + 1 == N {
            below = carry;
            continue;
        }
        (below, carry) = a[i].carrying_mul_add(a[N - 1 - i], below, carry);
        for j in N - i..i {
            (high[i + j - N], carry) = a[i].carrying_mul_add(a[j], high[i + j - N], carry);
        }
        high[2 * i - N] = carry;
    }
    // twice these products of two different limbs, and the squares
    let mut carry;
    (below, carry) = below.carrying_add(below, false);
    for limb in &mut high {
        (*limb, carry) = limb.carrying_add(*limb, carry);
    }
    let middle = (N - 1) / 2;
    if N.is_multiple_of(2) {
        (below, carry) = below.overflowing_add(upper(a[middle], a[middle]));
    } else {
        let (low, up) = a[middle].carrying_mul(a[middle], 0);
        (below, carry) = below.overflowing_add(low);
        (high[0], carry) = high[0].carrying_add(up, carry);
    }
    for (i, limb) in a.iter().enumerate().skip(middle + 1) {
        let (low, up) = limb.carrying_mul(*limb, 0);
        let k = 2 * i - N;
        (high[k], carry) = high[k].carrying_add(low, carry);
        (high[k + 1], carry) = high[k + 1].carrying_add(up, carry);
    }
    (high, below)
}

/// ⌊a b / 2^64⌋
#[inline(always)]
fn upper(a: u64, b: u64) -> u64 {
    a.carrying_mul(b, 0).1
}
