//! What a step carries along beside q and p: nothing, or what it adds to q, p and β.

use crate::number::Number;
use crate::number::saved::{Fields, list};
use crate::systems::coordinates::Coordinates;

/// What a step carries along beside q and p.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carried {
    /// Nothing: a plain step.
    Nothing,
    /// The rate of β, not β itself: a plain step before an augmented one. What it evaluates last, such as qᵀU_q − 2U
    /// beside the gradient, is kept for that.
    Rate,
    /// The [increments](Increments) of q, p and β: an augmented step.
    ///
    /// Along each flow β grows by the integral of qᵀH_q + pᵀH_p − 2H, H being A or B (Moan & Niesen, eq. 2, whose
    /// printed sign is wrong): by weight·(qᵀU_q − 2U) in a kick, and by weight·(pᵀT_p − 2T) in a drift, which is 0 for
    /// quadratic T.
    Increments,
}

impl Carried {
    /// Whether flows add to the increments of q, p and β.
    #[inline(always)]
    pub(crate) const fn has_increments(self) -> bool {
        matches!(self, Carried::Increments)
    }

    /// Whether the rate of β is evaluated with the force.
    #[inline(always)]
    pub(crate) const fn has_rate(self) -> bool {
        matches!(self, Carried::Rate | Carried::Increments)
    }
}

/// What a step added to q, p and β, borrowed from the system that made it or from a [copy](OwnedIncrements).
///
/// For a number type that does not [keep increments](Number::KEEPS_INCREMENTS), q and p are empty.
#[derive(Debug)]
pub struct Increments<'a, N> {
    /// To q: the sum of what its flows added, without the round-off of q itself. For an exact flow it must be computed
    /// without cancellation, not as a difference of states.
    pub q: &'a [N],
    /// To p: the sum of what its flows added, without the round-off of p itself.
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
    pub(crate) fn has_vectors(&self) -> bool {
        !self.q.is_empty()
    }

    /// Those of the first coordinates of q and p, where they are known.
    pub(crate) fn of_first(self, coordinates: usize) -> Self {
        let first = |all: &'a [N]| &all[..coordinates.min(all.len())];
        Increments { q: first(self.q), p: first(self.p), beta: self.beta }
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

    pub(crate) fn fields(&mut self, to: &mut dyn Fields<N>) {
        let OwnedIncrements { q, p, beta } = self;
        to.number(beta);
        [q, p].into_iter().for_each(|numbers| list(to, numbers, beta, |to, number| to.number(number)));
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
    pub(crate) fn assign_zero(&mut self) {
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
