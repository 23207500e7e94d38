//! The sum over all pairs of a few bodies whose energy is a formula read at run time: pairs are listed, and many are
//! evaluated at once.
//!
//! What is summed is added up in the order of the plain loop over i < j, so that it has its bits.

use super::group::{make_forces, separations};
use super::pair::{BLOCK, BLOCKS_AT_ONCE, PairPotential};
use crate::number::Number;

/// The pairs of fewer bodies are evaluated one by one: a list would cost more.
pub(super) const LEAST_BODIES: usize = 4;

/// How many pairs are evaluated at once.
const MOST_PAIRS: usize = BLOCK * BLOCKS_AT_ONCE;

/// A sum over all pairs of bodies in D dimensions.
pub(super) struct Listed<'a, P, const D: usize> {
    pub(super) pair: &'a P,
    pub(super) bodies: usize,
}

/// Pairs that are not evaluated yet, with what u is a function of.
struct List<N> {
    count: usize,
    bodies: [[u8; 2]; MOST_PAIRS],
    x: [[N; BLOCK]; BLOCKS_AT_ONCE],
}

impl<P, const D: usize> Listed<'_, P, D> {
    /// gradient ← U_q where `FORCES`, and total ← the sum of the summands of pairs where `SUM`, without forces of their
    /// energies; `scratch` is the scratch space of the pair.
    #[inline(never)]
    pub(super) fn sum<N: Number, const FORCES: bool, const SUM: bool>(
        &self,
        (q, gradient): (&[N], &mut [N]),
        mut total: Option<&mut N>,
        scratch: &mut [N],
    ) where
        P: PairPotential<N>,
    {
        gradient.iter_mut().for_each(N::assign_zero);
        if let Some(total) = &mut total {
            total.assign_zero();
        }
        let (q, gradient) = (q.as_chunks::<D>().0, gradient.as_chunks_mut::<D>().0);
        let zero = N::zero(&q[0][0].context());
        let x = std::array::from_fn(|_| std::array::from_fn(|_| zero.clone()));
        let mut list = List { count: 0, bodies: [[0; 2]; MOST_PAIRS], x };
        for i in 0..self.bodies {
            for j in i + 1..self.bodies {
                [list.x.as_flattened_mut()[list.count]] =
                    separations(&difference(&q[i], &q[j]), self.pair.separation());
                list.bodies[list.count] = [i, j].map(|body| body as u8);
                list.count += 1;
                if list.count == MOST_PAIRS {
                    self.add::<N, FORCES, SUM>(&mut list, (q, gradient), total.as_deref_mut(), scratch);
                }
            }
        }
        if list.count > 0 {
            self.add::<N, FORCES, SUM>(&mut list, (q, gradient), total, scratch);
        }
    }

    /// Adds the listed pairs, and empties the list.
    fn add<N: Number, const FORCES: bool, const SUM: bool>(
        &self,
        list: &mut List<N>,
        (q, gradient): (&[[N; D]], &mut [[N; D]]),
        total: Option<&mut N>,
        scratch: &mut [N],
    ) where
        P: PairPotential<N>,
    {
        let blocks = list.count.div_ceil(BLOCK);
        // places without a pair have the last one
        let (last, last_bodies) = (list.x.as_flattened()[list.count - 1].clone(), list.bodies[list.count - 1]);
        list.x.as_flattened_mut()[list.count..blocks * BLOCK].fill(last);
        list.bodies[list.count..blocks * BLOCK].fill(last_bodies);
        let (mut slopes, mut summands) = (list.x.clone(), list.x.clone());
        let (x, of_slopes, of_summands) = (&list.x[..blocks], &mut slopes[..blocks], &mut summands[..blocks]);
        let bodies = |place: usize| list.bodies[place].map(usize::from);
        self.pair.of_places::<BLOCK, FORCES, SUM>(bodies, x, of_slopes, of_summands, scratch);
        if FORCES {
            for (place, slope) in slopes.as_flattened()[..list.count].iter().enumerate() {
                let [i, j] = bodies(place);
                let mut forces = difference(&q[i], &q[j]);
                make_forces(&mut forces, std::array::from_ref(slope), self.pair.separation());
                for (axis, [force]) in forces.iter().enumerate() {
                    gradient[j][axis].add(force);
                    gradient[i][axis].subtract(force);
                }
            }
        }
        if let Some(total) = total.filter(|_| SUM) {
            summands.as_flattened()[..list.count].iter().for_each(|summand| total.add(summand));
        }
        list.count = 0;
    }
}

/// q_j − q_i
#[inline(always)]
fn difference<N: Number, const D: usize>(q_i: &[N; D], q_j: &[N; D]) -> [[N; 1]; D] {
    let mut difference = q_i.each_ref().map(|x| [x.clone()]);
    for axis in 0..D {
        difference[axis][0].assign_difference(&q_j[axis], &q_i[axis]);
    }
    difference
}
