//! The table of differences in fixed point.
//!
//! With L limbs a number takes a row of L + 1, and the table has rows of L + 2. The differences of a level are exact in the rows of the level
//! before. A level has only as many limbs as its differences need; and at the levels 64, 128, … the lowest limb of its rows is
//! dropped: term k of Stirling's series has c_k ≈ 2^{1−2k} √(π/k), so that a unit of a difference of order 2k − 1 counts 2^{2k−1}
//! times less than one of a state. Each term is multiplied to the precision that its difference has: for one of n limbs only the n + 1 upper
//! limbs of q and p are used, and the products of limbs that reach the limb below its unit.

use super::{
    MOST_OF_ROW, NOT_FINITE, Offset, ZERO, by_limbs, move_row, moved, read_number, sign, write_magnitude, write_number,
};
use crate::number::{LimbAccess, Number, Parts};
use crate::systems::increments::Increments;

/// The offset of q and p, which are about 1 in most units; and the offset of their products and of β.
const OFFSET: Offset = 16;
const OFFSET_OF_PRODUCTS: Offset = 2 * OFFSET;

/// ∇^r of (q, p, β) at the newest state, r = 0..2M−1, and at the one before.
#[derive(Clone, Debug)]
pub(in crate::shadow) struct FixedTable<N> {
    access: LimbAccess<N>,
    newest: Vec<Level>,
    before: Vec<Level>,
    /// The newest M + 1 states, the state n in place n mod their number.
    factors: Vec<Factors>,
    pushed: usize,
}

/// ∇^r of all coordinates, β last.
#[derive(Clone, Debug)]
struct Level {
    /// How many limbs of each row are in use: its number is smaller than a fourth of what they hold.
    len: usize,
    low: Vec<i64>,
    /// One row after the other.
    limbs: Vec<u64>,
    /// How many limbs there is room for in a row.
    room: usize,
}

/// p and −q of a state, the factors of δq and δp: magnitudes with as many limbs as rows have, and one more.
#[derive(Clone, Debug)]
struct Factors {
    low: Vec<i64>,
    negative: Vec<bool>,
    limbs: Vec<u64>,
}

impl<N: Number> FixedTable<N> {
    /// For terms 1..=`terms` of Stirling's series, in numbers like this 0.
    pub(in crate::shadow) fn new(access: LimbAccess<N>, zero: &N, terms: usize, dimension: usize) -> Self {
        let (rows, room) = (2 * dimension + 1, (access.limbs)(zero) + 2);
        let level = Level { len: 1, low: vec![ZERO; rows], limbs: vec![0; rows * room], room };
        let factors = Factors {
            low: vec![ZERO; 2 * dimension],
            negative: vec![false; 2 * dimension],
            limbs: vec![0; 2 * dimension * (room + 1)],
        };
        FixedTable {
            access,
            newest: vec![level.clone(); 2 * terms],
            before: vec![level; 2 * terms],
            factors: vec![factors; terms + 1],
            pushed: 0,
        }
    }

    /// Takes the next state. The increments are first differences, of q and p too where they are known.
    pub(in crate::shadow) fn push(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) {
        std::mem::swap(&mut self.newest, &mut self.before);
        let place = self.pushed % self.factors.len();
        self.factors[place].set(p.iter().chain(q).map(self.access.parts));
        self.newest[0].set(0, q.iter().chain(p).map(self.access.parts));
        self.pushed += 1;
        for r in 1..self.newest.len().min(self.pushed) {
            let [level, below] = self.newest.get_disjoint_mut([r, r - 1]).expect("levels r and r − 1");
            level.set_difference(below, &mut self.before[r - 1]);
            if r == 1 {
                let Increments { q, p, beta } = increments;
                level.set(0, q.iter().chain(p).map(self.access.parts));
                level.set(level.low.len() - 1, [(self.access.parts)(beta)]);
            }
            if r % 64 == 0 {
                level.drop_lowest_limb();
            }
        }
    }

    /// term ← −qᵀδp + pᵀδq − δβ at the state k before the newest, with δ = 2 μδ^{2k−1}.
    pub(in crate::shadow) fn term(&mut self, k: usize, term: &mut N) {
        let [newest, before] = [&mut self.newest, &mut self.before].map(|levels| &mut levels[2 * k - 1]);
        let factors = &self.factors[(self.pushed - 1 - k) % self.factors.len()];
        let mut sum = [0; MOST_OF_ROW + 3];
        let (len, low) = sum_of_term(newest, before, factors, &mut sum);
        if low == NOT_FINITE {
            (self.access.assign_nan)(term);
        } else {
            read_number(term, &self.access, &mut sum[..len + 3], low, OFFSET_OF_PRODUCTS);
        }
    }
}

