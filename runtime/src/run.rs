//! Trajectories with the states that an estimator needs on both sides, and the energy drift.

use num_traits::Zero;
use thiserror::Error;

use crate::Rational;
use crate::kinetic::Kinetic;
use crate::motion::{Coordinates, Motion};
use crate::number::Number;
use crate::potential::Potential;
use crate::scheme::{Moves, Scheme, Weights};
use crate::shadow::{Estimate, Estimator, Method};

/// A run that cannot go on.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum RunError {
    /// h = 0.
    #[error("a step of size 0 leads nowhere; a step has a size, such as 1/10")]
    ZeroStep,
    /// A step led to an infinity or to something that is not a number.
    #[error("the run ends at step {step} with {what}; a smaller step or another start may go on")]
    NotFinite {
        /// n of the state that is not finite (negative before the start).
        step: i64,
        /// The first such value: `q1 = NaN`.
        what: String,
    },
}

/// A state of a trajectory.
#[derive(Clone, Copy, Debug)]
pub struct State<'a, N> {
    /// Its number: t = n h.
    pub n: i64,
    /// Positions.
    pub q: &'a [N],
    /// Momenta.
    pub p: &'a [N],
    /// What the step to it added to β.
    pub beta: &'a N,
}

/// A state made before it is its turn.
struct Stored<N> {
    q: Vec<N>,
    p: Vec<N>,
    beta: N,
}

/// The states n = −reach, …, steps + reach of a trajectory in the order of time, with the β of each step.
///
/// States before 0 are made with the scheme's exact inverse from the state 0.
pub struct Trajectory<'s, S: Scheme, N: Number, V, P, K> {
    scheme: &'s S,
    weights: Weights<S::Array<N>>,
    motion: Motion<N, V, P, K>,
    /// The states up to 0, the earliest last.
    before: Vec<Stored<N>>,
    present: Option<Stored<N>>,
    n: i64,
    last: i64,
}

impl<'s, S, N, V, P, K> Trajectory<'s, S, N, V, P, K>
where
    S: Scheme + Moves<K::Class>,
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
{
    /// Begins at the motion's present state with steps of size h.
    ///
    /// # Errors
    /// A step of size 0; an initial energy, or a state before 0, that is not finite.
    pub fn new(
        scheme: &'s S,
        mut motion: Motion<N, V, P, K>,
        h: &Rational,
        steps: u64,
        reach: usize,
    ) -> Result<Self, RunError> {
        if h.is_zero() {
            return Err(RunError::ZeroStep);
        }
        let energy = motion.energy();
        if !energy.is_finite() {
            let what = format!("an energy of {}", energy.to_text());
            return Err(RunError::NotFinite { step: 0, what });
        }
        let weights = scheme.weights::<N>(h, &motion.context());
        let (q, p) = (motion.q().to_vec(), motion.p().to_vec());
        let mut before = Vec::with_capacity(reach + 1);
        let mut later = (q.clone(), p.clone());
        for n in 1..=reach as i64 {
            scheme.step_back_augmented(&weights, &mut motion);
            check(&motion, -n)?;
            // the step from −n to −n + 1 adds what the step back took
            let mut beta = motion.beta().clone();
            beta.negate();
            let (q, p) = std::mem::replace(&mut later, (motion.q().to_vec(), motion.p().to_vec()));
            before.push(Stored { q, p, beta });
        }
        before.push(Stored { q: later.0, p: later.1, beta: N::zero(&motion.context()) });
        motion.q_mut().iter_mut().zip(&q).for_each(|(own, q)| own.assign(q));
        motion.p_mut().iter_mut().zip(&p).for_each(|(own, p)| own.assign(p));
        let last = i64::try_from(steps).unwrap_or(i64::MAX).saturating_add(reach as i64);
        Ok(Trajectory { scheme, weights, motion, before, present: None, n: -(reach as i64) - 1, last })
    }

    /// Goes to the next state; `None` at the end.
    ///
    /// # Errors
    /// A state that is not finite.
    pub fn advance(&mut self) -> Result<Option<State<'_, N>>, RunError> {
        if self.n == self.last {
            return Ok(None);
        }
        self.n += 1;
        let n = self.n;
        self.present = self.before.pop();
        if let Some(Stored { q, p, beta }) = &self.present {
            return Ok(Some(State { n, q, p, beta }));
        }
        self.scheme.step_augmented(&self.weights, &mut self.motion);
        check(&self.motion, n)?;
        let motion = &self.motion;
        Ok(Some(State { n, q: motion.q(), p: motion.p(), beta: motion.beta() }))
    }

    /// The system, for energies and counts.
    pub fn motion(&mut self) -> &mut Motion<N, V, P, K> {
        &mut self.motion
    }
}

fn check<N, V, P, K>(motion: &Motion<N, V, P, K>, step: i64) -> Result<(), RunError>
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
{
    if motion.is_finite() {
        return Ok(());
    }
    let named = |name: &'static str, values: &[N]| {
        let index = values.iter().position(|x| !x.is_finite())?;
        Some(format!("{name}{} = {}", index + 1, values[index].to_text()))
    };
    let what = named("q", motion.q())
        .or_else(|| named("p", motion.p()))
        .unwrap_or_else(|| format!("beta = {}", motion.beta().to_text()));
    Err(RunError::NotFinite { step, what })
}

