//! Follows a trajectory while another program computes it.

use super::changes::{Changes, K};
use super::diagnosis::{Diagnosis, Evidence};
use super::error::RecordedError;
use super::log::Logged;
use super::roughness::Roughness;
use super::steps::LoggedSteps;
use super::value::Value;
use super::window::Window;
use crate::shadow::run::{Quantity, check_value};
use crate::shadow::{Bilinear, BilinearEstimator, BuildEstimator, Estimator};
use crate::steps::step_size::StepSize;

/// Follows the modified energy H̄ of a trajectory that another program computes by velocity Verlet, or by another
/// splitting whose [increments](super::MadeStep) it sums, and says [what moves the energy](Diagnosis).
///
/// It takes states that follow each other by a step, or windows of such states with [gaps](Observer::begin) between
/// them. From the 17th state of a window on each gives an estimate E_8 with its error, of the state eight before it;
/// with [windows of nine](Window::Nine), from the ninth on, of the state four before it.
///
/// ```
/// use shadowstep::StepSize;
/// use shadowstep::shadow::recorded::{Cause, Derivatives, Logged, Observer};
///
/// // a pendulum by velocity Verlet; the forces have errors of 1e-3 that change from step to step
/// let h = 0.1;
/// let mut state = 1_u64;
/// let mut noise = || {
///     state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
///     1e-3 * 12_f64.sqrt() * ((state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5)
/// };
/// let (mut q, mut p) = (1.0_f64, 0.0_f64);
/// let mut gradient = q.sin() + noise();
///
/// let mut observer = Observer::new(&StepSize::try_from(h)?, &[1.0])?;
/// for _ in 0..4000 {
///     observer.observe(&Logged { q: &[q], p: &[p], energy: -q.cos(), derivatives: Derivatives::Gradient(&[gradient]) })?;
///     p -= h / 2.0 * gradient;
///     q += h * p;
///     gradient = q.sin() + noise();
///     p -= h / 2.0 * gradient;
/// }
/// let found = observer.diagnosis();
/// println!("{found}");
/// assert!(matches!(found.cause, Cause::Noise { size } if (size / 1e-3 - 1.0).abs() < 0.1));
/// # Ok::<(), shadowstep::shadow::recorded::RecordedError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Observer {
    h: f64,
    window: Window,
    masses: Vec<f64>,
    steps: LoggedSteps,
    /// E_8
    estimator: BilinearEstimator<f64>,
    error: ErrorOf,
    forces: Roughness,
    /// Of U.
    energy: Roughness,
    changes: Changes,
    values: Vec<Value>,
    /// States of the present window.
    pushed: usize,
    /// H of the newest states, the state n in place n mod their number.
    energies: [f64; MOST],
    /// T of all states.
    kinetic: Vec<f64>,
}

/// The states of the longest window.
const MOST: usize = Window::Seventeen.states();

/// What gives the error of E_8.
#[derive(Clone, Debug)]
enum ErrorOf {
    /// E_8 with its error.
    Windows(BilinearEstimator<f64>),
    /// E_7, and its newest value.
    LastTerm(BilinearEstimator<f64>, f64),
}

impl Observer {
    /// For steps of size h, of coordinates with these masses, with windows of 17 states.
    ///
    /// # Errors
    /// A mass that is not positive and finite; no masses.
    pub fn new(h: &StepSize, masses: &[f64]) -> Result<Self, RecordedError> {
        Self::with_window(h, masses, Window::default())
    }

    /// The same with windows of this number of states.
    ///
    /// # Errors
    /// As [`Observer::new`].
    pub fn with_window(h: &StepSize, masses: &[f64], window: Window) -> Result<Self, RecordedError> {
        let dimension = masses.len();
        let steps = LoggedSteps::new(h, masses)?;
        let error = match window {
            Window::Nine => ErrorOf::LastTerm(Bilinear::new(K - 1).build(h, dimension, &())?, f64::NAN),
            Window::Seventeen => ErrorOf::Windows(Bilinear::with_error(K).build(h, dimension, &())?),
        };
        Ok(Observer {
            h: steps.h(),
            window,
            masses: masses.to_vec(),
            steps,
            estimator: Bilinear::new(K).build(h, dimension, &())?,
            error,
            forces: Roughness::new(window, dimension),
            energy: Roughness::new(window, 1),
            changes: Changes::default(),
            values: Vec::new(),
            pushed: 0,
            energies: [0.0; MOST],
            kinetic: Vec::new(),
        })
    }

