//! Potentials U(q) and kinetic energies T(p) as parts.

use super::part::{FlowState, Part};
use crate::Rational;
use crate::number::Number;
use crate::systems::kinetic::Kinetic;
use crate::systems::potential::{Potential, Prepared};

/// U(q) as a part: p ← p − t U_q, and β grows by t (qᵀU_q − 2U).
pub struct OfPotential<U, N> {
    potential: Prepared<N, U>,
    gradient: Vec<N>,
    rate: N,
    has_rate: bool,
}

impl<N: Number, U: Potential<N>> OfPotential<U, N> {
    /// The part of a potential.
    pub fn new(potential: U, context: &N::Context) -> Self {
        let gradient = vec![N::zero(context); potential.dimension()];
        OfPotential { potential: Prepared::new(potential, context), gradient, rate: N::zero(context), has_rate: false }
    }
}

impl<N: Number, U: Potential<N>> Part<N> for OfPotential<U, N> {
    fn add_energy(&mut self, q: &[N], _: &[N], energy: &mut N) {
        let mut of_part = N::zero(&energy.context());
        self.potential.energy(q, &mut of_part);
        energy.add(&of_part);
    }

    fn flow(&mut self, time: &N, state: &mut FlowState<'_, N>, continues: bool) {
        let OfPotential { potential, gradient, rate, has_rate } = self;
        if !continues || state.is_augmented() && !*has_rate {
            *has_rate = state.is_augmented();
            potential.gradient(state.q(), gradient, has_rate.then_some(&mut *rate));
        }
        let count = gradient.len();
        gradient.iter().enumerate().for_each(|(i, slope)| state.subtract_product(count + i, time, slope));
        state.add_to_beta(time, rate);
    }

    fn is_potential(&self, _: usize) -> bool {
        true
    }
}

/// T(p) as a part: q ← q + t T_p, and β grows by t (pᵀT_p − 2T).
pub struct OfKinetic<T, N> {
    kinetic: T,
    velocity: Vec<N>,
    rate: N,
    one: N,
    scratch: Vec<N>,
}

impl<N: Number, T: Kinetic<N>> OfKinetic<T, N> {
    /// The part of a kinetic energy of this number of momenta.
    pub fn new(kinetic: T, momenta: usize, context: &N::Context) -> Self {
        let mut scratch = vec![N::zero(context); kinetic.scratch()];
        kinetic.prepare(&mut scratch, context);
        let one = N::from_rational(&Rational::from_integer(1.into()), context);
        OfKinetic { kinetic, velocity: vec![N::zero(context); momenta], rate: N::zero(context), one, scratch }
    }
}

impl<N: Number, T: Kinetic<N>> Part<N> for OfKinetic<T, N> {
    fn add_energy(&mut self, _: &[N], p: &[N], energy: &mut N) {
        let mut of_part = N::zero(&energy.context());
        self.kinetic.energy(p, &mut of_part, &mut self.scratch);
        energy.add(&of_part);
    }

    fn flow(&mut self, time: &N, state: &mut FlowState<'_, N>, _: bool) {
        let OfKinetic { kinetic, velocity, rate, one, scratch } = self;
        // the velocity is what a drift by 1 adds to 0
        velocity.iter_mut().for_each(Number::assign_zero);
        rate.assign_zero();
        match state.is_augmented() {
            true => kinetic.drift_augmented(one, state.p(), velocity, rate, scratch),
            false => kinetic.drift(one, state.p(), velocity, scratch),
        }
        velocity.iter().enumerate().for_each(|(i, velocity)| state.add_product(i, time, velocity));
        state.add_to_beta(time, rate);
    }
}
