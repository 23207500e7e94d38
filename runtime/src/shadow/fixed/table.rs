//! The table of differences in fixed point.
//!
//! A number takes as many [digits](super::digits) as its bits need at any place, and the table has room for one more.
//! The differences of a level are exact in the rows of the level before, and their carries are settled at every fifth.
//! A level has only as many digits as its differences need; and at the levels 57, 114, … the lowest digit of its rows
//! is dropped: term k of Stirling's series has c_k ≈ 2^{1−2k} √(π/k), so that a unit of a difference of order 2k − 1
//! counts 2^{2k−1} times less than one of a state. Each term is multiplied to the precision that its difference has:
//! for one of n digits only the n + 1 upper digits of q and p are used, and the columns of the product from the digit
//! below its unit on.

use super::digits::{self, BITS, MORE, MOST_DIGITS, SUMS, digits_of, magnitude};
use super::{NOT_FINITE, Offset, ZERO, by_limbs};
use crate::number::{LimbAccess, Number, Parts, instructions};
use crate::systems::increments::Increments;

/// The offset of q and p, so that numbers in [2^−10, 2^47) have the same place; and the offset of their products and of
/// β.
const OFFSET: Offset = 8;
const OFFSET_OF_PRODUCTS: Offset = 2 * OFFSET;

/// The most columns of a term: one below the unit of its difference, and two above its digits.
const MOST_COLUMNS: usize = MOST_DIGITS + 3;

/// How many products fit into columns before their carries are settled: each is smaller than 2^(57 + 62) times its
/// number of digits.
const UNSETTLED: usize = 8;

/// ∇^r of (q, p, β) at the newest state, r = 0..2M−1, and at the one before.
#[derive(Clone, Debug)]
pub(in crate::shadow) struct FixedTable<N> {
    access: LimbAccess<N>,
    /// How many digits a number takes.
    digits: usize,
    newest: Vec<Level>,
    before: Vec<Level>,
    /// p and −q of the newest M + 1 states, the factors of δq and δp, with their highest digits first; the state n in
    /// place n mod their number.
    factors: Vec<Level>,
    /// That of the newest state.
    place: usize,
    pushed: usize,
    sum: SumOfTerm,
}

/// Rows Σ digit\[i\] 2^(BITS (low + i) − offset). Of ∇^r they are the coordinates, then β.
#[derive(Clone, Debug)]
struct Level {
    /// How many digits of each row are in use; those above are 0.
    len: usize,
    low: Vec<i64>,
    /// One row after the other.
    digits: Vec<i64>,
    /// How many digits there is room for in a row.
    room: usize,
}

/// Σ factor (newest + before) − δβ, in columns.
#[derive(Clone, Debug)]
struct SumOfTerm {
    columns: [i128; MOST_COLUMNS],
    low: i64,
}

impl<N: Number> FixedTable<N> {
    /// For terms 1..=`terms` of Stirling's series, in numbers like this 0.
    pub(in crate::shadow) fn new(access: LimbAccess<N>, zero: &N, terms: usize, dimension: usize) -> Self {
        let digits = digits_of((access.limbs)(zero));
        let room = digits + MORE;
        let level = Level::new(2 * dimension + 1, room);
        FixedTable {
            access,
            digits,
            newest: vec![level.clone(); 2 * terms],
            before: vec![level; 2 * terms],
            factors: vec![Level::new(2 * dimension, room + 1); terms + 1],
            place: 0,
            pushed: 0,
            sum: SumOfTerm { columns: [0; MOST_COLUMNS], low: ZERO },
        }
    }

