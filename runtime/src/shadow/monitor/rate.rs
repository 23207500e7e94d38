//! Whether the rate is qᵀU_q − 2U: H from the gradient and the rate against H itself.

use crate::number::{Real, epsilon};
use crate::systems::system::System;

/// Both are rounded; a difference of this number of last places of |H| + T is not round-off.
const LARGEST_ROUNDING: i32 = 1_000_000_000;

/// Room for the comparison, and its result.
#[derive(Clone, Debug)]
pub(super) struct RateCheck<N> {
    q: Vec<N>,
    p: Vec<N>,
    energy: N,
    kinetic: N,
    size: N,
    /// 10⁹ ε
    rounding: N,
    /// Windows in which they differ.
    pub(super) wrong: u64,
}

impl<N: Real> RateCheck<N> {
    pub(super) fn new(dimension: usize, context: &N::Context) -> Self {
        let zero = || N::zero(context);
        let zeros = || vec![zero(); dimension];
        let mut rounding: N = epsilon(context);
        rounding.multiply_integer(LARGEST_ROUNDING);
        RateCheck { q: zeros(), p: zeros(), energy: zero(), kinetic: zero(), size: zero(), rounding, wrong: 0 }
    }

    /// Compares H as the system gives it at its present state.
    pub(super) fn compare<M: System<Number = N> + ?Sized>(&mut self, system: &mut M, energy: &N) {
        self.q.iter_mut().zip(system.state().q()).for_each(|(own, q)| own.assign(q));
        self.p.iter_mut().zip(system.state().p()).for_each(|(own, p)| own.assign(p));
        system.assign_energy(Some((&self.q, &self.p)), &mut self.energy);
        system.assign_kinetic_energy(Some((&self.q, &self.p)), &mut self.kinetic);
        self.size.assign(energy);
        self.size.make_absolute();
        self.size.add(&self.kinetic);
        self.size.multiply(&self.rounding);
        self.energy.subtract(energy);
        self.energy.make_absolute();
        self.wrong += u64::from(self.energy > self.size);
    }
}
