//! The flows of T(p) and U(q), and what they change.

use std::ops::Range;

use super::curved::{Curved, Parts};
use crate::gradient_kicks::{GradientKicks, Place};
use crate::kept::Kept;
use crate::kinetic::Kinetic;
use crate::maps::{MapKind, MapSequence};
use crate::number::Number;
use crate::partial_sums::{LONG, add_sum};
use crate::potential::{FewCoordinates, Potential, Repeated};
use crate::summation::Summation;

/// What flows change: the state with the remainders of its sums, and what is kept at its q.
#[derive(Clone, Debug)]
pub(super) struct Moving<N, V, S> {
    pub(super) summation: S,
    pub(super) q: V,
    pub(super) p: V,
    pub(super) gradient: V,
    /// qᵀU_q − 2U
    pub(super) rate: N,
    pub(super) kept: Kept,
    pub(super) evaluations: u64,
}

/// A potential and a kinetic energy with their scratch space.
#[derive(Clone, Debug)]
pub(super) struct Flows<N, P, K> {
    pub(super) potential: P,
    pub(super) kinetic: K,
    /// Whether plain kicks that evaluate the gradient find and keep the rate as well.
    pub(super) keeps_rate: bool,
    /// The potential's, with what it keeps there.
    pub(super) scratch: Vec<N>,
    /// The kinetic energy's, likewise.
    pub(super) kinetic_scratch: Vec<N>,
    /// Of gradient kicks, once there was one; what it keeps belongs to the q of the last evaluation of the gradient.
    pub(super) curved: Option<Box<Curved<N>>>,
}

impl<N, V, S> Moving<N, V, S>
where
    N: Number,
    V: AsRef<[N]> + AsMut<[N]>,
    S: Summation<N>,
{
    #[inline(always)]
    pub(super) fn settle(&mut self) {
        self.summation.settle(self.q.as_mut(), self.p.as_mut());
    }

    #[inline(always)]
    pub(super) fn kick_with_kept_gradient(&mut self, weight: &N) {
        self.summation.kick(weight, self.gradient.as_ref(), self.p.as_mut());
    }
}

/// Flows are compiled for the instructions of the caller.
impl<N: Number, P: Potential<N>, K: Kinetic<N>> Flows<N, P, K> {
    #[inline(always)]
    pub(super) fn evaluate<V, S>(&mut self, moving: &mut Moving<N, V, S>, with_rate: bool)
    where
        V: AsRef<[N]> + AsMut<[N]>,
    {
        let (q, gradient) = (moving.q.as_ref(), moving.gradient.as_mut());
        self.potential.update(q);
        moving.kept = if with_rate {
            self.potential.gradient_and_rate(q, gradient, &mut moving.rate, &mut self.scratch);
            Kept::GradientAndRate
        } else {
            self.potential.gradient(q, gradient, &mut self.scratch);
            Kept::Gradient
        };
        moving.evaluations += 1;
        if let Some(curved) = &mut self.curved {
            curved.kicks.kept = Kept::Nothing;
        }
    }

    #[inline(always)]
    pub(super) fn kick<V, S>(&mut self, moving: &mut Moving<N, V, S>, weight: &N, with_rate: bool)
    where
        V: AsRef<[N]> + AsMut<[N]>,
        S: Summation<N>,
    {
        moving.settle();
        if moving.kept == Kept::Nothing {
            self.evaluate(moving, with_rate);
        }
        moving.kick_with_kept_gradient(weight);
    }

    /// A gradient kick, with its rate where that is wanted; the force is kept as the gradient is.
    #[inline]
    pub(super) fn gradient_kick<V, S>(
        &mut self,
        moving: &mut Moving<N, V, S>,
        weight: &N,
        with_rate: bool,
    ) -> &GradientKicks<N>
    where
        V: AsRef<[N]> + AsMut<[N]>,
        S: Summation<N>,
    {
        moving.settle();
        let is_displaced = self.curved.as_ref().is_some_and(|curved| curved.kicks.is_displaced());
        if moving.kept == Kept::Nothing || is_displaced && !moving.kept.suffices(with_rate) {
            self.evaluate(moving, with_rate);
        }
        let Flows { potential, kinetic, scratch, kinetic_scratch, curved, .. } = self;
        let curved = curved.get_or_insert_with(|| Box::new(Curved::new(potential, &weight.context())));
        let at = Place { q: moving.q.as_ref(), gradient: moving.gradient.as_ref(), rate: &moving.rate };
        let before = curved.kicks.evaluations;
        curved.evaluate(Parts { potential, kinetic, scratch, kinetic_scratch }, at, weight, with_rate);
        if is_displaced {
            moving.evaluations += curved.kicks.evaluations - before;
        }
        moving.summation.kick(weight, &curved.kicks.force, moving.p.as_mut());
        &curved.kicks
    }

    #[inline(always)]
    pub(super) fn drift<V, S>(&mut self, moving: &mut Moving<N, V, S>, weight: &N)
    where
        V: AsRef<[N]> + AsMut<[N]>,
        S: Summation<N>,
    {
        moving.settle();
        let Moving { summation, q, p, kept, .. } = moving;
        summation.drift(&self.kinetic, weight, p.as_ref(), q.as_mut(), &mut self.kinetic_scratch);
        *kept = Kept::Nothing;
    }

