//! Compensated sums: each coordinate with the remainder of its last sum.

use super::{Half, Remainders, Summation};
use crate::number::Number;
use crate::systems::coordinates::{Coordinates, index};
use crate::systems::kinetic::Kinetic;

/// q and p with the remainder of each sum, which is added to the next increment.
///
/// An increment δ changes a coordinate a and its remainder e by y = δ + e, rounded: a' is a + y rounded, and e' = y −
/// (a' − a). Where y is not larger than a, no part of it is lost: a' + e' = a + y exactly. Elsewhere, as where a
/// coordinate passes 0, ε y may be lost. So the round-off of a kick or drift is of the size ε δ, where a plain sum has
/// ε a.
///
/// What is left comes from the increments: from the force at the rounded q, and its own rounding. Exact products and
/// the remainder of p in drifts were tried, and gain no more than the spread of the measurement.
///
/// W. Kahan, *Further remarks on reducing truncation errors*, Comm. ACM 8 (1965) 40, and for steps of integrators O.
/// Møller, BIT 5 (1965) 37; E. Hairer, C. Lubich, G. Wanner, *Geometric Numerical Integration*, 2nd ed. (2006), section
/// VIII.5.
#[derive(Clone, Debug)]
pub struct Compensated<N, V> {
    q: V,
    p: V,
    /// What a drift adds to q.
    increment: V,
    /// Intermediate results.
    y: N,
    sum: N,
}

impl<N: Number, V: Coordinates<N>> Compensated<N, V> {
    /// Remainders of 0, for coordinates like these.
    pub(crate) fn of(coordinates: &V, context: &N::Context) -> Self {
        let mut zeros = coordinates.clone();
        zeros.as_mut().iter_mut().for_each(N::assign_zero);
        let zero = || N::zero(context);
        Compensated { q: zeros.clone(), p: zeros.clone(), increment: zeros, y: zero(), sum: zero() }
    }

    /// q ← q + increment
    #[inline(always)]
    fn add_increment(&mut self, q: &mut [N]) {
        let (mut y, mut sum) = (self.y.register(), self.sum.register());
        let length = q.len();
        let (remainders, increment) = (&mut self.q.as_mut()[..length], &self.increment.as_ref()[..length]);
        for i in 0..length {
            let i = index::<N>(i, length);
            y.assign_sum(&remainders[i], &increment[i]);
            add_with_remainder(&mut q[i], &mut remainders[i], &y, &mut sum);
        }
    }
}

/// a ← a + y, and what is rounded away is the remainder.
#[inline(always)]
fn add_with_remainder<N: Number>(a: &mut N, remainder: &mut N, y: &N, sum: &mut N) {
    sum.assign_sum(a, y);
    remainder.assign_difference(a, sum);
    remainder.add(y);
    a.assign(sum);
}

impl<N: Number, V: Coordinates<N>> Summation<N> for Compensated<N, V> {
    #[inline(always)]
    fn kick(&mut self, weight: &N, gradient: &[N], p: &mut [N]) {
        let (mut y, mut sum) = (self.y.register(), self.sum.register());
        let length = p.len();
        let (remainders, gradient) = (&mut self.p.as_mut()[..length], &gradient[..length]);
        for i in 0..length {
            let i = index::<N>(i, length);
            y.assign(&remainders[i]);
            y.subtract_product(weight, &gradient[i]);
            add_with_remainder(&mut p[i], &mut remainders[i], &y, &mut sum);
        }
    }

    #[inline(always)]
    fn drift<K: Kinetic<N>>(&mut self, kinetic: &K, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
        self.increment.as_mut().iter_mut().for_each(N::assign_zero);
        kinetic.drift(weight, p, self.increment.as_mut(), scratch);
        self.add_increment(q);
    }

    #[inline(always)]
    fn drift_augmented<K: Kinetic<N>>(
        &mut self,
        kinetic: &K,
        weight: &N,
        p: &[N],
        q: &mut [N],
        (added, beta): (&mut [N], &mut N),
        scratch: &mut [N],
    ) {
        self.increment.as_mut().iter_mut().for_each(N::assign_zero);
        kinetic.drift_augmented(weight, p, self.increment.as_mut(), beta, scratch);
        if N::KEEPS_INCREMENTS {
            added.iter_mut().zip(self.increment.as_ref()).for_each(|(own, increment)| own.add(increment));
        }
        self.add_increment(q);
    }

    #[inline(always)]
    fn change(&mut self, half: Half, index: usize, x: &mut N, add: impl Fn(&mut N)) {
        let remainders = match half {
            Half::Positions => self.q.as_mut(),
            Half::Momenta => self.p.as_mut(),
        };
        let remainder = &mut remainders[index];
        self.y.assign(remainder);
        add(&mut self.y);
        add_with_remainder(x, remainder, &self.y, &mut self.sum);
    }

    fn forget_positions(&mut self) {
        self.q.as_mut().iter_mut().for_each(N::assign_zero);
    }

    fn forget_momenta(&mut self) {
        self.p.as_mut().iter_mut().for_each(N::assign_zero);
    }

    fn remainders(&self, _: &[N], _: &[N]) -> Remainders<N> {
        Remainders { q: self.q.as_ref().to_vec(), p: self.p.as_ref().to_vec() }
    }

    fn set_remainders(&mut self, remainders: &Remainders<N>) {
        for (own, given) in [(self.q.as_mut(), &remainders.q), (self.p.as_mut(), &remainders.p)] {
            own.iter_mut().zip(given).for_each(|(own, given)| own.assign(given));
        }
    }

    fn is_compensated(&self) -> bool {
        true
    }
}