    /// Takes the next state. The increments are first differences, of q and p too where they are known.
    pub(in crate::shadow) fn push(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) {
        std::mem::swap(&mut self.newest, &mut self.before);
        let (parts, digits) = (self.access.parts, self.digits);
        self.place = self.pushed % self.factors.len();
        self.factors[self.place].set_factors(q.iter().map(parts), p.iter().map(parts));
        self.newest[0].set(0, digits, q.iter().chain(p).map(parts), OFFSET);
        self.pushed += 1;
        let levels = self.newest.len().min(self.pushed);
        if levels == 1 {
            return;
        }
        let Increments { q, p, beta } = increments;
        let [states, level] = self.newest.get_disjoint_mut([0, 1]).expect("levels 0 and 1");
        level.set_difference(states, &self.before[0]);
        level.set(0, digits, q.iter().chain(p).map(parts), OFFSET);
        level.set(level.low.len() - 1, digits, [parts(beta)], OFFSET_OF_PRODUCTS);
        set_differences(&mut self.newest[..levels], &self.before);
    }

    /// term ← −qᵀδp + pᵀδq − δβ at the state k before the newest, with δ = 2 μδ^{2k−1}.
    pub(in crate::shadow) fn term(&mut self, k: usize, term: &mut N) {
        let levels = [&self.newest, &self.before].map(|levels| &levels[2 * k - 1]);
        let place = if k <= self.place { self.place - k } else { self.place + self.factors.len() - k };
        let factors = &self.factors[place];
        let Some(columns) = self.sum.compute(factors, levels) else {
            return (self.access.assign_nan)(term);
        };
        let mut limbs = [0; MOST_COLUMNS];
        let (limbs, negative) = magnitude(columns, &mut limbs);
        let exponent = self.sum.low.saturating_mul(i64::from(BITS)).saturating_sub(OFFSET_OF_PRODUCTS);
        (self.access.assign)(term, negative, limbs, exponent);
    }
}

/// Sets the differences of the levels 2, 3, …
#[inline(never)]
fn set_differences(newest: &mut [Level], before: &[Level]) {
    instructions::widest(
        #[inline(always)]
        || {
            for r in 2..newest.len() {
                let (below, levels) = newest.split_at_mut(r);
                let level = &mut levels[0];
                level.set_difference(&below[r - 1], &before[r - 1]);
                let drops = r.is_multiple_of(BITS as usize);
                if drops || r.is_multiple_of(SUMS) {
                    level.settle();
                }
                if drops {
                    level.drop_lowest_digit();
                }
            }
        },
    );
}

impl Level {
    fn new(rows: usize, room: usize) -> Self {
        Level { len: 1, low: vec![ZERO; rows], digits: vec![0; rows * room], room }
    }

    fn row(&self, c: usize) -> &[i64] {
        &self.digits[c * self.room..][..self.room]
    }

    fn rows_mut(&mut self) -> impl Iterator<Item = &mut [i64]> {
        self.digits.chunks_exact_mut(self.room)
    }

    /// The digit i of a row that begins at a higher place.
    fn digit_at(&self, c: usize, low: i64, i: usize) -> i64 {
        let by = usize::try_from(low.saturating_sub(self.low[c])).unwrap_or(0);
        self.row(c).get(i.saturating_add(by)).copied().unwrap_or(0)
    }

