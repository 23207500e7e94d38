//! The paper's estimator: central differences D_m, at a fixed m or the best of all.

use num_traits::Zero;

use crate::Rational;
use crate::number::{Number, Real};
use crate::shadow::differences::AllOrders;
use crate::shadow::differences::{SelectionRule, StoppingRule};
use crate::shadow::error_estimate::{ErrorEstimate, Point};
use crate::shadow::estimator::{BuildEstimator, Estimate, Estimator, EstimatorError};
use crate::shadow::family::Family;
use crate::shadow::options::{EstimatorOptions, HIGHEST_ORDER};
use crate::shadow::weights::central;
use crate::shadow::window::Window;
use crate::steps::step_size::StepSize;
use crate::systems::increments::Increments;

/// Central differences (Moan & Niesen): T_{m,m} = ½(−qᵀD_m p + pᵀD_m q − D_m β).
///
/// **Its error** is estimated by the larger of two: the range, max − min of the values at the state and at three states
/// on either side, and the largest of their last terms |T_{m,m} − T_{m−1,m−1}|. That needs three states more on each
/// side; see [Errors](crate::shadow#errors). For m = 1 there is no term before the last, and no estimate.
///
/// ```
/// use shadowstep::{Motion, Stepper, UnitMasses, problems::Kepler, shadow::run::ShadowRun, tables::shipped};
/// use shadowstep::shadow::{Central, SelectionRule, StoppingRule};
///
/// let start = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0])?; // eccentricity 0.6
/// let verlet = Stepper::new(shipped("stormer-verlet").unwrap(), "1/20")?;
/// let best = Central::best_with_error(40, StoppingRule::Full, SelectionRule::Robust);
/// let mut run = ShadowRun::new(verlet.with(start), 100, &best)?;
/// while let Some((_, found)) = run.advance()? {
///     assert!((found.value + 0.490_943_1).abs() < 1e-6);
///     assert!(*found.error.unwrap() < 1e-6); // the largest is near the pericentre
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Central {
    /// One m ≥ 1.
    Fixed {
        /// The m of D_m.
        m: u32,
        /// Whether the last term and the error are computed as well.
        with_error: bool,
    },
    /// The best m of each state.
    Best {
        /// The largest m allowed, at least 2.
        largest: u32,
        /// Where the search ends.
        stop: StoppingRule,
        /// Which m is the best.
        rule: SelectionRule,
        /// Whether the error is computed as well; the last term always is.
        with_error: bool,
    },
}

/// The number of values on either side from which the error is estimated.
///
/// Near a close encounter errors alternate in sign, so that a few are enough. On the orbits of the table in `shadow`,
/// at 150 digits, the largest true error/estimate of the best m ≤ 20 by the least term is 4.0 with one, 1.0 with two
/// and 0.98 with three. With five it is not less, and the estimates of most states are three times as large.
const AROUND: usize = 3;

impl Central {
    /// D_m at one m ≥ 1; no estimate of the error.
    pub fn fixed(m: u32) -> Self {
        Central::Fixed { m, with_error: false }
    }

    /// D_m at one m, with an estimate of its error for m ≥ 2.
    pub fn fixed_with_error(m: u32) -> Self {
        Central::Fixed { m, with_error: true }
    }

    /// The paper's best: at each state the m of 2..=`largest` with the smallest |T_{m,m} − T_{m−1,m−1}|, the first of
    /// equal ones; no estimate of the error.
    pub fn best(largest: u32, stop: StoppingRule) -> Self {
        Central::Best { largest, stop, rule: SelectionRule::Least, with_error: false }
    }

    /// At each state the m of 2..=`largest` that is the best by a rule, with an estimate of its error.
    pub fn best_with_error(largest: u32, stop: StoppingRule, rule: SelectionRule) -> Self {
        Central::Best { largest, stop, rule, with_error: true }
    }
}

/// The largest m that is tried by default.
const DEFAULT_LARGEST_M: u32 = 200;

