//! E_k in fixed point: sums of pairs of states with integer weights.
//!
//! With rows (−1)^ℓ B(j + ℓ, j)/ℓ, B being the pair, the weights are integers and one factor:
//!
//! E_k = 1/(h C(2k,k)) Σ_ℓ Σ_j C(k,j+ℓ) C(k,j) (−1)^ℓ B(j + ℓ, j)/ℓ
//!
//! For k ≤ 34 a weight is one limb. Sums have a limb below the unit of the coarsest row, and are rounded once at the
//! end.

use num_bigint::{BigInt, Sign};

use super::{MOST_LIMBS, MOST_OF_ROW, NOT_FINITE, Offset, ZERO, by_limbs, move_row, read_number, sign, write_number};
use crate::number::saved::Fields;
use crate::number::{LimbAccess, Parts};

/// Pairs are numbers about 1 in most units.
pub(super) const OFFSET: Offset = 32;

/// The most limbs of a sum: the limbs of a row, one below, and one more than weights have, which is 9 for k ≤ 256.
const MOST_OF_SUM: usize = MOST_LIMBS + 1 + 11;

/// Rows of pairs, by places.
#[derive(Clone, Debug)]
pub(in crate::shadow) struct Rows {
    /// How many limbs a row has.
    size: usize,
    low: Vec<i64>,
    limbs: Vec<u64>,
}

impl Rows {
    /// The number of rows, for numbers with this number of limbs.
    pub(in crate::shadow) fn new(limbs: usize, count: usize) -> Self {
        let size = limbs + 1;
        Rows { size, low: vec![ZERO; count], limbs: vec![0; count * size] }
    }

    pub(in crate::shadow) fn fields<N>(&mut self, to: &mut dyn Fields<N>) {
        self.low.iter_mut().for_each(|low| to.whole(low));
        self.limbs.iter_mut().for_each(|limb| to.count(limb));
    }

    pub(in crate::shadow) fn set(&mut self, place: usize, number: Parts<'_>) {
        self.low[place] = write_number(number, OFFSET, &mut self.limbs[place * self.size..][..self.size]);
    }

    #[inline(always)]
    pub(super) fn row(&self, place: usize) -> (&[u64], i64) {
        (&self.limbs[place * self.size..][..self.size], self.low[place])
    }