impl Factors {
    /// From p and q.
    fn set<'a>(&mut self, numbers: impl Iterator<Item = Parts<'a>>) {
        let dimension = self.low.len() / 2;
        let size = self.limbs.len() / self.low.len();
        for (c, (parts, row)) in numbers.zip(self.limbs.chunks_exact_mut(size)).enumerate() {
            let (low, negative) = write_magnitude(parts, OFFSET, row);
            (self.low[c], self.negative[c]) = (low, negative != (c >= dimension));
        }
    }
}

impl Level {
    fn rows_mut(&mut self) -> impl Iterator<Item = &mut [u64]> {
        self.limbs.chunks_exact_mut(self.room)
    }

    /// A row and its `low`.
    #[inline(always)]
    fn row(&self, c: usize) -> (&[u64], i64) {
        (&self.limbs[c * self.room..(c + 1) * self.room], self.low[c])
    }

    /// Sets rows from `first` on to numbers.
    fn set<'a>(&mut self, first: usize, numbers: impl IntoIterator<Item = Parts<'a>>) {
        let size = self.room - 1;
        self.widen(size);
        let (len, last) = (self.len, self.low.len() - 1);
        let rows = self.limbs.chunks_exact_mut(self.room).zip(&mut self.low).enumerate().skip(first);
        for ((c, (row, low)), parts) in rows.zip(numbers) {
            let offset = if c == last { OFFSET_OF_PRODUCTS } else { OFFSET };
            *low = write_number(parts, offset, &mut row[..size]);
            let sign = sign(row[size - 1]);
            row[size..len].fill(sign);
        }
    }

    /// At least this number of limbs.
    fn widen(&mut self, len: usize) {
        let old = self.len;
        if len > old {
            self.len = len;
            self.rows_mut().for_each(|row| {
                let sign = sign(row[old - 1]);
                row[old..len].fill(sign);
            });
        }
    }

    /// The same number of limbs for both; returns it.
    fn widen_both(a: &mut Level, b: &mut Level) -> usize {
        a.widen(b.len);
        b.widen(a.len);
        a.len
    }

    /// self ← a − b
    fn set_difference(&mut self, a: &mut Level, b: &mut Level) {
        self.len = Level::widen_both(a, b);
        match by_limbs!(subtract_rows(self.len, self, a, b)) {
            Size::More if self.len < self.room => self.widen(self.len + 1),
            Size::More => self.drop_lowest_limb(),
            Size::Same => {}
            Size::Less => self.len -= 1,
        }
    }

    fn drop_lowest_limb(&mut self) {
        let len = self.len;
        for row in self.rows_mut() {
            let sign = sign(row[len - 1]);
            row.copy_within(1..len, 0);
            row[len - 1] = sign;
        }
        self.low.iter_mut().for_each(|low| *low = low.saturating_add(1));
        self.len = (len - 1).max(1);
    }
}

/// Whether the rows of a level need more limbs, or less.
enum Size {
    More,
    Same,
    Less,
}

/// out ← a − b
#[inline(always)]
fn subtract_rows(len: usize, out: &mut Level, a: &Level, b: &Level) -> Size {
    let (mut more, mut less) = (false, len > 1);
    for (c, (row, low)) in out.limbs.chunks_exact_mut(out.room).zip(&mut out.low).enumerate() {
        let room;
        let ((mut a, a_low), (mut b, b_low)) = (a.row(c), b.row(c));
        if a_low != b_low {
            room = moved(len, (a, a_low), (b, b_low));
            [a, b] = [&room[0], &room[1]];
        }
        *low = a_low.max(b_low);
        let (row, a, b) = (&mut row[..len], &a[..len], &b[..len]);
        let mut borrow = false;
        for i in 0..len {
            (row[i], borrow) = a[i].borrowing_sub(b[i], borrow);
        }
        more |= !is_small(row[len - 1]);
        less &= len > 1 && row[len - 1] == sign(row[len - 2]) && is_small(row[len - 2]);
    }
    match (more, less) {
        (true, _) => Size::More,
        (false, true) => Size::Less,
        (false, false) => Size::Same,
    }
}

/// Whether a number with this highest limb is smaller than a fourth of what its limbs hold.
#[inline(always)]
fn is_small(top: u64) -> bool {
    top.wrapping_add(1 << 62) >> 63 == 0
}

/// Σ factor (newest + before) − δβ in len + 3 limbs; returns len and `low`. It is compiled once for all number types.
fn sum_of_term(newest: &mut Level, before: &mut Level, factors: &Factors, sum: &mut [u64]) -> (usize, i64) {
    let len = Level::widen_both(newest, before);
    (len, by_limbs!(sum_of_products(len, newest, before, factors, sum)))
}

