//! What a splitting scheme advances: a system with its state, its kicks and its drifts.

use crate::coordinates::Coordinates;
use crate::maps::{MapKind, MapSequence, PartOrder};
use crate::number::Number;

/// A Hamiltonian system H = A + B with its state q, p and β, where the flows of A (*drifts*) and of B (*kicks*) are known.
///
/// Mostly A = T(p) and B = U(q): [`Motion`](crate::Motion) is such a system, made of a kinetic energy and a potential. A system
/// with a storage of its own, or with other flows, implements this trait; then schemes, trajectories, energy drifts and the
/// [monitor](crate::shadow::ShadowEnergy) work on it.
///
/// Along each flow β grows by the integral of qᵀH_q + pᵀH_p − 2H, H being A or B (Moan & Niesen, eq. 2, whose printed sign is
/// wrong): by weight·(qᵀU_q − 2U) in a kick, and by weight·(pᵀT_p − 2T) in a drift, which is 0 for quadratic T.
pub trait System {
    /// The type of its numbers.
    type Number: Number;

    /// What is known of A and B: [`ManyParts`](crate::many_parts::ManyParts) if H has three parts and more, [`Quadratic`](crate::kinetic::Quadratic) if A = ½pᵀM⁻¹p + f(q) and B = U(q), else
    /// [`General`](crate::kinetic::General). Schemes whose order holds for quadratic T only do not advance the latter. (Their order holds with any f, as
    /// the brackets that vanish do so by their degree in p.)
    type Class;

    /// Positions.
    fn q(&self) -> &[Self::Number];

    /// Momenta, as many as positions.
    fn p(&self) -> &[Self::Number];

    /// What the last augmented step added to q, p and β.
    fn increments(&self) -> Increments<'_, Self::Number>;

    /// Sets q and p. Where the state is changed in another way, the system has to drop all that it keeps of it, such as a
    /// gradient.
    fn set_state(&mut self, q: &[Self::Number], p: &[Self::Number]);

    /// What the state has beyond q and p, such as the remainders of [compensated sums](crate::summation): the state is q and p with
    /// these. By default there is nothing.
    fn remainders(&self) -> Remainders<Self::Number> {
        Remainders::default()
    }

    /// Sets them, after [`set_state`](System::set_state), which sets them to 0. The default does nothing.
    fn set_remainders(&mut self, remainders: &Remainders<Self::Number>) {
        let _ = remainders;
    }

    /// Whether the round-off of a kick or drift is ε times its increment, as of compensated sums, in place of ε times q and p. By default it
    /// is not.
    fn is_compensated(&self) -> bool {
        false
    }

    /// The flow of B for the time `weight`: p ← p − weight·U_q(q) for B = U(q).
    fn kick(&mut self, weight: &Self::Number);

    /// The kick with the same bits of q and p, and its part of the [increments](System::increments).
    fn kick_augmented(&mut self, weight: &Self::Number);

    /// The flow of A for the time `weight`: q ← q + weight·T_p(p) for A = T(p). Another A may change p as well.
    fn drift(&mut self, weight: &Self::Number);

    /// The drift with the same bits of q and p, and its part of the [increments](System::increments).
    fn drift_augmented(&mut self, weight: &Self::Number);

    /// Whether there are [gradient kicks](System::gradient_kick). By default there are none.
    fn has_gradient_kicks(&self) -> bool {
        false
    }

    /// The gradient kick p ← p + weight·U_qq M⁻¹U_q of B = U(q) and A = ½pᵀM⁻¹p; its weight is 2h³ c.
    ///
    /// It is the flow of h³ c `[B,[A,B]]`: of the Hamiltonian −½U_qᵀM⁻¹U_q for the time `weight`.
    ///
    /// # Panics
    /// By default, as where [`has_gradient_kicks`](System::has_gradient_kicks) is false.
    fn gradient_kick(&mut self, weight: &Self::Number) {
        let _ = weight;
        panic!("this system has no gradient kicks, which the scheme needs: see `System::gradient_kick`");
    }

    /// The gradient kick with the same bits of p, and its part of the [increments](System::increments): it adds
    /// −weight·vᵀ∂(qᵀU_q − 2U)/∂q with v = M⁻¹U_q to β.
    ///
    /// # Panics
    /// As [`gradient_kick`](System::gradient_kick).
    fn gradient_kick_augmented(&mut self, weight: &Self::Number) {
        self.gradient_kick(weight);
    }

