//! Numbers in fixed point as digits of 57 bits with signs, in words of 64.
//!
//! A word has room for several sums of digits, and two words for those of products, so that carries are settled once
//! for many operations, and no operation waits for another's. Signs are those of the digits: a difference or a product
//! is one without a test.

use super::{MOST_LIMBS, NOT_FINITE, Offset, ZERO, negate};
use crate::number::Parts;

/// Bits of a digit.
pub(super) const BITS: u32 = 57;

const MASK: i64 = (1 << BITS) - 1;

/// How many digits a number of this number of limbs takes, wherever it begins, with some bits below it.
pub(super) const fn digits_of(limbs: usize) -> usize {
    (64 * limbs + 1 + BITS as usize + GUARD).div_ceil(BITS as usize)
}

/// Bits below those of a number, for what is dropped from its differences.
const GUARD: usize = 7;

/// How many digits more a difference can have.
pub(super) const MORE: usize = 1;

/// The most digits of a difference.
pub(super) const MOST_DIGITS: usize = digits_of(MOST_LIMBS) + MORE;

/// Whether the highest digit of a number is too large, or is not needed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Highest {
    /// 2^BITS or more: there is no room for another [`SUMS`] sums.
    pub(super) is_large: bool,
    /// With the digit below it is smaller than half of that.
    pub(super) is_needless: bool,
}

/// How many times digits may double before they are settled.
pub(super) const SUMS: usize = 5;

/// Writes x; returns the place of the lowest digit. Bits below it are dropped: |x| is smaller than 2^(BITS (place +
/// count) − offset − 2), but not than 2^−BITS times that.
pub(super) fn write(parts: Parts<'_>, offset: Offset, digits: &mut [i64]) -> i64 {
    let (negative, exponent, significand) = match parts {
        Parts::Regular { negative, exponent, significand } => (negative, exponent, significand),
        Parts::Zero | Parts::NotFinite => {
            digits.fill(0);
            return if matches!(parts, Parts::Zero) { ZERO } else { NOT_FINITE };
        }
    };
    let bits = i64::from(BITS);
    let low = (exponent + offset + 2 + bits - 1).div_euclid(bits) - digits.len() as i64;
    let limb = |i: i64| usize::try_from(i).ok().and_then(|i| significand.get(i)).copied().unwrap_or(0);
    // of its lowest digit in the significand
    let mut bit = bits * low - offset - (exponent - 64 * significand.len() as i64);
    for digit in digits {
        let (at, from) = (bit.div_euclid(64), bit.rem_euclid(64) as u32);
        let magnitude = (limb(at) >> from | limb(at + 1) << 1 << (63 - from)).cast_signed() & MASK;
        *digit = if negative { -magnitude } else { magnitude };
        bit += bits;
    }
    low
}

/// Gives each digit but the lowest the carry of the digit below.
#[inline(always)]
pub(super) fn settle(digits: &mut [i64]) -> Highest {
    let Some((highest, rest)) = digits.split_last_mut() else { unreachable!("a number has a digit") };
    let mut carry = 0;
    for digit in rest.iter_mut() {
        let own = *digit;
        (*digit, carry) = ((own & MASK) + carry, own >> BITS);
    }
    *highest += carry;
    let both = rest.last().map(|next| next.wrapping_add(highest.wrapping_shl(BITS)));
    Highest {
        is_large: highest.unsigned_abs() >> BITS != 0,
        is_needless: (*highest == 0 || *highest == -1)
            && both.is_some_and(|both| both.unsigned_abs() >> (BITS - 1) == 0),
    }
}

/// Divides a highest digit into two.
pub(super) fn split(highest: &mut i64, above: &mut i64) {
    (*highest, *above) = (*highest & MASK, *highest >> BITS);
}

/// Makes one of the two highest digits.
pub(super) fn join(next: &mut i64, highest: &mut i64) {
    *next += *highest << BITS;
    *highest = 0;
}

/// Adds f a to columns, where a has n digits, and f has n + 1, its highest one first: from the column n − 1 on, which
/// is one below the unit of a times the highest digit of f. The columns below are lost, less than 32 n units of the
/// column n.
#[inline(always)]
pub(super) fn add_product(n: usize, columns: &mut [i128], f: &[i64], a: &[i64]) {
    let (columns, f, a) = (&mut columns[..n + 1], &f[..n + 1], &a[..n]);
    for column in 0..n + 1 {
        let mut sum = 0;
        for i in column.max(1) - 1..n {
            sum += i128::from(f[i + 1 - column]) * i128::from(a[i]);
        }
        columns[column] += sum;
    }
}

/// Moves columns to a place that is higher by this number of digits.
pub(super) fn move_down(columns: &mut [i128], by: usize) {
    let by = by.min(columns.len());
    let carry = columns[..by].iter().fold(0, |carry, column| (column + carry) >> BITS);
    columns.copy_within(by.., 0);
    let left = columns.len() - by;
    columns[left..].fill(0);
    columns[0] += carry;
}

/// Settles all carries of columns but that of the highest.
#[inline(always)]
pub(super) fn carry(columns: &mut [i128]) {
    let mut carry = 0;
    let Some((highest, rest)) = columns.split_last_mut() else { return };
    for column in rest {
        let sum = *column + carry;
        (*column, carry) = (sum & i128::from(MASK), sum >> BITS);
    }
    *highest += carry;
}

/// Writes the magnitude of the number in columns, of which the highest is smaller than 2^60, into limbs, as many as are
/// needed; returns them, and whether it is below 0.
pub(super) fn magnitude<'l>(columns: &[i128], limbs: &'l mut [u64]) -> (&'l [u64], bool) {
    let Some((highest, rest)) = columns.split_last() else { unreachable!("there is a column") };
    let (mut at, mut bits, mut limb) = (0, 0, 0);
    // a column has bits of three digits: so a carry waits for the one before it only in words of 64 bits
    let (mut carry, mut from_below, mut from_two_below) = (0, 0, [0; 2]);
    for column in rest {
        let sum = (*column as i64 & MASK) + from_below + from_two_below[0] + carry;
        (from_below, from_two_below) =
            ((column >> BITS) as i64 & MASK, [from_two_below[1], (column >> (2 * BITS)) as i64]);
        carry = sum >> BITS;
        let digit = (sum & MASK).cast_unsigned();
        limb |= digit << bits;
        bits += BITS;
        if bits >= 64 {
            bits -= 64;
            limbs[at] = limb;
            (at, limb) = (at + 1, digit >> (BITS - bits));
        }
    }
    // products end two columns below
    let sum = *highest as i64 + from_below + from_two_below[0] + carry;
    let negative = sum < 0;
    limbs[at] = limb | sum.cast_unsigned() << bits;
    limbs[at + 1] = (i128::from(sum) >> (64 - bits)) as u64;
    let limbs = &mut limbs[..at + 2];
    if negative {
        negate(limbs);
    }
    (limbs, negative)
}
