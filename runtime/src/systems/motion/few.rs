//! Steps of [a few coordinates](FewCoordinates) whose potential is behind a `dyn`, by one call of it.

use super::Motion;
use super::hamiltonian::{Hamiltonian, kicks_and_drifts};
use crate::number::Number;
use crate::systems::coordinates::Coordinates;
use crate::systems::evaluated::Evaluated;
use crate::systems::kinetic::Kinetic;
use crate::systems::maps::MapSequence;
use crate::systems::potential::{FewCoordinates, FewOfSystem, Potential, Prepared, evaluate};
use crate::systems::state::State;
use crate::systems::summation::Summation;
use crate::systems::system::Visitor;

/// Of fewer steps than these no list of maps is made.
pub(super) const FEW: u64 = 8;

/// `count` plain steps of each motion; false, and nothing is done, where they are not such.
#[inline(always)]
pub(super) fn advance_few<N, V, P, K, S>(
    motions: &mut [Motion<N, V, P, K, S>],
    maps: &impl MapSequence<N>,
    count: u64,
    visitor: Option<&mut dyn Visitor<N>>,
) -> bool
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
    S: Summation<N>,
{
    if !FewCoordinates::<N>::FIT || !P::is_boxed() || count < FEW || !motions.iter().all(|motion| is_plain(motion)) {
        return false;
    }
    let dimension = motions.first().map_or(0, |motion| motion.q().len());
    if !FewCoordinates::<N>::can_hold(motions.len(), dimension) {
        return false;
    }
    let Some(maps) = kicks_and_drifts(maps, count) else { return false };
    let (mut potentials, systems) = motions.iter_mut().map(of_system).unzip::<_, _, Vec<_>, Vec<_>>();
    // as short a borrow as that of the state
    let visitor = visitor.map(|visitor| -> &mut dyn Visitor<N> { visitor });
    let mut few = FewCoordinates { systems, maps, visitor };
    let [first, others @ ..] = &mut potentials[..] else { return true };
    let others = others.iter_mut().map(|other| other.as_any()).collect::<Option<_>>();
    if !others.is_some_and(|others| first.advance_few(others, &mut few)) {
        few.advance(dimension, potentials, evaluate);
    }
    true
}

/// Kicks are plain, and masses are known.
fn is_plain<N, V, P, K, S>(Motion { hamiltonian, at }: &Motion<N, V, P, K, S>) -> bool
where
    N: Number,
    K: Kinetic<N>,
    S: Summation<N>,
{
    at.state.sums.is_plain() && hamiltonian.gradient_kicks.is_none() && hamiltonian.kinetic.inverse_masses().is_some()
}

fn of_system<N, V, P, K, S>(motion: &mut Motion<N, V, P, K, S>) -> (&mut P, FewOfSystem<'_, N>)
where
    N: Number,
    V: Coordinates<N>,
    K: Kinetic<N>,
{
    let Motion { hamiltonian: Hamiltonian { potential, kinetic, .. }, at } = motion;
    let Prepared { function: potential, scratch, .. } = potential;
    let Evaluated { state: State { q, p, evaluations, .. }, gradient, kept, .. } = at;
    let inverse_masses = kinetic.inverse_masses().expect("the masses are known");
    (potential, FewOfSystem { state: [q, p, gradient].map(V::as_mut), inverse_masses, scratch, kept, evaluations })
}
