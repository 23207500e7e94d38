//! The pairs that interact: bodies, and walls at the ends of a chain.

use std::ops::DerefMut;

use super::pair::Ends;
use crate::number::Number;

/// A body, or a wall at 0, with its number.
pub(super) enum End<'a, N, const D: usize> {
    Wall,
    Body(usize, &'a [N; D]),
}

// derived, it would ask for numbers that are `Copy`
impl<N, const D: usize> Copy for End<'_, N, D> {}

impl<N, const D: usize> Clone for End<'_, N, D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<N: Number, const D: usize> End<'_, N, D> {
    /// A wall is asked for no properties.
    pub(super) fn number(self) -> usize {
        match self {
            End::Wall => 0,
            End::Body(number, _) => number,
        }
    }

    /// difference ← q_j − q_i
    #[inline(always)]
    pub(super) fn subtract<R: DerefMut<Target = N>>(i: Self, j: Self, difference: &mut [R; D]) {
        for (axis, difference) in difference.iter_mut().enumerate() {
            match (i, j) {
                (End::Body(_, i), End::Body(_, j)) => difference.assign_difference(&j[axis], &i[axis]),
                (End::Wall, End::Body(_, j)) => difference.assign(&j[axis]),
                (End::Body(_, i), End::Wall) => {
                    difference.assign(&i[axis]);
                    difference.negate();
                }
                (End::Wall, End::Wall) => difference.assign_zero(),
            }
        }
    }
}

/// Visits all pairs i < j.
#[inline(always)]
pub(super) fn each_pair<'q, N, const D: usize>(q: &'q [N], mut visit: impl FnMut(End<'q, N, D>, End<'q, N, D>)) {
    let (q, _) = q.as_chunks::<D>();
    for (i, q_i) in q.iter().enumerate() {
        for (j, q_j) in q.iter().enumerate().skip(i + 1) {
            visit(End::Body(i, q_i), End::Body(j, q_j));
        }
    }
}

/// Visits the pairs of neighbours in a chain.
#[inline(always)]
pub(super) fn each_neighbour<'q, N, const D: usize>(
    q: &'q [N],
    ends: Ends,
    mut visit: impl FnMut(End<'q, N, D>, End<'q, N, D>),
) {
    let (q, _) = q.as_chunks::<D>();
    let body = |number: usize| End::Body(number, &q[number]);
    let last = q.len() - 1;
    if ends == Ends::Fixed {
        visit(End::Wall, body(0));
    }
    (0..last).for_each(|i| visit(body(i), body(i + 1)));
    match ends {
        Ends::Free => {}
        Ends::Fixed => visit(body(last), End::Wall),
        Ends::Periodic => visit(body(last), body(0)),
    }
}
