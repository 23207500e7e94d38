//! Products of the newest state with those before it, in fixed point: the pairs of states of which no increments are
//! known but those of β.
//!
//! Coordinates are magnitudes with signs. Their offset is such that the upper half of a product has the offset of
//! pairs, and is added to a pair without a shift. As both factors may have a limb of leading zeros, a pair is summed
//! with a limb below its row.

use shadowstep_limbs::fixed;

use super::pairs::{OFFSET, Rows};
use super::{NOT_FINITE, Offset, ZERO, sign, write_magnitude};
use crate::number::Parts;
use crate::number::saved::Fields;

/// Products have twice this offset: that of pairs and a limb.
const OFFSET_OF_COORDINATES: Offset = OFFSET / 2 + 32;

/// Products of more limbs are those of numbers: their loops are not unrolled here.
const MOST_UNROLLED: usize = 8;

/// States, by places.
#[derive(Clone, Debug)]
pub(in crate::shadow) struct StateRows {
    /// How many limbs a row has.
    size: usize,
    dimension: usize,
    /// |q| and |p| of each state, and their signs; `low` is in halves of a limb, so that a magnitude has at most 34 leading zeros.
    limbs: Vec<u64>,
    low: Vec<i64>,
    negative: Vec<bool>,
    /// What the step to each state added to β.
    of_beta: Rows,
}

/// A pair: a row with a limb below it and one above.
#[derive(Clone, Copy)]
struct Pair<const L: usize> {
    below: u64,
    row: [u64; L],
    above: u64,
    /// Of the row.
    low: i64,
}

/// A coordinate: its magnitude, `low`, and whether it is below 0.
type Coordinate<'a, const L: usize> = (&'a [u64; L], i64, bool);

impl StateRows {
    /// For numbers with this number of limbs, 2 to [`MOST_UNROLLED`].
    pub(in crate::shadow) fn new(limbs: usize, states: usize, dimension: usize) -> Option<Self> {
        let (size, coordinates) = (limbs + 1, 2 * dimension * states);
        (2..=MOST_UNROLLED).contains(&limbs).then(|| StateRows {
            size,
            dimension,
            limbs: vec![0; coordinates * size],
            low: vec![ZERO; coordinates],
            negative: vec![false; coordinates],
            of_beta: Rows::new(limbs, states),
        })
    }

    pub(in crate::shadow) fn fields<N>(&mut self, to: &mut dyn Fields<N>) {
        let StateRows { limbs, low, negative, of_beta, .. } = self;
        limbs.iter_mut().for_each(|limb| to.count(limb));
        low.iter_mut().for_each(|low| to.whole(low));
        negative.iter_mut().for_each(|negative| to.flag(negative));
        of_beta.fields(to);
    }

    /// Sets q and p of a state, and what the step to it added to β.
    pub(in crate::shadow) fn set<'a>(
        &mut self,
        place: usize,
        coordinates: impl Iterator<Item = Parts<'a>>,
        of_beta: Parts<'_>,
    ) {
        for (at, parts) in (2 * self.dimension * place..).zip(coordinates) {
            let row = &mut self.limbs[at * self.size..][..self.size];
            let (low, negative) = write_magnitude(parts, OFFSET_OF_COORDINATES, row);
            (self.low[at], self.negative[at]) = (low.saturating_mul(2), negative);
            if row[self.size - 1] >> 30 == 0 && ZERO < low && low < NOT_FINITE {
                shift_up_half(row);
                self.low[at] -= 1;
            }
        }
        self.of_beta.set(place, of_beta);
    }

    /// Writes (q_i·p − p_i·q + β − β_i)/((−1)^i i) of the newest state and the i-th before it, i = 1, 2, …, `count`, to
    /// the rows of lags.
    pub(in crate::shadow) fn write_pairs(&self, newest: usize, count: usize, rows: &mut Rows) {
        let write = match self.size {
            3 => Self::write_pairs_of::<3>,
            4 => Self::write_pairs_of::<4>,
            5 => Self::write_pairs_of::<5>,
            6 => Self::write_pairs_of::<6>,
            7 => Self::write_pairs_of::<7>,
            8 => Self::write_pairs_of::<8>,
            9 => Self::write_pairs_of::<9>,
            _ => unreachable!("rows of {} limbs", self.size),
        };
        write(self, newest, count, rows);
    }

    fn write_pairs_of<const L: usize>(&self, newest: usize, count: usize, rows: &mut Rows) {
        let places = self.low.len() / (2 * self.dimension);
        let mut beta = Pair { below: 0, row: [0; L], above: 0, low: ZERO };
        for lag in 1..=count {
            let [older, after] = [lag, lag - 1].map(|back| (newest + places - back) % places);
            let (row, low) = self.of_beta.row(after);
            let row: &[u64; L] = row.first_chunk().expect("as many limbs");
            beta.add(&Pair { below: 0, row: *row, above: sign(row[L - 1]), low });
            let mut pair = beta;
            for c in 0..self.dimension {
                let [q_older, q] = [older, newest].map(|place| self.coordinate(place, c));
                let [p_older, p] = [older, newest].map(|place| self.coordinate(place, self.dimension + c));
                pair.add_product(q_older, p, false);
                pair.add_product(p_older, q, true);
            }
            pair.settle();
            pair.divide(lag);
            rows.set_row((lag - 1) * places + newest, &pair.row, pair.low);
        }
    }

    #[inline(always)]
    fn coordinate<const L: usize>(&self, place: usize, c: usize) -> Coordinate<'_, L> {
        let at = 2 * self.dimension * place + c;
        (self.limbs[at * L..].first_chunk().expect("as many limbs"), self.low[at], self.negative[at])
    }
}

