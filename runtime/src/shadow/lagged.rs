//! E_k by increments, for numbers that keep them.
//!
//! With δq, δp and δβ, what each step added, the product of two states in E_k is a sum over the steps between them,
//!
//! q_i·p − p_i·q + β − β_i = Σ_m (q·δp_m − p·δq_m + δβ_m),
//!
//! so that E_k is a form in the products of each state with the k newest steps, the *lags*. They are computed once,
//! when the state comes, and kept for all windows that they belong to.

mod form;
mod long;
mod products;
mod short;

use crate::Rational;
use crate::number::Number;
use crate::number::instructions::copy;
use crate::number::saved::Fields;
use crate::shadow::error_estimate::{ErrorEstimate, Point, around};
use crate::shadow::estimator::Estimate;
use crate::systems::increments::Increments;
use form::LaggedForm;
use products::LaggedProducts;

/// E_k for k up to [`LARGEST_K`](LaggedEstimator::LARGEST_K).
#[derive(Clone, Debug)]
pub(super) struct LaggedEstimator<N> {
    k: usize,
    /// k, or a larger number for which there is a loop of fixed length.
    lags: usize,
    products: LaggedProducts<N>,
    /// The products of the newest states: a ring that is stored twice, so that the newest ones are contiguous wherever
    /// they begin.
    kept: Vec<N>,
    value: LaggedForm<N>,
    /// Without it no error is computed.
    last_term: Option<LaggedForm<N>>,
    /// The newest value, or those around the one whose error is computed.
    newest: Point<N>,
    error_estimate: ErrorEstimate<N>,
    /// q and p of the newest states, each in turn.
    states: Vec<N>,
    /// In place of what a step added, where that is not known.
    differences: Vec<N>,
    dimension: usize,
    /// The place of the newest.
    place: usize,
    pushed: usize,
    /// The first state of the window: the step to it is unknown, and those after it are known.
    begin: usize,
    /// The state after the newest one without increments.
    after_unknown: usize,
}

impl<N: Number> LaggedEstimator<N> {
    /// In larger windows the round-off of the weights, which is alike in all windows of a circular orbit, is more than
    /// the estimated error.
    pub(super) const LARGEST_K: u32 = 8;

    pub(super) fn new(k: u32, with_error: bool, h: &Rational, dimension: usize, context: &N::Context) -> Self {
        let zero = || N::zero(context);
        let with_error = with_error && k > 1;
        let around = if with_error { around(k) } else { 0 };
        let lags = if k <= 4 { 4 } else { 8 };
        let states = (k as usize).div_ceil(2) + around + 1;
        LaggedEstimator {
            k: k as usize,
            lags,
            products: LaggedProducts::new(lags, dimension, context),
            kept: vec![zero(); 2 * lags * lags],
            value: LaggedForm::new(lags, &form::value_weights(k, h), context),
            last_term: with_error.then(|| LaggedForm::new(lags, &form::last_term_weights(k, h), context)),
            newest: Point { value: zero(), last_term: zero(), order: k },
            error_estimate: ErrorEstimate::new(around, context),
            states: vec![zero(); states * 2 * dimension],
            differences: vec![zero(); 2 * dimension],
            dimension,
            place: 0,
            pushed: 0,
            begin: 0,
            after_unknown: 0,
        }
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        self.products.fields(to);
        to.numbers(&mut self.kept);
        self.newest.fields(to);
        self.error_estimate.fields(to);
        to.numbers(&mut self.states);
        to.place(&mut self.place, self.states.len() / (2 * self.dimension).max(1));
        let LaggedEstimator { pushed, begin, after_unknown, .. } = self;
        to.place(pushed, usize::MAX);
        [begin, after_unknown].into_iter().for_each(|n| to.place(n, *pushed + 1));
    }

    /// How many states an estimate needs.
    pub(super) fn states(&self) -> usize {
        self.k + 1 + 2 * self.error_estimate.around()
    }

