//! The bodies that are closer to a body than the cutoff.

use shadowstep_schemes::symbolic::Separation;

use super::group::separations;
use super::neighbours::nearest_integer;
use super::switch::COEFFICIENTS;
use crate::number::{Number, scaled};

/// What is in the scratch space before that of the pair.
pub(super) struct Constants<'a, N, const D: usize> {
    /// r_c², r_s² and 1/(r_c² − r_s²)
    pub(super) squares: &'a [N; 3],
    /// Of the switch.
    pub(super) coefficients: &'a [N; COEFFICIENTS],
    pub(super) sides: &'a [N; D],
}

impl<'a, N, const D: usize> Constants<'a, N, D> {
    /// The constants, and the scratch space of the pair.
    #[inline(always)]
    pub(super) fn split(scratch: &'a mut [N]) -> (Self, &'a mut [N]) {
        const ENOUGH: &str = "as much as asked for";
        let (squares, rest) = scratch.split_first_chunk_mut().expect(ENOUGH);
        let (coefficients, rest) = rest.split_first_chunk_mut().expect(ENOUGH);
        let (sides, pair) = rest.split_first_chunk_mut().expect(ENOUGH);
        (Constants { squares, coefficients, sides }, pair)
    }
}

/// How many numbers these are.
pub(super) const fn constants(dimensions: usize) -> usize {
    3 + COEFFICIENTS + dimensions
}

/// Pairs of a body with others that are closer than the cutoff, in blocks; there is room for B of them, of which the
/// last one is filled in part.
pub(super) struct Near<N, const D: usize, const W: usize, const B: usize> {
    pub(super) count: usize,
    pub(super) others: [[u32; W]; B],
    /// From the other body to the body.
    pub(super) difference: [[[N; W]; B]; D],
    pub(super) squared: [[N; W]; B],
}

impl<N: Number, const D: usize, const W: usize, const B: usize> Near<N, D, W, B> {
    /// How many pairs are evaluated at once.
    pub(super) const FULL: usize = W * (B - 1);

    pub(super) fn new(zero: &N) -> Self {
        let zeros = || std::array::from_fn(|_| std::array::from_fn(|_| zero.clone()));
        Near { count: 0, others: [[0; W]; B], difference: std::array::from_fn(|_| zeros()), squared: zeros() }
    }

    /// Adds those of some bodies that are closer than the cutoff.
    #[inline(always)]
    pub(super) fn add(
        &mut self,
        others: &[u32],
        at: &[N; D],
        q: &[[N; D]],
        constants: &Constants<'_, N, D>,
        reciprocal_sides: Option<&[f64; D]>,
    ) {
        // beyond the last one it is repeated, and not taken
        let others_of_block: [u32; W] = std::array::from_fn(|l| others[l.min(others.len() - 1)]);
        let mut difference: [[N; W]; D] =
            std::array::from_fn(|axis| std::array::from_fn(|l| q[others_of_block[l] as usize][axis].clone()));
        for (axis, of_axis) in difference.iter_mut().enumerate() {
            for difference in of_axis {
                let mut own = at[axis].clone();
                own.subtract(difference);
                if let Some(reciprocal_sides) = reciprocal_sides {
                    subtract_images(&mut own, reciprocal_sides[axis], &constants.sides[axis]);
                }
                *difference = own;
            }
        }
        let squared = separations(&difference, Separation::SquaredDistance);
        let [cutoff, ..] = constants.squares;
        let is_near: [bool; W] = std::array::from_fn(|l| is_below(&squared[l], cutoff));
        for l in 0..W {
            let place = self.count;
            self.others.as_flattened_mut()[place] = others_of_block[l];
            for (own, of_axis) in self.difference.iter_mut().zip(&difference) {
                own.as_flattened_mut()[place].assign(&of_axis[l]);
            }
            self.squared.as_flattened_mut()[place].assign(&squared[l]);
            self.count += usize::from(is_near[l] && l < others.len());
        }
    }

    /// Takes all blocks away but the last one.
    #[inline(always)]
    pub(super) fn drop_full(&mut self) {
        self.count -= Self::FULL;
        self.others[0] = self.others[B - 1];
        for blocks in self.difference.iter_mut().chain([&mut self.squared]) {
            let [first, .., last] = &mut blocks[..] else { return };
            first.iter_mut().zip(last).for_each(|(first, last)| first.assign(last));
        }
    }
}

/// difference ← that of the nearest images
#[inline(always)]
fn subtract_images<N: Number>(difference: &mut N, reciprocal_side: f64, side: &N) {
    let mut images = difference.clone();
    for lane in 0..N::LANES {
        let (m, n) = difference.lane(lane);
        images.set_lane(lane, nearest_integer(scaled(m, n) * reciprocal_side), 0);
    }
    difference.subtract_product(&images, side);
}

/// Whether a < b in some lane.
#[inline(always)]
pub(super) fn is_below<N: Number>(a: &N, b: &N) -> bool {
    let mut difference = b.clone();
    difference.subtract(a);
    (0..N::LANES).any(|lane| difference.lane(lane).0 > 0.0)
}

/// Numbers ← 0 in the lanes in which bodies are as far as the cutoff.
pub(super) fn clear_far_lanes<N: Number>(x: &[N], cutoff: &N, numbers: &mut [N]) {
    for (x, number) in x.iter().zip(numbers) {
        let mut difference = cutoff.clone();
        difference.subtract(x);
        for lane in (0..N::LANES).filter(|&lane| difference.lane(lane).0 <= 0.0) {
            number.set_lane(lane, 0.0, 0);
        }
    }
}
