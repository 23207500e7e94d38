//! All T_{m,m}, m = 1..M, of every state from one table of differences.
//!
//! T_{m,m} is the sum of the first m terms of Stirling's series, and term k needs ∇^{2k−1} of (q, p, β) at the states
//! n + k and n + k − 1 only. The table of backward differences of the newest state is updated with 2M vector
//! subtractions a step; with that of the state before it completes one term of each of M states.

use crate::Rational;
use crate::number::Ordered;
use crate::shadow::error_estimate::{ErrorEstimate, Point};
use crate::shadow::estimator::{Estimate, Estimator};
use crate::shadow::weights::stirling;
use crate::system::Increments;

/// Where the search for the best m ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StoppingRule {
    /// At the largest m allowed.
    Full,
    /// At the first m ≥ 13 with max_{j=m−11..m−1} e_j < max_{j=m−10..m} e_j, e_j = |T_{j,j} − T_{j−1,j−1}|: the newest
    /// of twelve terms is the largest.
    Early,
    /// As [`Early`](StoppingRule::Early), but with ≤ as Moan & Niesen, section 5.2, print it.
    ///
    /// That also stops where the oldest of the twelve terms is not the largest, thus at the first ripple. The paper states that
    /// the result can hardly be distinguished from the full search. That is true of < only: for Störmer–Verlet on the pendulum,
    /// h = 1/10, 120 digits, the drift over [0, 100] is 1.6e-25 by the full search, 2.8e-25 with < and 7.3e-17 with ≤; on
    /// Kepler, e = 0.6, h = 1/20, it is 1.0e-7, 1.2e-7 and 2.8e-6.
    Printed,
}

/// The number of successive terms in the early stopping rule.
const STOP_WINDOW: usize = 11;

/// The rule that selects the best m, by the sizes e_j = |T_{j,j} − T_{j−1,j−1}| of the terms. Of equal ones it is the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SelectionRule {
    /// The smallest e_m (Moan & Niesen), which reproduces their results. A term may be small by chance, far from the m where the
    /// series is most accurate.
    Least,
    /// Minimises the maximum of the ten neighbouring terms e_{m−5}, …, e_{m+4}, as far as they are among those computed.
    ///
    /// On the exact flow of Kepler's problem, whose energy is known, e = 0.3, 0.6 and 0.9, h = 1/10, 3/31, 2/21, 1/20 and 1/40,
    /// m ≤ 100, the largest error of an orbit is on none of the 15 more than by the other rule; it is less by a factor of 1.6 in
    /// the mean, 6.4 at most. From state to state errors are smaller as often as larger. With the terms e_{m−9}, …, e_m the largest
    /// error is the same and the others three times as large in the mean; with e_m, …, e_{m+9} twice.
    Robust,
}

/// The number of terms before e_m, and after it, in the robust rule.
const ROBUST: (usize, usize) = (5, 4);

/// The best m of each state.
#[derive(Clone, Debug)]
pub(super) struct AllOrders<N> {
    largest: usize,
    stop: StoppingRule,
    rule: SelectionRule,
    /// c_k/(4h): the halves of μ and of H̄ are in it.
    coefficients: Vec<N>,
    /// ∇^r of (q, p, β) at the newest state, r = 0..2M−1, and at the one before.
    table: Vec<Vec<N>>,
    previous: Vec<Vec<N>>,
    /// 2 μδ^{2k−1} of (q, p, β)
    mean: Vec<N>,
    /// The newest states, the state k in place k mod their number: M + 1, and those whose values are there already.
    ring: Vec<Place<N>>,
    pushed: usize,
    /// e_1, …, e_M and T_{1,1}, …, T_{M,M} of a state, up to where the search ended.
    sizes: Vec<N>,
    sums: Vec<N>,
    error_estimate: ErrorEstimate<N>,
    with_error: bool,
}

#[derive(Clone, Debug)]
struct Place<N> {
    q: Vec<N>,
    p: Vec<N>,
    /// −qᵀδp + pᵀδq − δβ with δ = 2 μδ^{2k−1}, k = 1..M.
    terms: Vec<N>,
}

impl<N: Ordered> AllOrders<N> {
    /// With the error from this many values on either side, or without.
    pub(super) fn new(
        (largest, stop, rule): (u32, StoppingRule, SelectionRule),
        around: Option<usize>,
        h: &Rational,
        dimension: usize,
        context: &N::Context,
    ) -> Self {
        let error_estimate = ErrorEstimate::new(around.unwrap_or(0), context);
        let size = largest as usize;
        let zero = N::zero(context);
        let numbers = |count| vec![zero.clone(); count];
        let four_h = h * Rational::from_integer(4.into());
        let table = vec![numbers(2 * dimension + 1); 2 * size];
        let place = Place { q: numbers(dimension), p: numbers(dimension), terms: numbers(size) };
        AllOrders {
            largest: size,
            stop,
            rule,
            coefficients: stirling(largest).iter().map(|c| N::from_rational(&(c / &four_h), context)).collect(),
            previous: table.clone(),
            mean: numbers(2 * dimension + 1),
            table,
            ring: vec![place; size + 1 + error_estimate.around()],
            pushed: 0,
            sizes: numbers(size),
            sums: numbers(size),
            error_estimate,
            with_error: around.is_some(),
        }
    }

