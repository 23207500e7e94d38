//! The table of backward differences, by the operations of the numbers.

use crate::number::Number;
use crate::systems::increments::Increments;

/// ∇^r of (q, p, β) at the newest state, r = 0..2M−1, and at the one before.
#[derive(Clone, Debug)]
pub(super) struct DifferenceTable<N> {
    newest: Vec<Vec<N>>,
    before: Vec<Vec<N>>,
    /// 2 μδ^{2k−1} of (q, p, β)
    mean: Vec<N>,
    pushed: usize,
}

impl<N: Number> DifferenceTable<N> {
    /// For terms 1..=`terms` of Stirling's series.
    pub(super) fn new(terms: usize, dimension: usize, context: &N::Context) -> Self {
        let zeros = vec![N::zero(context); 2 * dimension + 1];
        let levels = vec![zeros.clone(); 2 * terms];
        DifferenceTable { newest: levels.clone(), before: levels, mean: zeros, pushed: 0 }
    }

    /// ∇^0, ∇^1, … of the next state, as far as there are states before it. The increments are first differences, of q
    /// and p too where they are known.
    pub(super) fn push(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) {
        std::mem::swap(&mut self.newest, &mut self.before);
        for (entry, value) in self.newest[0].iter_mut().zip(q.iter().chain(p)) {
            entry.assign(value);
        }
        self.pushed += 1;
        for r in 1..self.newest.len().min(self.pushed) {
            let (lower, upper) = self.newest.split_at_mut(r);
            let below = lower[r - 1].iter().zip(&self.before[r - 1]);
            upper[0].iter_mut().zip(below).for_each(|(own, (this, last))| own.assign_difference(this, last));
            if r == 1 {
                set_first_differences(&mut upper[0], increments);
            }
        }
    }

    /// term ← −qᵀδp + pᵀδq − δβ at the state k before the newest, with δ = 2 μδ^{2k−1}.
    pub(super) fn term(&mut self, k: usize, (q, p): (&[N], &[N]), term: &mut N) {
        let (newest, before) = (&self.newest[2 * k - 1], &self.before[2 * k - 1]);
        for ((mean, newest), before) in self.mean.iter_mut().zip(newest).zip(before) {
            mean.assign_sum(newest, before);
        }
        let (dq, rest) = self.mean.split_at(q.len());
        let (dp, dbeta) = rest.split_at(q.len());
        term.assign_zero();
        for (((q, p), dq), dp) in q.iter().zip(p).zip(dq).zip(dp) {
            term.add_product(p, dq);
            term.subtract_product(q, dp);
        }
        term.subtract(&dbeta[0]);
    }
}

/// For β it is always the increment, for q and p where increments are known.
fn set_first_differences<N: Number>(differences: &mut [N], Increments { q, p, beta }: Increments<'_, N>) {
    let (last, others) = differences.split_last_mut().expect("β is there");
    others.iter_mut().zip(q.iter().chain(p)).for_each(|(own, increment)| own.assign(increment));
    last.assign(beta);
}