    /// Sets rows from `first` on to numbers, of this number of digits.
    fn set<'a>(&mut self, first: usize, len: usize, numbers: impl IntoIterator<Item = Parts<'a>>, offset: Offset) {
        let rows = self.digits.chunks_exact_mut(self.room).zip(&mut self.low).skip(first);
        for ((row, low), parts) in rows.zip(numbers) {
            let (row, above) = row.split_at_mut(len);
            *low = digits::write(parts, offset, row);
            above.fill(0);
        }
        self.len = self.len.max(len);
    }

    /// Sets the rows to p and −q, of as many digits as there is room for, and `low` to what the place of a product is
    /// above that of its other factor.
    fn set_factors<'a>(&mut self, q: impl Iterator<Item = Parts<'a>>, p: impl Iterator<Item = Parts<'a>>) {
        self.set(0, self.room, p.chain(q.map(negative)), OFFSET);
        self.rows_mut().for_each(<[i64]>::reverse);
        let below = self.room as i64 - 2;
        self.low.iter_mut().for_each(|low| *low = low.saturating_add(below));
    }

    /// self ← a − b
    #[inline(always)]
    fn set_difference(&mut self, a: &Level, b: &Level) {
        self.len = a.len.max(b.len);
        let mut same = true;
        for ((low, a), b) in self.low.iter_mut().zip(&a.low).zip(&b.low) {
            same &= have_one_place(*a, *b);
            *low = *a.max(b);
        }
        for ((own, a), b) in self.digits.iter_mut().zip(&a.digits).zip(&b.digits) {
            *own = a - b;
        }
        if !same {
            self.set_difference_of_places(a, b);
        }
    }

    /// The same in the rows of which one is coarser.
    #[cold]
    fn set_difference_of_places(&mut self, a: &Level, b: &Level) {
        for c in (0..self.low.len()).filter(|c| a.low[*c] != b.low[*c]) {
            let low = self.low[c];
            let row = self.digits[c * self.room..].iter_mut().take(self.len);
            row.enumerate().for_each(|(i, own)| *own = a.digit_at(c, low, i) - b.digit_at(c, low, i));
        }
    }

    /// Settles all carries, with a highest digit more or less where it is needed or not.
    #[inline(always)]
    fn settle(&mut self) {
        let len = self.len;
        let (mut is_large, mut is_needless) = (false, true);
        for row in self.rows_mut() {
            let highest = digits::settle(&mut row[..len]);
            is_large |= highest.is_large;
            is_needless &= highest.is_needless;
        }
        if is_large {
            self.lengthen();
        } else if is_needless {
            for row in self.rows_mut() {
                let [next, highest] = row.get_disjoint_mut([len - 2, len - 1]).expect("two digits");
                digits::join(next, highest);
            }
            self.len -= 1;
        }
    }

    /// A highest digit more, in place of the lowest one if there is no room.
    #[cold]
    fn lengthen(&mut self) {
        if self.len == self.room {
            self.drop_lowest_digit();
        }
        let len = self.len;
        for row in self.rows_mut() {
            let [highest, above] = row.get_disjoint_mut([len - 1, len]).expect("there is room");
            digits::split(highest, above);
        }
        self.len += 1;
    }

    fn drop_lowest_digit(&mut self) {
        let len = self.len;
        for row in self.rows_mut() {
            row.copy_within(1..len, 0);
            row[len - 1] = 0;
        }
        self.low.iter_mut().for_each(|low| *low = low.saturating_add(1));
        self.len = (len - 1).max(1);
    }
}

