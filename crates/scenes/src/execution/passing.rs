//! States of a run that are made at once: the end is looked for among them.

use std::any::TypeId;
use std::mem::take;

use num_traits::Signed;
use shadowstep::systems::system::Visitor;

use crate::columns::at::View;
use crate::columns::evaluator::{Test, TestInLanes};
use crate::document::expression::Condition;
use crate::execution::posed::Posed;
use crate::motion::lanes::LANES;
use crate::scene::{SceneNumber, System};
use crate::watch::Watch;

/// Passes states until the run ends with one of them, or before it.
pub(crate) struct Passing<'s, 'a, N: SceneNumber> {
    pub(crate) watch: &'s mut Option<Watch<N>>,
    pub(crate) ends: &'s mut Ends<N>,
    pub(crate) view: &'s View<'a, N>,
    /// The last state before.
    pub(crate) n: i64,
    pub(crate) has_ended: bool,
}

/// What ends a run before its most steps.
pub(crate) struct Ends<N> {
    /// A condition.
    pub(crate) test: Option<Test<N>>,
    /// Where the condition is tested at many states at once.
    block: Option<Block<N>>,
    /// The physical time that no state is to pass, and whether steps go forwards.
    pub(crate) until: Option<(N, bool)>,
}

impl<N: SceneNumber> Ends<N> {
    pub(crate) fn of(posed: &Posed<'_>, context: &N::Context) -> Self {
        let Posed { system, ends, until, .. } = *posed;
        let test = |condition| Test::new(condition, system, context).expect("it was checked with the system");
        Ends {
            test: ends.map(test),
            block: ends.filter(|_| until.is_none()).and_then(|condition| Block::of(condition, system)),
            until: until.map(|until| (N::from_rational(until, context), until.is_positive())),
        }
    }

    pub(crate) fn are_none(&self) -> bool {
        self.test.is_none() && self.until.is_none()
    }

    /// Whether they need more than q and p of a state: H, and the trajectory of a processed scheme, are known at the
    /// present state only.
    pub(crate) fn need_system(&self, is_processed: bool) -> bool {
        self.test.as_ref().is_some_and(|test| test.has_energy() || is_processed)
    }

    /// Whether a state is past the physical end.
    pub(crate) fn are_passed(&self, q: &[N]) -> bool {
        let t = || q.last().expect("time is a coordinate");
        self.until.as_ref().is_some_and(|(until, forwards)| if *forwards { t() > until } else { t() < until })
    }
}

/// States whose condition is tested at once: evaluated in lanes, a formula costs little more than at one state.
pub(crate) struct Block<N> {
    test: TestInLanes,
    /// q and p of the states that were seen one by one, one state after the other.
    seen: Vec<N>,
}

impl<N: SceneNumber> Block<N> {
    /// In double precision, and of a condition on q and p alone.
    pub(crate) fn of(condition: &Condition, system: &System) -> Option<Self> {
        let is_double = TypeId::of::<N>() == TypeId::of::<f64>();
        let test = if is_double { TestInLanes::of(condition, system)? } else { return None };
        Some(Block { test, seen: Vec::new() })
    }
}

impl<N: SceneNumber> Passing<'_, '_, N> {
    /// Whether the run ends with one of the states, or before it.
    pub(crate) fn finish(&mut self) -> bool {
        self.test_seen();
        self.has_ended
    }

    /// Tests the states that were seen one by one.
    fn test_seen(&mut self) {
        let Some(block) = self.ends.block.as_mut().filter(|block| !block.seen.is_empty()) else { return };
        let mut seen = take(&mut block.seen);
        self.test(&seen);
        seen.clear();
        self.ends.block.iter_mut().for_each(|block| block.seen = take(&mut seen));
    }

    /// Tests as many states as there are lanes, at most; the watch sees those before the end.
    fn test(&mut self, states: &[N]) {
        let (Some(Block { test, .. }), false) = (&mut self.ends.block, self.has_ended) else { return };
        let dimension = self.view.system.dimension();
        let first = test.first_met(states, 2 * dimension);
        self.has_ended = first.is_some();
        let before = first.map_or(states, |first| &states[..first * 2 * dimension]);
        self.n += i64::try_from(before.len() / (2 * dimension)).expect("there are few");
        if let Some(watch) = self.watch {
            watch.visit_each(before, dimension);
        }
    }
}

impl<N: SceneNumber> Visitor<N> for Passing<'_, '_, N> {
    fn visit(&mut self, q: &[N], p: &[N]) {
        if self.has_ended {
            return;
        }
        if let Some(Block { seen, .. }) = &mut self.ends.block {
            seen.extend_from_slice(q);
            seen.extend_from_slice(p);
            if seen.len() == LANES * 2 * q.len() {
                self.test_seen();
            }
            return;
        }
        let (n, View { run, context, .. }) = (self.n + 1, self.view);
        let mut is_met = |test: &mut Test<N>| test.is_met_at((q, p), || run.time_in(n, *context));
        if self.ends.are_passed(q) || self.ends.test.as_mut().is_some_and(&mut is_met) {
            self.has_ended = true;
            return;
        }
        self.n = n;
        if let Some(watch) = self.watch {
            watch.visit(q, p);
        }
    }

    fn visit_each(&mut self, states: &[N], dimension: usize) {
        if self.ends.block.is_some() {
            self.test_seen();
            states.chunks(LANES * 2 * dimension).for_each(|states| self.test(states));
            return;
        }
        for (q, p) in states.chunks_exact(2 * dimension).map(|state| state.split_at(dimension)) {
            self.visit(q, p);
        }
    }
}
