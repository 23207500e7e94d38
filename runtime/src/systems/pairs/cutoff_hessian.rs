//! The Hessian–vector product of a sum over pairs up to a cutoff, one pair after the other.

use super::cutoff_pairs::CutoffPairs;
use super::near::{Constants, Near, clear_far_lanes, is_below};
use super::pair::{PairCurvature, PairPotential};
use crate::number::Number;
use crate::systems::potential::{HessianProduct, Potential};

impl<N: Number, P: PairPotential<N>, const D: usize> HessianProduct<N> for CutoffPairs<P, D> {
    fn hessian_scratch(&self) -> usize {
        Potential::<N>::scratch(self) + self.pair.curved().map_or(0, PairCurvature::curvature_scratch)
    }

    fn prepare_hessian(&self, scratch: &mut [N], context: &N::Context) {
        let (own, second) = scratch.split_at_mut(Potential::<N>::scratch(self));
        self.prepare(own, context);
        if let Some(curved) = self.pair.curved() {
            curved.prepare_curvature(second, context);
        }
    }

    fn hessian_product(&self, q: &[N], v: &[N], product: &mut [N], scratch: &mut [N]) {
        self.sum_products(q, v, product, scratch);
    }

    fn hessian_product_and_rate(&self, q: &[N], v: &[N], product: &mut [N], rate: &mut N, scratch: &mut [N]) {
        // qᵀU_qq v − vᵀU_q
        *rate = self.sum_products(q, v, product, scratch);
        rate.negate();
        q.iter().zip(product).for_each(|(q, product)| rate.add_product(q, product));
    }
}

impl<P, const D: usize> CutoffPairs<P, D> {
    /// product ← U_qq v; gives vᵀU_q.
    fn sum_products<N: Number>(&self, q: &[N], v: &[N], product: &mut [N], scratch: &mut [N]) -> N
    where
        P: PairPotential<N>,
    {
        let curved = self.pair.curved().expect("the potential has a Hessian–vector product only then");
        let (scratch, second) = scratch.split_at_mut(Potential::<N>::scratch(self));
        let (constants, pair) = Constants::<N, D>::split(scratch);
        let zero = N::zero(&q[0].context());
        product.iter_mut().for_each(N::assign_zero);
        let (q, _) = q.as_chunks::<D>();
        let (vectors, _) = v.as_chunks::<D>();
        let (product, _) = product.as_chunks_mut::<D>();
        let reciprocal_sides = self.reciprocal_sides();
        let mut near = Near::<N, D, 1, 2>::new(&zero);
        let [mut along, mut total] = [zero.clone(), zero];
        for j in 0..self.bodies {
            for other in self.neighbours.of(j).chunks(1) {
                near.add(other, &q[j], q, &constants, reciprocal_sides.as_ref());
                if near.count == 0 {
                    continue;
                }
                near.count = 0;
                let (i, x) = (other[0] as usize, &near.squared[0][0]);
                let [slope, curvature] = self.second_derivatives(curved, (i, j), x, &constants, (pair, second));
                // curvature·(dᵀw) d + slope·w of the difference w of the vectors
                let mut parts = vectors[j].clone();
                along.assign_zero();
                for axis in 0..D {
                    parts[axis].subtract(&vectors[i][axis]);
                    along.add_product(&parts[axis], &near.difference[axis][0][0]);
                }
                total.add_product(&slope, &along);
                along.multiply(&curvature);
                for axis in 0..D {
                    parts[axis].multiply(&slope);
                    parts[axis].add_product(&along, &near.difference[axis][0][0]);
                    product[j][axis].add(&parts[axis]);
                    product[i][axis].subtract(&parts[axis]);
                }
            }
        }
        total
    }

    /// 2φ′ and 4φ″ of φ = S u at x = r².
    fn second_derivatives<N: Number>(
        &self,
        curved: &dyn PairCurvature<N>,
        (i, j): (usize, usize),
        x: &N,
        constants: &Constants<'_, N, D>,
        (pair, second): (&mut [N], &mut [N]),
    ) -> [N; 2]
    where
        P: PairPotential<N>,
    {
        let [mut slope, mut curvature] = [x.clone(), x.clone()];
        curved.curvature(i, j, x, &mut slope, &mut curvature, second);
        let [cutoff, from, reciprocal] = constants.squares;
        if let Some(polynomial) = self.switch.filter(|_| is_below(from, x)) {
            let mut energy = x.clone();
            self.pair.energy(i, j, x, &mut energy, pair);
            let mut t = cutoff.clone();
            t.subtract(x);
            t.multiply(reciprocal);
            let ([mut value], [mut rise]) = ([x.clone()], [x.clone()]);
            let places = (std::array::from_mut(&mut value), std::array::from_mut(&mut rise));
            polynomial.assign(constants.coefficients, std::array::from_ref(&t), places.0, places.1);
            let mut bend = polynomial.second_derivative(constants.coefficients, &t);
            // d/dx is −1/(r_c² − r_s²) of d/dt: 4φ″ = S 4u″ − 4 S′ 2u′/(…) + 4 S″ u/(…)²
            rise.multiply(reciprocal);
            bend.multiply(reciprocal);
            bend.multiply(reciprocal);
            bend.multiply_integer(4);
            curvature.multiply(&value);
            curvature.add_product(&bend, &energy);
            rise.multiply_integer(2);
            curvature.subtract_product(&rise, &slope);
            curvature.subtract_product(&rise, &slope);
            slope.multiply(&value);
            slope.subtract_product(&rise, &energy);
        }
        let mut found = [slope, curvature];
        if N::LANES > 1 {
            found
                .iter_mut()
                .for_each(|number| clear_far_lanes(std::array::from_ref(x), cutoff, std::array::from_mut(number)));
        }
        found
    }
}