    /// The flows of the middle parts H_2, …, H_(n−1) of H = H_1 + … + H_n for the time `weight`, one after the other; kicks are then the flow of
    /// H_1, and drifts that of H_n. See [`many_parts`](crate::many_parts).
    ///
    /// # Panics
    /// By default, as H has two parts.
    fn middle_parts(&mut self, weight: &Self::Number, order: PartOrder) {
        let _ = (weight, order);
        panic!("this system has two parts, and the scheme is for three and more: see `System::middle_parts`");
    }

    /// The same with the same bits of q and p, and its part of the [increments](System::increments).
    ///
    /// # Panics
    /// As [`middle_parts`](System::middle_parts).
    fn middle_parts_augmented(&mut self, weight: &Self::Number, order: PartOrder) {
        self.middle_parts(weight, order);
    }

    /// `count` steps of several systems, with the bits that their kicks and drifts have one by one: what
    /// [`Stepper::steps`](crate::Stepper::steps) and [`Stepper::merged_steps`](crate::Stepper::merged_steps) do.
    /// [`Motion`](crate::Motion) does it in the widest instructions.
    fn advance(systems: &mut [Self], maps: &impl MapSequence<Self::Number>, count: u64)
    where
        Self: Sized,
    {
        maps.each(0..count, count, |kind, weight, between| {
            match kind {
                MapKind::Kick => systems.iter_mut().for_each(|system| system.kick(weight)),
                MapKind::Drift => systems.iter_mut().for_each(|system| system.drift(weight)),
                MapKind::GradientKick => systems.iter_mut().for_each(|system| system.gradient_kick(weight)),
            }
            if let Some(weight) = between {
                systems.iter_mut().for_each(|system| system.middle_parts(weight, PartOrder::after(kind)));
            }
        });
    }

    /// One step of several systems with its [increments](System::increments), with the bits that their kicks and drifts have one by one: what
    /// [`Stepper::step_each_augmented`](crate::Stepper::step_each_augmented) does. [`Motion`](crate::Motion) does it in the widest
    /// instructions.
    fn advance_augmented(systems: &mut [Self], maps: &impl MapSequence<Self::Number>)
    where
        Self: Sized,
    {
        for system in systems {
            system.clear_increments();
            maps.each(0..1, 1, |kind, weight, between| {
                match kind {
                    MapKind::Kick => system.kick_augmented(weight),
                    MapKind::Drift => system.drift_augmented(weight),
                    MapKind::GradientKick => system.gradient_kick_augmented(weight),
                }
                if let Some(weight) = between {
                    system.middle_parts_augmented(weight, PartOrder::after(kind));
                }
            });
        }
    }

    /// Sets the increments to 0: an augmented step begins with it, so that β keeps its digits in long runs.
    fn clear_increments(&mut self);

    /// energy ← H, and kinetic ← T, at the present state.
    ///
    /// The monitor compares the error of H with T: for an A that is not a kinetic energy, `kinetic` is any energy of the size of
    /// those exchanged in the motion.
    fn assign_energies(&mut self, energy: &mut Self::Number, kinetic: &mut Self::Number);

    /// energy ← H, and kinetic ← T, at another state of the same system.
    fn assign_energies_at(
        &mut self,
        q: &[Self::Number],
        p: &[Self::Number],
        energy: &mut Self::Number,
        kinetic: &mut Self::Number,
    );

    /// How often the forces have been evaluated so far; the monitor counts the stages of a step by it.
    fn evaluations(&self) -> u64;

    /// Announces whether the next augmented step follows the next plain step: what that evaluates last, such as the rate
    /// qᵀU_q − 2U beside the gradient, can then be kept. The default does nothing.
    fn before_augmented_step(&mut self, follows: bool) {
        let _ = follows;
    }

    /// H at the present state.
    fn energy(&mut self) -> Self::Number {
        let [mut energy, mut kinetic] = [self.increments().beta.clone(), self.increments().beta.clone()];
        self.assign_energies(&mut energy, &mut kinetic);
        energy
    }

    /// H at another state of the same system.
    fn energy_at(&mut self, q: &[Self::Number], p: &[Self::Number]) -> Self::Number {
        let [mut energy, mut kinetic] = [self.increments().beta.clone(), self.increments().beta.clone()];
        self.assign_energies_at(q, p, &mut energy, &mut kinetic);
        energy
    }