/// A trajectory with the modified energies of its states n = 0, …, steps.
pub struct ShadowRun<'s, S: Scheme, N: Number, V, P, K, E> {
    trajectory: Trajectory<'s, S, N, V, P, K>,
    estimator: E,
    reach: i64,
}

impl<'s, S, N, V, P, K, E> ShadowRun<'s, S, N, V, P, K, E>
where
    S: Scheme + Moves<K::Class>,
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
    E: Estimator<N>,
{
    /// Begins at the motion's present state; makes the states before it that the estimator needs.
    ///
    /// # Errors
    /// As [`Trajectory::new`].
    pub fn new(
        scheme: &'s S,
        motion: Motion<N, V, P, K>,
        h: &Rational,
        steps: u64,
        method: &impl Method<N, Estimator = E>,
    ) -> Result<Self, RunError> {
        if h.is_zero() {
            return Err(RunError::ZeroStep);
        }
        let estimator = method.estimator(h, motion.q().len(), &motion.context());
        let reach = estimator.reach();
        let trajectory = Trajectory::new(scheme, motion, h, steps, reach)?;
        Ok(ShadowRun { trajectory, estimator, reach: reach as i64 })
    }

    /// The next n with its estimate; `None` after n = steps.
    ///
    /// # Errors
    /// A state that is not finite, up to the last one that the estimator needs, or a modified energy that is not.
    pub fn advance(&mut self) -> Result<Option<(i64, Estimate<'_, N>)>, RunError> {
        loop {
            let Some(State { n, q, p, beta }) = self.trajectory.advance()? else { return Ok(None) };
            if n < self.reach {
                self.estimator.push(q, p, beta);
                continue;
            }
            let Some(estimate) = self.estimator.push(q, p, beta) else { return Ok(None) };
            let n = n - self.reach;
            // states may be finite where their products overflow
            if !estimate.value.is_finite() {
                let what = format!("a modified energy of {}", estimate.value.to_text());
                return Err(RunError::NotFinite { step: n, what });
            }
            return Ok(Some((n, estimate)));
        }
    }

    /// The system, for energies and counts.
    pub fn motion(&mut self) -> &mut Motion<N, V, P, K> {
        self.trajectory.motion()
    }
}

/// The modified energy over a run.
#[derive(Clone, Debug, PartialEq)]
pub struct EnergyDrift<N> {
    /// maximum − minimum over n = 0..=steps: the paper's drift.
    pub drift: N,
    /// The least modified energy.
    pub minimum: N,
    /// The largest.
    pub maximum: N,
    /// The first n with the least.
    pub at_minimum: i64,
    /// The first n with the largest.
    pub at_maximum: i64,
    /// At n = 0.
    pub first: N,
    /// At n = steps.
    pub last: N,
    /// The least and the largest m used.
    pub orders: (u32, u32),
    /// Evaluations of the gradient, those for the states on both sides included.
    pub evaluations: u64,
}

/// Runs over n = 0..=steps and keeps the extremes of the modified energy; `progress` hears of each n.
///
/// # Errors
/// A step of size 0, a state or a modified energy that is not finite.
pub fn energy_drift<S, N, V, P, K>(
    scheme: &S,
    motion: Motion<N, V, P, K>,
    h: &Rational,
    steps: u64,
    method: &impl Method<N>,
    mut progress: impl FnMut(i64),
) -> Result<EnergyDrift<N>, RunError>
where
    S: Scheme + Moves<K::Class>,
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
{
    let mut run = ShadowRun::new(scheme, motion, h, steps, method)?;
    let mut found: Option<EnergyDrift<N>> = None;
    while let Some((n, estimate)) = run.advance()? {
        match &mut found {
            None => found = Some(EnergyDrift::begin(&estimate)),
            Some(found) => found.include(n, &estimate),
        }
        progress(n);
    }
    let mut found = found.expect("a run has the state 0");
    found.drift.assign_difference(&found.maximum, &found.minimum);
    found.evaluations = run.motion().evaluations();
    Ok(found)
}

impl<N: Number> EnergyDrift<N> {
    fn begin(estimate: &Estimate<'_, N>) -> Self {
        let value = || estimate.value.clone();
        EnergyDrift {
            drift: N::zero(&estimate.value.context()),
            minimum: value(),
            maximum: value(),
            at_minimum: 0,
            at_maximum: 0,
            first: value(),
            last: value(),
            orders: (estimate.order, estimate.order),
            evaluations: 0,
        }
    }

    fn include(&mut self, n: i64, estimate: &Estimate<'_, N>) {
        if *estimate.value < self.minimum {
            self.minimum.assign(estimate.value);
            self.at_minimum = n;
        }
        if *estimate.value > self.maximum {
            self.maximum.assign(estimate.value);
            self.at_maximum = n;
        }
        self.last.assign(estimate.value);
        self.orders = (self.orders.0.min(estimate.order), self.orders.1.max(estimate.order));
    }
}