    /// STATE: whether q and p of the estimates are wanted, for all states.
    #[inline(always)]
    pub(super) fn push<const STATE: bool>(
        &mut self,
        q: &[N],
        p: &[N],
        increments: Increments<'_, N>,
    ) -> Option<Estimate<'_, N>> {
        let is_complete = N::in_widest_instructions(
            #[inline(always)]
            || match self.lags {
                4 => self.add::<4>([q, p], increments),
                _ => self.add::<8>([q, p], increments),
            },
        );
        self.pushed += 1;
        // a state without increments, too: from it those to the next one follow
        if STATE || !increments.has_vectors() {
            self.keep(q, p);
        }
        if !is_complete {
            return None;
        }
        self.estimate::<STATE>(q.len())
    }

    /// Adds the products of the next state, and returns whether it ends a window of k known steps, whose value `newest`
    /// then is.
    #[inline(always)]
    fn add<const K: usize>(&mut self, [q, p]: [&[N]; 2], increments: Increments<'_, N>) -> bool {
        let place = self.pushed % K;
        let products: [N; K] = if increments.has_vectors() {
            // as many as coordinates, whose number may be known when this is compiled
            let added = [&increments.q[..q.len()], &increments.p[..p.len()]];
            self.products.of_state(place, [q, p], (added, increments.beta), self.pushed - self.begin)
        } else {
            self.products_by_differences(place, [q, p], increments.beta)
        };
        let is_complete = self.pushed >= self.begin + self.k;
        let (kept, _) = self.kept.as_chunks_mut::<K>();
        let before: &[[N; K]; K] = kept[place..].first_chunk().expect("they are there twice");
        if is_complete {
            self.value.evaluate(&products, before, &mut self.newest.value);
            if let Some(last_term) = &self.last_term {
                last_term.evaluate(&products, before, &mut self.newest.last_term);
                self.newest.last_term.make_absolute();
            }
        }
        kept[place].clone_from(&products);
        kept[place + K] = products;
        is_complete
    }

    /// The step to the first state of all is unknown, and does not affect a value.
    #[cold]
    fn products_by_differences<const K: usize>(&mut self, place: usize, [q, p]: [&[N]; 2], beta: &N) -> [N; K] {
        // a state without increments after one with them begins a window
        if self.after_unknown != self.pushed {
            self.begin = self.pushed;
        }
        self.after_unknown = self.pushed + 1;
        let before = &self.states[self.place * 2 * self.dimension..];
        for (own, (newest, before)) in self.differences.iter_mut().zip(q.iter().chain(p).zip(before)) {
            own.assign_difference(newest, before);
        }
        let added = self.differences.split_at(self.dimension).into();
        self.products.of_state(place, [q, p], (added, beta), self.pushed - self.begin)
    }

    #[inline(always)]
    fn keep(&mut self, q: &[N], p: &[N]) {
        let length = 2 * q.len();
        self.place = if (self.place + 1) * length < self.states.len() { self.place + 1 } else { 0 };
        let (own_q, own_p) = self.states[self.place * length..][..length].split_at_mut(q.len());
        copy(q, own_q);
        copy(p, own_p);
    }

    /// The state in the middle is the oldest that is kept.
    #[inline(always)]
    fn estimate<const STATE: bool>(&mut self, dimension: usize) -> Option<Estimate<'_, N>> {
        let (q, p): (&[N], &[N]) = if STATE {
            let length = 2 * dimension;
            let oldest = if (self.place + 1) * length < self.states.len() { self.place + 1 } else { 0 };
            self.states[oldest * length..][..length].split_at(dimension)
        } else {
            (&[], &[])
        };
        if self.last_term.is_none() {
            let Point { value, order, .. } = &self.newest;
            return Some(Estimate { value, last_term: None, error: None, order: *order, q, p, particles: (&[], &[]) });
        }
        self.error_estimate.next().assign(&self.newest);
        if !self.error_estimate.update() {
            return None;
        }
        let Point { value, last_term, order } = self.error_estimate.middle();
        let error = Some(self.error_estimate.error());
        Some(Estimate { value, last_term: Some(last_term), error, order: *order, q, p, particles: (&[], &[]) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Limbs;
    use crate::shadow::form::{Form, Products};
    use crate::shadow::weights::bilinear;
    use crate::systems::increments::OwnedIncrements;
    use crate::{Stepper, exact, steps::tables::shipped, systems::problems};

    /// Numbers between −1/2 and 1/2 that look random.
    fn noise(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        }
    }

    /// q, p, β, and what the step to them added.
    type State = (Vec<f64>, Vec<f64>, f64, OwnedIncrements<f64>);

    /// From increments that are exact: multiples of 2⁻²⁰.
    fn walk(dimension: usize, count: usize) -> Vec<State> {
        let mut next = noise(dimension as u64 + 17);
        let mut round = move || (next() * f64::from(1 << 20)).round() / f64::from(1 << 20);
        let (mut q, mut p, mut beta) = (vec![0.5; dimension], vec![0.25; dimension], 0.0);
        let mut step = || {
            let mut added = || (0..dimension).map(|_| round()).collect::<Vec<f64>>();
            let increments = OwnedIncrements { q: added(), p: added(), beta: added()[0] };
            q.iter_mut().zip(&increments.q).for_each(|(q, added)| *q += added);
            p.iter_mut().zip(&increments.p).for_each(|(p, added)| *p += added);
            beta += increments.beta;
            (q.clone(), p.clone(), beta, increments)
        };
        (0..count).map(|_| step()).collect()
    }

    /// P by its exact values.
    fn weights(k: u32) -> Vec<Vec<f64>> {
        let row = |row: &Vec<Rational>| row.iter().map(|weight| f64::from_rational(weight, &())).collect();
        bilinear(k).iter().map(row).collect()
    }

    /// E_k by its definition: from states and β.
    fn by_definition(weights: &[Vec<f64>], h: f64, states: &[State]) -> f64 {
        let newest = states.len() - 1;
        let mut sum = 0.0;
        for (lag, row) in (1..).zip(weights) {
            for (j, weight) in row.iter().enumerate() {
                let ((q_j, p_j, beta_j, _), (q_i, p_i, beta_i, _)) = (&states[newest - j], &states[newest - j - lag]);
                let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
                let pair = dot(q_i, p_j) - dot(p_i, q_j) + beta_j - beta_i;
                sum += weight * pair;
            }
        }
        sum / (2.0 * h)
    }

    /// For short and long states, with increments of q and p and without.
    #[test]
    fn values_are_those_of_the_definition() {
        for (k, dimension) in (1..=8).flat_map(|k| [(k, 1), (k, 3), (k, 8), (k, 69)]) {
            let states = walk(dimension, 3 * k as usize + 5);
            let of_orders = [weights(k), weights((k - 1).max(1))];
            for with_vectors in [true, false] {
                let mut estimator = LaggedEstimator::<f64>::new(k, true, &exact("0.5").unwrap(), dimension, &());
                let mut without_states = estimator.clone();
                for (n, (q, p, _, added)) in states.iter().enumerate() {
                    let added = if with_vectors { added.view() } else { Increments::of_beta(&added.beta) };
                    let values = |estimate: Estimate<'_, f64>| (*estimate.value, estimate.error.copied());
                    let of_values = without_states.push::<false>(q, p, added).map(values);
                    assert_eq!(
                        of_values,
                        estimator.clone().push::<true>(q, p, added).map(values),
                        "k = {k}, state {n}"
                    );
                    let error = estimator.push::<true>(q, p, added).map(|estimate| estimate.error.copied());
                    let k_states = k as usize + 1;
                    assert_eq!(error.is_some(), n + 1 >= estimator.states(), "k = {k}, state {n}");
                    if n + 1 < k_states {
                        continue;
                    }
                    let window = |end: usize, weights: &Vec<Vec<f64>>| {
                        by_definition(weights, 0.5, &states[end - weights.len()..=end])
                    };
                    let expected = window(n, &of_orders[0]);
                    // the walk goes to some √n, with weights of size 1
                    let tolerance = 1e-13 * f64::from(k) * dimension as f64;
                    let value = estimator.newest.value;
                    assert!((value - expected).abs() <= tolerance, "k = {k}, {dimension}: {value} {expected}");
                    if k > 1 {
                        let term = (expected - (window(n, &of_orders[1]) + window(n - 1, &of_orders[1])) / 2.0).abs();
                        let found = estimator.newest.last_term;
                        assert!((found - term).abs() <= tolerance, "k = {k}, {dimension}: {found} {term}");
                    }
                }
            }
        }
    }

    /// In windows with other steps between them, whose first states come without increments.
    #[test]
    fn values_of_windows_are_those_of_the_definition() {
        for (k, dimension) in (1..=8).flat_map(|k| [(k, 1), (k, 8), (k, 69)]) {
            let (states, weights) = (walk(dimension, 80), weights(k));
            let mut estimator = LaggedEstimator::<f64>::new(k, false, &exact("0.5").unwrap(), dimension, &());
            for window in states.chunks_exact(k as usize + 3).map(|states| &states[2..]) {
                let mut last = None;
                for (n, (q, p, _, added)) in window.iter().enumerate() {
                    let added = if n > 0 { added.view() } else { Increments::of_beta(&added.beta) };
                    last = estimator.push::<true>(q, p, added).map(|estimate| *estimate.value);
                    assert_eq!(last.is_some(), n == k as usize, "k = {k}: only the last state ends a window");
                }
                let (value, expected) = (last.unwrap(), by_definition(&weights, 0.5, window));
                // as above
                let tolerance = 1e-13 * f64::from(k) * dimension as f64;
                assert!((value - expected).abs() <= tolerance, "k = {k}, {dimension}: {value} {expected}");
            }
        }
    }

    /// The error of E_k by round-off, rms, by lags and by pairs of states, for the same states and increments: the
    /// right value is computed with four limbs.
    fn round_off(k: u32, problem: &str, h: &str) -> [f64; 2] {
        const STEPS: u32 = 500;
        let mut system = problems::problem(problem).unwrap().setup(&[], 20).unwrap().motion::<f64>(&()).unwrap();
        let dimension = system.q().len();
        let (stepper, h) = (Stepper::new(shipped("stormer-verlet").unwrap(), h).unwrap(), exact(h).unwrap());
        let mut right = LaggedEstimator::<Limbs<4>>::new(k, false, &h, dimension, &());
        let mut by_lags = LaggedEstimator::<f64>::new(k, false, &h, dimension, &());
        let mut products = Products::<f64>::new(k as usize + 1, k as usize, dimension, &());
        let mut form = Form::<f64>::new(k, false, &h, &());
        let limbs = |x: &f64| Limbs::<4>::from_rational(&Rational::from_float(*x).unwrap(), &());
        let [mut of_lags, mut of_pairs] = [0.0; 2];
        for _ in 0..STEPS {
            stepper.step_augmented(&mut system);
            let [q, p] = [system.q(), system.p()].map(|x| x.iter().map(limbs).collect::<Vec<_>>());
            let added = system.increments();
            let [dq, dp] = [added.q, added.p].map(|x| x.iter().map(limbs).collect::<Vec<_>>());
            let exact = Increments { q: &dq, p: &dp, beta: &limbs(added.beta) };
            let right = right.push::<true>(&q, &p, exact).map(|estimate| *estimate.value);
            by_lags.push::<true>(system.q(), system.p(), added);
            products.push(system.q(), system.p(), added);
            let Some(right) = right else { continue };
            form.add_value(&products, 0);
            form.error_estimate.update();
            let by_pairs = form.estimate(products.state(0)).value;
            let off = |x: &f64| {
                let mut off = limbs(x);
                off.subtract(&right);
                off.to_f64().powi(2)
            };
            of_lags += off(&by_lags.newest.value);
            of_pairs += off(by_pairs);
        }
        [of_lags, of_pairs].map(|squares| (squares / f64::from(STEPS)).sqrt())
    }

    /// Also near the round-off floor: there the estimates vary by nothing else.
    #[test]
    fn round_off_is_at_most_that_of_pairs() {
        let cases =
            [("kepler", "1/20"), ("kepler", "1/200"), ("outer-solar-system", "10"), ("outer-solar-system", "100")];
        for (k, (problem, h)) in [2, 4, 8].into_iter().flat_map(|k| cases.map(|case| (k, case))) {
            let [by_lags, by_pairs] = round_off(k, problem, h);
            assert!(by_lags <= by_pairs, "{problem}, k = {k}, h = {h}: {by_lags:e}, {by_pairs:e}");
        }
    }
}
