//! The modified energies of a run in fixed memory: the most accurate one of each of at most 64 equal parts.

use crate::number::Number;

/// The largest number of blocks; a long run has at least half as many.
const BLOCKS: usize = 64;

/// An estimate of the modified energy, and its error.
#[derive(Clone, Debug)]
pub(super) struct Estimated<N> {
    pub(super) value: N,
    /// 0 where the estimator gives none.
    pub(super) error: N,
}

impl<N: Number> Estimated<N> {
    pub(super) fn zero(context: &N::Context) -> Self {
        Estimated { value: N::zero(context), error: N::zero(context) }
    }

    fn assign(&mut self, other: &Self) {
        self.value.assign(&other.value);
        self.error.assign(&other.error);
    }
}

/// Of each block of successive estimates the one with the smallest error.
///
/// The modified energy is constant while the error of its estimates is not: near a close encounter it can be larger by many
/// orders of magnitude. When all blocks are full, they are merged in pairs.
#[derive(Clone, Debug)]
pub(super) struct Blocks<N> {
    /// `full` complete ones, then the one that grows.
    blocks: Vec<Estimated<N>>,
    full: usize,
    /// Estimates in a block.
    size: u64,
    /// Those in the one that grows.
    count: u64,
}

impl<N: Number> Blocks<N> {
    pub(super) fn new(context: &N::Context) -> Self {
        Blocks { blocks: vec![Estimated::zero(context); BLOCKS + 1], full: 0, size: 1, count: 0 }
    }

    /// Takes an estimate, and returns the most accurate one of its block so far.
    pub(super) fn push(&mut self, newest: &Estimated<N>) -> &Estimated<N> {
        let place = self.full;
        let own = &mut self.blocks[place];
        // of equal errors the newest
        if self.count == 0 || newest.error <= own.error {
            own.assign(newest);
        }
        self.count += 1;
        if self.count < self.size {
            return &self.blocks[place];
        }
        self.full += 1;
        self.count = 0;
        if self.full < BLOCKS {
            return &self.blocks[place];
        }
        self.merge();
        &self.blocks[self.full - 1]
    }

    fn merge(&mut self) {
        for pair in 0..BLOCKS / 2 {
            let better = if self.blocks[2 * pair].error <= self.blocks[2 * pair + 1].error { 0 } else { 1 };
            self.blocks.swap(pair, 2 * pair + better);
        }
        self.full = BLOCKS / 2;
        self.size *= 2;
    }

    /// The blocks in the order of time; the one that grows as soon as it is half full.
    pub(super) fn all(&self) -> &[Estimated<N>] {
        let growing = usize::from(2 * self.count >= self.size && self.count > 0);
        &self.blocks[..self.full + growing]
    }

    /// The half of the blocks with the smaller errors, in the order of time.
    pub(super) fn accurate(&self) -> Vec<&Estimated<N>> {
        let all = self.all();
        let mut errors: Vec<&N> = all.iter().map(|block| &block.error).collect();
        errors.sort_by(|a, b| a.partial_cmp(b).expect("estimates that are not finite are refused"));
        let Some(median) = errors.get(all.len().saturating_sub(1) / 2) else { return Vec::new() };
        all.iter().filter(|block| block.error <= **median).collect()
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
        let mut blocks = Blocks::new(&());
        for i in 0..count {
            blocks.push(&Estimated { value: f64::from(i), error: if i % 10 == 3 { 1e-9 } else { 1.0 } });
        }
        blocks
    }

    #[test]
    fn few_estimates_are_blocks_of_their_own() {
        assert_eq!(blocks(63).all().len(), 63);
        assert_eq!(
            values(&blocks(63).accurate()),
            (0..63).map(f64::from).collect::<Vec<_>>(),
            "the median has a large error"
        );
        assert!(blocks(0).accurate().is_empty());
    }

    #[test]
    fn merged_blocks_keep_the_most_accurate() {
        // 64 of 16 estimates become 32 of 32, each with accurate ones; ties go to the newest of a block, to the first of
        // two blocks
        let all = blocks(1024);
        assert_eq!((all.all().len(), all.size), (32, 32));
        let found = values(&all.accurate());
        assert_eq!(found.len(), 32);
        for (i, value) in found.into_iter().enumerate() {
            assert_eq!(value % 10.0, 3.0);
            assert!((32 * i..32 * (i + 1)).contains(&(value as usize)), "{i}: {value}");
        }
    }

    #[test]
    fn a_block_counts_from_its_middle_on() {
        assert_eq!([15, 16, 31].map(|more| blocks(1024 + more).all().len()), [32, 33, 33]);
        assert_eq!(blocks(1_000_000).all().len(), 61, "of 16384 each, and 576 that are too few");
    }

    #[test]
    fn the_most_accurate_of_the_present_block_is_returned() {
        let mut blocks = blocks(1024);
        let mut push = |value, error| blocks.push(&Estimated { value, error }).value;
        assert_eq!([push(1.0, 0.5), push(2.0, 0.9), push(3.0, 0.1), push(4.0, 0.1)], [1.0, 1.0, 3.0, 4.0]);
    }
}