    /// A new window begins: the next state is the state n, which does not follow the newest by a step.
    ///
    /// # Errors
    /// An n that is not larger than the newest state's.
    pub fn begin(&mut self, n: i64) -> Result<(), RecordedError> {
        self.steps.begin(n)?;
        self.forces.begin();
        self.energy.begin();
        self.pushed = 0;
        Ok(())
    }

    /// How many states a window needs for an estimate with its error.
    pub fn states(&self) -> usize {
        self.window.states()
    }

    /// Takes the next state; gives the estimate that it completes.
    ///
    /// # Errors
    /// A state of another dimension; a number, or a modified energy, that is not finite; gradients where there were
    /// none, or the reverse.
    pub fn observe(&mut self, logged: &Logged<'_>) -> Result<Option<Value>, RecordedError> {
        self.steps.check(self.steps.next(), logged)?;
        self.steps.push(logged)?;
        self.pushed += 1;
        let state = self.steps.state();
        let n = state.n;
        if let Some(gradient) = logged.derivatives.gradient() {
            self.forces.push(gradient, logged.p, &self.masses);
        }
        self.energy.push(&[logged.energy], &[0.0], &[1.0]);
        let kinetic = logged.p.iter().zip(&self.masses).map(|(p, mass)| p * p / mass).sum::<f64>() / 2.0;
        check_value(&(kinetic + logged.energy), Quantity::Energy, n)?;
        self.kinetic.push(kinetic);
        let place = |n: i64| n as usize % MOST;
        self.energies[place(n)] = kinetic + logged.energy;

        let pushed = self.pushed;
        let estimate =
            self.estimator.push_for_value(state.q, state.p, state.increments).filter(|_| pushed > K as usize);
        let estimate = estimate.map(|found| *found.value);
        if let Some(estimate) = estimate {
            check_value(&estimate, Quantity::ModifiedEnergy, n)?;
            self.changes.push(n - i64::from(K) / 2, estimate);
        }
        let found = match &mut self.error {
            ErrorOf::Windows(with_error) => {
                let found = with_error.push_for_value(state.q, state.p, state.increments);
                found.map(|found| (*found.value, found.error.copied().unwrap_or(f64::NAN)))
            }
            ErrorOf::LastTerm(of_seven, before) => {
                let newest =
                    of_seven.push_for_value(state.q, state.p, state.increments).map_or(f64::NAN, |found| *found.value);
                let before = std::mem::replace(before, newest);
                if estimate.is_some() {
                    self.changes.push_seven(newest - before);
                }
                let mean = (newest + before) / 2.0;
                estimate.map(|estimate| (estimate, (estimate - mean).abs()))
            }
        };
        let Some((modified, error)) = found.filter(|_| pushed >= self.window.states()) else { return Ok(None) };
        let n = n - (self.window.states() as i64 - 1) / 2;
        let value = Value { n, modified, error, energy: self.energies[place(n)] };
        self.values.push(value);
        Ok(Some(value))
    }

    /// All estimates so far.
    pub fn values(&self) -> &[Value] {
        &self.values
    }

    /// What moves the energy, as far as the states so far show.
    pub fn diagnosis(&self) -> Diagnosis {
        Diagnosis::of(&Evidence {
            window: self.window,
            h: self.h,
            values: &self.values,
            kinetic: &self.kinetic,
            changes: &self.changes,
            forces: &self.forces,
            energy: &self.energy,
            differences: self.steps.differences(),
            work: self.steps.work(),
            reordered: self.steps.reordered(),
        })
        .judged()
    }
}
