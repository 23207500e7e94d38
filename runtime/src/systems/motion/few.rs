//! Steps of [a few coordinates](FewCoordinates) whose potential is behind a `dyn`, by one call of it.

use std::mem::take;

use super::Motion;
use super::hamiltonian::{Evaluated, Hamiltonian, kicks_and_drifts};
use super::turns::advance_in_turns;
use crate::number::Number;
use crate::systems::coordinates::Coordinates;
use crate::systems::kinetic::{InverseMasses, Kinetic, UnitMasses};
use crate::systems::maps::MapSequence;
use crate::systems::potential::{FewCoordinates, FewOfSystem, Potential, Repeated};
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
        few.advance(potentials);
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
    let Motion { hamiltonian: Hamiltonian { potential, kinetic, scratch, .. }, at } = motion;
    let Evaluated { state: State { q, p, evaluations, .. }, gradient, kept, .. } = at;
    let inverse_masses = kinetic.inverse_masses().expect("the masses are known");
    (potential, FewOfSystem { state: [q, p, gradient].map(V::as_mut), inverse_masses, scratch, kept, evaluations })
}

/// The steps of systems in lanes, in turns, with states in arrays.
#[inline(always)]
pub(crate) fn advance_in_arrays<const D: usize, N: Number, P: Potential<N> + ?Sized>(
    systems: &mut [FewOfSystem<'_, N>],
    potentials: Vec<&mut P>,
    maps: &[Repeated<N>; 3],
) {
    if systems.iter().all(|system| matches!(system.inverse_masses, InverseMasses::Ones)) {
        advance_with::<D, N, P, _>(systems, potentials, maps, |_| UnitMasses);
    } else {
        advance_with::<D, N, P, _>(systems, potentials, maps, |system| system.inverse_masses);
    }
}

/// With these masses.
#[inline(always)]
fn advance_with<'m, const D: usize, N: Number, P: Potential<N> + ?Sized, K: Kinetic<N>>(
    systems: &mut [FewOfSystem<'m, N>],
    potentials: Vec<&mut P>,
    maps: &[Repeated<N>; 3],
    kinetic: impl Fn(&FewOfSystem<'m, N>) -> K,
) {
    let parts = systems.iter_mut().zip(potentials);
    let mut motions: Vec<_> = parts
        .map(|(system, potential)| {
            let kinetic = kinetic(system);
            in_arrays::<D, _, _, _>(system, potential, kinetic)
        })
        .collect();
    advance_in_turns(&mut motions, maps);
    for (system, Motion { hamiltonian, at }) in systems.iter_mut().zip(motions) {
        for (own, made) in system.state.iter_mut().zip([at.state.q, at.state.p, at.gradient]) {
            own.clone_from_slice(&made);
        }
        *system.scratch = hamiltonian.scratch;
        *system.kept = at.kept;
        *system.evaluations += at.state.evaluations;
    }
}

fn in_arrays<'a, const D: usize, N: Number, P: Potential<N> + ?Sized, K>(
    system: &mut FewOfSystem<'_, N>,
    potential: &'a mut P,
    kinetic: K,
) -> Motion<N, [N; D], &'a mut P, K> {
    let [q, p, gradient] = system.state.each_ref().map(|x| std::array::from_fn::<N, D, _>(|i| x[i].clone()));
    let context = q[0].context();
    let zero = N::zero(&context);
    let at = Evaluated { state: State::new(q, p, &context), gradient, rate: zero.clone(), kept: *system.kept };
    let hamiltonian = Hamiltonian {
        potential,
        kinetic,
        scratch: take(system.scratch),
        kinetic_scratch: vec![zero.clone()],
        kinetic_energy: zero,
        gradient_kicks: None,
    };
    Motion { hamiltonian, at }
}
