//! What a splitting scheme advances: a system with its state, its kicks and its drifts.

use crate::number::Number;
use crate::systems::coordinates::Coordinates;
use crate::systems::increments::Carried;
use crate::systems::maps::{Flows, MapKind, MapSequence, PartOrder};
use crate::systems::state::State;
use crate::systems::summation::Summation;

/// A Hamiltonian system H = A + B with its state, where the flows of A (*drifts*) and of B (*kicks*) are known.
///
/// Mostly A = T(p) and B = U(q): [`Motion`](crate::Motion) is such a system, made of a kinetic energy and a potential.
/// A system with other flows implements this trait; then schemes, trajectories, energy drifts and the
/// [monitor](crate::shadow::ShadowEnergy) work on it.
///
/// Each flow is written once, for all that may be [carried](Carried) along: it changes q and p with the same bits
/// whatever that is.
pub trait System {
    /// The type of its numbers.
    type Number: Number;

    /// What is known of A and B: [`ManyParts`](crate::systems::many_parts::ManyParts) if H has three parts and more,
    /// [`Quadratic`](crate::systems::kinetic::Quadratic) if A = ½pᵀM⁻¹p + f(q) and B = U(q), else
    /// [`General`](crate::systems::kinetic::General). Schemes whose order holds for quadratic T only do not advance the
    /// latter. (Their order holds with any f, as the brackets that vanish do so by their degree in p.)
    type Class
    where
        Self: Sized;

    /// What holds its positions, and its momenta: arrays or vectors.
    type Coordinates: Coordinates<Self::Number>;

    /// How increments are added to q and p.
    type Summation: Summation<Self::Number>;

    /// The state.
    fn state(&self) -> &State<Self::Number, Self::Coordinates, Self::Summation>;

    /// The state, to be set: the system has to drop all that it keeps of it, such as a gradient.
    fn state_mut(&mut self) -> &mut State<Self::Number, Self::Coordinates, Self::Summation>;

    /// The increments of the state ← 0, with [`State::clear_increments`]; what is kept of the state stays.
    fn clear_increments(&mut self);

    /// The flow of B for the time `weight`: p ← p − weight·U_q(q) for B = U(q).
    fn kick(&mut self, weight: &Self::Number, carried: Carried);

    /// The flow of A for the time `weight`: q ← q + weight·T_p(p) for A = T(p). Another A may change p as well.
    fn drift(&mut self, weight: &Self::Number, carried: Carried);

    /// Whether there are [gradient kicks](System::gradient_kick). By default there are none.
    fn has_gradient_kicks(&self) -> bool {
        false
    }

    /// The gradient kick p ← p + weight·U_qq M⁻¹U_q of B = U(q) and A = ½pᵀM⁻¹p; its weight is 2h³ c.
    ///
    /// It is the flow of h³ c `[B,[A,B]]`: of the Hamiltonian −½U_qᵀM⁻¹U_q for the time `weight`. With v = M⁻¹U_q it
    /// adds −weight·vᵀ∂(qᵀU_q − 2U)/∂q to β.
    ///
    /// # Panics
    /// By default, as where [`has_gradient_kicks`](System::has_gradient_kicks) is false.
    fn gradient_kick(&mut self, weight: &Self::Number, carried: Carried) {
        let _ = (weight, carried);
        panic!("this system has no gradient kicks, which the scheme needs: see `System::gradient_kick`");
    }

    /// The flows of the middle parts H_2, …, H_(n−1) of H = H_1 + … + H_n for the time `weight`, one after the other;
    /// kicks are then the flow of H_1, and drifts that of H_n. See [`many_parts`](crate::systems::many_parts).
    ///
    /// # Panics
    /// By default, as H has two parts.
    fn middle_parts(&mut self, weight: &Self::Number, order: PartOrder, carried: Carried) {
        let _ = (weight, order, carried);
        panic!("this system has two parts, and the scheme is for three and more: see `System::middle_parts`");
    }

    /// A kick, drift or gradient kick.
    #[inline(always)]
    fn map(&mut self, kind: MapKind, weight: &Self::Number, carried: Carried) {
        match kind {
            MapKind::Kick => self.kick(weight, carried),
            MapKind::Drift => self.drift(weight, carried),
            MapKind::GradientKick => self.gradient_kick(weight, carried),
        }
    }

