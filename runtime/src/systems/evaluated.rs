//! A state with what is kept of B(q) there, and the kicks that this makes.

use crate::number::Number;
use crate::systems::coordinates::Coordinates;
use crate::systems::gradient_kicks::{GradientKicks, PartOfKicks, Place, are_displaced};
use crate::systems::increments::Carried;
use crate::systems::kept::KeptForce;
use crate::systems::state::State;
use crate::systems::summation::{Compensated, Summation};

/// A state, and what is kept of B at its q.
#[derive(Clone, Debug)]
pub(crate) struct Evaluated<N, V = Vec<N>, S = Option<Compensated<N, V>>> {
    pub(crate) state: State<N, V, S>,
    pub(crate) gradient: V,
    /// qᵀB_q − 2B
    pub(crate) rate: N,
    pub(crate) kept: KeptForce,
}

/// Kicks are compiled for the instructions of the caller.
impl<N: Number, V: Coordinates<N>, S: Summation<N>> Evaluated<N, V, S> {
    pub(crate) fn new(state: State<N, V, S>) -> Self {
        let (gradient, rate) = (state.p.clone(), state.increments.beta.clone());
        Evaluated { state, gradient, rate, kept: KeptForce::Nothing }
    }

    /// The same with the same state whose sums are other ones.
    pub(crate) fn with<T>(self, with_sums: impl FnOnce(State<N, V, S>) -> State<N, V, T>) -> Evaluated<N, V, T> {
        let Evaluated { state, gradient, rate, kept } = self;
        Evaluated { state: with_sums(state), gradient, rate, kept }
    }

    /// The state, to be changed: nothing is kept.
    pub(crate) fn state_mut(&mut self) -> &mut State<N, V, S> {
        self.kept = KeptForce::Nothing;
        &mut self.state
    }

    /// Evaluates the gradient at the present q, with the rate where that is wanted.
    #[inline(always)]
    pub(crate) fn evaluate(&mut self, part: &mut impl PartOfKicks<N>, with_rate: bool) {
        let rate = if with_rate { Some(&mut self.rate) } else { None };
        part.gradient(self.state.q.as_ref(), self.gradient.as_mut(), rate);
        self.kept = KeptForce::with(with_rate);
        self.state.count_evaluation();
        if let Some(kicks) = part.gradient_kicks() {
            kicks.kept = KeptForce::Nothing;
        }
    }

    /// The flow of B for the time `weight`.
    #[inline(always)]
    pub(crate) fn kick(&mut self, part: &mut impl PartOfKicks<N>, weight: &N, carried: Carried) {
        self.state.settle();
        if !self.kept.suffices(carried.has_increments()) {
            self.evaluate(part, carried.has_rate());
        }
        self.state.kick(weight, self.gradient.as_ref(), &self.rate, carried);
    }

    /// A gradient kick; its force is kept as the gradient is.
    #[inline]
    pub(crate) fn gradient_kick(&mut self, part: &mut impl PartOfKicks<N>, weight: &N, carried: Carried) {
        self.state.settle();
        let with_rate = carried.has_rate();
        let are_displaced = are_displaced(part.gradient_kicks().as_deref());
        // a displaced force is compared with the gradient, and its rate with the rate
        if !self.kept.suffices(are_displaced && with_rate) {
            self.evaluate(part, with_rate);
        }
        let new = || Box::new(GradientKicks::new(self.state.q().len(), None, &weight.context()));
        let mut kicks = part.gradient_kicks().take().unwrap_or_else(new);
        let before = kicks.evaluations;
        let place = Place { q: self.state.q.as_ref(), gradient: self.gradient.as_ref(), rate: &self.rate };
        kicks.evaluate(part, place, weight, with_rate);
        if are_displaced {
            self.state.evaluations += kicks.evaluations - before;
        }
        self.state.kick(weight, &kicks.force, &kicks.rate, carried);
        *part.gradient_kicks() = Some(kicks);
    }
}
