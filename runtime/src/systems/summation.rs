//! How a motion adds the increments of kicks and drifts to its coordinates: plainly, compensated, or in fixed point.
//!
//! A run of n steps adds n increments of the size h to coordinates of the size 1. In `f64` each sum is rounded by ε
//! times the coordinate, ε = 2⁻⁵³, so that most of the round-off of a run comes from the sums, not from the forces.
//!
//! | | q and p | round-off of a kick or drift | made by |
//! | --- | --- | --- | --- |
//! | [`Plain`] | rounded after each sum | ε times the coordinate | [`Motion::new`](crate::Motion::new) |
//! | [`Compensated`] | with the remainder of each sum | ε times the increment | [`Motion::compensated`](crate::Motion::compensated) |
//! | [`FixedPoint`] | multiples of a power of two | that, or ε times the increment | [`fixed_point`](crate::Motion::fixed_point) |

mod compensated;
mod fixed_point;

pub use compensated::Compensated;
pub use fixed_point::{FixedPoint, InDouble, RangeError};

use std::mem::needs_drop;

use crate::number::Number;
use crate::systems::coordinates::for_each_two;
use crate::systems::kinetic::Kinetic;

/// How increments are added to q and p.
///
/// `Option<S>` adds plainly if it is `None`: for a choice at run time.
pub trait Summation<N: Number>: Clone {
    /// p ← p − weight·gradient
    fn kick(&mut self, weight: &N, gradient: &[N], p: &mut [N]);

    /// q ← q + weight·T_p(p)
    fn drift<K: Kinetic<N>>(&mut self, kinetic: &K, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]);

    /// The drift, with the same bits of q; what it adds to q, where the numbers
    /// [keep increments](Number::KEEPS_INCREMENTS), and to β is added to the increments.
    fn drift_augmented<K: Kinetic<N>>(
        &mut self,
        kinetic: &K,
        weight: &N,
        p: &[N],
        q: &mut [N],
        increments: (&mut [N], &mut N),
        scratch: &mut [N],
    );

    /// x ← x + δ of one coordinate or momentum x; `add` adds δ to a number.
    fn change(&mut self, half: Half, index: usize, x: &mut N, add: impl Fn(&mut N));

    /// q was set: what was kept of it is dropped. The default does nothing.
    fn forget_positions(&mut self) {}

    /// p was set: what was kept of it is dropped. The default does nothing.
    fn forget_momenta(&mut self) {}

    /// Rounds q and p, where they were set, to numbers that can be kept. The default does nothing.
    fn settle(&mut self, q: &mut [N], p: &mut [N]) {
        let _ = (q, p);
    }

    /// What is kept beyond q and p; by default nothing.
    fn remainders(&self, q: &[N], p: &[N]) -> Remainders<N> {
        let _ = (q, p);
        Remainders::default()
    }

    /// Sets what is kept beyond q and p. The default does nothing.
    fn set_remainders(&mut self, remainders: &Remainders<N>) {
        let _ = remainders;
    }

    /// Whether round-off is ε times the increments, not ε times q and p.
    fn is_compensated(&self) -> bool {
        false
    }

    /// Whether increments are added as by [`Plain`]; by default they are not.
    fn is_plain(&self) -> bool {
        false
    }
}

/// What a state has beyond q and p: numbers of the size of their last places, or nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Remainders<N> {
    /// Beyond q: one for each coordinate, or none.
    pub q: Vec<N>,
    /// Beyond p: one for each momentum, or none.
    pub p: Vec<N>,
}

impl<N> Default for Remainders<N> {
    fn default() -> Self {
        Remainders { q: Vec::new(), p: Vec::new() }
    }
}

/// The two halves of a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Half {
    /// q
    Positions,
    /// p
    Momenta,
}

/// Increments are added to q and p, and the sums are rounded.
#[derive(Clone, Copy, Debug, Default)]
pub struct Plain;

impl<N: Number> Summation<N> for Plain {
    #[inline(always)]
    fn kick(&mut self, weight: &N, gradient: &[N], p: &mut [N]) {
        // a copy, as for all that the compiler knows the reference may be to a coordinate that is written; with two
        // coordinates it made steps from tables slower
        let copy = (!needs_drop::<N>() && p.len() > 4).then(|| weight.clone());
        let weight = copy.as_ref().unwrap_or(weight);
        for_each_two(
            p,
            gradient,
            #[inline(always)]
            |p, gradient| p.subtract_product(weight, gradient),
        );
    }

    #[inline(always)]
    fn drift<K: Kinetic<N>>(&mut self, kinetic: &K, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
        kinetic.drift(weight, p, q, scratch);
    }

    #[inline(always)]
    fn drift_augmented<K: Kinetic<N>>(
        &mut self,
        kinetic: &K,
        weight: &N,
        p: &[N],
        q: &mut [N],
        (added, beta): (&mut [N], &mut N),
        scratch: &mut [N],
    ) {
        kinetic.drift_augmented(weight, p, q, beta, scratch);
        if N::KEEPS_INCREMENTS {
            kinetic.drift(weight, p, added, scratch);
        }
    }

    #[inline(always)]
    fn change(&mut self, _: Half, _: usize, x: &mut N, add: impl Fn(&mut N)) {
        add(x);
    }

    fn is_plain(&self) -> bool {
        true
    }
}

impl<N: Number, S: Summation<N>> Summation<N> for Option<S> {
    #[inline(always)]
    fn kick(&mut self, weight: &N, gradient: &[N], p: &mut [N]) {
        match self {
            Some(own) => own.kick(weight, gradient, p),
            None => Plain.kick(weight, gradient, p),
        }
    }

    #[inline(always)]
    fn drift<K: Kinetic<N>>(&mut self, kinetic: &K, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
        match self {
            Some(own) => own.drift(kinetic, weight, p, q, scratch),
            None => Plain.drift(kinetic, weight, p, q, scratch),
        }
    }

    #[inline(always)]
    fn drift_augmented<K: Kinetic<N>>(
        &mut self,
        kinetic: &K,
        weight: &N,
        p: &[N],
        q: &mut [N],
        (added, beta): (&mut [N], &mut N),
        scratch: &mut [N],
    ) {
        match self {
            Some(own) => own.drift_augmented(kinetic, weight, p, q, (added, beta), scratch),
            None => Plain.drift_augmented(kinetic, weight, p, q, (added, beta), scratch),
        }
    }

    #[inline(always)]
    fn change(&mut self, half: Half, index: usize, x: &mut N, add: impl Fn(&mut N)) {
        match self {
            Some(own) => own.change(half, index, x, add),
            None => Plain.change(half, index, x, add),
        }
    }

    fn forget_positions(&mut self) {
        self.iter_mut().for_each(S::forget_positions);
    }

    fn forget_momenta(&mut self) {
        self.iter_mut().for_each(S::forget_momenta);
    }

    #[inline(always)]
    fn settle(&mut self, q: &mut [N], p: &mut [N]) {
        if let Some(own) = self {
            own.settle(q, p);
        }
    }

    fn remainders(&self, q: &[N], p: &[N]) -> Remainders<N> {
        self.as_ref().map_or_else(Remainders::default, |own| own.remainders(q, p))
    }

    fn set_remainders(&mut self, remainders: &Remainders<N>) {
        self.iter_mut().for_each(|own| own.set_remainders(remainders));
    }

    fn is_compensated(&self) -> bool {
        self.as_ref().is_some_and(S::is_compensated)
    }

    fn is_plain(&self) -> bool {
        self.as_ref().is_none_or(S::is_plain)
    }
}
