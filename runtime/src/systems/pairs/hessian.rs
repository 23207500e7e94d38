//! The Hessian–vector product of a sum over pairs, one pair after the other.

use super::Pairs;
use super::ends::End;
use super::pair::{PairCurvature, PairPotential};
use crate::number::Number;
use crate::systems::potential::HessianProduct;
use shadowstep_schemes::symbolic::Separation;

/// The scratch space of a call, followed by the pair's: differences of positions and of the vector, their product, x
/// and what the pair computes of it.
struct Scratch<'a, N, const D: usize> {
    difference: &'a mut [N; D],
    direction: &'a mut [N; D],
    along: &'a mut N,
    squared: &'a mut N,
    results: &'a mut [N; 3],
    pair: &'a mut [N],
}

const fn own_scratch(dimensions: usize) -> usize {
    2 * dimensions + 5
}

fn parts<N, const D: usize>(scratch: &mut [N]) -> Scratch<'_, N, D> {
    const ENOUGH: &str = "as much as asked for";
    let (difference, rest) = scratch.split_first_chunk_mut::<D>().expect(ENOUGH);
    let (direction, rest) = rest.split_first_chunk_mut::<D>().expect(ENOUGH);
    let ([along, squared], rest) = rest.split_first_chunk_mut::<2>().expect(ENOUGH);
    let (results, pair) = rest.split_first_chunk_mut::<3>().expect(ENOUGH);
    Scratch { difference, direction, along, squared, results, pair }
}

/// The pair's scratch space.
pub(super) fn scratch_of_pair<N, const D: usize>(scratch: &mut [N]) -> &mut [N] {
    parts::<N, D>(scratch).pair
}

impl<N: Number, P: PairPotential<N>, const D: usize> HessianProduct<N> for Pairs<P, D> {
    fn hessian_scratch(&self) -> usize {
        own_scratch(D) + self.pair.curved().map_or(0, PairCurvature::curvature_scratch)
    }

    fn prepare_hessian(&self, scratch: &mut [N], context: &N::Context) {
        if let Some(curved) = self.pair.curved() {
            curved.prepare_curvature(parts::<N, D>(scratch).pair, context);
        }
    }

    fn hessian_product(&self, q: &[N], v: &[N], product: &mut [N], scratch: &mut [N]) {
        self.sum_products(q, v, product, None, scratch);
    }

    fn hessian_product_and_rate(&self, q: &[N], v: &[N], product: &mut [N], rate: &mut N, scratch: &mut [N]) {
        self.sum_products(q, v, product, Some(rate), scratch);
    }
}

impl<P, const D: usize> Pairs<P, D> {
    /// product ← U_qq v, and the rate where it is wanted.
    fn sum_products<N: Number>(&self, q: &[N], v: &[N], product: &mut [N], mut rate: Option<&mut N>, scratch: &mut [N])
    where
        P: PairPotential<N>,
    {
        let curved = self.pair.curved().expect("the potential has a Hessian–vector product only then");
        product.iter_mut().for_each(N::assign_zero);
        rate.iter_mut().for_each(|rate| rate.assign_zero());
        let (product, _) = product.as_chunks_mut::<D>();
        let (vectors, _) = v.as_chunks::<D>();
        let mut s = parts::<N, D>(scratch);
        self.each(q, |i, j| {
            self.compute_pair(curved, (i, j), vectors, rate.as_deref_mut(), &mut s);
            if let End::Body(j, _) = j {
                product[j].iter_mut().zip(s.direction.iter()).for_each(|(product, part)| product.add(part));
            }
            if let End::Body(i, _) = i {
                product[i].iter_mut().zip(s.direction.iter()).for_each(|(product, part)| product.subtract(part));
            }
        });
    }

    /// direction ← what a pair adds to the product of the body j; adds what it adds to the rate.
    fn compute_pair<N: Number>(
        &self,
        curved: &dyn PairCurvature<N>,
        (i, j): (End<'_, N, D>, End<'_, N, D>),
        vectors: &[[N; D]],
        rate: Option<&mut N>,
        s: &mut Scratch<'_, N, D>,
    ) where
        P: PairPotential<N>,
    {
        End::subtract(i, j, &mut s.difference.each_mut());
        // walls do not move
        let moving = |end: End<'_, N, D>| match end {
            End::Wall => End::Wall,
            End::Body(number, _) => End::Body(number, &vectors[number]),
        };
        End::subtract(moving(i), moving(j), &mut s.direction.each_mut());
        let separation = self.pair.separation();
        let x = match separation {
            Separation::Difference => &s.difference[0],
            Separation::SquaredDistance => {
                s.squared.assign_square(&s.difference[0]);
                s.difference[1..].iter().for_each(|axis| s.squared.add_product(axis, axis));
                &*s.squared
            }
        };
        let [slope, curvature, of_rate] = s.results;
        if rate.is_some() {
            curved.curvature_and_rate(i.number(), j.number(), x, [slope, curvature, of_rate], s.pair);
        } else {
            curved.curvature(i.number(), j.number(), x, slope, curvature, s.pair);
        }
        s.along.assign(&s.direction[0]);
        match separation {
            Separation::Difference => s.direction[0].multiply(curvature),
            Separation::SquaredDistance => {
                s.along.multiply(&s.difference[0]);
                (1..D).for_each(|axis| s.along.add_product(&s.difference[axis], &s.direction[axis]));
                curvature.multiply(s.along);
                for (part, axis) in s.direction.iter_mut().zip(s.difference.iter()) {
                    part.multiply(slope);
                    part.add_product(curvature, axis);
                }
            }
        }
        if let Some(rate) = rate {
            rate.add_product(of_rate, s.along);
        }
    }
}
