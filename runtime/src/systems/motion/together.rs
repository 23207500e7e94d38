//! Gradients of several systems at once, whose potential is one formula, evaluated by an interpreter: each of its instructions for all systems
//! before the next one, so that an instruction is decoded once, and need not wait for the results of the one before.

use std::array::from_fn;

use super::Motion;
use crate::number::Number;
use crate::systems::coordinates::Coordinates;
use crate::systems::kept::KeptForce;
use crate::systems::kinetic::Kinetic;
use crate::systems::potential::Potential;
use crate::systems::summation::Summation;

/// How many systems there are: of 16 lanes, 64 trajectories, whose registers fit into the nearest cache.
pub(super) const SYSTEMS: usize = 4;

/// The coordinates and registers of the systems.
pub(super) struct Together<N> {
    q: Vec<[N; SYSTEMS]>,
    registers: Vec<[N; SYSTEMS]>,
}

impl<N: Number> Together<N> {
    /// `None` where the gradient is not a program, or not the same.
    pub(super) fn of<V, P: Potential<N>, K, S>(motions: &[Motion<N, V, P, K, S>; SYSTEMS]) -> Option<Self> {
        let first = motions[0].hamiltonian.potential.program()?.0;
        let is_same = |motion: &Motion<N, V, P, K, S>| {
            motion.hamiltonian.potential.program().is_some_and(|program| first.has_gradient_of(program.0))
        };
        if !motions.iter().all(is_same) {
            return None;
        }
        let of_systems = |i: usize| from_fn(|system| motions[system].hamiltonian.scratch[i].clone());
        let registers: Vec<[N; SYSTEMS]> = (0..first.registers()).map(of_systems).collect();
        let dimension = motions[0].hamiltonian.potential.dimension();
        Some(Together { q: vec![registers[0].clone(); dimension], registers })
    }

    /// Evaluates the gradients, unless one is known.
    #[inline(always)]
    pub(super) fn evaluate<V, P, K, S>(&mut self, motions: &mut [Motion<N, V, P, K, S>; SYSTEMS])
    where
        V: Coordinates<N>,
        P: Potential<N>,
        K: Kinetic<N>,
        S: Summation<N>,
    {
        if motions.iter().any(|motion| motion.at.kept != KeptForce::Nothing) {
            return;
        }
        for (c, q) in self.q.iter_mut().enumerate() {
            for system in 0..SYSTEMS {
                q[system].assign(&motions[system].at.state.q.as_ref()[c]);
            }
        }
        let program = motions[0].hamiltonian.potential.program().expect("it was there before").0;
        let gradients = program.gradients(&self.q, &mut self.registers);
        for (system, Motion { hamiltonian, at }) in motions.iter_mut().enumerate() {
            for (own, gradients) in at.gradient.as_mut().iter_mut().zip(gradients) {
                own.assign(&gradients[system]);
            }
            hamiltonian.keep(at, KeptForce::Gradient);
        }
    }
}
