//! Sums of potentials.

use crate::number::Number;
use crate::systems::potential::{HessianProduct, Potential};

/// The sum of two potentials of the same coordinates.
///
/// ```
/// use shadowstep::systems::formula::FormulaPotential;
/// use shadowstep::systems::potential::Sum;
/// use shadowstep::{Motion, UnitMasses};
///
/// let [spring, field] = ["x^2/2", "-x"].map(|formula| FormulaPotential::<f64>::new(formula, &["x"], &[]).unwrap());
/// assert_eq!(Motion::new(Sum(spring, field), UnitMasses, [2.0], [0.0]).unwrap().energy(), 0.0);
/// ```
#[derive(Clone, Debug)]
pub struct Sum<P, Q>(pub P, pub Q);

/// The gradient or product of the second, its rate or energy, and the scratch space of both.
struct Parts<'a, N> {
    second: &'a mut [N],
    number: &'a mut N,
    scratch: [&'a mut [N]; 2],
}

impl<P, Q> Sum<P, Q> {
    fn parts<N>(dimension: usize, of_first: usize, scratch: &mut [N]) -> Parts<'_, N> {
        let (second, rest) = scratch.split_at_mut(dimension);
        let (number, rest) = rest.split_first_mut().expect("as much as asked for");
        Parts { second, number, scratch: rest.split_at_mut(of_first).into() }
    }
}

fn add<N: Number>(sums: &mut [N], parts: &[N]) {
    sums.iter_mut().zip(parts).for_each(|(sum, part)| sum.add(part));
}

impl<N: Number, P: Potential<N>, Q: Potential<N>> Potential<N> for Sum<P, Q> {
    fn dimension(&self) -> usize {
        self.0.dimension()
    }

    fn scratch(&self) -> usize {
        self.dimension() + 1 + self.0.scratch() + self.1.scratch()
    }

    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        let [first, second] = Self::parts(self.dimension(), self.0.scratch(), scratch).scratch;
        self.0.prepare(first, context);
        self.1.prepare(second, context);
    }

    fn update(&mut self, q: &[N]) {
        self.0.update(q);
        self.1.update(q);
    }

    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        let Parts { number, scratch: [first, second], .. } = Self::parts(self.dimension(), self.0.scratch(), scratch);
        self.0.energy(q, energy, first);
        self.1.energy(q, number, second);
        energy.add(number);
    }

    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        let Parts { second, scratch, .. } = Self::parts(self.dimension(), self.0.scratch(), scratch);
        self.0.gradient(q, gradient, scratch[0]);
        self.1.gradient(q, second, scratch[1]);
        add(gradient, second);
    }

    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        let Parts { second, number, scratch } = Self::parts(self.dimension(), self.0.scratch(), scratch);
        self.0.gradient_and_rate(q, gradient, rate, scratch[0]);
        self.1.gradient_and_rate(q, second, number, scratch[1]);
        add(gradient, second);
        rate.add(number);
    }

    fn hessian(&self) -> Option<&dyn HessianProduct<N>> {
        self.0.hessian().and(self.1.hessian()).map(|_| self as &dyn HessianProduct<N>)
    }
}

impl<P, Q> Sum<P, Q> {
    /// The second derivatives of both.
    fn hessians<N: Number>(&self) -> [&dyn HessianProduct<N>; 2]
    where
        P: Potential<N>,
        Q: Potential<N>,
    {
        let [first, second] = [self.0.hessian(), self.1.hessian()];
        [first, second].map(|hessian| hessian.expect("both have second derivatives"))
    }
}

impl<N: Number, P: Potential<N>, Q: Potential<N>> HessianProduct<N> for Sum<P, Q> {
    fn hessian_scratch(&self) -> usize {
        self.0.dimension() + 1 + self.hessians().map(HessianProduct::hessian_scratch).iter().sum::<usize>()
    }

    fn prepare_hessian(&self, scratch: &mut [N], context: &N::Context) {
        let [of_first, of_second] = self.hessians();
        let [first, second] = Self::parts(self.0.dimension(), of_first.hessian_scratch(), scratch).scratch;
        of_first.prepare_hessian(first, context);
        of_second.prepare_hessian(second, context);
    }

    fn hessian_product(&self, q: &[N], v: &[N], product: &mut [N], scratch: &mut [N]) {
        let [of_first, of_second] = self.hessians();
        let Parts { second, scratch, .. } = Self::parts(self.0.dimension(), of_first.hessian_scratch(), scratch);
        of_first.hessian_product(q, v, product, scratch[0]);
        of_second.hessian_product(q, v, second, scratch[1]);
        add(product, second);
    }

    fn hessian_product_and_rate(&self, q: &[N], v: &[N], product: &mut [N], rate: &mut N, scratch: &mut [N]) {
        let [of_first, of_second] = self.hessians();
        let Parts { second, number, scratch } = Self::parts(self.0.dimension(), of_first.hessian_scratch(), scratch);
        of_first.hessian_product_and_rate(q, v, product, rate, scratch[0]);
        of_second.hessian_product_and_rate(q, v, second, number, scratch[1]);
        add(product, second);
        rate.add(number);
    }
}
