//! The bilinear estimator: products of the newest k + 1 states in pairs, of order 2k.
//!
//! The formula and its proof are in [`weights`](crate::shadow::weights).

use num_traits::Signed;
use shadowstep_schemes::symbolic::decimal::to_significant;

use crate::Rational;
use crate::number::saved::{Fields, Saved};
use crate::number::{Number, Real};
use crate::shadow::best_bilinear::BestOrder;
use crate::shadow::estimator::{BuildEstimator, Estimate, Estimator, EstimatorError};
use crate::shadow::family::Family;
use crate::shadow::form::{Form, Products};
use crate::shadow::lagged::LaggedEstimator;
use crate::shadow::options::EstimatorOptions;
use crate::steps::step_size::StepSize;
use crate::systems::increments::Increments;

/// The bilinear estimator E_k of order 2k from the newest k + 1 states, 1 ≤ k ≤ 256.
///
/// Its value belongs to the middle of these: for an odd k to the time between two states. A state costs k products of
/// vectors and some k²/2 of numbers; therefore a k above [`LARGEST_K`](Self::LARGEST_K) is refused.
///
/// **Its error** is estimated by the larger of two: the range, max − min over the 1 + ⌈√k⌉ windows on either side (the
/// modified energy is constant, so what changes from window to window is the estimator's error, or round-off), and the
/// largest of their last terms |E_k − E_{k−1}|, the mean of E_{k−1} over the two windows within. The range alone does
/// not detect an error that is the same everywhere, as on a circular orbit; the difference alone has zeros. That needs
/// 1 + ⌈√k⌉ states more on each side; see [Errors](crate::shadow#errors). For k = 1 there is no E_{k−1}, and no
/// estimate.
///
/// ```
/// use shadowstep::{Motion, Stepper, UnitMasses, problems::Kepler, shadow::run::energy_drift, shadow::Bilinear, tables::shipped};
///
/// let start = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0])?; // eccentricity 0.6
/// let verlet = Stepper::new(shipped("stormer-verlet").unwrap(), "1/40")?;
/// let drift = energy_drift(verlet.with(start), 400, &Bilinear::new(16))?;
/// assert!(drift.drift < 1e-12); // the energy itself varies by 0.01
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// **The best k of each state** is taken from the ladder 2, 4, 8, …, up to the largest even one allowed: the smallest k
/// whose estimated error is at most the target error. Where there is none, or no target error is set, it is the
/// smallest k whose estimated error is at most twice the least of all: where more states would only add round-off, or
/// where a close encounter sets a limit, k stays small. [`Estimate::order`] is the k used.
///
/// All k of the ladder are computed at every state, whatever the target error, as an error is known only with the
/// estimates of neighbouring windows: K products of vectors and some ⅔K² of numbers a state, K the largest k; and K/2 +
/// 1 + ⌈√K⌉ states on each side. What a longer ladder gains: the largest error of an orbit of the exact flow of
/// Kepler's problem, at 120 digits,
///
/// | K | e = 0.3, h = 1/20 | e = 0.6, h = 1/10 | 1/20 | 1/40 | e = 0.9, h = 1/40 |
/// | --- | --- | --- | --- | --- | --- |
/// | 16 | 1.4e-25 | 3.0e-7 | 1.4e-12 | 4.0e-20 | 4.4e-3 |
/// | 32 | 2.1e-34 | 5.2e-8 | 2.0e-14 | 2.3e-25 | 4.4e-3 |
/// | 64 | 1.7e-41 | 1.6e-8 | 1.4e-15 | 5.7e-29 | 2.6e-3 |
/// | 128 | 6.6e-46 | 7.0e-9 | 2.9e-16 | 3.8e-31 | 1.7e-3 |
///
/// K = 64 takes some 2 900 products of numbers a state, a fourth of what 128 takes.
///
/// ```
/// use shadowstep::{Motion, Stepper, UnitMasses, exact, problems::Kepler, shadow::run::ShadowRun, tables::shipped};
/// use shadowstep::shadow::Bilinear;
///
/// let start = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0])?; // eccentricity 0.6
/// let verlet = Stepper::new(shipped("stormer-verlet").unwrap(), "1/40")?;
/// let mut run = ShadowRun::new(verlet.with(start), 125, &Bilinear::best_to(64, exact("1e-10")?))?;
/// let mut orders = Vec::new();
/// while let Some((_, found)) = run.advance()? {
///     assert!(*found.error.unwrap() <= 1e-10);
///     orders.push(found.order);
/// }
/// assert!(orders[0] > orders[125]); // pericentre and apocentre
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Bilinear {
    /// One k ≥ 1.
    Fixed {
        /// Half the order; one less than the states. At most [`Bilinear::LARGEST_K`].
        k: u32,
        /// Whether the last term and the error are computed as well.
        with_error: bool,
    },
    /// The best k of each state.
    Best {
        /// The largest k allowed, 2 to [`Bilinear::LARGEST_K`]; an odd one stands for the even one below it.
        largest: u32,
        /// The target error, in the units of the energy; `None` for the smallest possible.
        accuracy: Option<Rational>,
    },
}