impl Family for Central {
    const NAME: &'static str = "central";
    const SUMMARY: &'static str = "Central differences D_m: 2m + 1 states, order 2m";
    const LETTER: &'static str = "m";
    const HIGHEST_ORDER: u32 = HIGHEST_ORDER;
    const AUTO_OPTIONS: &'static [&'static str] = &["max_order", "stop", "rule"];

    fn from_options(options: EstimatorOptions) -> Self {
        match options.order {
            Some(m) => Central::fixed(m),
            None => Central::Best {
                largest: options.max_order.unwrap_or(DEFAULT_LARGEST_M),
                stop: options.stop.unwrap_or(StoppingRule::Full),
                rule: options.rule.unwrap_or(SelectionRule::Least),
                with_error: false,
            },
        }
    }

    fn options(&self) -> EstimatorOptions {
        match *self {
            Central::Fixed { m, .. } => EstimatorOptions { order: Some(m), ..Default::default() },
            Central::Best { largest, stop, rule, .. } => {
                EstimatorOptions { max_order: Some(largest), stop: Some(stop), rule: Some(rule), ..Default::default() }
            }
        }
    }

    fn set_errors(&mut self, wanted: bool) {
        let (Central::Fixed { with_error, .. } | Central::Best { with_error, .. }) = self;
        *with_error = wanted;
    }

    fn is_between(&self) -> bool {
        false
    }

    fn description(&self) -> String {
        match self {
            Central::Fixed { m, .. } => format!("central differences, m = {m}"),
            Central::Best { largest, stop, rule, .. } => {
                let by = if *rule == SelectionRule::Robust { " by the robust rule" } else { "" };
                let end = match stop {
                    StoppingRule::Full => "",
                    StoppingRule::Early => " before errors rise",
                    StoppingRule::Printed => " before the first ripple",
                };
                format!("central differences, the best m of 2–{largest}{by}{end}")
            }
        }
    }
}

impl<N: Real> BuildEstimator<N> for Central {
    type Estimator = CentralEstimator<N>;

    /// # Errors
    /// m = 0, or a largest m below 2.
    fn build(
        &self,
        step_size: &StepSize,
        dimension: usize,
        context: &N::Context,
    ) -> Result<Self::Estimator, EstimatorError> {
        let h = step_size.exact();
        Ok(CentralEstimator(match *self {
            Central::Fixed { m, with_error } => {
                FixedOrBest::Fixed(FixedCentral { m, with_error }.build(step_size, dimension, context)?)
            }
            Central::Best { largest, stop, rule, with_error } => {
                EstimatorError::check_order("the largest m", largest, 2)?;
                let around = with_error.then_some(AROUND);
                FixedOrBest::Best(AllOrders::new((largest, stop, rule), around, h, dimension, context))
            }
        }))
    }
}

/// The estimator that [`Central`] describes.
#[derive(Clone, Debug)]
pub struct CentralEstimator<N>(FixedOrBest<N>);

#[derive(Clone, Debug)]
enum FixedOrBest<N> {
    Fixed(FixedCentralEstimator<N>),
    Best(AllOrders<N>),
}

impl<N: Real> Estimator<N> for CentralEstimator<N> {
    fn states(&self) -> usize {
        match &self.0 {
            FixedOrBest::Fixed(fixed) => fixed.states(),
            FixedOrBest::Best(best) => best.states(),
        }
    }

    fn push(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) -> Option<Estimate<'_, N>> {
        match &mut self.0 {
            FixedOrBest::Fixed(fixed) => fixed.push(q, p, increments),
            FixedOrBest::Best(best) => best.push(q, p, increments),
        }
    }
}

/// D_m at one m. Nothing is compared, so that it works also on numbers without an order, such as
/// [lanes](crate::number::Lanes).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedCentral {
    m: u32,
    with_error: bool,
}

impl FixedCentral {
    /// D_m without an estimate of its error.
    pub fn new(m: u32) -> Self {
        FixedCentral { m, with_error: false }
    }

    /// D_m with its last term and an estimate of its error, for m ≥ 2.
    pub fn with_error(m: u32) -> Self {
        FixedCentral { m, with_error: true }
    }
}

impl<N: Number> BuildEstimator<N> for FixedCentral {
    type Estimator = FixedCentralEstimator<N>;

    /// # Errors
    /// m = 0.
    fn build(&self, h: &StepSize, dimension: usize, context: &N::Context) -> Result<Self::Estimator, EstimatorError> {
        EstimatorError::check_order("m", self.m, 1)?;
        Ok(FixedCentralEstimator::new(self.m, self.with_error, h.exact(), dimension, context))
    }
}