    /// energy ← T(p) + U(q), kinetic_energy ← T(p)
    pub(super) fn assign_energies(&mut self, (q, p): (&[N], &[N]), energy: &mut N, kinetic_energy: &mut N) {
        self.potential.update(q);
        self.potential.energy(q, energy, &mut self.scratch);
        self.add_kinetic_energy((q, p), energy, kinetic_energy);
    }

    /// Of an energy U(q), energy ← T(p) + U(q) and kinetic_energy ← T(p); NaN where U is finite though squares of positions overflow: an
    /// infinite r² makes 0 of 1/r.
    #[inline(always)]
    pub(super) fn add_kinetic_energy(&mut self, (q, p): (&[N], &[N]), energy: &mut N, kinetic_energy: &mut N) {
        self.kinetic.energy(p, kinetic_energy, &mut self.kinetic_scratch);
        energy.add(kinetic_energy);
        self.kinetic.exchanged_energy(p, kinetic_energy, &mut self.kinetic_scratch);
        if N::KEEPS_INCREMENTS && q.len() >= LONG {
            let zero = N::zero(&energy.context());
            let mut overflows = zero.clone();
            add_sum(&mut overflows, [q], |[position], overflows| {
                let mut part = zero.clone();
                part.make_nan_where_square_overflows(position);
                overflows.add(&part);
            });
            energy.make_nan_where_square_overflows(&overflows);
        } else {
            q.iter().for_each(|position| energy.make_nan_where_square_overflows(position));
        }
    }

    /// `count` steps. A state in arrays is copied, so that the compiler can hold it in registers.
    #[inline(always)]
    pub(super) fn advance<V, S>(&mut self, moving: &mut Moving<N, V, S>, maps: &impl MapSequence<N>, count: u64)
    where
        V: AsRef<[N]> + AsMut<[N]> + Clone,
        S: Summation<N>,
    {
        // the rate is kept for what follows the last step
        let before = count - u64::from(self.keeps_rate).min(count);
        let is_done = self.advance_few(moving, maps, before, count);
        if !is_done && std::mem::needs_drop::<Moving<N, V, S>>() {
            self.advance_in_place::<false, _, _>(moving, maps, 0..before, count);
        } else if !is_done {
            let mut copy = moving.clone();
            self.advance_in_place::<false, _, _>(&mut copy, maps, 0..before, count);
            *moving = copy;
        }
        self.advance_in_place::<true, _, _>(moving, maps, before..count, count);
    }

    /// The first steps of `count`, by one call of a potential behind a `dyn`; false, and nothing is done, where these steps are not of
    /// [a few coordinates](FewCoordinates).
    #[inline(always)]
    fn advance_few<V, S>(
        &mut self,
        moving: &mut Moving<N, V, S>,
        maps: &impl MapSequence<N>,
        steps: u64,
        count: u64,
    ) -> bool
    where
        V: AsRef<[N]> + AsMut<[N]>,
        S: Summation<N>,
    {
        let Moving { summation, q, p, gradient, kept, evaluations, .. } = moving;
        let [q, p, gradient] = [q, p, gradient].map(V::as_mut);
        let is_worth_it = P::is_boxed() && steps >= FEW && FewCoordinates::<N>::can_hold(q.len());
        if !is_worth_it || !summation.is_plain() || self.curved.is_some() {
            return false;
        }
        let Some(inverse_masses) = self.kinetic.inverse_masses() else { return false };
        let Some(maps) = kicks_and_drifts(maps, steps, count) else { return false };
        let state = [q, p, gradient];
        let mut few = FewCoordinates { state, inverse_masses, kept: *kept, evaluations: 0, maps };
        self.potential.advance_few(&mut few, &mut self.scratch);
        (*kept, *evaluations) = (few.kept, *evaluations + few.evaluations);
        true
    }

    #[inline(always)]
    fn advance_in_place<const RATE: bool, V, S>(
        &mut self,
        moving: &mut Moving<N, V, S>,
        maps: &impl MapSequence<N>,
        steps: Range<u64>,
        count: u64,
    ) where
        V: AsRef<[N]> + AsMut<[N]>,
        S: Summation<N>,
    {
        maps.each(
            steps,
            count,
            #[inline(always)]
            |kind, weight, _| match kind {
                MapKind::Kick => self.kick(moving, weight, RATE),
                MapKind::Drift => self.drift(moving, weight),
                MapKind::GradientKick => {
                    self.gradient_kick(moving, weight, RATE);
                }
            },
        );
    }
}

/// Of fewer steps than these no list of maps is made.
pub(super) const FEW: u64 = 8;

/// The maps of the first, of each middle and of the last of these steps of `count`; `None` unless a step has kicks and drifts and nothing else.
pub(super) fn kicks_and_drifts<N: Number>(
    maps: &impl MapSequence<N>,
    steps: u64,
    count: u64,
) -> Option<[Repeated<N>; 3]> {
    let mut has_others = false;
    let mut list = |step: u64| {
        let mut list = Vec::new();
        maps.each(step..step + 1, count, |kind, weight, between| {
            has_others |= kind == MapKind::GradientKick || between.is_some();
            list.push((kind, weight.clone()));
        });
        list
    };
    let lists = [(list(0), 1), (list(1), steps - 2), (list(steps - 1), 1)];
    let middle = &lists[1].0;
    let has = |wanted| middle.iter().any(|(kind, _)| *kind == wanted);
    (!has_others && has(MapKind::Kick) && has(MapKind::Drift)).then_some(lists)
}
