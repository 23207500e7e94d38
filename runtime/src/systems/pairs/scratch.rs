//! The scratch space of a sum over pairs, one after the other.

use shadowstep_schemes::symbolic::Separation;

use crate::number::Number;

/// The scratch space of a call.
pub(super) struct Scratch<'a, N: Number + 'a, const D: usize> {
    pub(super) difference: [N::Register<'a>; D],
    pub(super) squared: N::Register<'a>,
    pub(super) slope: N::Register<'a>,
    pub(super) result: N::Register<'a>,
    pub(super) pair: &'a mut [N],
}

/// difference, squared, slope, result
pub(super) const fn own_scratch(dimensions: usize) -> usize {
    dimensions + 3
}

#[inline(always)]
pub(super) fn parts<N: Number, const D: usize>(scratch: &mut [N]) -> Scratch<'_, N, D> {
    let (difference, rest) = scratch.split_first_chunk_mut::<D>().expect("as much as asked for");
    let [squared, slope, result, pair @ ..] = rest else { unreachable!("as much as asked for") };
    let difference = difference.each_mut().map(N::register);
    let [squared, slope, result] = [squared, slope, result].map(N::register);
    Scratch { difference, squared, slope, result, pair }
}

/// What u is a function of, from the difference.
#[inline(always)]
pub(super) fn separated<'a, N: Number, const D: usize>(
    difference: &'a [N::Register<'_>; D],
    squared: &'a mut N,
    separation: Separation,
) -> &'a N {
    match separation {
        Separation::Difference => &difference[0],
        Separation::SquaredDistance => {
            let (first, others) = difference.split_first().expect("at least one dimension");
            squared.assign_square(first);
            others.iter().for_each(|other| squared.add_product(other, other));
            squared
        }
    }
}
