//! The energies of a run in fixed memory: of each of at most 64 equal parts the most accurate modified energy, and the
//! means of H and H̄.

use super::arithmetic::{integer, quotient};
use super::estimated::Estimated;
use crate::number::Real;
use crate::number::saved::Fields;

/// The largest number of blocks; a long run has at least half as many.
const BLOCKS: usize = 64;

/// A part of a run.
#[derive(Clone, Debug)]
pub(super) struct Block<N> {
    /// The estimate with the smallest error.
    ///
    /// The modified energy is constant while the error of its estimates is not: near a close encounter it can be larger
    /// by many orders of magnitude.
    pub(super) best: Estimated<N>,
    /// Σ (H − H_0), H_0 the energy of the first state.
    energy: N,
    /// Σ (H̄ − H_0)
    modified: N,
}

impl<N: Real> Block<N> {
    fn zero(context: &N::Context) -> Self {
        Block { best: Estimated::zero(context), energy: N::zero(context), modified: N::zero(context) }
    }
}

/// Blocks of successive estimates. When all are full, they are merged in pairs.
#[derive(Clone, Debug)]
pub(super) struct Blocks<N> {
    /// `full` complete ones, then the one that grows.
    blocks: Vec<Block<N>>,
    /// H_0
    origin: N,
    difference: N,
    full: usize,
    /// Estimates in a block.
    size: u64,
    /// Those in the one that grows.
    count: u64,
}

impl<N: Real> Blocks<N> {
    /// The blocks of a run that begins with the energy `origin`.
    pub(super) fn new(origin: &N) -> Self {
        let context = origin.context();
        Blocks {
            blocks: vec![Block::zero(&context); BLOCKS + 1],
            origin: origin.clone(),
            difference: N::zero(&context),
            full: 0,
            size: 1,
            count: 0,
        }
    }

    /// Takes an estimate and the energy at the same state; returns the most accurate estimate of its block so far.
    #[inline]
    pub(super) fn push(&mut self, energy: &N, newest: &Estimated<N>) -> &Estimated<N> {
        let place = self.full;
        let block = &mut self.blocks[place];
        if self.count == 0 {
            block.energy.assign_zero();
            block.modified.assign_zero();
        }
        for (sum, value) in [(&mut block.energy, energy), (&mut block.modified, &newest.value)] {
            self.difference.assign_difference(value, &self.origin);
            sum.add(&self.difference);
        }
        // of equal errors the newest
        if self.count == 0 || newest.error <= block.best.error {
            block.best.assign(newest);
        }
        self.count += 1;
        if self.count < self.size {
            return &self.blocks[place].best;
        }
        self.full += 1;
        self.count = 0;
        if self.full < BLOCKS {
            return &self.blocks[place].best;
        }
        self.merge();
        &self.blocks[self.full - 1].best
    }

    fn merge(&mut self) {
        for pair in 0..BLOCKS / 2 {
            let [first, second] = &mut self.blocks[2 * pair..2 * pair + 2] else { unreachable!("two blocks") };
            first.energy.add(&second.energy);
            first.modified.add(&second.modified);
            if second.best.error < first.best.error {
                std::mem::swap(&mut first.best, &mut second.best);
            }
            self.blocks.swap(pair, 2 * pair);
        }
        self.full = BLOCKS / 2;
        self.size *= 2;
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        let Blocks { blocks, origin, difference: _, full, size, count } = self;
        to.number(origin);
        to.place(full, BLOCKS);
        to.count(size);
        to.count(count);
        for Block { best, energy, modified } in &mut blocks[..=*full] {
            best.fields(to);
            to.number(energy);
            to.number(modified);
        }
    }

    /// The most accurate estimates in the order of time; the growing block's as soon as it is half full.
    pub(super) fn best(&self) -> impl Iterator<Item = &Estimated<N>> + Clone {
        let growing = usize::from(2 * self.count >= self.size && self.count > 0);
        self.blocks[..self.full + growing].iter().map(|block| &block.best)
    }

    /// The half of these with the smaller errors, in the order of time.
    pub(super) fn accurate(&self) -> Vec<&Estimated<N>> {
        let mut errors: Vec<&N> = self.best().map(|estimate| &estimate.error).collect();
        errors.sort_by(|a, b| a.partial_cmp(b).expect("estimates that are not finite are refused"));
        let Some(median) = errors.get(errors.len().saturating_sub(1) / 2).copied() else { return Vec::new() };
        self.best().filter(|estimate| estimate.error <= *median).collect()
    }

    /// How many estimates a full block has.
    pub(super) fn size(&self) -> u64 {
        self.size
    }

    /// The means of H and of H̄ in the full blocks, less H_0, as parts of `unit`.
    pub(super) fn means(&self, unit: &N) -> [Vec<f64>; 2] {
        let mut size: N = integer(self.size, &unit.context());
        size.multiply(unit);
        let parts = |sum: fn(&Block<N>) -> &N| {
            self.blocks[..self.full].iter().map(|block| quotient(sum(block), &size).to_f64()).collect()
        };
        [parts(|block| &block.energy), parts(|block| &block.modified)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(estimates: &[&Estimated<f64>]) -> Vec<f64> {
        estimates.iter().map(|estimated| estimated.value).collect()
    }

    /// Every tenth estimate is accurate, the value is its number.
    fn blocks(count: u32) -> Blocks<f64> {
        let mut blocks = Blocks::new(&0.0);
        for i in 0..count {
            blocks.push(&0.0, &Estimated { value: f64::from(i), error: if i % 10 == 3 { 1e-9 } else { 1.0 } });
        }
        blocks
    }

    #[test]
    fn few_estimates_are_blocks_of_their_own() {
        assert_eq!(blocks(63).best().count(), 63);
        assert_eq!(
            values(&blocks(63).accurate()),
            (0..63).map(f64::from).collect::<Vec<_>>(),
            "the median has a large error"
        );
        assert!(blocks(0).accurate().is_empty());
    }

    #[test]
    fn merged_blocks_keep_the_most_accurate() {
        // 64 of 16 estimates become 32 of 32, each with accurate ones; ties go to the newest of a block, to the first
        // of two blocks
        let all = blocks(1024);
        assert_eq!((all.best().count(), all.size), (32, 32));
        let found = values(&all.accurate());
        assert_eq!(found.len(), 32);
        for (i, value) in found.into_iter().enumerate() {
            assert_eq!(value % 10.0, 3.0);
            assert!((32 * i..32 * (i + 1)).contains(&(value as usize)), "{i}: {value}");
        }
    }

    #[test]
    fn a_block_counts_from_its_middle_on() {
        assert_eq!([15, 16, 31].map(|more| blocks(1024 + more).best().count()), [32, 33, 33]);
        assert_eq!(blocks(1_000_000).best().count(), 61, "of 16384 each, and 576 that are too few");
    }

    #[test]
    fn the_most_accurate_of_the_present_block_is_returned() {
        let mut blocks = blocks(1024);
        let mut push = |value, error| blocks.push(&0.0, &Estimated { value, error }).value;
        assert_eq!([push(1.0, 0.5), push(2.0, 0.9), push(3.0, 0.1), push(4.0, 0.1)], [1.0, 1.0, 3.0, 4.0]);
    }
}
