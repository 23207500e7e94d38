//! E_k in fixed point: sums of pairs of states with integer weights.
//!
//! With rows (−1)^ℓ B(j + ℓ, j)/ℓ, B being the pair, the weights are integers and one factor:
//!
//! E_k = 1/(h C(2k,k)) Σ_ℓ Σ_j C(k,j+ℓ) C(k,j) (−1)^ℓ B(j + ℓ, j)/ℓ
//!
//! For k ≤ 34 a weight is one limb. A sum begins with the unit of the first row, takes that of a coarser row where it meets one, and is rounded
//! once at the end.

use num_bigint::{BigInt, Sign};

use super::{
    MOST_LIMBS, MOST_OF_ROW, NOT_FINITE, Offset, ZERO, by_limbs, move_row, moved, read_number, sign, write_number,
};
use crate::number::{LimbAccess, Parts};

/// Pairs are numbers about 1 in most units.
const OFFSET: Offset = 32;

/// The most limbs of a sum: those of a row, and as many as weights have, whose sum is below 2^(64 · 9) for k ≤ 256.
const MOST_OF_SUM: usize = MOST_LIMBS + 1 + 10;

/// Rows of pairs, by places.
#[derive(Clone, Debug)]
pub(in crate::shadow) struct Rows {
    /// How many limbs a row has.
    size: usize,
    low: Vec<i64>,
    limbs: Vec<u64>,
}

impl Rows {
    /// So many rows, for numbers with so many limbs.
    pub(in crate::shadow) fn new(limbs: usize, count: usize) -> Self {
        let size = limbs + 1;
        Rows { size, low: vec![ZERO; count], limbs: vec![0; count * size] }
    }

    pub(in crate::shadow) fn set(&mut self, place: usize, number: Parts<'_>) {
        self.low[place] = write_number(number, OFFSET, &mut self.limbs[place * self.size..][..self.size]);
    }

    fn row(&self, place: usize) -> (&[u64], i64) {
        (&self.limbs[place * self.size..][..self.size], self.low[place])
    }
}

/// The rows of a lag within a window, newest first: j = 0..=last.
#[derive(Clone, Copy, Debug)]
pub(in crate::shadow) struct OfLag {
    pub(in crate::shadow) lag: usize,
    pub(in crate::shadow) last: usize,
    /// Where the rows of the lag begin, how many there are, and which of them is the newest of the window.
    pub(in crate::shadow) first: usize,
    pub(in crate::shadow) count: usize,
    pub(in crate::shadow) newest: usize,
}

impl OfLag {
    /// The place of the j-th row.
    pub(in crate::shadow) fn place(&self, j: usize) -> usize {
        self.first + if j <= self.newest { self.newest - j } else { self.newest + self.count - j }
    }
}

/// Integer weights by lags ℓ = 1, 2, …
#[derive(Clone, Debug)]
pub(in crate::shadow) struct IntegerWeights {
    /// For each lag the magnitudes one after the other, each with as many limbs as the largest weight has.
    of_lags: Vec<Vec<u64>>,
    negative: Vec<Vec<bool>>,
    width: usize,
}

impl IntegerWeights {
    pub(in crate::shadow) fn new(weights: &[Vec<BigInt>]) -> Self {
        let limbs = |weight: &BigInt| weight.magnitude().to_u64_digits();
        let width = weights.iter().flatten().map(|weight| limbs(weight).len()).max().unwrap_or(1);
        let padded = |weight: &BigInt| {
            let mut limbs = limbs(weight);
            limbs.resize(width, 0);
            limbs
        };
        IntegerWeights {
            of_lags: weights.iter().map(|row| row.iter().flat_map(padded).collect()).collect(),
            negative: weights.iter().map(|row| row.iter().map(|w| w.sign() == Sign::Minus).collect()).collect(),
            width,
        }
    }
}

