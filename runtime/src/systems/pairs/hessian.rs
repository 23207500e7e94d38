//! The Hessian–vector product of a sum over pairs, one pair after the other.

use super::Pairs;
use super::ends::End;
use super::pair::{PairCurvature, PairPotential};
use super::scratch::{Scratch, own_scratch, parts, separated};
use crate::number::Number;
use crate::systems::potential::HessianProduct;
use shadowstep_schemes::symbolic::Separation;

/// What is in the scratch space before that of a sum.
struct OfVector<'a, N, const D: usize> {
    /// Of the vector, as the difference of positions.
    direction: &'a mut [N; D],
    /// Their product.
    along: &'a mut N,
    curvature: &'a mut N,
    rate: &'a mut N,
}

/// What is of the vector, and the scratch space of the sum.
fn split<N, const D: usize>(scratch: &mut [N]) -> (OfVector<'_, N, D>, &mut [N]) {
    let (direction, rest) = scratch.split_first_chunk_mut::<D>().expect("as much as asked for");
    let [along, curvature, rate, rest @ ..] = rest else { unreachable!("as much as asked for") };
    (OfVector { direction, along, curvature, rate }, rest)
}

/// The pair's scratch space.
pub(super) fn scratch_of_pair<N: Number, const D: usize>(scratch: &mut [N]) -> &mut [N] {
    parts::<N, D>(split::<N, D>(scratch).1).pair
}

impl<N: Number, P: PairPotential<N>, const D: usize> HessianProduct<N> for Pairs<P, D> {
    fn hessian_scratch(&self) -> usize {
        D + 3 + own_scratch(D) + self.pair.curved().map_or(0, PairCurvature::curvature_scratch)
    }

    fn prepare_hessian(&self, scratch: &mut [N], context: &N::Context) {
        if let Some(curved) = self.pair.curved() {
            curved.prepare_curvature(scratch_of_pair::<N, D>(scratch), context);
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
        let (mut own, scratch) = split::<N, D>(scratch);
        let mut s = parts::<N, D>(scratch);
        self.each(q, |i, j| {
            self.compute_pair(curved, (i, j), vectors, rate.as_deref_mut(), (&mut own, &mut s));
            if let End::Body(j, _) = j {
                product[j].iter_mut().zip(own.direction.iter()).for_each(|(product, part)| product.add(part));
            }
            if let End::Body(i, _) = i {
                product[i].iter_mut().zip(own.direction.iter()).for_each(|(product, part)| product.subtract(part));
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
        (own, s): (&mut OfVector<'_, N, D>, &mut Scratch<'_, N, D>),
    ) where
        P: PairPotential<N>,
    {
        End::subtract(i, j, &mut s.difference);
        // walls do not move
        let moving = |end: End<'_, N, D>| match end {
            End::Wall => End::Wall,
            End::Body(number, _) => End::Body(number, &vectors[number]),
        };
        End::subtract(moving(i), moving(j), &mut own.direction.each_mut());
        let separation = self.pair.separation();
        let x = separated::<N, D>(&s.difference, &mut s.squared, separation);
        if rate.is_some() {
            let results = [&mut *s.slope, &mut *own.curvature, &mut *own.rate];
            curved.curvature_and_rate(i.number(), j.number(), x, results, s.pair);
        } else {
            curved.curvature(i.number(), j.number(), x, &mut s.slope, own.curvature, s.pair);
        }
        own.along.assign(&own.direction[0]);
        match separation {
            Separation::Difference => own.direction[0].multiply(own.curvature),
            Separation::SquaredDistance => {
                own.along.multiply(&s.difference[0]);
                (1..D).for_each(|axis| own.along.add_product(&s.difference[axis], &own.direction[axis]));
                own.curvature.multiply(own.along);
                for (part, axis) in own.direction.iter_mut().zip(s.difference.iter()) {
                    part.multiply(&s.slope);
                    part.add_product(own.curvature, axis);
                }
            }
        }
        if let Some(rate) = rate {
            rate.add_product(own.rate, own.along);
        }
    }
}