/// D_m at one m, by products of pairs.
///
/// With B(i,k) = q_i·p_k − p_i·q_k + (β_k − β_i), i < k, the estimate at n is
/// T_{m,m} = −1/(2h) Σ_j d_{m,j} (B(n, n+j) + B(n−j, n)), so each pair of states is multiplied once and serves both.
#[derive(Clone, Debug)]
pub struct FixedCentralEstimator<N> {
    m: usize,
    /// d_{m,j}/(2h)
    weights: Vec<N>,
    /// (d_{m,j} − d_{m−1,j})/(2h), for the last term alone; empty where no error is computed
    last_term: Vec<N>,
    /// The newest m + 1 states, and those whose values are there already; and what their values are so far.
    window: Window<N>,
    sums: Vec<Sums<N>>,
    /// B(n−j, n) for the newest state n
    pairs: Vec<N>,
    product: N,
    error_estimate: ErrorEstimate<N>,
}

#[derive(Clone, Debug)]
struct Sums<N> {
    value: N,
    last_term: N,
}

impl<N: Number> FixedCentralEstimator<N> {
    fn new(m: u32, with_error: bool, h: &Rational, dimension: usize, context: &N::Context) -> Self {
        let twice_h = h * Rational::from_integer(2.into());
        let zero = N::zero(context);
        let number = |weight: Rational| N::from_rational(&(weight / &twice_h), context);
        let last_term: Vec<N> = last_term_weights(m, with_error).into_iter().map(number).collect();
        let around = if last_term.is_empty() { 0 } else { AROUND };
        let (m, states) = (m as usize, m as usize + 1 + around);
        FixedCentralEstimator {
            m,
            weights: central(m as u32).iter().map(|d| number(d.clone())).collect(),
            last_term,
            window: Window::new(states, dimension, context),
            sums: vec![Sums { value: zero.clone(), last_term: zero.clone() }; states],
            pairs: vec![zero.clone(); m],
            product: zero,
            error_estimate: ErrorEstimate::new(around, context),
        }
    }

    /// Adds the pair of the newest state and the one j places before it to the estimates at both.
    fn add_pair(&mut self, j: usize) {
        let places = [self.window.place(j), self.window.place(0)];
        let pair = &self.pairs[j - 1];
        self.product.assign_product(&self.weights[j - 1], pair);
        places.iter().for_each(|&place| self.sums[place].value.subtract(&self.product));
        if let Some(weight) = self.last_term.get(j - 1) {
            self.product.assign_product(weight, pair);
            places.iter().for_each(|&place| self.sums[place].last_term.subtract(&self.product));
        }
    }
}

impl<N: Number> Estimator<N> for FixedCentralEstimator<N> {
    fn states(&self) -> usize {
        2 * (self.m + self.error_estimate.around()) + 1
    }

    fn push(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) -> Option<Estimate<'_, N>> {
        self.window.push(q, p, increments);
        let newest = &mut self.sums[self.window.place(0)];
        newest.value.assign_zero();
        newest.last_term.assign_zero();
        for j in 1..=self.window.pairs(&mut self.pairs) {
            self.add_pair(j);
        }
        if self.window.pushed() <= 2 * self.m {
            return None;
        }
        let sums = &self.sums[self.window.place(self.m)];
        let point = self.error_estimate.next();
        point.value.assign(&sums.value);
        point.last_term.assign(&sums.last_term);
        point.last_term.make_absolute();
        if !self.error_estimate.update() {
            return None;
        }
        let Point { value, last_term, .. } = self.error_estimate.middle();
        let known = !self.last_term.is_empty();
        let (q, p) = self.window.state(self.m + self.error_estimate.around());
        Some(Estimate {
            value,
            last_term: known.then_some(last_term),
            error: known.then(|| self.error_estimate.error()),
            order: self.m as u32,
            q,
            p,
            particles: (&[], &[]),
        })
    }
}

/// d_{m,j} − d_{m−1,j}, j = 1..m; none for m = 1, whose one term is the derivative itself and no error.
fn last_term_weights(m: u32, with_error: bool) -> Vec<Rational> {
    if !with_error || m == 1 {
        return Vec::new();
    }
    let (this, last) = (central(m), central(m - 1));
    let before = |j: usize| last.get(j).cloned().unwrap_or_else(Rational::zero);
    this.iter().enumerate().map(|(j, weight)| weight - before(j)).collect()
}
