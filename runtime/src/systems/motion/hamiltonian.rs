//! T(p) and U(q) with their scratch space, and their flows.

use super::gradient_kick_state::{GradientKickState, Parts};
use crate::number::Number;
use crate::number::partial_sums::add_sum;
use crate::systems::coordinates::Coordinates;
use crate::systems::gradient_kicks::Place;
use crate::systems::increments::Carried;
use crate::systems::kept::KeptForce;
use crate::systems::kinetic::Kinetic;
use crate::systems::maps::{Flows, MapKind, MapSequence, PartOrder, Repeated};
use crate::systems::potential::Potential;
use crate::systems::state::State;
use crate::systems::summation::Summation;

/// A state, and what is kept of the potential at its q.
#[derive(Clone, Debug)]
pub(super) struct Evaluated<N, V, S> {
    pub(super) state: State<N, V, S>,
    pub(super) gradient: V,
    /// qᵀU_q − 2U
    pub(super) rate: N,
    pub(super) kept: KeptForce,
}

/// A potential and a kinetic energy with their scratch space.
#[derive(Clone, Debug)]
pub(super) struct Hamiltonian<N, P, K> {
    pub(super) potential: P,
    pub(super) kinetic: K,
    /// The potential's, with what it keeps there.
    pub(super) scratch: Vec<N>,
    /// The kinetic energy's, with what it keeps there.
    pub(super) kinetic_scratch: Vec<N>,
    /// T of an energy.
    kinetic_energy: N,
    /// Of gradient kicks, once there was one; what it keeps belongs to the q of the last evaluation of the gradient.
    pub(super) gradient_kicks: Option<Box<GradientKickState<N>>>,
}

/// Flows are compiled for the instructions of the caller.
impl<N: Number, P: Potential<N>, K: Kinetic<N>> Hamiltonian<N, P, K> {
    pub(super) fn new(potential: P, kinetic: K, context: &N::Context) -> Self {
        let mut scratch = vec![N::zero(context); potential.scratch()];
        potential.prepare(&mut scratch, context);
        let mut kinetic_scratch = vec![N::zero(context); kinetic.scratch()];
        kinetic.prepare(&mut kinetic_scratch, context);
        let kinetic_energy = N::zero(context);
        Hamiltonian { potential, kinetic, scratch, kinetic_scratch, kinetic_energy, gradient_kicks: None }
    }

    /// Evaluates the gradient at the present q, with the rate where that is wanted.
    #[inline(always)]
    pub(super) fn evaluate<V: Coordinates<N>, S: Summation<N>>(
        &mut self,
        at: &mut Evaluated<N, V, S>,
        with_rate: bool,
    ) {
        let (q, gradient) = (at.state.q.as_ref(), at.gradient.as_mut());
        self.potential.update(q);
        let kept = if with_rate {
            self.potential.gradient_and_rate(q, gradient, &mut at.rate, &mut self.scratch);
            KeptForce::GradientAndRate
        } else {
            self.potential.gradient(q, gradient, &mut self.scratch);
            KeptForce::Gradient
        };
        self.keep(at, kept);
    }

    /// Takes what has been evaluated at the present q.
    #[inline(always)]
    pub(super) fn keep<V: Coordinates<N>, S: Summation<N>>(&mut self, at: &mut Evaluated<N, V, S>, kept: KeptForce) {
        at.kept = kept;
        at.state.count_evaluation();
        if let Some(gradient_kicks) = &mut self.gradient_kicks {
            gradient_kicks.kicks.kept = KeptForce::Nothing;
        }
    }

    #[inline(always)]
    pub(super) fn kick<V: Coordinates<N>, S: Summation<N>>(
        &mut self,
        at: &mut Evaluated<N, V, S>,
        weight: &N,
        carried: Carried,
    ) {
        at.state.settle();
        if carried.has_increments() {
            if at.kept != KeptForce::GradientAndRate {
                self.evaluate(at, true);
            }
            return at.state.kick_augmented(weight, at.gradient.as_ref(), &at.rate);
        }
        if at.kept == KeptForce::Nothing {
            self.evaluate(at, carried.has_rate());
        }
        at.state.kick(weight, at.gradient.as_ref());
    }

    /// A gradient kick, with its rate where that is wanted; the force is kept as the gradient is.
    #[inline]
    pub(super) fn gradient_kick<V: Coordinates<N>, S: Summation<N>>(
        &mut self,
        at: &mut Evaluated<N, V, S>,
        weight: &N,
        carried: Carried,
    ) {
        let with_rate = carried.has_rate();
        at.state.settle();
        let is_displaced =
            self.gradient_kicks.as_ref().is_some_and(|gradient_kicks| gradient_kicks.kicks.is_displaced());
        if at.kept == KeptForce::Nothing || is_displaced && !at.kept.suffices(with_rate) {
            self.evaluate(at, with_rate);
        }
        let Hamiltonian { potential, kinetic, scratch, kinetic_scratch, gradient_kicks, .. } = self;
        let kicks =
            gradient_kicks.get_or_insert_with(|| Box::new(GradientKickState::new(potential, &weight.context())));
        let place = Place { q: at.state.q.as_ref(), gradient: at.gradient.as_ref(), rate: &at.rate };
        let before = kicks.kicks.evaluations;
        kicks.evaluate(Parts { potential, kinetic, scratch, kinetic_scratch }, place, weight, with_rate);
        let kicks = &kicks.kicks;
        if is_displaced {
            at.state.evaluations += kicks.evaluations - before;
        }
        match carried.has_increments() {
            true => at.state.kick_augmented(weight, &kicks.force, &kicks.rate),
            false => at.state.kick(weight, &kicks.force),
        }
    }