    /// ∇^0, ∇^1, … of the newest state, as far as there are states before it. The increments are first differences, of q and p too where
    /// they are known.
    fn update_table(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) {
        std::mem::swap(&mut self.table, &mut self.previous);
        for (entry, value) in self.table[0].iter_mut().zip(q.iter().chain(p)) {
            entry.assign(value);
        }
        for r in 1..self.table.len().min(self.pushed + 1) {
            let (lower, upper) = self.table.split_at_mut(r);
            let below = lower[r - 1].iter().zip(&self.previous[r - 1]);
            upper[0].iter_mut().zip(below).for_each(|(own, (this, last))| own.assign_difference(this, last));
            if r == 1 {
                set_first_differences(&mut upper[0], increments);
            }
        }
    }

    fn place(&mut self, q: &[N], p: &[N]) -> usize {
        let newest = self.pushed % self.ring.len();
        let place = &mut self.ring[newest];
        place.q.iter_mut().zip(q).for_each(|(own, q)| own.assign(q));
        place.p.iter_mut().zip(p).for_each(|(own, p)| own.assign(p));
        self.pushed += 1;
        newest
    }

    /// Term k of the state n is complete when n + k has come. States with fewer than M before them get no value.
    fn add_terms(&mut self, newest: usize) {
        let size = self.ring.len();
        let newest_with_value = (self.pushed - 1).saturating_sub(self.largest);
        for k in 1..=self.largest.min(newest_with_value) {
            let (this, last) = (&self.table[2 * k - 1], &self.previous[2 * k - 1]);
            for ((mean, this), last) in self.mean.iter_mut().zip(this).zip(last) {
                mean.assign_sum(this, last);
            }
            self.ring[(newest + size - k) % size].set_term(k, &self.mean);
        }
    }

    /// Sums the series at a state up to the end of the search; returns where that is.
    fn sum_up(&mut self, place: usize) -> usize {
        for m in 1..=self.largest {
            let size = &mut self.sizes[m - 1];
            size.assign_product(&self.coefficients[m - 1], &self.ring[place].terms[m - 1]);
            let (before, sum) = self.sums.split_at_mut(m - 1);
            match before.last() {
                Some(before) => sum[0].assign_sum(before, size),
                None => sum[0].assign(size),
            }
            size.make_absolute();
            if self.stops_at(m) {
                return m;
            }
        }
        self.largest
    }

    fn stops_at(&self, m: usize) -> bool {
        // sizes[j − 1] is e_j, and e_2 is the first one that is a difference
        if self.stop == StoppingRule::Full || m < STOP_WINDOW + 2 {
            return false;
        }
        let before = largest(&self.sizes[m - STOP_WINDOW - 1..m - 1]);
        let now = largest(&self.sizes[m - STOP_WINDOW..m]);
        if self.stop == StoppingRule::Early { before < now } else { before <= now }
    }

    /// The value of the state whose last term has just come.
    fn add_value(&mut self, place: usize) {
        let last = self.sum_up(place);
        let best = self.rule.best(&self.sizes[..last]);
        let Point { value, last_term, order } = self.error_estimate.next();
        value.assign(&self.sums[best - 1]);
        last_term.assign(&self.sizes[best - 1]);
        *order = best as u32;
    }
}

impl SelectionRule {
    /// The best m for e_1, e_2, …
    fn best<N: PartialOrd>(self, sizes: &[N]) -> usize {
        let (before, after) = if self == SelectionRule::Robust { ROBUST } else { (0, 0) };
        let terms = |m: usize| &sizes[(m - 1).saturating_sub(before).max(1)..(m + after).min(sizes.len())];
        let (mut best, mut least) = (2, largest(terms(2)));
        for m in 3..=sizes.len() {
            if terms(m).iter().all(|size| size < least) {
                (best, least) = (m, largest(terms(m)));
            }
        }
        best
    }
}

/// β's is always its increment; those of q and p are where these are known.
fn set_first_differences<N: Ordered>(differences: &mut [N], Increments { q, p, beta }: Increments<'_, N>) {
    let (last, others) = differences.split_last_mut().expect("β is there");
    others.iter_mut().zip(q.iter().chain(p)).for_each(|(own, increment)| own.assign(increment));
    last.assign(beta);
}

fn largest<N: PartialOrd>(numbers: &[N]) -> &N {
    numbers.iter().reduce(|a, b| if a < b { b } else { a }).expect("the window is not empty")
}

impl<N: Ordered> Place<N> {
    fn set_term(&mut self, k: usize, mean: &[N]) {
        let (dq, rest) = mean.split_at(self.q.len());
        let (dp, dbeta) = rest.split_at(self.q.len());
        let term = &mut self.terms[k - 1];
        term.assign_zero();
        for (((q, p), dq), dp) in self.q.iter().zip(&self.p).zip(dq).zip(dp) {
            term.add_product(p, dq);
            term.subtract_product(q, dp);
        }
        term.subtract(&dbeta[0]);
    }
}

impl<N: Ordered> Estimator<N> for AllOrders<N> {
    fn states(&self) -> usize {
        2 * (self.largest + self.error_estimate.around()) + 1
    }

    fn push(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) -> Option<Estimate<'_, N>> {
        self.update_table(q, p, increments);
        let newest = self.place(q, p);
        self.add_terms(newest);
        if self.pushed <= 2 * self.largest {
            return None;
        }
        let size = self.ring.len();
        self.add_value((newest + size - self.largest) % size);
        if !self.error_estimate.update() {
            return None;
        }
        let Point { value, last_term, order } = self.error_estimate.middle();
        let Place { q, p, .. } = &self.ring[(newest + 1) % size];
        let error = self.with_error.then(|| self.error_estimate.error());
        Some(Estimate { value, last_term: Some(last_term), error, order: *order, q, p })
    }
}
