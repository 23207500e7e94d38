//! States of a run that are made at once: the end is looked for among them.

use std::any::TypeId;

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
    /// How many states there are.
    count: usize,
    /// q and p, one state after the other, where a watch sees those before the end.
    numbers: Vec<N>,
}

impl<N: SceneNumber> Block<N> {
    /// In double precision, and of a condition on q and p alone.
    pub(crate) fn of(condition: &Condition, system: &System) -> Option<Self> {
        let is_double = TypeId::of::<N>() == TypeId::of::<f64>();
        let test = if is_double { TestInLanes::of(condition, system)? } else { return None };
        Some(Block { test, count: 0, numbers: Vec::new() })
    }
}

impl<N: SceneNumber> Passing<'_, '_, N> {
    /// Whether the run ends with one of the states, or before it.
    pub(crate) fn finish(&mut self) -> bool {
        self.test_block();
        self.has_ended
    }

    fn test_block(&mut self) {
        let Some(Block { test, count, numbers }) = &mut self.ends.block else { return };
        let size = 2 * self.view.system.dimension();
        let first = test.first_met(*count);
        self.has_ended |= first.is_some();
        let before = first.unwrap_or(*count);
        self.n += i64::try_from(before).expect("a block is short");
        *count = 0;
        if let Some(watch) = self.watch {
            let states = numbers.chunks_exact(size).take(before).map(|state| state.split_at(size / 2));
            states.for_each(|(q, p)| watch.visit(q, p));
        }
        numbers.clear();
    }
}

impl<N: SceneNumber> Visitor<N> for Passing<'_, '_, N> {
    fn visit(&mut self, q: &[N], p: &[N]) {
        if self.has_ended {
            return;
        }
        if let Some(block) = &mut self.ends.block {
            block.test.set(block.count, (q, p));
            block.count += 1;
            if self.watch.is_some() {
                block.numbers.extend_from_slice(q);
                block.numbers.extend_from_slice(p);
            }
            if block.count == LANES {
                self.test_block();
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
}
