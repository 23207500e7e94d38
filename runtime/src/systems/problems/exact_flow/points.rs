//! The points of a solution one after the other, rounded to the numbers of a run.

use std::fmt;

use super::solution::{Point, Solution};
use crate::number::value::Value;
use crate::number::{CorrectlyRounded, HighPrecision};
use crate::systems::increments::OwnedIncrements;

/// Points at the times n h.
pub(crate) trait Points<N>: fmt::Debug {
    /// q and p at n h, and the increments since (n − 1) h, each rounded once.
    fn assign(&mut self, n: i64, q: &mut [N], p: &mut [N], increments: &mut OwnedIncrements<N>);
}

/// The points of a solution in numbers of type R.
#[derive(Debug)]
pub(crate) struct PointsOf<R> {
    solution: Box<dyn Solution<R>>,
    /// The newest point and its number.
    present: Option<(i64, Point<R>)>,
}

impl<R: HighPrecision> PointsOf<R> {
    pub(crate) fn new(solution: Box<dyn Solution<R>>) -> Self {
        PointsOf { solution, present: None }
    }
}

impl<R: HighPrecision, N: CorrectlyRounded> Points<N> for PointsOf<R> {
    fn assign(&mut self, n: i64, q: &mut [N], p: &mut [N], increments: &mut OwnedIncrements<N>) {
        let before = self.present.take().filter(|(number, _)| *number == n - 1);
        let before = before.map_or_else(|| self.solution.at(n - 1), |(_, point)| point);
        let present = self.solution.at(n);
        assign_rounded(q, &present.q);
        assign_rounded(p, &present.p);
        assign_differences(&mut increments.q, &present.q, &before.q);
        assign_differences(&mut increments.p, &present.p, &before.p);
        increments.beta.assign_rounded(&(present.beta.clone() - &before.beta).0);
        self.present = Some((n, present));
    }
}

fn assign_rounded<N: CorrectlyRounded, R: HighPrecision>(numbers: &mut [N], values: &[Value<R>]) {
    numbers.iter_mut().zip(values).for_each(|(own, value)| own.assign_rounded(&value.0));
}

/// The differences, each rounded once; empty for a number type that keeps no increments.
fn assign_differences<N: CorrectlyRounded, R: HighPrecision>(
    increments: &mut [N],
    next: &[Value<R>],
    last: &[Value<R>],
) {
    for ((own, next), last) in increments.iter_mut().zip(next).zip(last) {
        own.assign_rounded(&(next.clone() - last).0);
    }
}
