//! T(p) and U(q) with their scratch space, and their flows.

use crate::Rational;
use crate::number::Number;
use crate::number::partial_sums::add_sum;
use crate::systems::coordinates::Coordinates;
use crate::systems::displaced::Displacements;
use crate::systems::evaluated::Evaluated;
use crate::systems::gradient_kicks::{GradientKicks, PartOfKicks, Place, are_displaced};
use crate::systems::increments::Carried;
use crate::systems::kept::KeptForce;
use crate::systems::kinetic::Kinetic;
use crate::systems::maps::{Flows, MapKind, MapSequence, PartOrder, Repeated};
use crate::systems::potential::{Potential, Prepared};
use crate::systems::summation::Summation;

/// A potential and a kinetic energy with their scratch space.
#[derive(Clone, Debug)]
pub(crate) struct Hamiltonian<N, P, K> {
    pub(super) potential: Prepared<N, P>,
    pub(super) kinetic: K,
    /// The kinetic energy's, with what it keeps there.
    pub(super) kinetic_scratch: Vec<N>,
    /// T of an energy.
    kinetic_energy: N,
    pub(super) gradient_kicks: Option<Box<GradientKicks<N>>>,
    /// 1 and −1.
    one: [N; 2],
    /// 0, where T_p is b; empty if there is none.
    origin: Vec<N>,
}

impl<N: Number, P: Potential<N>, K: Kinetic<N>> PartOfKicks<N> for Hamiltonian<N, P, K> {
    #[inline(always)]
    fn gradient(&mut self, q: &[N], gradient: &mut [N], rate: Option<&mut N>) {
        self.potential.gradient(q, gradient, rate);
    }

    /// The drift of a quadratic T moves by M⁻¹ times a vector, and by b.
    fn assign_velocity(&mut self, gradient: &[N], velocity: &mut [N]) {
        let Hamiltonian { kinetic, kinetic_scratch, one: [one, minus], origin, .. } = self;
        velocity.iter_mut().for_each(N::assign_zero);
        kinetic.drift(one, gradient, velocity, kinetic_scratch);
        if kinetic.has_linear_terms() {
            kinetic.drift(minus, origin, velocity, kinetic_scratch);
        }
    }

    fn hessian_product(&mut self, at: Place<'_, N>, v: &[N], product: &mut [N], rate: Option<&mut N>) {
        self.potential.hessian_product(at.q, v, product, rate);
    }

    #[inline(always)]
    fn gradient_kicks(&mut self) -> &mut Option<Box<GradientKicks<N>>> {
        &mut self.gradient_kicks
    }
}

/// Flows are compiled for the instructions of the caller.
impl<N: Number, P: Potential<N>, K: Kinetic<N>> Hamiltonian<N, P, K> {
    pub(crate) fn new(potential: P, kinetic: K, context: &N::Context) -> Self {
        let zeros = |count| vec![N::zero(context); count];
        let mut kinetic_scratch = zeros(kinetic.scratch());
        kinetic.prepare(&mut kinetic_scratch, context);
        Hamiltonian {
            kinetic_scratch,
            kinetic_energy: N::zero(context),
            gradient_kicks: None,
            one: [1, -1].map(|one| N::from_rational(&Rational::from_integer(one.into()), context)),
            origin: zeros(if kinetic.has_linear_terms() { potential.dimension() } else { 0 }),
            potential: Prepared::new(potential, context),
            kinetic,
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
        at.state.drift(&self.kinetic, weight, &mut self.kinetic_scratch, carried);
        at.kept = KeptForce::Nothing;
    }

    /// Makes gradient kicks by displaced forces.
    pub(crate) fn displace_forces(&mut self, displacements: Displacements<N>) {
        let (dimension, context) = (self.potential.function.dimension(), self.kinetic_energy.context());
        self.gradient_kicks = Some(Box::new(GradientKicks::new(dimension, Some(displacements), &context)));
    }

    pub(crate) fn has_gradient_kicks(&self) -> bool {
        are_displaced(self.gradient_kicks.as_deref()) || self.potential.function.hessian().is_some()
    }

    /// kinetic ← T(p), as the monitor compares it with the error of H
    pub(crate) fn assign_kinetic_energy(&mut self, p: &[N], kinetic: &mut N) {
        self.kinetic.energy(p, kinetic, &mut self.kinetic_scratch);
        self.kinetic.exchanged_energy(p, kinetic, &mut self.kinetic_scratch);
    }

    /// energy ← T(p) + U(q)
    pub(crate) fn assign_energy(&mut self, (q, p): (&[N], &[N]), energy: &mut N) {
        self.potential.energy(q, energy);
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
    fn map(&mut self, kind: MapKind, weight: &N) {
        match kind {
            MapKind::Kick => self.at.kick(self.hamiltonian, weight, Carried::Nothing),
            MapKind::Drift => self.hamiltonian.drift(self.at, weight, Carried::Nothing),
            MapKind::GradientKick => self.at.gradient_kick(self.hamiltonian, weight, Carried::Nothing),
        }
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

    fn map(&mut self, kind: MapKind, weight: &N) {
        match kind {
            MapKind::GradientKick => self.has_others = true,
            _ => self.maps.push((kind, weight.clone())),
        }
    }

    fn middle_parts(&mut self, _: &N, _: PartOrder) {
        self.has_others = true;
    }
}
