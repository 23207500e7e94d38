//! The sum over all pairs of a few bodies whose energy is a formula read at run time: pairs are listed, and many are
//! evaluated at once.
//!
//! What is summed is added up in the order of the plain loop over i < j, so that it has its bits.

use super::pair::{BLOCK, BLOCKS_AT_ONCE, PairPotential, separated};
use crate::number::Number;
use shadowstep_schemes::symbolic::Separation;

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

/// What is added up.
struct Sums<'a, N, const D: usize> {
    /// Empty where no gradient is wanted.
    gradient: &'a mut [[N; D]],
    total: Option<&'a mut N>,
}

impl<P, const D: usize> Listed<'_, P, D> {
    /// gradient ← U_q, and the sum of the summands of pairs where it is wanted; `scratch` is the scratch space of the
    /// pair.
    pub(super) fn sum<N: Number>(&self, q: &[N], gradient: &mut [N], mut total: Option<&mut N>, scratch: &mut [N])
    where
        P: PairPotential<N>,
    {
        gradient.iter_mut().for_each(N::assign_zero);
        if let Some(total) = &mut total {
            total.assign_zero();
        }
        self.add_all(q, &mut Sums { gradient: gradient.as_chunks_mut().0, total }, scratch);
    }

    /// energy ← U
    pub(super) fn energy<N: Number>(&self, q: &[N], energy: &mut N, scratch: &mut [N])
    where
        P: PairPotential<N>,
    {
        energy.assign_zero();
        self.add_all(q, &mut Sums { gradient: &mut [], total: Some(energy) }, scratch);
    }

    fn add_all<N: Number>(&self, q: &[N], sums: &mut Sums<'_, N, D>, scratch: &mut [N])
    where
        P: PairPotential<N>,
    {
        let (q, _) = q.as_chunks::<D>();
        let zero = N::zero(&q[0][0].context());
        let mut list = List {
            count: 0,
            bodies: [[0; 2]; MOST_PAIRS],
            x: std::array::from_fn(|_| std::array::from_fn(|_| zero.clone())),
        };
        for i in 0..self.bodies {
            for j in i + 1..self.bodies {
                list.push([i, j], q, self.pair.separation());
                if list.count == MOST_PAIRS {
                    self.evaluate(&mut list, q, sums, scratch);
                }
            }
        }
        if list.count > 0 {
            self.evaluate(&mut list, q, sums, scratch);
        }
    }

    /// Adds the listed pairs, and empties the list.
    fn evaluate<N: Number>(&self, list: &mut List<N>, q: &[[N; D]], sums: &mut Sums<'_, N, D>, scratch: &mut [N])
    where
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
        match (sums.gradient.is_empty(), &sums.total) {
            (true, _) => self.pair.energies_of(bodies, x, of_summands, scratch),
            (false, None) => self.pair.slopes_of(bodies, x, of_slopes, scratch),
            (false, Some(_)) => self.pair.slopes_and_summands_of(bodies, x, of_slopes, of_summands, scratch),
        }
        if !sums.gradient.is_empty() {
            let separation = self.pair.separation();
            for (place, slope) in slopes.as_flattened()[..list.count].iter().enumerate() {
                let [i, j] = bodies(place);
                let mut forces = difference(&q[i], &q[j]);
                for (axis, force) in forces.iter_mut().enumerate() {
                    match separation {
                        Separation::Difference => force.assign(slope),
                        Separation::SquaredDistance => force.multiply(slope),
                    }
                    sums.gradient[j][axis].add(force);
                    sums.gradient[i][axis].subtract(force);
                }
            }
        }
        if let Some(total) = &mut sums.total {
            summands.as_flattened()[..list.count].iter().for_each(|summand| total.add(summand));
        }
        list.count = 0;
    }
}

impl<N: Number> List<N> {
    fn push<const D: usize>(&mut self, [i, j]: [usize; 2], q: &[[N; D]], separation: Separation) {
        self.x.as_flattened_mut()[self.count] = separated(&difference(&q[i], &q[j]), separation);
        self.bodies[self.count] = [i, j].map(|body| body as u8);
        self.count += 1;
    }
}

/// q_j − q_i
#[inline(always)]
fn difference<N: Number, const D: usize>(q_i: &[N; D], q_j: &[N; D]) -> [N; D] {
    let mut difference = q_i.clone();
    for axis in 0..D {
        difference[axis].assign_difference(&q_j[axis], &q_i[axis]);
    }
    difference
}
