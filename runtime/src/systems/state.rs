//! The state of a system: q and p with the sums by which they change, and what the last augmented step added.

use crate::number::Number;
use crate::number::instructions;
use crate::systems::coordinates::Coordinates;
use crate::systems::increments::{Carried, Increments, OwnedIncrements};
use crate::systems::kinetic::Kinetic;
use crate::systems::summation::{Compensated, Half, Plain, Remainders, Summation};

/// q and p, [how increments are added](crate::systems::summation) to them, the [increments](Increments) of the last
/// augmented step, and the number of evaluations of the gradient.
///
/// A [`System`](crate::System) has one, and its flows change q and p by the methods of it: these add what is carried
/// along to the increments.
#[derive(Clone, Debug)]
pub struct State<N, V = Vec<N>, S = Plain> {
    pub(crate) q: V,
    pub(crate) p: V,
    pub(crate) sums: S,
    /// Those of q and p only if the numbers keep them.
    pub(crate) increments: OwnedIncrements<N, V>,
    pub(crate) evaluations: u64,
}

impl<N: Number, V: Coordinates<N>> State<N, V> {
    /// The state q, p, with plain sums.
    pub fn new(q: V, p: V, context: &N::Context) -> Self {
        let mut increments = OwnedIncrements { q: q.clone(), p: p.clone(), beta: N::zero(context) };
        increments.assign_zero();
        State { q, p, sums: Plain, increments, evaluations: 0 }
    }
}

/// A state in vectors, whose sums are plain or compensated.
pub type VectorState<N> = State<N, Vec<N>, Option<Compensated<N, Vec<N>>>>;

impl<N: Number, V: Coordinates<N>, S: Summation<N>> State<N, V, S> {
    /// The same state with [compensated sums](Compensated).
    pub fn compensated(self) -> State<N, V, Compensated<N, V>> {
        let sums = Compensated::of(&self.q, &self.context());
        self.with_sums(sums)
    }

    /// The same state with compensated sums if `compensated` is true, else with plain ones: for a choice at run time.
    pub fn compensated_if(self, compensated: bool) -> State<N, V, Option<Compensated<N, V>>> {
        let sums = compensated.then(|| Compensated::of(&self.q, &self.context()));
        self.with_sums(sums)
    }

    /// The same state with other sums.
    pub(crate) fn with_sums<T>(self, sums: T) -> State<N, V, T> {
        let State { q, p, increments, evaluations, .. } = self;
        State { q, p, sums, increments, evaluations }
    }

    /// Positions.
    #[inline(always)]
    pub fn q(&self) -> &[N] {
        self.q.as_ref()
    }

    /// Momenta.
    #[inline(always)]
    pub fn p(&self) -> &[N] {
        self.p.as_ref()
    }

