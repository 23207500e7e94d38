//! The estimated error of an estimate, from the neighbouring estimates.
//!
//! The modified energy is constant along a trajectory, so what changes from one estimate to the next is the estimator's
//! error, or round-off. What is the same in all of them, as on a circular orbit, only the last term of the series
//! shows. Neither is enough: the spread vanishes on a circle, and the last term is far too small where the differences
//! alias, near a close encounter.

use std::collections::VecDeque;
use std::mem::take;

use crate::number::saved::{Fields, list};
use crate::number::{Number, epsilon};

/// The newest 2·`around` + 1 values of an estimator. The one in the middle has an error: the largest of max − min of
/// them all, of their last terms, and of the last place of the value, as on a circle all values may agree by chance in
/// all their digits.
#[derive(Clone, Debug)]
pub(super) struct ErrorEstimate<N> {
    around: usize,
    /// The newest last.
    points: VecDeque<Point<N>>,
    /// The last place of 1.
    epsilon: N,
    last_place: N,
    least: N,
    error: N,
}

/// The value of an estimator at a state.
#[derive(Clone, Debug)]
pub(super) struct Point<N> {
    pub(super) value: N,
    /// Its size; 0 where it is not known.
    pub(super) last_term: N,
    pub(super) order: u32,
}

impl<N: Number> Point<N> {
    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        let Point { value, last_term, order } = self;
        to.number(value);
        to.number(last_term);
        let mut k = u64::from(*order);
        to.count(&mut k);
        *order = k as u32;
    }

    pub(super) fn assign(&mut self, other: &Self) {
        self.value.assign(&other.value);
        self.last_term.assign(&other.last_term);
        self.order = other.order;
    }
}

impl<N: Number> ErrorEstimate<N> {
    /// With `around` values on either side.
    pub(super) fn new(around: usize, context: &N::Context) -> Self {
        ErrorEstimate {
            around,
            points: VecDeque::with_capacity(2 * around + 1),
            epsilon: epsilon(context),
            last_place: N::zero(context),
            least: N::zero(context),
            error: N::zero(context),
        }
    }

    /// The error and what it is made of are computed anew with each value.
    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        let zero = N::zero(&self.error.context());
        let none = Point { value: zero.clone(), last_term: zero, order: 0 };
        let mut points = Vec::from(take(&mut self.points));
        list(to, &mut points, &none, |to, point| point.fields(to));
        points.truncate(2 * self.around + 1);
        self.points = points.into();
    }

    pub(super) fn around(&self) -> usize {
        self.around
    }

    /// The place for the next value, which is the oldest value's.
    pub(super) fn next(&mut self) -> &mut Point<N> {
        let oldest = if self.is_complete() { self.points.pop_front() } else { None };
        let zero = || N::zero(&self.error.context());
        self.points.push_back(oldest.unwrap_or_else(|| Point { value: zero(), last_term: zero(), order: 0 }));
        self.points.back_mut().expect("one was put there")
    }

    /// Finds the error of the value in the middle; `false` as long as there are too few values.
    pub(super) fn update(&mut self) -> bool {
        if !self.is_complete() {
            return false;
        }
        self.least.assign(&self.points[0].value);
        self.error.assign(&self.points[0].value);
        for point in self.points.iter().skip(1) {
            self.least.make_at_most(&point.value);
            self.error.make_at_least(&point.value);
        }
        self.error.subtract(&self.least);
        self.last_place.assign_product(&self.points[self.around].value, &self.epsilon);
        self.last_place.make_absolute();
        for other in self.points.iter().map(|point| &point.last_term).chain([&self.last_place]) {
            self.error.make_at_least(other);
        }
        true
    }

    /// The value that [`update`](Self::update) was about.
    pub(super) fn middle(&self) -> &Point<N> {
        &self.points[self.around]
    }

    pub(super) fn error(&self) -> &N {
        &self.error
    }

    fn is_complete(&self) -> bool {
        self.points.len() > 2 * self.around
    }
}

/// From how many values on either side the error of E_k is estimated.
///
/// The error is a bump of a few steps' width that grows like √k. With three, the largest true error/estimate on the
/// orbits of the tests grows from 1.0 for k ≤ 8 to 2.9 for k = 96; with ⌈k/2⌉ it is 1.0, and estimates are many decades
/// too large where the error changes fast; with this it is 1.01.
pub(super) fn around(k: u32) -> usize {
    let root = k.isqrt();
    1 + root as usize + usize::from(root * root < k)
}
