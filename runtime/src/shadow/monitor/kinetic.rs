//! The mean kinetic energy T of a run.

use super::arithmetic::{integer, quotient};
use crate::number::Real;
use crate::number::saved::Fields;
use crate::systems::system::System;

/// In the distance of windows T is computed this many times. It needs no forces.
const STATES_IN_A_DISTANCE: u64 = 4;

/// T at one state of each stretch of some steps.
///
/// Its place there is irregular: middles of windows, which are spread evenly, do not see all phases of a motion whose
/// period has one of some ratios to their distance, and their mean of T was up to a factor of 2 off.
#[derive(Clone, Debug)]
pub(super) struct MeanKinetic<N> {
    /// The steps of a stretch.
    stretch: u64,
    /// How many states have been taken, one of each stretch so far.
    count: u64,
    /// The state of the present stretch.
    next: u64,
    /// T of the newest one.
    newest: N,
    sum: N,
}

impl<N: Real> MeanKinetic<N> {
    /// At the state 0, whose T is `kinetic`, where there is a window every `every` steps.
    pub(super) fn new(every: u64, kinetic: &N) -> Self {
        let stretch = (every / STATES_IN_A_DISTANCE).max(1);
        let sum = N::zero(&kinetic.context());
        let mut mean = MeanKinetic { stretch, count: 0, next: state_of(0, stretch), newest: kinetic.clone(), sum };
        if mean.next == 0 {
            mean.include();
        }
        mean
    }

    /// The same where there is a window every `every` steps; the system is still at the state 0.
    pub(super) fn every(&self, every: u64) -> Self {
        Self::new(every, &self.newest)
    }

    /// How many states from n on are not taken.
    pub(super) fn idle(&self, n: u64) -> u64 {
        self.next.saturating_sub(n)
    }

    /// Takes T of the state n, at which the system is, if it is one of the states.
    #[inline]
    pub(super) fn observe<M: System<Number = N> + ?Sized>(&mut self, n: u64, system: &mut M) {
        if n < self.next {
            return;
        }
        system.assign_kinetic_energy(None, &mut self.newest);
        self.include();
    }

    /// Adds T of the newest state, and goes on to the next stretch.
    #[inline]
    fn include(&mut self) {
        self.sum.add(&self.newest);
        self.count += 1;
        self.next = state_of(self.count, self.stretch);
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        let MeanKinetic { stretch, count, next, newest, sum } = self;
        [&mut *stretch, count, next].into_iter().for_each(|count| to.count(count));
        [newest, sum].into_iter().for_each(|number| to.number(number));
        *stretch = (*stretch).max(1);
    }

    /// Whether n is the number of one of the states.
    pub(super) fn takes(&self, n: u64) -> bool {
        n == state_of(n / self.stretch, self.stretch)
    }

    /// ⟨T⟩, or 0 before the first state.
    pub(super) fn mean(&self) -> N {
        quotient(&self.sum, &integer(self.count.max(1), &self.sum.context()))
    }
}

/// The state in a stretch, which is at an independent place in each: the finaliser of SplitMix64 (Steele, Lea and Flood
/// 2014), scaled.
#[inline]
fn state_of(number: u64, stretch: u64) -> u64 {
    if stretch == 1 {
        return number;
    }
    let mut bits = number.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    bits ^= bits >> 31;
    let place = ((u128::from(bits) * u128::from(stretch)) >> 64) as u64;
    number.saturating_mul(stretch).saturating_add(place)
}
