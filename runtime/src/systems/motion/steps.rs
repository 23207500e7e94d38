//! The flows and steps of a motion.

use std::slice;

use super::few::advance_few;
use super::{Motion, side_by_side, turns};
use crate::number::Number;
use crate::number::instructions;
use crate::number::partial_sums::add_sum;
use crate::systems::coordinates::Coordinates;
use crate::systems::evaluated::Evaluated;
use crate::systems::increments::Carried;
use crate::systems::kept::KeptForce;
use crate::systems::kinetic::Kinetic;
use crate::systems::maps::MapSequence;
use crate::systems::potential::Potential;
use crate::systems::state::State;
use crate::systems::summation::Summation;
use crate::systems::system::{Carrying, System, Visitor, visit_each};

impl<N, V, P, K, S> System for Motion<N, V, P, K, S>
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
    S: Summation<N>,
{
    type Number = N;
    type Class = K::Class;
    type Coordinates = V;
    type Summation = S;

    #[inline(always)]
    fn state(&self) -> &State<N, V, S> {
        &self.at.state
    }

    fn state_mut(&mut self) -> &mut State<N, V, S> {
        self.at.state_mut()
    }

    #[inline]
    fn clear_increments(&mut self) {
        self.at.state.clear_increments();
    }

    #[inline(always)]
    fn kick(&mut self, weight: &N, carried: Carried) {
        self.at.kick(&mut self.hamiltonian, weight, carried);
    }

    #[inline(always)]
    fn drift(&mut self, weight: &N, carried: Carried) {
        self.hamiltonian.drift(&mut self.at, weight, carried);
    }

    fn has_gradient_kicks(&self) -> bool {
        self.hamiltonian.has_gradient_kicks()
    }

    #[inline(always)]
    fn gradient_kick(&mut self, weight: &N, carried: Carried) {
        self.at.gradient_kick(&mut self.hamiltonian, weight, carried);
    }

    fn advance(motions: &mut [Self], maps: &impl MapSequence<N>, count: u64, carried: Carried) {
        // two functions: in one of both the compiler would no longer inline the gradient, which has to be compiled for
        // these instructions
        if carried == Carried::Nothing {
            N::in_widest_instructions(
                #[inline(always)]
                || {
                    let motions = side_by_side::advance_first(motions, maps, count);
                    if motions.is_empty() || advance_few(motions, maps, count, None) {
                        return;
                    }
                    match motions {
                        // registers hold the state
                        [Motion { hamiltonian, at }] => hamiltonian.advance(at, maps, count),
                        many => turns::advance(many, maps, count),
                    }
                },
            );
        } else {
            instructions::widest_for_energies::<N, _>(
                #[inline(always)]
                || {
                    for motion in motions {
                        motion.clear_increments();
                        maps.each(0..count, count, &mut Carrying { system: motion, carried: Carried::Increments });
                    }
                },
            );
        }
    }

    fn advance_visited(&mut self, maps: &impl MapSequence<N>, count: u64, visitor: &mut dyn Visitor<N>) {
        N::in_widest_instructions(
            #[inline(always)]
            || {
                if !advance_few(slice::from_mut(self), maps, count, Some(visitor)) {
                    visit_each(self, maps, count, visitor);
                }
            },
        );
    }

    /// Where the gradient and the rate are kept, U = ½(qᵀU_q − rate) costs no evaluation.
    #[inline]
    fn assign_energy(&mut self, at: Option<(&[N], &[N])>, energy: &mut N) {
        let Motion { hamiltonian, at: Evaluated { state, gradient, rate, kept } } = self;
        let (q, p) = at.unwrap_or((state.q(), state.p()));
        if at.is_some() || *kept != KeptForce::GradientAndRate {
            return hamiltonian.assign_energy((q, p), energy);
        }
        energy.assign_zero();
        let massive = hamiltonian.kinetic.massive_coordinates(q.len());
        add_sum(energy, [&q[..massive], &gradient.as_ref()[..massive]], |[q, u], energy| energy.add_product(q, u));
        energy.subtract(rate);
        energy.divide_integer(2);
        hamiltonian.add_kinetic_energy((q, p), energy);
    }

    #[inline]
    fn assign_kinetic_energy(&mut self, at: Option<(&[N], &[N])>, kinetic: &mut N) {
        let (_, p) = at.unwrap_or((self.at.state.q(), self.at.state.p()));
        self.hamiltonian.assign_kinetic_energy(p, kinetic);
    }

    fn energy(&mut self) -> N {
        Motion::energy(self)
    }

    fn massive_coordinates(&self) -> usize {
        self.hamiltonian.kinetic.massive_coordinates(self.q().len())
    }
}
