//! The increments of steps from one logged state to the next: of velocity Verlet, or as they were logged.

use super::error::RecordedError;
use super::log::{Derivatives, Logged, MadeStep};
use super::misfit::{Differences, Misfit};
use super::work::Work;
use crate::number::Number;
use crate::shadow::run::{RunError, TrajectoryState};
use crate::steps::step_size::StepSize;
use crate::systems::increments::{Increments, OwnedIncrements};

/// What steps of velocity Verlet added to q, p and β, from logged states and gradients:
///
/// $$\Delta q = h M^{-1} \left( p_n - \tfrac h2 U_q(q_n) \right), \quad
/// \Delta p = -\tfrac h2 \left( U_q(q_n) + U_q(q_{n+1}) \right), \quad
/// \Delta\beta = \tfrac h2 \left( r_n + r_{n+1} \right), \quad r = q^{\mathsf T} U_q - 2U.$$
///
/// q is counted from the first state: a constant displacement of q is a canonical transformation, and changes H̄ by
/// nothing but round-off. Where rates are logged and no gradients, Δq and Δp are differences of states, and q is as
/// logged, as the rate belongs to it. Where a [step](MadeStep) of another splitting is logged, its increments are
/// these.
#[derive(Clone, Debug)]
pub(super) struct LoggedSteps {
    h: f64,
    half: f64,
    masses: Vec<f64>,
    /// The q of the first state, where gradients are logged.
    origin: Vec<f64>,
    /// What is known of the derivatives.
    known: Option<&'static str>,
    n: i64,
    /// Whether the next state follows the newest by a step, and whether that followed the one before.
    follows: [bool; 2],
    q: Vec<f64>,
    p: Vec<f64>,
    gradient: Vec<f64>,
    rate: f64,
    increments: OwnedIncrements<f64>,
    misfits: [Misfit; 2],
    work: Work,
    /// The logged q to which the newest step leads.
    predicted: Vec<f64>,
    reordered: Option<i64>,
}

/// Where q is off the step by more than this many times the step, its order may have changed:
const FAR_OFF: f64 = 10.0;
/// it has, if q in ascending order differs from the step by less than this part of what it differs as it is.
const SAME_NUMBERS: f64 = 0.01;
/// Coordinates that are off by more than this part of the largest difference have jumped.
const FAR_PART: f64 = 0.1;

impl LoggedSteps {
    /// Steps of size h of coordinates with these masses.
    ///
    /// # Errors
    /// A mass that is not positive and finite; no masses.
    pub(super) fn new(h: &StepSize, masses: &[f64]) -> Result<Self, RecordedError> {
        if masses.is_empty() {
            return Err(RecordedError::NoCoordinates);
        }
        if let Some(coordinate) = masses.iter().position(|mass| !(mass.is_finite() && *mass > 0.0)) {
            return Err(RecordedError::Mass { coordinate, mass: masses[coordinate] });
        }
        let dimension = masses.len();
        let h = f64::from_rational(h.exact(), &());
        let zeros = || vec![0.0; dimension];
        Ok(LoggedSteps {
            h,
            half: h / 2.0,
            masses: masses.to_vec(),
            origin: zeros(),
            known: None,
            n: -1,
            follows: [false; 2],
            q: zeros(),
            p: zeros(),
            gradient: zeros(),
            rate: 0.0,
            increments: OwnedIncrements::zero(dimension, &()),
            misfits: [Misfit::new(dimension), Misfit::new(dimension)],
            work: Work::default(),
            predicted: zeros(),
            reordered: None,
        })
    }

    pub(super) fn h(&self) -> f64 {
        self.h
    }

    /// The next state is the state n, which does not follow the newest by a step.
    pub(super) fn begin(&mut self, n: i64) -> Result<(), RecordedError> {
        if n <= self.n {
            return Err(RecordedError::Backwards { n, newest: self.n });
        }
        self.n = n - 1;
        self.follows[0] = false;
        self.misfits.iter_mut().for_each(Misfit::begin);
        Ok(())
    }

    /// Refuses a state that cannot be the state n of this log.
    pub(super) fn check(&self, n: i64, logged: &Logged<'_>) -> Result<(), RecordedError> {
        let dimension = self.masses.len();
        let (rate, step) = match logged.derivatives {
            Derivatives::Gradient(_) => (None, None),
            Derivatives::Rate(rate) => (Some(rate), None),
            Derivatives::Step(_, step) => (None, Some(step)),
        };
        let of_state = [("q", Some(logged.q)), ("p", Some(logged.p)), ("the gradient", logged.derivatives.gradient())];
        let of_step =
            [("the increment of q", step.map(|step| step.q)), ("the increment of p", step.map(|step| step.p))];
        for (name, numbers) in of_state.into_iter().chain(of_step) {
            let Some(numbers) = numbers else { continue };
            if numbers.len() != dimension {
                return Err(RecordedError::Dimension { name, n, found: numbers.len(), dimension });
            }
            if let Some(coordinate) = numbers.iter().position(|number| !number.is_finite()) {
                let (value, coordinate) = (numbers[coordinate], Some(coordinate));
                return Err(RecordedError::NotFinite { name, n, coordinate, dimension, value });
            }
        }
        let of_beta = step.map(|step| step.beta);
        for (name, value) in [("U", Some(logged.energy)), ("the rate", rate), ("the increment of β", of_beta)] {
            if let Some(value) = value.filter(|value| !value.is_finite()) {
                return Err(RecordedError::NotFinite { name, n, coordinate: None, dimension, value });
            }
        }
        match self.known {
            Some(known) if known != logged.derivatives.name() => {
                Err(RecordedError::Mixed { n, found: logged.derivatives.name() })
            }
            _ => Ok(()),
        }
    }