    /// What the last augmented step added to q, p and β.
    #[inline]
    pub fn increments(&self) -> Increments<'_, N> {
        if N::KEEPS_INCREMENTS { self.increments.view() } else { Increments::of_beta(&self.increments.beta) }
    }

    /// The number of evaluations of the gradient so far.
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// The context of the numbers.
    pub fn context(&self) -> N::Context {
        self.increments.beta.context()
    }

    /// Whether every q, p and β is a finite number.
    pub fn is_finite(&self) -> bool {
        self.increments.beta.is_finite() && self.q().iter().chain(self.p()).all(N::is_finite)
    }

    /// What the state has beyond q and p, such as the remainders of [compensated sums](crate::systems::summation): the
    /// state is q and p with these.
    pub fn remainders(&self) -> Remainders<N> {
        self.sums.remainders(self.q(), self.p())
    }

    /// Whether the round-off of a kick or drift is ε times its increment, as with compensated sums, in place of ε times
    /// q and p.
    pub fn is_compensated(&self) -> bool {
        self.sums.is_compensated()
    }

    /// Positions, to be changed; the remainders of their sums are dropped.
    pub fn q_mut(&mut self) -> &mut [N] {
        self.sums.forget_positions();
        self.q.as_mut()
    }

    /// Momenta, to be changed; the remainders of their sums are dropped.
    pub fn p_mut(&mut self) -> &mut [N] {
        self.sums.forget_momenta();
        self.p.as_mut()
    }

    /// Sets q and p, without remainders.
    pub fn set(&mut self, q: &[N], p: &[N]) {
        self.q_mut().iter_mut().zip(q).for_each(|(own, q)| own.assign(q));
        self.p_mut().iter_mut().zip(p).for_each(|(own, p)| own.assign(p));
        self.settle();
    }

    /// Sets the remainders, after q and p.
    pub fn set_remainders(&mut self, remainders: &Remainders<N>) {
        self.sums.set_remainders(remainders);
    }

    /// Rounds q and p, where they were set, to numbers that the sums can keep: before a gradient is evaluated there.
    #[inline(always)]
    pub(crate) fn settle(&mut self) {
        self.sums.settle(self.q.as_mut(), self.p.as_mut());
    }

    /// Increments ← 0: an augmented step begins with it, so that β keeps its digits in long runs.
    #[inline]
    pub fn clear_increments(&mut self) {
        if N::KEEPS_INCREMENTS {
            self.increments.assign_zero();
        } else {
            self.increments.beta.assign_zero();
        }
    }

    /// Counts an evaluation of the gradient.
    #[inline(always)]
    pub fn count_evaluation(&mut self) {
        self.evaluations += 1;
    }

    /// p ← p − weight·force and, if increments are carried along, those of p and β, by weight·rate, with it.
    #[inline(always)]
    pub(crate) fn kick(&mut self, weight: &N, force: &[N], rate: &N, carried: Carried) {
        let State { p, sums, increments, .. } = self;
        if !carried.has_increments() {
            return sums.kick(weight, force, p.as_mut());
        }
        increments.beta.add_product(weight, rate);
        instructions::widest_if_long(
            N::IN_VECTORS,
            p.as_ref().len(),
            #[inline(always)]
            || {
                sums.kick(weight, force, p.as_mut());
                if N::KEEPS_INCREMENTS {
                    for (increment, force) in increments.p.as_mut().iter_mut().zip(force) {
                        increment.subtract_product(weight, force);
                    }
                }
            },
        );
    }

    /// q ← q + weight·T_p(p) and, if increments are carried along, those of q and β with it.
    #[inline(always)]
    pub fn drift<K: Kinetic<N>>(&mut self, kinetic: &K, weight: &N, scratch: &mut [N], carried: Carried) {
        let State { q, p, sums, increments, .. } = self;
        if !carried.has_increments() {
            return sums.drift(kinetic, weight, p.as_ref(), q.as_mut(), scratch);
        }
        instructions::widest_if_long(
            N::IN_VECTORS,
            p.as_ref().len(),
            #[inline(always)]
            || {
                let added = (increments.q.as_mut(), &mut increments.beta);
                sums.drift_augmented(kinetic, weight, p.as_ref(), q.as_mut(), added, scratch);
            },
        );
    }

    /// Changes a coordinate or a momentum, and its increment if these are carried along; `add` adds to a number what
    /// the flow adds.
    #[inline]
    pub fn change(&mut self, half: Half, index: usize, carried: Carried, add: impl Fn(&mut N)) {
        let State { q, p, sums, increments, .. } = self;
        let (own, increments) = match half {
            Half::Positions => (q.as_mut(), increments.q.as_mut()),
            Half::Momenta => (p.as_mut(), increments.p.as_mut()),
        };
        sums.change(half, index, &mut own[index], &add);
        if N::KEEPS_INCREMENTS && carried.has_increments() {
            add(&mut increments[index]);
        }
    }

    /// β ← β + ab, if increments are carried along.
    #[inline]
    pub fn add_to_beta(&mut self, carried: Carried, a: &N, b: &N) {
        if carried.has_increments() {
            self.increments.beta.add_product(a, b);
        }
    }
}

/// A state that a system leaves and comes back to, to the last bit.
pub(crate) struct Saved<N> {
    q: Vec<N>,
    p: Vec<N>,
    remainders: Remainders<N>,
}

impl<N: Number> Saved<N> {
    pub(crate) fn of<V: Coordinates<N>, S: Summation<N>>(state: &State<N, V, S>) -> Self {
        Saved { q: state.q().to_vec(), p: state.p().to_vec(), remainders: state.remainders() }
    }

    pub(crate) fn restore<V: Coordinates<N>, S: Summation<N>>(&self, state: &mut State<N, V, S>) {
        state.set(&self.q, &self.p);
        state.set_remainders(&self.remainders);
    }
}