/// The same for a number of limbs.
#[inline(always)]
fn sum_of_products(len: usize, newest: &Level, before: &Level, factors: &Factors, sum: &mut [u64]) -> i64 {
    let last = factors.low.len();
    let size = newest.room + 1;
    // products begin at the limb below the row's unit times the upper limb of the factor; so β has a limb below it, too
    let low_of = |c: usize| newest.low[c].max(before.low[c]);
    let begin = |c: usize| low_of(c).saturating_add(factors.low[c]).saturating_add(size as i64 - 2);
    let low = (0..last).map(begin).fold(low_of(last).saturating_sub(1), i64::max);
    sum[..len + 3].fill(0);
    if low > NOT_FINITE / 2 {
        return NOT_FINITE;
    }
    let (mut mean, mut product) = ([0; MOST_OF_ROW], [0; MOST_OF_ROW + 2]);
    for (c, factor) in factors.limbs.chunks_exact(size).enumerate() {
        let negative = magnitude_of_sum(len, newest.row(c), before.row(c), &mut mean) != factors.negative[c];
        upper_product(len, &factor[size - 1 - len..], &mean, &mut product);
        add(&mut sum[..len + 3], &mut product[..len + 2], begin(c).saturating_sub(low), negative);
    }
    let negative = !magnitude_of_sum(len, newest.row(last), before.row(last), &mut mean);
    add(&mut sum[..len + 3], &mut mean[..len], low_of(last).saturating_sub(low), negative);
    low
}

/// sum ← |a + b|; returns whether a + b < 0.
#[inline(always)]
fn magnitude_of_sum(len: usize, (mut a, a_low): (&[u64], i64), (mut b, b_low): (&[u64], i64), sum: &mut [u64]) -> bool {
    let room;
    if a_low != b_low {
        room = moved(len, (a, a_low), (b, b_low));
        [a, b] = [&room[0], &room[1]];
    }
    let (sum, a, b) = (&mut sum[..len], &a[..len], &b[..len]);
    let mut carry = false;
    for i in 0..len {
        (sum[i], carry) = a[i].carrying_add(b[i], carry);
    }
    let mask = sign(sum[len - 1]);
    carry = mask != 0;
    for limb in sum {
        (*limb, carry) = (*limb ^ mask).carrying_add(0, carry);
    }
    mask != 0
}

/// sum ± a 2^(64 at), at ≤ 1: a is lost, and what is below the sum is dropped.
#[inline(always)]
fn add(sum: &mut [u64], a: &mut [u64], at: i64, negative: bool) {
    match usize::try_from(at) {
        Ok(0) => add_limbs(sum, a, negative),
        Ok(_) => add_limbs(&mut sum[1..], a, negative),
        Err(_) => {
            move_row(a, at.saturating_neg());
            add_limbs(sum, a, negative);
        }
    }
}

#[inline(always)]
fn add_limbs(sum: &mut [u64], a: &[u64], negative: bool) {
    let mask = if negative { u64::MAX } else { 0 };
    let mut carry = negative;
    let (low, high) = sum.split_at_mut(a.len());
    for (limb, a) in low.iter_mut().zip(a) {
        (*limb, carry) = limb.carrying_add(a ^ mask, carry);
    }
    for limb in high {
        (*limb, carry) = limb.carrying_add(mask, carry);
    }
}

/// a b of len + 1 and len limbs, from the products of limbs that reach its limb len, in len + 2 limbs from len − 1 on: it is too small
/// by less than len units of the lowest.
#[inline(always)]
fn upper_product(len: usize, a: &[u64], b: &[u64], product: &mut [u64]) {
    let (a, b, product) = (&a[..len + 1], &b[..len], &mut product[..len + 2]);
    product.fill(0);
    macro_rules! rows {
        ($($i:literal)*) => { $(if $i <= len { add_row(len, $i, a, b, product); })* };
    }
    add_row(len, 0, a, b, product);
    if len <= 9 {
        // each with a constant number of limbs, so that its loop is unrolled
        rows!(1 2 3 4 5 6 7 8 9);
    } else {
        (1..=len).for_each(|i| add_row(len, i, a, b, product));
    }
}

/// Adds the products of the limb i of a.
#[inline(always)]
fn add_row(len: usize, i: usize, a: &[u64], b: &[u64], product: &mut [u64]) {
    let mut carry = 0;
    for j in (len - 1).saturating_sub(i)..len {
        let limb = &mut product[i + j + 1 - len];
        (*limb, carry) = a[i].carrying_mul_add(b[j], *limb, carry);
    }
    product[i + 1] = carry;
}
