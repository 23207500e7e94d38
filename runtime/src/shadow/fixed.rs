//! Fixed-point numbers of 64-bit limbs, for the estimators of numbers that are made of limbs.
//!
//! A *row* is a number in two's complement: Σ limb\[i\] 2^(64 (low + i) − offset), the lowest limb first. Rows of the
//! same `low` are added limb by limb, without a search for leading bits and without rounding. A number is put into a
//! row with all its bits, at the limbs where its exponent puts it: its `low` follows from its size, so that rows keep
//! the relative precision of floating point. Where a row meets one with a larger `low`, the limbs below that are
//! dropped: an error of one unit of the coarser row.
//!
//! Where numbers are subtracted and multiplied many times, rows are of smaller [`digits`] with signs.

mod digits;
mod pairs;
mod products;
mod table;

pub(super) use pairs::{IntegerWeights, OfLag, Rows, Sums};
pub(super) use products::StateRows;
pub(super) use table::FixedTable;

use crate::number::{LimbAccess, Parts};

/// The most limbs of a significand.
pub(super) const MOST_LIMBS: usize = 17;

/// The most limbs of a row: of a difference.
const MOST_OF_ROW: usize = MOST_LIMBS + 2;

/// `low` of 0, which is exact in every row.
const ZERO: i64 = i64::MIN / 2;

/// `low` of an infinity or NaN, which any number becomes that it is added to.
const NOT_FINITE: i64 = i64::MAX;

/// Numbers in [2^−(offset + 2), 2^(62 − offset)) have the same `low`.
type Offset = i64;

/// Calls an inlined function with its first argument, a number of limbs or digits: a constant up to 10, as 120 decimal
/// digits and their differences need, so that its loops are unrolled.
macro_rules! by_limbs {
    ($function:ident($limbs:expr, $($argument:expr),*)) => {
        by_limbs!($function, $limbs, ($($argument),*), 1 2 3 4 5 6 7 8 9 10)
    };
    ($function:ident, $limbs:expr, $arguments:tt, $($n:literal)*) => {
        match $limbs {
            $($n => by_limbs!(@call $function, $n, $arguments),)*
            limbs => by_limbs!(@call $function, limbs, $arguments),
        }
    };
    (@call $function:ident, $n:expr, ($($argument:expr),*)) => { $function($n, $($argument),*) };
}
use by_limbs;

/// Writes |x| into a row with two free bits above it; returns `low`, and whether x < 0. Bits below the row are dropped:
/// a row of one limb more than the significand has them all.
fn write_magnitude(parts: Parts<'_>, offset: Offset, row: &mut [u64]) -> (i64, bool) {
    let (negative, exponent, significand) = match parts {
        Parts::Regular { negative, exponent, significand } => (negative, exponent, significand),
        Parts::Zero | Parts::NotFinite => {
            row.fill(0);
            return (if matches!(parts, Parts::Zero) { ZERO } else { NOT_FINITE }, false);
        }
    };
    // |x| < 2^exponent ≤ 2^(64 top − offset − 2)
    let top = (exponent + offset + 2 + 63).div_euclid(64);
    let down = (64 * top - offset - exponent) as u32; // 2 to 65 bits, from the upper end of the row
    let (limbs, bits) = ((down / 64) as usize, down % 64);
    let first = significand.len() as isize + limbs as isize - row.len() as isize;
    let at = |i: isize| usize::try_from(i).ok().and_then(|i| significand.get(i)).copied().unwrap_or(0);
    for (i, limb) in (first..).zip(row.iter_mut()) {
        *limb = at(i) >> bits | at(i + 1) << 1 << (63 - bits);
    }
    (top - row.len() as i64, negative)
}

/// Writes x into a row; returns `low`.
fn write_number(parts: Parts<'_>, offset: Offset, row: &mut [u64]) -> i64 {
    let (low, negative) = write_magnitude(parts, offset, row);
    if negative {
        negate(row);
    }
    low
}

/// x ← the number in a row, whose limbs are lost.
fn read_number<N>(x: &mut N, access: &LimbAccess<N>, row: &mut [u64], low: i64, offset: Offset) {
    let negative = sign(row[row.len() - 1]) != 0;
    if negative {
        negate(row);
    }
    (access.assign)(x, negative, row, low.saturating_mul(64).saturating_sub(offset));
}

/// All bits of a limb like the highest one: what follows above.
#[inline(always)]
fn sign(top: u64) -> u64 {
    (top.cast_signed() >> 63).cast_unsigned()
}

/// x ← −x
#[inline(always)]
fn negate(row: &mut [u64]) {
    let mut carry = true;
    for limb in row {
        (*limb, carry) = (!*limb).carrying_add(0, carry);
    }
}

/// Moves a row to the place of one with a larger `low`.
fn move_row(row: &mut [u64], by: i64) {
    let by = usize::try_from(by).unwrap_or(0).min(row.len());
    let (left, sign) = (row.len() - by, sign(row[row.len() - 1]));
    row.copy_within(by.., 0);
    row[left..].fill(sign);
}
