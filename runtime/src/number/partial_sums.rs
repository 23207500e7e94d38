//! Sums over the coordinates of a state.

use std::mem::needs_drop;

use crate::number::Number;
use crate::number::instructions;

/// In how many partial sums the coordinates of a long state are added up, which do not wait for one another: as many on
/// all machines.
const LANES: usize = 8;

/// For this number of coordinates and more, [`add_sum`] adds numbers that [keep increments](Number::KEEPS_INCREMENTS)
/// in partial sums.
pub(crate) const LONG: usize = 64;

/// sum ← sum + what `add` adds for each coordinate, which gets the coordinate of each of these vectors.
#[inline(always)]
pub(crate) fn add_sum<N: Number, const V: usize>(
    sum: &mut N,
    vectors: [&[N]; V],
    mut add: impl FnMut([&N; V], &mut N),
) {
    let length = vectors[0].len();
    let in_lanes = if N::KEEPS_INCREMENTS && length >= LONG { length - length % LANES } else { 0 };
    if in_lanes > 0 {
        let mut lanes: [N; LANES] = std::array::from_fn(|_| N::zero(&sum.context()));
        add_to_lanes(&mut lanes, &vectors, &mut add);
        lanes.iter().for_each(|lane| sum.add(lane));
    }
    let vectors = vectors.map(|vector| &vector[..length]);
    let mut add_all = |sum: &mut N| {
        for i in in_lanes..length {
            add(vectors.map(|vector| &vector[i]), sum);
        }
    };
    if const { needs_drop::<N>() } {
        return add_all(sum);
    }
    // a copy, in a register: memory would take twice as long as the addition, at each coordinate
    let mut own = sum.clone();
    add_all(&mut own);
    *sum = own;
}

/// Not inlined, so that the lanes are in memory at the end and the compiler makes vectors of them.
#[inline(never)]
fn add_to_lanes<N: Number, const V: usize>(
    lanes: &mut [N; LANES],
    vectors: &[&[N]; V],
    add: &mut impl FnMut([&N; V], &mut N),
) {
    instructions::widest_if_long(
        N::IN_VECTORS,
        vectors[0].len(),
        #[inline(always)]
        || {
            let mut own = lanes.clone();
            let chunks = vectors.map(|vector| vector.as_chunks::<LANES>().0);
            for i in 0..chunks[0].len() {
                let groups = chunks.map(|chunks| &chunks[i]);
                for l in 0..LANES {
                    add(groups.map(|group| &group[l]), &mut own[l]);
                }
            }
            *lanes = own;
        },
    );
}

/// Room for S sums at once.
#[derive(Clone, Debug)]
pub(crate) struct PartialSums<N, const S: usize> {
    lanes: [[N; LANES]; S],
    sums: [N; S],
}

impl<N: Number, const S: usize> PartialSums<N, S> {
    pub(crate) fn new(context: &N::Context) -> Self {
        let zeros = || std::array::from_fn(|_| N::zero(context));
        let lanes = || std::array::from_fn(|_| N::zero(context));
        PartialSums { lanes: std::array::from_fn(|_| lanes()), sums: zeros() }
    }

    /// The sums over all coordinates of what `add` adds for one, which gets the coordinate of each of these vectors.
    #[inline(always)]
    pub(crate) fn of<const V: usize>(
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Lanes;

    /// Sums of multiples of 1/1024 are exact, so that nothing may be missing or twice.
    #[test]
    fn every_coordinate_is_added_once() {
        for length in [1, 7, 8, LONG - 1, LONG, LONG + 1, 10 * LONG + 5] {
            let a: Vec<f64> = (0..length).map(|i| ((i * i) % 101) as f64 / 1024.0).collect();
            let b: Vec<f64> = (0..length).map(|i| ((7 * i) % 31) as f64 - 15.0).collect();
            let expected = 0.5 + a.iter().zip(&b).map(|(a, b)| a * b).sum::<f64>();
            let mut sum = 0.5;
            add_sum(&mut sum, [&a, &b], |[a, b], sum| sum.add_product(a, b));
            assert_eq!(sum, expected, "{length}");
        }
    }

    #[test]
    fn lanes_have_the_bits_of_f64() {
        for length in [3, LONG, 10 * LONG + 5] {
            let a: Vec<f64> = (0..length).map(|i| (i as f64).sin()).collect();
            let (mut sum, mut lanes) = (0.0, Lanes::<4>::all(0.0));
            add_sum(&mut sum, [&a], |[a], sum| sum.add_product(a, a));
            add_sum(&mut lanes, [&a.iter().copied().map(Lanes::all).collect::<Vec<_>>()], |[a], sum| {
                sum.add_product(a, a)
            });
            assert_eq!(lanes, Lanes::all(sum), "{length}");
        }
    }
}
