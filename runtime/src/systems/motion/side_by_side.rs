//! Steps of several systems side by side, whose gradients are one [program](GradientProgram): coordinate by coordinate,
//! those of all systems.

use std::array::from_fn;

use num_traits::One;

use super::Motion;
use super::few::FEW;
use super::hamiltonian::kicks_and_drifts;
use crate::Rational;
use crate::number::Number;
use crate::systems::coordinates::Coordinates;
use crate::systems::kept::KeptForce;
use crate::systems::kinetic::{InverseMasses, Kinetic};
use crate::systems::maps::{MapKind, MapSequence, Repeated};
use crate::systems::potential::{GradientProgram, Potential, SYSTEMS};
use crate::systems::summation::{Compensated, Remainders, Summation};
use crate::systems::turn::{InTurns, Turn, advance_in_turns};

/// `count` plain steps of the first motions, as many as have one program with their neighbours; the others are
/// returned.
#[inline(always)]
pub(super) fn advance_first<'m, N, V, P, K, S>(
    motions: &'m mut [Motion<N, V, P, K, S>],
    maps: &impl MapSequence<N>,
    count: u64,
) -> &'m mut [Motion<N, V, P, K, S>]
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
    S: Summation<N>,
{
    // of other numbers it is not compiled, as each kind needs a loop of the interpreter of its own
    if const { N::LANES == 1 || N::HAS_DERIVATIVES } || count < FEW {
        return motions;
    }
    let groups = motions.as_chunks::<SYSTEMS>().0.iter().take_while(|group| has_one_program(group)).count();
    if groups == 0 {
        return motions;
    }
    let Some(maps) = kicks_and_drifts(maps, count) else { return motions };
    let (first, others) = motions.split_at_mut(groups * SYSTEMS);
    // a loop: a closure would not be compiled for these instructions
    for group in first.as_chunks_mut().0 {
        advance(group, &maps);
    }
    others
}

fn has_one_program<N, V, P, K, S>(motions: &[Motion<N, V, P, K, S>; SYSTEMS]) -> bool
where
    N: Number,
    P: Potential<N>,
    K: Kinetic<N>,
    S: Summation<N>,
{
    let address =
        |motion: &Motion<_, _, P, _, _>| motion.hamiltonian.potential.function.program().map(GradientProgram::address);
    let first = address(&motions[0]);
    let is_compensated = motions[0].at.state.sums.is_compensated();
    first.is_some()
        && motions.iter().all(|motion| {
            let (hamiltonian, sums) = (&motion.hamiltonian, &motion.at.state.sums);
            address(motion) == first
                && hamiltonian.gradient_kicks.is_none()
                && hamiltonian.kinetic.inverse_masses().is_some()
                && sums.is_compensated() == is_compensated
                && (is_compensated || sums.is_plain())
        })
}

#[inline(always)]
fn advance<N, V, P, K, S>(motions: &mut [Motion<N, V, P, K, S>; SYSTEMS], maps: &[Repeated<N>; 3])
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
    S: Summation<N>,
{
    let [q, p] = [side_by_side(|system| motions[system].q()), side_by_side(|system| motions[system].p())];
    let registers = side_by_side(|system| &motions[system].hamiltonian.potential.scratch);
    let masses = inverse_masses(motions);
    let inverse_masses = masses.as_ref().map_or(InverseMasses::Ones, |inverse| InverseMasses::Of(inverse));
    let (sums, velocity) = (compensated(motions, &q), [q[0].clone()]);
    let Some(program) = motions[0].hamiltonian.potential.function.program() else { return };
    let (kept, gradient, evaluations) = (KeptForce::Nothing, 0, 0);
    let mut all = SideBySide { program, registers, gradient, kept, evaluations, q, p, sums, inverse_masses, velocity };
    advance_in_turns(&mut all, maps);
    let SideBySide { registers, gradient, kept, evaluations, q, p, sums, .. } = all;
    // a gradient that was kept was evaluated again
    let begins_with_kick = maps[0].0.first().is_some_and(|(kind, _)| *kind == MapKind::Kick);
    let remainders = sums.remainders(&q, &p);
    for (system, Motion { at, .. }) in motions.iter_mut().enumerate() {
        at.state.evaluations += evaluations - u64::from(begins_with_kick && at.kept != KeptForce::Nothing);
        scatter(system, &q, at.state.q.as_mut());
        scatter(system, &p, at.state.p.as_mut());
        if kept != KeptForce::Nothing {
            scatter(system, &registers[gradient..], at.gradient.as_mut());
        }
        at.kept = kept;
        let own = |list: &[N]| list.iter().skip(system).step_by(SYSTEMS).cloned().collect();
        at.state.set_remainders(&Remainders { q: own(&remainders.q), p: own(&remainders.p) });
    }
}