/// Sums of the same rows with up to two kinds of weights.
#[derive(Clone, Debug)]
pub(in crate::shadow) struct Sums {
    low: i64,
    limbs: [[u64; MOST_OF_SUM]; 2],
}

impl Sums {
    pub(in crate::shadow) fn zero() -> Self {
        Sums { low: ZERO, limbs: [[0; MOST_OF_SUM]; 2] }
    }

    /// Adds the rows of a lag with the weights of each kind; those at the same distance from both ends have the same weight.
    pub(in crate::shadow) fn add(&mut self, rows: &Rows, of_lag: OfLag, weights: [Option<&IntegerWeights>; 2]) {
        by_limbs!(add_rows(rows.size, self, rows, of_lag, weights));
    }

    /// x ← the sum of a kind, whose limbs are lost.
    pub(in crate::shadow) fn read<N>(&mut self, kind: usize, weights: &IntegerWeights, access: &LimbAccess<N>, x: &mut N) {
        if self.low == NOT_FINITE {
            return (access.assign_nan)(x);
        }
        let len = access.limbs + 1 + weights.width + 1;
        read_number(x, access, &mut self.limbs[kind][..len], self.low, OFFSET);
    }

    /// Gives the sums and a row the same `low`: the larger one.
    #[cold]
    fn move_to(&mut self, row: &mut [u64], low: i64) {
        let common = self.low.max(low);
        self.limbs.iter_mut().for_each(|limbs| move_row(limbs, common.saturating_sub(self.low)));
        move_row(row, common.saturating_sub(low));
        self.low = common;
    }
}

#[inline(always)]
fn add_rows(len: usize, sums: &mut Sums, rows: &Rows, of_lag: OfLag, weights: [Option<&IntegerWeights>; 2]) {
    let OfLag { lag, last, .. } = of_lag;
    let mut row = [0; MOST_OF_ROW];
    let row = &mut row[..len];
    for j in 0..=last / 2 {
        let room;
        let ((mut a, a_low), (mut b, b_low)) = (rows.row(of_lag.place(j)), rows.row(of_lag.place(last - j)));
        if a_low != b_low {
            room = moved(len, (a, a_low), (b, b_low));
            [a, b] = [&room[0], &room[1]];
        }
        let low = a_low.max(b_low);
        let (a, b) = (&a[..len], &b[..len]);
        if last - j == j {
            row.copy_from_slice(a);
        } else {
            let mut carry = false;
            for i in 0..len {
                (row[i], carry) = a[i].carrying_add(b[i], carry);
            }
        }
        if low != sums.low {
            sums.move_to(row, low);
        }
        for (sum, weights) in sums.limbs.iter_mut().zip(weights) {
            if let Some(IntegerWeights { of_lags, negative, width }) = weights {
                let weight = &of_lags[lag - 1][j * width..(j + 1) * width];
                add_multiple(len, &mut sum[..len + width + 1], row, weight, negative[lag - 1][j]);
            }
        }
    }
}

/// sum ← sum ± n row
#[inline(always)]
fn add_multiple(len: usize, sum: &mut [u64], row: &[u64], n: &[u64], minus: bool) {
    let opposite = if minus { u64::MAX } else { 0 };
    let negative = sign(row[len - 1]) ^ opposite;
    for (at, n) in n.iter().enumerate() {
        let (low, high) = sum[at..].split_at_mut(len);
        // −row is the complement and 1; n times that is carried in
        let mut carry = n & opposite;
        for i in 0..len {
            (low[i], carry) = (row[i] ^ opposite).carrying_mul_add(*n, low[i], carry);
        }
        // as an unsigned number, a row below 0 is too large by 2^(64 len)
        let (mut more, less) = carry.overflowing_sub(n & negative);
        let above = if less { u64::MAX } else { 0 };
        let mut carry = false;
        for limb in high {
            (*limb, carry) = limb.carrying_add(more, carry);
            more = above;
        }
    }
}