impl Bilinear {
    /// The largest k, which takes some 33 000 products of numbers a state.
    pub const LARGEST_K: u32 = 256;

    /// E_k; no estimate of the error.
    pub fn new(k: u32) -> Self {
        Bilinear::Fixed { k, with_error: false }
    }

    /// E_k with an estimate of its error for k ≥ 2.
    pub fn with_error(k: u32) -> Self {
        Bilinear::Fixed { k, with_error: true }
    }

    /// The best k of each state, of 2, 4, 8, 16, … and `largest`: as accurate as the step size, these k and the
    /// precision allow.
    pub fn best(largest: u32) -> Self {
        Bilinear::Best { largest, accuracy: None }
    }

    /// For each state the least k of 2, 4, 8, 16, … and `largest` that meets a target error; the best of them where
    /// none does.
    pub fn best_to(largest: u32, accuracy: Rational) -> Self {
        Bilinear::Best { largest, accuracy: Some(accuracy) }
    }
}

/// The largest k that is tried by default.
const DEFAULT_LARGEST_K: u32 = 64;

impl Family for Bilinear {
    const NAME: &'static str = "bilinear";
    const SUMMARY: &'static str =
        "Products of states in pairs E_k: k + 1 states, order 2k; for an odd k between two states";
    const LETTER: &'static str = "k";
    const HIGHEST_ORDER: u32 = Bilinear::LARGEST_K;
    const AUTO_OPTIONS: &'static [&'static str] = &["max_order", "accuracy"];

    fn from_options(options: EstimatorOptions) -> Self {
        match options.order {
            Some(k) => Bilinear::new(k),
            None => {
                Bilinear::Best { largest: options.max_order.unwrap_or(DEFAULT_LARGEST_K), accuracy: options.accuracy }
            }
        }
    }

    fn options(&self) -> EstimatorOptions {
        match self {
            Bilinear::Fixed { k, .. } => EstimatorOptions { order: Some(*k), ..Default::default() },
            Bilinear::Best { largest, accuracy } => {
                EstimatorOptions { max_order: Some(*largest), accuracy: accuracy.clone(), ..Default::default() }
            }
        }
    }

    fn set_errors(&mut self, wanted: bool) {
        if let Bilinear::Fixed { with_error, .. } = self {
            *with_error = wanted;
        }
    }

    fn is_between(&self) -> bool {
        matches!(self, Bilinear::Fixed { k, .. } if k % 2 == 1)
    }

    fn description(&self) -> String {
        match self {
            Bilinear::Fixed { k, .. } => format!("products of {} states, k = {k}", u64::from(*k) + 1),
            Bilinear::Best { largest, accuracy: None } => format!("products of states, the best k of 2–{largest}"),
            Bilinear::Best { largest, accuracy: Some(accuracy) } => {
                let accuracy = to_significant(accuracy, 6);
                format!("products of states, the best k of 2–{largest} for an accuracy of {accuracy}")
            }
        }
    }
}

