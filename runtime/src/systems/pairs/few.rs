//! The sum over all pairs of a few bodies, for numbers of a few bytes: unrolled, so that sums are in registers, with
//! two to four pairs of a body at once.
//!
//! The gradient is added up in the order of the plain loop over i < j, so that it has its bits, and so is the sum of
//! the summands of pairs.

use std::hint::black_box;
use std::slice::{from_mut, from_ref};

use super::group::{make_forces, separations};
use super::pair::PairPotential;
use crate::number::Number;

/// More bodies are summed in a loop.
pub(super) const MOST_BODIES: usize = 6;

/// A sum over all pairs of three to six bodies in D dimensions.
pub(super) struct Few<'a, P, const D: usize> {
    pub(super) pair: &'a P,
    pub(super) bodies: usize,
}

/// A coordinate; by itself where the program is built for wide vectors: a wide read would wait until the narrower
/// writes of the drift before it are done.
#[inline(always)]
fn read<N: Number>(coordinate: &N) -> N {
    if cfg!(target_feature = "avx") { black_box(coordinate).clone() } else { coordinate.clone() }
}

/// The sum of a fixed number of bodies, by groups of pairs: the body i, the first other one, and how many. Bodies are
/// side by side, axis by axis. The compiler does not unroll loops of this size.
macro_rules! unrolled {
    ($few:ident, $q:ident, $gradient:ident, $total:ident, $scratch:ident, $bodies:literal: $($i:literal $j:literal $width:literal),*) => {{
        const BODIES: &str = "there are as many bodies";
        let q: &[[N; D]; $bodies] = $q.as_chunks().0.try_into().expect(BODIES);
        let gradient: &mut [[N; D]; $bodies] = $gradient.as_chunks_mut().0.try_into().expect(BODIES);
        let zero = N::zero(&q[0][0].context());
        let q: [[N; $bodies]; D] = std::array::from_fn(|axis| std::array::from_fn(|body| read(&q[body][axis])));
        let mut sum: [[N; $bodies]; D] = std::array::from_fn(|_| std::array::from_fn(|_| zero.clone()));
        $($few.add::<N, SUM, $bodies, $width>(($i, $j), &q, &mut sum, $total, $scratch);)*
        *gradient = std::array::from_fn(|body| std::array::from_fn(|axis| sum[axis][body].clone()));
    }};
}

impl<P, const D: usize> Few<'_, P, D> {
    /// gradient ← U_q, and total ← the sum of the summands of pairs where `SUM`; `scratch` is the scratch space of the
    /// pair.
    #[inline(always)]
    pub(super) fn sum<N: Number, const SUM: bool>(
        &self,
        (q, gradient): (&[N], &mut [N]),
        total: Option<&mut N>,
        scratch: &mut [N],
    ) where
        P: PairPotential<N>,
    {
        N::in_widest_instructions(
            #[inline(always)]
            || {
                // in a register: in memory each sum would wait for the one before
                let mut sum = N::zero(&q[0].context());
                self.add_all::<N, SUM>(q, gradient, &mut sum, scratch);
                if let Some(total) = total {
                    total.assign(&sum);
                }
            },
        );
    }

    #[inline(always)]
    fn add_all<N: Number, const SUM: bool>(&self, q: &[N], gradient: &mut [N], total: &mut N, scratch: &mut [N])
    where
        P: PairPotential<N>,
    {
        match self.bodies {
            3 => unrolled!(self, q, gradient, total, scratch, 3: 0 1 2, 1 2 1),
            4 => unrolled!(self, q, gradient, total, scratch, 4: 0 1 2, 0 3 1, 1 2 2, 2 3 1),
            5 => unrolled!(self, q, gradient, total, scratch, 5: 0 1 2, 0 3 2, 1 2 2, 1 4 1, 2 3 2, 3 4 1),
            _ => {
                unrolled!(self, q, gradient, total, scratch, 6: 0 1 4, 0 5 1, 1 2 4, 2 3 3, 3 4 2, 4 5 1)
            }
        }
    }

    /// Adds the pairs of the body i with the bodies j, …, j + W − 1.
    #[inline(always)]
    fn add<N: Number, const SUM: bool, const B: usize, const W: usize>(
        &self,
        (i, j): (usize, usize),
        q: &[[N; B]; D],
        sum: &mut [[N; B]; D],
        total: &mut N,
        scratch: &mut [N],
    ) where
        P: PairPotential<N>,
    {
        let zero = N::zero(&total.context());
        let zeros = || -> [N; W] { std::array::from_fn(|_| zero.clone()) };
        let mut forces: [[N; W]; D] = std::array::from_fn(|_| zeros());
        for axis in 0..D {
            for l in 0..W {
                forces[axis][l].assign_difference(&q[axis][j + l], &q[axis][i]);
            }
        }
        let separation = self.pair.separation();
        let x = separations(&forces, separation);
        let (mut slopes, mut summands) = (zeros(), zeros());
        let results = (from_mut(&mut slopes), from_mut(&mut summands));
        self.pair.of_blocks::<W, true, SUM>([i, j], from_ref(&x), results.0, results.1, scratch);
        if SUM {
            summands.iter().for_each(|summand| total.add(summand));
        }
        make_forces(&mut forces, &slopes, separation);
        for l in 0..W {
            for axis in 0..D {
                sum[axis][j + l].add(&forces[axis][l]);
                sum[axis][i].subtract(&forces[axis][l]);
            }
        }
    }
}