impl<const L: usize> Pair<L> {
    #[inline(always)]
    fn add(&mut self, other: &Self) {
        if other.low != self.low {
            return self.add_elsewhere(other);
        }
        let mut carry;
        (self.below, carry) = self.below.overflowing_add(other.below);
        for (limb, other) in self.row.iter_mut().zip(&other.row) {
            (*limb, carry) = limb.carrying_add(*other, carry);
        }
        self.above = self.above.wrapping_add(other.above).wrapping_add(u64::from(carry));
    }

    /// Of two rows the finer one is moved to the place of the coarser.
    #[cold]
    fn add_elsewhere(&mut self, other: &Self) {
        let mut other = *other;
        if other.low > self.low {
            self.move_to(other.low);
        } else {
            other.move_to(self.low);
        }
        self.add(&other);
    }

    /// Drops limbs below a larger `low`.
    fn move_to(&mut self, low: i64) {
        let by = usize::try_from(low.saturating_sub(self.low)).unwrap_or(usize::MAX);
        let (old, beyond) = (*self, sign(self.above));
        let at = |place: usize| match place.saturating_add(by) {
            0 => old.below,
            place if place <= L => old.row[place - 1],
            place if place == L + 1 => old.above,
            _ => beyond,
        };
        (self.below, self.above, self.low) = (at(0), at(L + 1), low);
        self.row.iter_mut().zip(1..).for_each(|(limb, place)| *limb = at(place));
    }

    /// Adds a product of two coordinates, or subtracts it.
    #[inline(always)]
    fn add_product(&mut self, a: Coordinate<'_, L>, b: Coordinate<'_, L>, minus: bool) {
        let ((a, a_low, a_negative), (b, b_low, b_negative)) = (a, b);
        let opposite = if a_negative ^ b_negative ^ minus { u64::MAX } else { 0 };
        let (mut row, below) = fixed::high_product(a, b);
        // too small by less than 2 L, and by L/2 in the mean
        let below = below.saturating_add(L as u64 / 2);
        let (below, mut carry) = (below ^ opposite).carrying_add(0, opposite != 0);
        for limb in &mut row {
            (*limb, carry) = (*limb ^ opposite).carrying_add(0, carry);
        }
        // −0 is 0
        let above = if carry { 0 } else { opposite };
        let mut product = Pair { below, row, above, low: NOT_FINITE };
        if a_low != NOT_FINITE && b_low != NOT_FINITE {
            let halves = a_low.saturating_add(b_low).saturating_add(2 * (L as i64 - 1));
            product.low = halves.div_euclid(2);
            if halves % 2 != 0 {
                product.shift_down_half();
                product.low += 1;
            }
        }
        self.add(&product);
    }

    #[cold]
    fn shift_down_half(&mut self) {
        self.below = self.below >> 32 | self.row[0] << 32;
        self.row = fixed::shift_down(&self.row, 32);
        self.row[L - 1] |= self.above << 32;
    }

    /// Moves the row so that it has two free bits above, and no more than it needs.
    #[inline(always)]
    fn settle(&mut self) {
        let free = |top: u64| sign(top) == self.above && sign(top << 1) == self.above;
        if !free(self.row[L - 1]) {
            self.move_to(self.low.saturating_add(1));
        } else if self.row[L - 1] == self.above && free(self.row[L - 2]) && self.low != NOT_FINITE {
            self.row = fixed::limb_up(&self.row);
            self.row[0] = self.below;
            (self.below, self.low) = (0, self.low.saturating_sub(1));
        }
    }