    /// The context of the numbers.
    fn context(&self) -> <Self::Number as Number>::Context {
        self.increments().beta.context()
    }
}

/// What a state has beyond q and p: numbers of the size of their last places, or nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Remainders<N> {
    /// Beyond q: as many, or none.
    pub q: Vec<N>,
    /// Beyond p, likewise.
    pub p: Vec<N>,
}

impl<N> Default for Remainders<N> {
    fn default() -> Self {
        Remainders { q: Vec::new(), p: Vec::new() }
    }
}

/// What a step added to q, p and β, borrowed from the system that made it or from a [copy](OwnedIncrements).
///
/// For a number type that does not [keep increments](Number::KEEPS_INCREMENTS), q and p are empty.
#[derive(Debug)]
pub struct Increments<'a, N> {
    /// To q: the sum of what its flows added, without the round-off of q itself. For an exact flow it must be computed without
    /// cancellation, not as a difference of states.
    pub q: &'a [N],
    /// To p, likewise.
    pub p: &'a [N],
    /// To β.
    pub beta: &'a N,
}

// derived, it would ask for numbers that are `Copy`
impl<N> Copy for Increments<'_, N> {}

impl<N> Clone for Increments<'_, N> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<'a, N: Number> Increments<'a, N> {
    /// The increment of β alone, for states whose increments of q and p are unknown.
    pub fn of_beta(beta: &'a N) -> Self {
        Increments { q: &[], p: &[], beta }
    }

    /// Whether those of q and p are known.
    pub fn has_vectors(&self) -> bool {
        !self.q.is_empty()
    }

    /// A copy.
    pub fn to_owned(&self) -> OwnedIncrements<N> {
        OwnedIncrements { q: self.q.to_vec(), p: self.p.to_vec(), beta: self.beta.clone() }
    }
}

/// What a step added to q, p and β, with a place for each: in arrays or vectors, like the coordinates of the state.
#[derive(Clone, Debug)]
pub struct OwnedIncrements<N, V = Vec<N>> {
    /// To q.
    pub q: V,
    /// To p.
    pub p: V,
    /// To β.
    pub beta: N,
}

impl<N: Number> OwnedIncrements<N> {
    /// Zeros for states of `dimension` coordinates, as many as the number type keeps.
    pub fn zero(dimension: usize, context: &N::Context) -> Self {
        let kept = if N::KEEPS_INCREMENTS { dimension } else { 0 };
        let zeros = || vec![N::zero(context); kept];
        OwnedIncrements { q: zeros(), p: zeros(), beta: N::zero(context) }
    }

    /// The increment of β alone, for states whose increments of q and p are unknown.
    pub fn of_beta(beta: N) -> Self {
        OwnedIncrements { q: Vec::new(), p: Vec::new(), beta }
    }

    pub(crate) fn assign(&mut self, other: Increments<'_, N>) {
        for (own, other) in [(&mut self.q, other.q), (&mut self.p, other.p)] {
            own.truncate(other.len());
            let known = own.len();
            own.iter_mut().zip(other).for_each(|(own, other)| own.assign(other));
            own.extend_from_slice(&other[known..]);
        }
        self.beta.assign(other.beta);
    }

    /// Adds other increments; those of q and p that are known in one of the two only are dropped.
    pub(crate) fn add(&mut self, other: Increments<'_, N>) {
        for (own, other) in [(&mut self.q, other.q), (&mut self.p, other.p)] {
            own.truncate(other.len());
            own.iter_mut().zip(other).for_each(|(own, other)| own.add(other));
        }
        self.beta.add(other.beta);
    }
}

impl<N: Number, V: Coordinates<N>> OwnedIncrements<N, V> {
    /// The increments, borrowed.
    #[inline]
    pub fn view(&self) -> Increments<'_, N> {
        Increments { q: self.q.as_ref(), p: self.p.as_ref(), beta: &self.beta }
    }

    /// All increments ← 0.
    #[inline]
    pub fn assign_zero(&mut self) {
        self.each(N::assign_zero);
    }

    pub(crate) fn negate(&mut self) {
        self.each(N::negate);
    }

    #[inline]
    fn each(&mut self, change: impl Fn(&mut N)) {
        self.q.as_mut().iter_mut().for_each(&change);
        self.p.as_mut().iter_mut().for_each(&change);
        change(&mut self.beta);
    }
}
