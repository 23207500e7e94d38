//! Gradients of several systems at once, whose potentials have one [program](GradientProgram).

use std::array::from_fn;

use super::Motion;
use crate::number::Number;
use crate::systems::coordinates::Coordinates;
use crate::systems::kept::KeptForce;
use crate::systems::kinetic::Kinetic;
use crate::systems::potential::{GradientProgram, Potential, SYSTEMS};
use crate::systems::summation::Summation;

/// The coordinates and scratch spaces of the systems, side by side.
pub(super) struct Together<N> {
    q: Vec<[N; SYSTEMS]>,
    registers: Vec<[N; SYSTEMS]>,
}

impl<N: Number> Together<N> {
    /// `None` where the gradient is not a program, or not the same.
    pub(super) fn of<V, P, K, S>(motions: &[Motion<N, V, P, K, S>; SYSTEMS]) -> Option<Self>
    where
        V: Coordinates<N>,
        P: Potential<N>,
    {
        let address =
            |motion: &Motion<N, V, P, K, S>| motion.hamiltonian.potential.program().map(GradientProgram::address);
        let first = address(&motions[0])?;
        if !motions.iter().all(|motion| address(motion) == Some(first)) {
            return None;
        }
        Some(Together {
            q: side_by_side(|system| motions[system].at.state.q.as_ref()),
            registers: side_by_side(|system| &motions[system].hamiltonian.scratch),
        })
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
        let Some(program) = motions[0].hamiltonian.potential.program() else { return };
        let gradients = program.gradients(&self.q, &mut self.registers);
        for (system, Motion { hamiltonian, at }) in motions.iter_mut().enumerate() {
            for (own, gradients) in at.gradient.as_mut().iter_mut().zip(gradients) {
                own.assign(&gradients[system]);
            }
            hamiltonian.keep(at, KeptForce::Gradient);
        }
    }
}

fn side_by_side<'a, N: Clone + 'a>(list: impl Fn(usize) -> &'a [N]) -> Vec<[N; SYSTEMS]> {
    (0..list(0).len()).map(|i| from_fn(|system| list(system)[i].clone())).collect()
}