impl<N: Real> BuildEstimator<N> for Bilinear {
    type Estimator = BilinearEstimator<N>;

    /// # Errors
    /// k = 0, a largest k below 2, one above [`Bilinear::LARGEST_K`], or a negative target error.
    fn build(&self, h: &StepSize, dimension: usize, context: &N::Context) -> Result<Self::Estimator, EstimatorError> {
        Ok(BilinearEstimator(match self {
            Bilinear::Fixed { k, with_error } => {
                FixedOrBest::Fixed(FixedBilinear { k: *k, with_error: *with_error }.build(h, dimension, context)?)
            }
            Bilinear::Best { largest, accuracy } => {
                EstimatorError::check_order("the largest k", *largest, 2)?;
                EstimatorError::check_high_order("the largest k", *largest, Bilinear::LARGEST_K)?;
                if accuracy.as_ref().is_some_and(Signed::is_negative) {
                    return Err(EstimatorError::NegativeAccuracy);
                }
                FixedOrBest::Best(BestOrder::new(*largest, accuracy.as_ref(), h.exact(), dimension, context))
            }
        }))
    }
}

/// The estimator that [`Bilinear`] describes.
#[derive(Clone, Debug)]
pub struct BilinearEstimator<N>(FixedOrBest<N>);

#[derive(Clone, Debug)]
enum FixedOrBest<N> {
    Fixed(FixedBilinearEstimator<N>),
    Best(BestOrder<N>),
}

impl<N: Real> Estimator<N> for BilinearEstimator<N> {
    fn states(&self) -> usize {
        match &self.0 {
            FixedOrBest::Fixed(fixed) => fixed.states(),
            FixedOrBest::Best(best) => best.states(),
        }
    }

    #[inline(always)]
    fn push(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) -> Option<Estimate<'_, N>> {
        self.push_state::<true>(q, p, increments)
    }

    #[inline(always)]
    fn push_for_value(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) -> Option<Estimate<'_, N>> {
        self.push_state::<false>(q, p, increments)
    }
}

impl<N: Real> Saved<N> for BilinearEstimator<N> {
    fn fields(&mut self, to: &mut dyn Fields<N>) {
        match &mut self.0 {
            FixedOrBest::Fixed(FixedBilinearEstimator(By::Increments(lagged))) => lagged.fields(to),
            FixedOrBest::Fixed(FixedBilinearEstimator(By::Pairs(products, form))) => {
                products.fields(to);
                form.error_estimate.fields(to);
            }
            FixedOrBest::Best(best) => best.fields(to),
        }
    }
}

impl<N: Real> BilinearEstimator<N> {
    /// STATE: whether q and p of the estimates are wanted.
    #[inline(always)]
    fn push_state<const STATE: bool>(
        &mut self,
        q: &[N],
        p: &[N],
        increments: Increments<'_, N>,
    ) -> Option<Estimate<'_, N>> {
        match &mut self.0 {
            FixedOrBest::Fixed(fixed) => fixed.push_state::<STATE>(q, p, increments),
            FixedOrBest::Best(best) => best.push(q, p, increments),
        }
    }
}

/// E_k at one k. Nothing is compared, so that it works also on numbers without an order, such as
/// [lanes](crate::number::Lanes).
///
/// ```
/// use shadowstep::number::Lanes;
/// use shadowstep::shadow::{BuildEstimator, Estimator, FixedBilinear};
/// use shadowstep::{Motion, Stepper, UnitMasses, problems::Kepler, tables::shipped};
///
/// let verlet = Stepper::new(shipped("stormer-verlet").unwrap(), "1/20")?;
/// let q = [Lanes([0.4, 0.5, 0.6, 0.7]), Lanes::all(0.0)];
/// let mut motion = Motion::new(Kepler, UnitMasses, q, [Lanes::all(0.0), Lanes::all(1.2)])?;
/// let energy = motion.energy();
/// let mut estimator = FixedBilinear::new(8).build(verlet.step_size(), 2, &())?;
/// for n in 0..100 {
///     if let Some(estimate) = estimator.push(motion.q(), motion.p(), motion.increments()) {
///         assert!((estimate.value.0[3] - energy.0[3]).abs() < 1e-2, "step {n}, lane 3");
///     }
///     verlet.step_augmented(&mut motion);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedBilinear {
    k: u32,
    with_error: bool,
}