/// −x
fn negative(parts: Parts<'_>) -> Parts<'_> {
    match parts {
        Parts::Regular { negative, exponent, significand } => {
            Parts::Regular { negative: !negative, exponent, significand }
        }
        other => other,
    }
}

/// Whether a row is 0, which has no place.
#[inline(always)]
fn is_zero(low: i64) -> bool {
    low < ZERO / 2
}

/// Whether two rows can be added digit by digit.
#[inline(always)]
fn have_one_place(a: i64, b: i64) -> bool {
    a == b || is_zero(a.min(b))
}

impl SumOfTerm {
    /// Computes it; returns its columns, or `None` if it is not finite. Not inlined: it is compiled once for all number
    /// types.
    #[inline(never)]
    fn compute(&mut self, factors: &Level, [newest, before]: [&Level; 2]) -> Option<&mut [i128]> {
        let len = newest.len.max(before.len);
        let places = Places::of(factors, [newest, before]);
        let low = places.highest;
        // also of 0 times what is not finite
        if low >= NOT_FINITE / 2 {
            return None;
        }
        self.low = low;
        let columns = &mut self.columns[..len + 3];
        columns.fill(0);
        if places.are_one {
            by_limbs!(add_products(len, columns, factors, [newest, before]));
        } else {
            add_products_of_places(columns, factors, [newest, before], low);
        }
        Some(columns)
    }
}

/// The places of products, and of β with a digit below it.
struct Places {
    highest: i64,
    /// Whether all products have it, and levels have one in each row.
    are_one: bool,
}

impl Places {
    #[inline(always)]
    fn of(factors: &Level, [newest, before]: [&Level; 2]) -> Places {
        let [a, b] = [newest, before].map(|level| level.low[factors.low.len()]);
        let of_beta = a.max(b).saturating_sub(1);
        // in most terms all rows of a kind have the same
        let (of_factors, of_levels, mut others) = (factors.low[0], newest.low[0], a ^ b);
        for ((factor, a), b) in factors.low.iter().zip(&newest.low).zip(&before.low) {
            others |= (factor ^ of_factors) | (a ^ of_levels) | (b ^ of_levels);
        }
        if others == 0 && of_levels.saturating_add(of_factors) == of_beta {
            return Places { highest: of_beta, are_one: true };
        }
        let mut places = Places { highest: of_beta, are_one: have_one_place(a, b) };
        let mut lowest = i64::MAX;
        for ((factor, a), b) in factors.low.iter().zip(&newest.low).zip(&before.low) {
            let place = a.max(b).saturating_add(*factor);
            places.highest = places.highest.max(place);
            lowest = lowest.min(if is_zero(place) { i64::MAX } else { place });
            places.are_one &= have_one_place(*a, *b);
        }
        places.are_one &= lowest >= places.highest && have_one_place(of_beta, places.highest);
        places
    }
}

/// Adds the products of all coordinates, and −δβ.
#[inline(always)]
fn add_products(len: usize, columns: &mut [i128], factors: &Level, [newest, before]: [&Level; 2]) {
    let mut both = [0; MOST_DIGITS];
    let both = &mut both[..len];
    for c in 0..factors.low.len() {
        set_sum(both, newest.row(c), before.row(c));
        digits::add_product(len, columns, factors.row(c), both);
        if c % UNSETTLED == UNSETTLED - 1 {
            digits::carry(columns);
        }
    }
    set_sum(both, newest.row(factors.low.len()), before.row(factors.low.len()));
    for (column, beta) in columns[1..].iter_mut().zip(both) {
        *column -= i128::from(*beta);
    }
}

/// sum ← a + b
#[inline(always)]
fn set_sum(sum: &mut [i64], a: &[i64], b: &[i64]) {
    let (a, b) = (&a[..sum.len()], &b[..sum.len()]);
    for i in 0..sum.len() {
        sum[i] = a[i] + b[i];
    }
}

/// The same where a product or β begins below the sum, or one level is coarser.
#[cold]
fn add_products_of_places(sum: &mut [i128], factors: &Level, [a, b]: [&Level; 2], place: i64) {
    let len = a.len.max(b.len);
    for (c, of_factor) in factors.low.iter().enumerate() {
        let low = a.low[c].max(b.low[c]);
        let mut product = [0; MOST_COLUMNS];
        let columns = &mut product[..sum.len()];
        let mean: [_; MOST_DIGITS] = std::array::from_fn(|i| a.digit_at(c, low, i) + b.digit_at(c, low, i));
        digits::add_product(len, columns, factors.row(c), &mean[..len]);
        let by = place.saturating_sub(low.saturating_add(*of_factor));
        digits::move_down(columns, usize::try_from(by).unwrap_or(usize::MAX));
        sum.iter_mut().zip(columns).for_each(|(sum, column)| *sum += *column);
        if c % UNSETTLED == UNSETTLED - 1 {
            digits::carry(sum);
        }
    }
    let of_beta = factors.low.len();
    for level in [a, b] {
        let at = level.low[of_beta].saturating_sub(place);
        let skip = usize::try_from(at.saturating_neg()).unwrap_or(0);
        let own = sum[usize::try_from(at).unwrap_or(0)..].iter_mut();
        own.zip(level.row(of_beta)[..len].iter().skip(skip)).for_each(|(column, beta)| *column -= i128::from(*beta));
    }
}