    /// `count` steps of several systems, with the bits that their kicks and drifts have one by one; increments are
    /// those of all these steps. [`Motion`](crate::Motion) does it in the widest instructions.
    fn advance(systems: &mut [Self], maps: &impl MapSequence<Self::Number>, count: u64, carried: Carried)
    where
        Self: Sized,
    {
        if carried.has_increments() {
            systems.iter_mut().for_each(Self::clear_increments);
        }
        maps.each(0..count, count, &mut Each { systems, carried });
    }

    /// `count` plain steps, with the bits that [`advance`](System::advance) gives, and the visitor sees the state after
    /// each. [`Motion`](crate::Motion) does it in less time than one by one.
    fn advance_visited(
        &mut self,
        maps: &impl MapSequence<Self::Number>,
        count: u64,
        visitor: &mut dyn Visitor<Self::Number>,
    ) where
        Self: Sized,
    {
        visit_each(self, maps, count, visitor);
    }

    /// energy ← H at another state q, p of the same system, or at the present one.
    fn assign_energy(&mut self, at: Option<Point<'_, Self::Number>>, energy: &mut Self::Number);

    /// kinetic ← T, there as well.
    ///
    /// The monitor compares the error of H with T: for an A that is not a kinetic energy, `kinetic` is any energy of
    /// the size of those exchanged in the motion.
    fn assign_kinetic_energy(&mut self, at: Option<Point<'_, Self::Number>>, kinetic: &mut Self::Number);

    /// How many of the first coordinates have an energy: by default all. Those after them are of particles of mass 0,
    /// which move in the field of the bodies with mass and whose momenta are divided by their mass; the modified energy
    /// does not contain them.
    fn massive_coordinates(&self) -> usize {
        self.state().q().len()
    }

    /// H at the present state.
    fn energy(&mut self) -> Self::Number {
        let mut energy = self.state().increments.beta.clone();
        self.assign_energy(None, &mut energy);
        energy
    }
}

/// Sees the states of steps that are made at once: see [`Stepper::steps_visited`](crate::Stepper::steps_visited).
pub trait Visitor<N> {
    /// Takes the next state: its positions and momenta.
    fn visit(&mut self, q: &[N], p: &[N]);

    /// Takes the next states, of each q and p, of `dimension` numbers each.
    fn visit_each(&mut self, states: &[N], dimension: usize) {
        for (q, p) in states.chunks_exact(2 * dimension).map(|state| state.split_at(dimension)) {
            self.visit(q, p);
        }
    }
}

/// Plain steps one by one, each of which the visitor sees.
#[inline(always)]
pub(crate) fn visit_each<M: System>(
    system: &mut M,
    maps: &impl MapSequence<M::Number>,
    count: u64,
    visitor: &mut dyn Visitor<M::Number>,
) {
    for step in 0..count {
        maps.each(step..step + 1, count, &mut Carrying { system, carried: Carried::Nothing });
        visitor.visit(system.state().q(), system.state().p());
    }
}

/// Positions and momenta.
pub(crate) type Point<'a, N> = (&'a [N], &'a [N]);

/// A system of any class: it has energies and a state, and only a stepper that is valid for it makes steps.
pub(crate) type AnySystem<'a, N, V, S> = dyn System<Number = N, Coordinates = V, Summation = S> + 'a;

/// The flows of a system, with what they carry along.
pub(crate) struct Carrying<'a, M: ?Sized> {
    pub(crate) system: &'a mut M,
    pub(crate) carried: Carried,
}

impl<M: System + ?Sized> Flows for Carrying<'_, M> {
    type Number = M::Number;

    #[inline(always)]
    fn map(&mut self, kind: MapKind, weight: &M::Number) {
        self.system.map(kind, weight, self.carried);
    }

    #[inline(always)]
    fn middle_parts(&mut self, weight: &M::Number, order: PartOrder) {
        self.system.middle_parts(weight, order, self.carried);
    }
}

/// The flows of several systems, each map for all of them.
pub(crate) struct Each<'a, M> {
    pub(crate) systems: &'a mut [M],
    pub(crate) carried: Carried,
}

impl<M: System> Flows for Each<'_, M> {
    type Number = M::Number;

    #[inline(always)]
    fn map(&mut self, kind: MapKind, weight: &M::Number) {
        for system in &mut *self.systems {
            system.map(kind, weight, self.carried);
        }
    }

    #[inline(always)]
    fn middle_parts(&mut self, weight: &M::Number, order: PartOrder) {
        for system in &mut *self.systems {
            system.middle_parts(weight, order, self.carried);
        }
    }
}