    /// row ← the row with what is below it, divided by (−1)^lag lag and rounded. It keeps two free bits above.
    #[inline(always)]
    fn divide(&mut self, lag: usize) {
        let negative = fixed::is_negative(&self.row);
        if negative {
            self.negate();
        }
        if lag > 1 {
            let (below, _) = fixed::divide_limb(&mut self.row, lag as u64);
            self.below = below.saturating_add(self.below / lag as u64);
        }
        // the largest numbers are not rounded up: two free bits stay
        let up = self.below >> 63 & u64::from(self.row[L - 1] != u64::MAX >> 2);
        fixed::add_limb(&mut self.row, up);
        if negative ^ (lag % 2 == 1) {
            fixed::negate(&mut self.row);
        }
    }

    #[inline(always)]
    fn negate(&mut self) {
        let (below, mut carry) = (!self.below).overflowing_add(1);
        self.below = below;
        for limb in &mut self.row {
            (*limb, carry) = (!*limb).carrying_add(0, carry);
        }
    }
}

/// row ← 2³² row
#[cold]
fn shift_up_half(row: &mut [u64]) {
    for i in (1..row.len()).rev() {
        row[i] = row[i] << 32 | row[i - 1] >> 32;
    }
    row[0] <<= 32;
}

#[cfg(test)]
mod tests {
    use num_bigint::{BigInt, BigUint, Sign};
    use num_traits::Signed;
    use rand_pcg::Pcg64Mcg;
    use rand_pcg::rand_core::{Rng, SeedableRng};

    use super::*;

    const LIMBS: usize = 4;
    /// Numbers are integers of this unit.
    const UNIT: i64 = -4000;

    struct Given {
        significand: Vec<u64>,
        exponent: i64,
        negative: bool,
    }

    impl Given {
        fn random(random: &mut Pcg64Mcg, largest: i64) -> Self {
            let mut significand: Vec<u64> = (0..LIMBS).map(|_| random.next_u64()).collect();
            significand[LIMBS - 1] |= 1 << 63;
            let exponent = random.next_u64() as i64 % (largest + 1);
            Given { significand, exponent, negative: random.next_u64() % 2 == 1 }
        }

        fn parts(&self) -> Parts<'_> {
            let Given { significand, exponent, negative } = self;
            Parts::Regular { negative: *negative, exponent: *exponent, significand }
        }

        fn exact(&self) -> BigInt {
            let digits = self.significand.iter().flat_map(|limb| [*limb as u32, (limb >> 32) as u32]).collect();
            let size = BigUint::new(digits) << usize::try_from(self.exponent - 64 * LIMBS as i64 - UNIT).unwrap();
            BigInt::from_biguint(if self.negative { Sign::Minus } else { Sign::Plus }, size)
        }
    }

    /// A row of a number of L limbs has 64 L − 1 bits or more, and a pair is rounded once: its error is 2^(1 − 64 L) of
    /// its largest term, whatever sizes coordinates have.
    #[test]
    fn pairs_are_exact_to_the_last_place_of_their_largest_term() {
        let mut random = Pcg64Mcg::seed_from_u64(37);
        for largest in [0, 20, 70, 300] {
            for _ in 0..2000 {
                let [older, newest]: [[Given; 5]; 2] =
                    std::array::from_fn(|_| std::array::from_fn(|_| Given::random(&mut random, largest)));
                let mut states = StateRows::new(LIMBS, 2, 2).unwrap();
                for (place, state) in [&older, &newest].into_iter().enumerate() {
                    states.set(place, state[..4].iter().map(Given::parts), state[4].parts());
                }
                let mut rows = Rows::new(LIMBS, 2);
                states.write_pairs(1, 1, &mut rows);
                let (row, low) = rows.row(1);
                let digits: Vec<u32> = row.iter().flat_map(|limb| [*limb as u32, (limb >> 32) as u32]).collect();
                let mut found = BigInt::from_biguint(Sign::Plus, BigUint::new(digits));
                if sign(row[row.len() - 1]) != 0 {
                    found -= BigInt::from(1) << (64 * row.len());
                }
                // the pair in units of 2^(2 UNIT)
                let found = -found << usize::try_from(64 * low - OFFSET - 2 * UNIT).unwrap();
                let terms = [(0, 2, 1), (1, 3, 1), (2, 0, -1), (3, 1, -1)];
                let terms = terms.map(|(i, j, sign)| older[i].exact() * newest[j].exact() * sign);
                let beta = newest[4].exact() << usize::try_from(-UNIT).unwrap();
                let exact: BigInt = terms.iter().sum::<BigInt>() + &beta;
                let size = terms.iter().chain([&beta]).map(|term| term.abs()).max().unwrap();
                let error = ((found - exact).abs() << (64 * LIMBS)) / size;
                assert!(error <= BigInt::from(2), "{largest}: {error}");
            }
        }
    }
}
