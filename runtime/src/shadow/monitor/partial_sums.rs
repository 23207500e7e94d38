//! Sums over the coordinates of a state.

use crate::instructions;
use crate::number::Number;

/// In how many partial sums the coordinates of a long state are added up, which do not wait for one another: as many on all machines.
const LANES: usize = 8;

/// Room for S sums at once.
#[derive(Clone, Debug)]
pub(super) struct PartialSums<N, const S: usize> {
    lanes: [[N; LANES]; S],
    sums: [N; S],
}

impl<N: Number, const S: usize> PartialSums<N, S> {
    pub(super) fn new(context: &N::Context) -> Self {
        let zeros = || std::array::from_fn(|_| N::zero(context));
        let lanes = || std::array::from_fn(|_| N::zero(context));
        PartialSums { lanes: std::array::from_fn(|_| lanes()), sums: zeros() }
    }

    /// The sums over all coordinates of what `add` adds for one, which gets the coordinate of each of these vectors.
    #[inline(always)]
    pub(super) fn of<const V: usize>(
        &mut self,
        mut vectors: [&[N]; V],
        mut add: impl FnMut([&N; V], [&mut N; S]),
    ) -> [N::Register<'_>; S] {
        let length = vectors[0].len();
        for vector in &mut vectors {
            *vector = &vector[..length];
        }
        if length >= LANES {
            self.add_lanes(vectors, &mut add);
        }
        let PartialSums { lanes, sums } = self;
        let mut sums = sums.each_mut().map(N::register);
        sums.iter_mut().for_each(|sum| sum.assign_zero());
        for c in length - length % LANES..length {
            let mut coordinates = [&vectors[0][c]; V];
            for (coordinate, vector) in coordinates.iter_mut().zip(&vectors) {
                *coordinate = &vector[c];
            }
            add(coordinates, sums.each_mut().map(|sum| &mut **sum));
        }
        if length >= LANES {
            for (sum, lanes) in sums.iter_mut().zip(lanes) {
                lanes.iter().for_each(|lane| sum.add(lane));
            }
        }
        sums
    }

    fn add_lanes<const V: usize>(&mut self, vectors: [&[N]; V], add: &mut impl FnMut([&N; V], [&mut N; S])) {
        instructions::widest_if_long(
            N::IN_VECTORS,
            vectors[0].len(),
            #[inline(always)]
            || self.add_lanes_here(vectors, add),
        );
    }

    /// The lanes of a sum are side by side in memory at the end: so the compiler makes vectors of them.
    #[inline(always)]
    fn add_lanes_here<const V: usize>(&mut self, vectors: [&[N]; V], add: &mut impl FnMut([&N; V], [&mut N; S])) {
        let mut chunks = [vectors[0].as_chunks::<LANES>().0; V];
        let count = chunks[0].len();
        for (chunks, vector) in chunks.iter_mut().zip(vectors) {
            *chunks = &vector.as_chunks::<LANES>().0[..count];
        }
        let mut sums = self.lanes.clone();
        sums.iter_mut().flatten().for_each(N::assign_zero);
        for i in 0..count {
            let mut groups = [&chunks[0][i]; V];
            for (group, chunks) in groups.iter_mut().zip(&chunks) {
                *group = &chunks[i];
            }
            for l in 0..LANES {
                let mut coordinates = [&groups[0][l]; V];
                for (coordinate, group) in coordinates.iter_mut().zip(&groups) {
                    *coordinate = &group[l];
                }
                add(coordinates, sums.each_mut().map(|lanes| &mut lanes[l]));
            }
        }
        self.lanes = sums;
    }
}
