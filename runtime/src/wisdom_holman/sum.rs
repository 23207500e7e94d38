//! How increments are added to the coordinates of planets: plainly, or with the remainder of each sum.

use crate::number::Number;
use crate::summation::add_with_remainder;

/// Adds increments to positions, or to momenta.
#[derive(Clone, Debug)]
pub(super) struct Sum<N> {
    /// Of each coordinate; none where sums are plain.
    pub(super) remainders: Vec<N>,
    y: N,
    sum: N,
}

impl<N: Number> Sum<N> {
    pub(super) fn plain(context: &N::Context) -> Self {
        Sum { remainders: Vec::new(), y: N::zero(context), sum: N::zero(context) }
    }

    /// Keeps remainders from now on.
    pub(super) fn compensate(&mut self, dimension: usize) {
        self.remainders = vec![N::zero(&self.y.context()); dimension];
    }

    /// Drops the remainders, where coordinates were set.
    pub(super) fn forget(&mut self) {
        self.remainders.iter_mut().for_each(N::assign_zero);
    }

    /// x ← x + by, x being the coordinate of this number
    pub(super) fn add(&mut self, number: usize, x: &mut N, by: &N) {
        let Some(remainder) = self.remainders.get_mut(number) else { return x.add(by) };
        self.y.assign_sum(remainder, by);
        add_with_remainder(x, remainder, &self.y, &mut self.sum);
    }

    /// x ← x + a b
    pub(super) fn add_product(&mut self, number: usize, x: &mut N, a: &N, b: &N) {
        let Some(remainder) = self.remainders.get_mut(number) else { return x.add_product(a, b) };
        self.y.assign(remainder);
        self.y.add_product(a, b);
        add_with_remainder(x, remainder, &self.y, &mut self.sum);
    }

    /// p ← p − weight gradient, of all coordinates
    pub(super) fn kick(&mut self, p: &mut [N], weight: &N, gradient: &[N]) {
        // one loop with both cases is slower: the compiler makes it one of masked vectors
        if self.remainders.is_empty() {
            return p.iter_mut().zip(gradient).for_each(|(p, gradient)| p.subtract_product(weight, gradient));
        }
        for ((p, remainder), gradient) in p.iter_mut().zip(&mut self.remainders).zip(gradient) {
            self.y.assign(remainder);
            self.y.subtract_product(weight, gradient);
            add_with_remainder(p, remainder, &self.y, &mut self.sum);
        }
    }
}
