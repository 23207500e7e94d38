//! Follows a trajectory while another program computes it.

use super::cause::Cause;
use super::changes::{Changes, K, median};
use super::diagnosis::Diagnosis;
use super::error::RecordedError;
use super::log::Logged;
use super::roughness::Roughness;
use super::steps::LoggedSteps;
use super::units::Units;
use super::value::Value;
use super::window::Window;
use crate::shadow::rules::ERROR_FACTOR;
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
        let Observer { values, kinetic, changes, .. } = self;
        let largest = |of: &dyn Fn(&Value) -> f64| values.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        let width = |of: &dyn Fn(&Value) -> f64| largest(of) + largest(&|value| -of(value));
        let factor = f64::from(ERROR_FACTOR);
        // the error of seventeen states contains it
        let scatter = if self.window == Window::Nine { changes.scatter() } else { 0.0 };
        let error = |value: &Value| value.error.hypot(scatter);
        // an error of seventeen states is a range of what scatters
        let known_to = |value: &Value| value.error.hypot(factor * scatter);
        let beyond = |sign: f64| largest(&|value| sign * value.modified - factor * error(value));
        let (first, last) = (values.first(), values.last());
        let modified = |value: Option<&Value>| value.map_or(f64::NAN, |value| value.modified);
        let smoothness = self.forces.found();
        let square = changes.square_in_a_step();
        let steps = last.zip(first).map_or(0, |(last, first)| last.n.abs_diff(first.n));
        Diagnosis {
            window: self.window,
            states: kinetic.len() as u64,
            estimates: values.len(),
            kinetic: kinetic.iter().sum::<f64>() / kinetic.len().max(1) as f64,
            usual_kinetic: median(kinetic.to_vec()),
            energy_error: width(&|value| value.energy),
            method_error: width(&|value| value.energy - value.modified),
            first: modified(first),
            change: modified(last) - modified(first),
            range: width(&|value| value.modified),
            moved: (beyond(1.0) + beyond(-1.0)).max(0.0),
            known_to: median(values.iter().map(known_to).collect()),
            time: self.h.abs() * steps as f64,
            smoothness,
            energy_smoothness: self.energy.found(),
            in_a_step: square.sqrt(),
            growth: changes.growth(),
            excess: smoothness.map(|_| square / (self.h * self.h * self.forces.power())),
            isolation: changes.isolation(),
            jumps: changes.jumps(),
            differences: self.steps.differences(),
            work: self.steps.work().range(steps),
            work_in_a_step: self.steps.work().in_a_step(),
            reordered: self.steps.reordered(),
            cause: Cause::Undecided,
            units: Units::default(),
        }
        .judged()
    }
}