impl FixedBilinear {
    /// E_k without an estimate of its error.
    pub fn new(k: u32) -> Self {
        FixedBilinear { k, with_error: false }
    }

    /// E_k with its last term and an estimate of its error, for k ≥ 2.
    pub fn with_error(k: u32) -> Self {
        FixedBilinear { k, with_error: true }
    }
}

impl<N: Number> BuildEstimator<N> for FixedBilinear {
    type Estimator = FixedBilinearEstimator<N>;

    /// # Errors
    /// k = 0, or above [`Bilinear::LARGEST_K`].
    fn build(&self, h: &StepSize, dimension: usize, context: &N::Context) -> Result<Self::Estimator, EstimatorError> {
        EstimatorError::check_order("k", self.k, 1)?;
        EstimatorError::check_high_order("k", self.k, Bilinear::LARGEST_K)?;
        Ok(FixedBilinearEstimator::new(self.k, self.with_error, h.exact(), dimension, context))
    }
}

/// E_k at one k.
#[derive(Clone, Debug)]
pub struct FixedBilinearEstimator<N>(By<N>);

/// How E_k is computed.
#[derive(Clone, Debug)]
enum By<N> {
    Increments(LaggedEstimator<N>),
    Pairs(Products<N>, Form<N>),
}

impl<N: Number> FixedBilinearEstimator<N> {
    /// STATE: whether q and p of the estimates are wanted.
    #[inline(always)]
    fn push_state<const STATE: bool>(
        &mut self,
        q: &[N],
        p: &[N],
        increments: Increments<'_, N>,
    ) -> Option<Estimate<'_, N>> {
        match &mut self.0 {
            By::Increments(lagged) => lagged.push::<STATE>(q, p, increments),
            By::Pairs(products, form) => push_pairs(products, form, (q, p), increments),
        }
    }

    fn new(k: u32, with_error: bool, h: &Rational, dimension: usize, context: &N::Context) -> Self {
        if N::KEEPS_INCREMENTS && k <= LaggedEstimator::<N>::LARGEST_K {
            return FixedBilinearEstimator(By::Increments(LaggedEstimator::new(k, with_error, h, dimension, context)));
        }
        let form = Form::new(k, with_error, h, context);
        let states = form.k().max(form.delay()) + 1;
        FixedBilinearEstimator(By::Pairs(Products::new(states, form.k(), dimension, context), form))
    }
}

impl<N: Number> Estimator<N> for FixedBilinearEstimator<N> {
    fn states(&self) -> usize {
        match &self.0 {
            By::Increments(lagged) => lagged.states(),
            By::Pairs(_, form) => form.k() + 1 + 2 * form.error_estimate.around(),
        }
    }

    #[inline(always)]
    fn push(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) -> Option<Estimate<'_, N>> {
        self.push_state::<true>(q, p, increments)
    }

    #[inline(always)]
    fn push_for_value(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) -> Option<Estimate<'_, N>> {
        self.push_state::<false>(q, p, increments)
    }
}

fn push_pairs<'a, N: Number>(
    products: &'a mut Products<N>,
    form: &'a mut Form<N>,
    (q, p): (&[N], &[N]),
    increments: Increments<'_, N>,
) -> Option<Estimate<'a, N>> {
    products.push(q, p, increments);
    if products.reach() < form.k() {
        return None;
    }
    form.add_value(products, 0);
    form.error_estimate.update().then(|| form.estimate(products.state(form.delay())))
}