    #[inline(always)]
    pub(super) fn set_row(&mut self, place: usize, row: &[u64], low: i64) {
        self.limbs[place * self.size..][..self.size].copy_from_slice(row);
        self.low[place] = low;
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
pub(in crate::shadow) struct Sums<'a> {
    rows: &'a Rows,
    weights: [Option<&'a IntegerWeights>; 2],
    /// Whether no weight has more than a limb.
    weights_are_limbs: bool,
    /// `low` of the coarsest row, which the limb 1 is for.
    low: i64,
    limbs: [[u64; MOST_OF_SUM]; 2],
}

impl<'a> Sums<'a> {
    /// Without rows.
    pub(in crate::shadow) fn new(rows: &'a Rows, weights: [Option<&'a IntegerWeights>; 2]) -> Self {
        let weights_are_limbs = weights.into_iter().flatten().all(|weights| weights.width == 1);
        Sums { rows, weights, weights_are_limbs, low: ZERO, limbs: [[0; MOST_OF_SUM]; 2] }
    }

    /// Adds the rows of a lag with the weights of each kind; those at the same distance from both ends have the same
    /// weight.
    pub(in crate::shadow) fn add(&mut self, of_lag: OfLag) {
        by_limbs!(add_rows(self.rows.size, self, of_lag));
    }

    /// x ← the sum of a kind, whose limbs are lost.
    pub(in crate::shadow) fn read<N>(&mut self, kind: usize, access: &LimbAccess<N>, x: &mut N) {
        if self.low == NOT_FINITE {
            return (access.assign_nan)(x);
        }
        let low = self.low.saturating_sub(1);
        let [(first, _), (second, _)] = self.kinds();
        read_number(x, access, if kind == 0 { first } else { second }, low, OFFSET);
    }

    /// The limbs of each sum, and its weights.
    #[inline(always)]
    fn kinds(&mut self) -> [(&mut [u64], Option<&'a IntegerWeights>); 2] {
        let [first, second] = &mut self.limbs;
        let size = self.rows.size + 2;
        let len = |weights: Option<&IntegerWeights>| size + weights.map_or(1, |weights| weights.width);
        let [a, b] = self.weights;
        [(&mut first[..len(a)], a), (&mut second[..len(b)], b)]
    }

    /// Where a row is to be added, which is moved if it is too fine: at 1 if no row was coarser, and at 0 else.
    #[inline(always)]
    fn place(&mut self, row: &mut [u64], low: i64) -> usize {
        if low == self.low { 1 } else { self.place_other(row, low) }
    }

    #[cold]
    fn place_other(&mut self, row: &mut [u64], low: i64) -> usize {
        if low > self.low {
            let by = low.saturating_sub(self.low);
            self.kinds().into_iter().for_each(|(sum, _)| move_row(sum, by));
            self.low = low;
            return 1;
        }
        move_row(row, self.low.saturating_sub(1).saturating_sub(low));
        0
    }
}

#[inline(always)]
fn add_rows(len: usize, sums: &mut Sums<'_>, of_lag: OfLag) {
    let OfLag { lag, last, .. } = of_lag;
    let rows = sums.rows;
    let mut row = [0; MOST_OF_ROW];
    for j in 0..=last / 2 {
        let ((a, a_low), (b, b_low)) = (rows.row(of_lag.place(j)), rows.row(of_lag.place(last - j)));
        let both = last - j != j;
        if both && sums.weights_are_limbs && a_low == sums.low && b_low == sums.low {
            add_pair(len, sums, [a, b], (lag, j));
            continue;
        }
        if both && a_low == b_low {
            add_limbs(&mut row[..len], &a[..len], &b[..len]);
        } else {
            row[..len].copy_from_slice(&a[..len]);
        }
        add_row(len, sums, (&mut row, a_low), (lag, j));
        if both && a_low != b_low {
            row[..len].copy_from_slice(&b[..len]);
            add_row(len, sums, (&mut row, b_low), (lag, j));
        }
    }
}

/// Adds two rows at the place of the sum, where weights have one limb: what nearly all are. Nothing is called, so that
/// the limbs stay in registers.
#[inline(always)]
fn add_pair(len: usize, sums: &mut Sums<'_>, [a, b]: [&[u64]; 2], (lag, j): (usize, usize)) {
    let mut row = [0; MOST_OF_ROW];
    add_limbs(&mut row[..len], &a[..len], &b[..len]);
    for (limbs, weights) in sums.limbs.iter_mut().zip(sums.weights) {
        if let Some(IntegerWeights { of_lags, negative, .. }) = weights {
            let (low, high) = limbs[1..len + 3].split_at_mut(len);
            add_multiple_of_limb(len, low, high, &row[..len], of_lags[lag - 1][j], negative[lag - 1][j]);
        }
    }
}

/// sum ← a + b
#[inline(always)]
fn add_limbs(sum: &mut [u64], a: &[u64], b: &[u64]) {
    let mut carry = false;
    for i in 0..sum.len() {
        (sum[i], carry) = a[i].carrying_add(b[i], carry);
    }
}

/// Adds a row with the j-th weights of a lag.
#[inline(always)]
fn add_row(len: usize, sums: &mut Sums<'_>, (row, low): (&mut [u64], i64), (lag, j): (usize, usize)) {
    let row = &mut row[..len];
    let at = sums.place(row, low);
    for (sum, weights) in sums.kinds() {
        if let Some(IntegerWeights { of_lags, negative, width }) = weights {
            let weight = &of_lags[lag - 1][j * width..(j + 1) * width];
            add_multiple(len, &mut sum[at..], row, weight, negative[lag - 1][j]);
        }
    }
}

/// sum ← sum ± n row
#[inline(always)]
fn add_multiple(len: usize, sum: &mut [u64], row: &[u64], n: &[u64], minus: bool) {
    for (at, n) in n.iter().enumerate() {
        let (low, high) = sum[at..].split_at_mut(len);
        add_multiple_of_limb(len, low, high, row, *n, minus);
    }
}

/// The same for one limb n; the sum in two parts.
#[inline(always)]
fn add_multiple_of_limb(len: usize, low: &mut [u64], high: &mut [u64], row: &[u64], n: u64, minus: bool) {
    let opposite = if minus { u64::MAX } else { 0 };
    let negative = sign(row[len - 1]) ^ opposite;
    // −row is the complement and 1; n times that is carried in
    let mut carry = n & opposite;
    for i in 0..len {
        (low[i], carry) = (row[i] ^ opposite).carrying_mul_add(n, low[i], carry);
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