    #[inline(always)]
    pub(super) fn drift<V: Coordinates<N>, S: Summation<N>>(
        &mut self,
        at: &mut Evaluated<N, V, S>,
        weight: &N,
        carried: Carried,
    ) {
        at.state.settle();
        match carried.has_increments() {
            true => at.state.drift_augmented(&self.kinetic, weight, &mut self.kinetic_scratch),
            false => at.state.drift(&self.kinetic, weight, &mut self.kinetic_scratch),
        }
        at.kept = KeptForce::Nothing;
    }

    /// energy ← T(p) + U(q)
    pub(super) fn assign_energy(&mut self, (q, p): (&[N], &[N]), energy: &mut N) {
        self.potential.update(q);
        self.potential.energy(q, energy, &mut self.scratch);
        self.add_kinetic_energy((q, p), energy);
    }

    /// Of an energy U(q), energy ← T(p) + U(q); NaN where U is finite though squares of positions overflow: an infinite
    /// r² makes 0 of 1/r.
    #[inline(always)]
    pub(super) fn add_kinetic_energy(&mut self, (q, p): (&[N], &[N]), energy: &mut N) {
        self.kinetic.energy(p, &mut self.kinetic_energy, &mut self.kinetic_scratch);
        energy.add(&self.kinetic_energy);
        let q = &q[..self.kinetic.massive_coordinates(q.len())];
        if N::KEEPS_INCREMENTS {
            let mut squares = N::zero(&energy.context());
            add_sum(&mut squares, [q], |[position], squares| squares.add_product(position, position));
            // 0, or NaN
            let mut overflows = squares.clone();
            overflows.subtract(&squares);
            energy.make_nan_where_square_overflows(&overflows);
        } else {
            q.iter().for_each(|position| energy.make_nan_where_square_overflows(position));
        }
    }

    /// `count` plain steps. A state in arrays is copied, so that the compiler can hold it in registers.
    #[inline(always)]
    pub(super) fn advance<V: Coordinates<N>, S: Summation<N>>(
        &mut self,
        at: &mut Evaluated<N, V, S>,
        maps: &impl MapSequence<N>,
        count: u64,
    ) {
        // one of both is compiled
        if const { std::mem::needs_drop::<Evaluated<N, V, S>>() } {
            return maps.each(0..count, count, &mut PlainFlows { hamiltonian: self, at });
        }
        let mut copy = at.clone();
        maps.each(0..count, count, &mut PlainFlows { hamiltonian: self, at: &mut copy });
        *at = copy;
    }
}

/// The flows of plain steps.
struct PlainFlows<'a, N, V, P, K, S> {
    hamiltonian: &'a mut Hamiltonian<N, P, K>,
    at: &'a mut Evaluated<N, V, S>,
}

impl<N: Number, V: Coordinates<N>, P: Potential<N>, K: Kinetic<N>, S: Summation<N>> Flows
    for PlainFlows<'_, N, V, P, K, S>
{
    type Number = N;

    #[inline(always)]
    fn kick(&mut self, weight: &N) {
        self.hamiltonian.kick(self.at, weight, Carried::Nothing);
    }

    #[inline(always)]
    fn drift(&mut self, weight: &N) {
        self.hamiltonian.drift(self.at, weight, Carried::Nothing);
    }

    #[inline(always)]
    fn gradient_kick(&mut self, weight: &N) {
        self.hamiltonian.gradient_kick(self.at, weight, Carried::Nothing);
    }

    fn middle_parts(&mut self, _: &N, _: PartOrder) {
        unreachable!("H has two parts")
    }
}

/// The maps of the first, of each middle and of the last of `count` steps; `None` unless a step has kicks and drifts
/// and nothing else.
pub(super) fn kicks_and_drifts<N: Number>(maps: &impl MapSequence<N>, count: u64) -> Option<[Repeated<N>; 3]> {
    let mut has_others = false;
    let mut list = |step: u64| {
        let mut list = List { maps: Vec::new(), has_others: false };
        maps.each(step..step + 1, count, &mut list);
        has_others |= list.has_others;
        list.maps
    };
    let lists = [(list(0), 1), (list(1), count - 2), (list(count - 1), 1)];
    let middle = &lists[1].0;
    let has = |wanted| middle.iter().any(|(kind, _)| *kind == wanted);
    (!has_others && has(MapKind::Kick) && has(MapKind::Drift)).then_some(lists)
}

/// Lists kicks and drifts in place of making them.
struct List<N> {
    maps: Vec<(MapKind, N)>,
    has_others: bool,
}

impl<N: Number> Flows for List<N> {
    type Number = N;

    fn kick(&mut self, weight: &N) {
        self.maps.push((MapKind::Kick, weight.clone()));
    }

    fn drift(&mut self, weight: &N) {
        self.maps.push((MapKind::Drift, weight.clone()));
    }

    fn gradient_kick(&mut self, _: &N) {
        self.has_others = true;
    }

    fn middle_parts(&mut self, _: &N, _: PartOrder) {
        self.has_others = true;
    }
}