/// Four systems: each list has coordinate by coordinate those of all.
struct SideBySide<'a, N> {
    program: &'a dyn GradientProgram<N>,
    registers: Vec<N>,
    /// The first of the registers with the gradients.
    gradient: usize,
    kept: KeptForce,
    evaluations: u64,
    q: Vec<N>,
    p: Vec<N>,
    sums: Option<Compensated<N, Vec<N>>>,
    inverse_masses: InverseMasses<'a, N>,
    velocity: [N; 1],
}

impl<N: Number> InTurns<N> for SideBySide<'_, N> {
    const IN_REGISTERS: bool = false;

    #[inline(always)]
    fn advance(&mut self, turn: &Turn<'_, N>) {
        let SideBySide { program, registers, gradient, kept, evaluations, q, p, sums, inverse_masses, velocity } = self;
        if turn.has_kick() && *kept == KeptForce::Nothing {
            *gradient = SYSTEMS * program.gradients(q.as_chunks().0, registers.as_chunks_mut().0);
            *kept = KeptForce::Gradient;
            *evaluations += 1;
        }
        let gradient = &registers[*gradient..][..q.len()];
        turn.kick(sums, p, gradient);
        turn.drift(sums, (inverse_masses, velocity), (q, p), kept);
    }
}

/// Compensated sums of all motions, if theirs are.
fn compensated<N, V, P, K, S>(motions: &[Motion<N, V, P, K, S>; SYSTEMS], q: &Vec<N>) -> Option<Compensated<N, Vec<N>>>
where
    N: Number,
    V: Coordinates<N>,
    S: Summation<N>,
{
    motions[0].at.state.is_compensated().then(|| {
        let each = motions.each_ref().map(|motion| motion.at.state.remainders());
        let mut sums = Compensated::of(q, &q[0].context());
        sums.set_remainders(&Remainders {
            q: side_by_side(|system| &each[system].q),
            p: side_by_side(|system| &each[system].p),
        });
        sums
    })
}

/// `None` where all masses are 1.
fn inverse_masses<N, V, P, K, S>(motions: &[Motion<N, V, P, K, S>; SYSTEMS]) -> Option<Vec<N>>
where
    N: Number,
    V: Coordinates<N>,
    K: Kinetic<N>,
{
    let each = motions.each_ref().map(|motion| motion.hamiltonian.kinetic.inverse_masses());
    if each.iter().all(|masses| matches!(masses, Some(InverseMasses::Ones))) {
        return None;
    }
    let q = motions[0].at.state.q.as_ref();
    let one = N::from_rational(&Rational::one(), &q[0].context());
    let of = |masses: &Option<InverseMasses<'_, N>>, i: usize| match masses {
        Some(InverseMasses::Of(inverse)) => inverse[i].clone(),
        _ => one.clone(),
    };
    Some((0..q.len()).flat_map(|i| each.each_ref().map(|masses| of(masses, i))).collect())
}

fn side_by_side<'a, N: Clone + 'a>(list: impl Fn(usize) -> &'a [N]) -> Vec<N> {
    (0..list(0).len()).flat_map(|i| from_fn::<_, SYSTEMS, _>(|system| list(system)[i].clone())).collect()
}

fn scatter<N: Number>(system: usize, all: &[N], own: &mut [N]) {
    own.iter_mut().zip(all.iter().skip(system).step_by(SYSTEMS)).for_each(|(own, all)| own.assign(all));
}