    /// n of the next state.
    pub(super) fn next(&self) -> i64 {
        self.n + 1
    }

    /// Takes the next state, which is of this log.
    ///
    /// # Errors
    /// A number that is not finite.
    pub(super) fn push(&mut self, logged: &Logged<'_>) -> Result<(), RunError> {
        self.n += 1;
        self.follows = [true, self.follows[0]];
        match logged.derivatives {
            Derivatives::Gradient(gradient) => self.push_with_gradient(logged, gradient, None),
            Derivatives::Step(gradient, step) => self.push_with_gradient(logged, gradient, Some(step)),
            Derivatives::Rate(rate) => self.push_with_rate(logged, rate),
        }
        self.state().check()
    }

    fn push_with_gradient(&mut self, logged: &Logged<'_>, gradient: &[f64], step: Option<MadeStep<'_>>) {
        if self.known.replace(logged.derivatives.name()).is_none() {
            self.origin.copy_from_slice(logged.q);
        }
        let LoggedSteps { half, n, rate, increments: OwnedIncrements { q: dq, p: dp, beta }, .. } = self;
        let [of_q, of_p] = &mut self.misfits;
        let rate_before = std::mem::replace(rate, -2.0 * logged.energy);
        let mut of_origin = 0.0;
        for i in 0..self.masses.len() {
            let (q, p, gradient) = (logged.q[i] - self.origin[i], logged.p[i], gradient[i]);
            *rate += q * gradient;
            (dq[i], dp[i]) = match step {
                Some(step) => (step.q[i], step.p[i]),
                None => {
                    let dq = self.h * ((self.p[i] - *half * self.gradient[i]) / self.masses[i]);
                    (dq, -*half * self.gradient[i] - *half * gradient)
                }
            };
            of_origin += self.q[i] * dp[i];
            if self.follows[1] {
                let by_q = of_q.add((*n, i), [self.q[i], q], dq[i], logged.q[i]);
                self.predicted[i] = self.origin[i] + (self.q[i] + dq[i]);
                let by_p = of_p.add((*n, i), [self.p[i], p], dp[i], p);
                let mean = [(gradient + self.gradient[i]) / 2.0, (p + self.p[i]) / 2.0 / self.masses[i]];
                self.work.add([mean[0] * by_q, mean[1] * by_p]);
            }
            (self.q[i], self.p[i], self.gradient[i]) = (q, p, gradient);
        }
        *beta = match step {
            Some(step) => step.beta - of_origin,
            None => *half * rate_before + *half * *rate,
        };
        if self.follows[1] {
            of_q.end();
            of_p.end();
            self.work.end();
            if self.reordered.is_none() && self.is_reordered(logged.q) {
                self.reordered = Some(self.n);
            }
        }
    }

    /// Whether the newest q, as logged, has the numbers that the step leads to, in another order.
    fn is_reordered(&self, q: &[f64]) -> bool {
        let square = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
        let off = square(q, &self.predicted);
        if off <= FAR_OFF * FAR_OFF * self.increments.q.iter().map(|added| added * added).sum::<f64>() {
            return false;
        }
        let ascending = |x: &[f64]| {
            let mut x = x.to_vec();
            x.sort_by(f64::total_cmp);
            x
        };
        square(&ascending(q), &ascending(&self.predicted)) < SAME_NUMBERS * SAME_NUMBERS * off && !self.is_wrapped(q)
    }

    /// Whether more than two coordinates are off by one length, as where particles leave a periodic box on both sides.
    fn is_wrapped(&self, q: &[f64]) -> bool {
        let sizes = q.iter().zip(&self.predicted).map(|(q, predicted)| (q - predicted).abs());
        let largest = sizes.clone().fold(0.0, f64::max);
        let [far, alike] =
            [FAR_PART, 1.0 - SAME_NUMBERS].map(|part| sizes.clone().filter(|size| *size > part * largest).count());
        far > 2 && far == alike
    }

    fn push_with_rate(&mut self, logged: &Logged<'_>, rate: f64) {
        self.known = Some(logged.derivatives.name());
        let OwnedIncrements { q: dq, p: dp, beta } = &mut self.increments;
        for (own, logged, added) in [(&mut self.q, logged.q, dq), (&mut self.p, logged.p, dp)] {
            for ((own, logged), added) in own.iter_mut().zip(logged).zip(added) {
                *added = logged - *own;
                *own = *logged;
            }
        }
        *beta = self.half * self.rate + self.half * rate;
        self.rate = rate;
    }

    /// The newest state, with what the step to it added if it follows the one before.
    pub(super) fn state(&self) -> TrajectoryState<'_, f64> {
        let increments = if self.follows[1] { self.increments.view() } else { Increments::of_beta(&0.0) };
        TrajectoryState { n: self.n, q: &self.q, p: &self.p, increments }
    }

    /// What the differences do to the energy.
    pub(super) fn work(&self) -> &Work {
        &self.work
    }

    /// The first state whose coordinates are in another order than those of the state before.
    pub(super) fn reordered(&self) -> Option<i64> {
        self.reordered
    }

    /// By how much logged q and p differ from the steps; `None` before the first step, and where no gradients are
    /// logged.
    pub(super) fn differences(&self) -> Option<[Differences; 2]> {
        let [of_q, of_p] = &self.misfits;
        Some([of_q.found()?, of_p.found()?])
    }
}
