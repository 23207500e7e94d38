//! A monitor of the modified energy for loops of one's own.
//!
//! | file | what it is |
//! | --- | --- |
//! | `schedule` | which states belong to windows |
//! | `blocks` | the quietest estimates of the parts of a run, in fixed memory |
//! | `statistics` | extremes and sums over the windows |
//! | `recent` | round-off, turning and whether β was carried, from the newest states of a window |
//! | `report`, `verdict`, `text` | what it comes to, in numbers, a word, and sentences |

mod blocks;
mod recent;
mod report;
mod schedule;
mod statistics;
mod text;
mod verdict;

pub use report::{Course, Report};
pub use verdict::{Sign, Verdict};

use num_traits::Zero;

use self::blocks::{Blocks, Quiet};
use self::recent::Recent;
use self::schedule::Schedule;
use self::statistics::Statistics;
use crate::Rational;
use crate::kinetic::Kinetic;
use crate::motion::{Coordinates, Increments, Motion};
use crate::number::Number;
use crate::potential::Potential;
use crate::run::{RunError, State, check_finite};
use crate::scheme::{Moves, Scheme, Weights};
use crate::shadow::{Estimator, Method};

/// Watches the modified energy H̄ of a trajectory that a loop of your own makes.
///
/// It is fed with all states, and keeps those of *windows*: as many as the estimator needs, at every step or
/// [once in so many](ShadowEnergy::every). Only the steps within windows carry β; the others are plain steps, with the same
/// bits, and cost what plain steps cost. From what the windows give it keeps extremes, sums and 64 estimates, however
/// long the run: nothing is allocated after the beginning.
///
/// The [`Report`] splits the energy error into the method's part H − H̄, the wander of H̄ with what round-off is expected to make
/// of it, and its permanent change; and it says whether the step size is [fine](Verdict).
///
/// ```
/// use shadowstep::shadow::{Bilinear, ShadowEnergy, Verdict};
/// use shadowstep::{Motion, Scheme, UnitMasses, exact, problems::Kepler, splitting_scheme};
///
/// #[splitting_scheme("stormer-verlet.toml")]
/// pub struct StormerVerlet;
///
/// let h = exact("1/20").unwrap();
/// let weights = StormerVerlet.weights(&h, &());
/// let mut comet = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]); // eccentricity 0.6
/// let mut monitor = ShadowEnergy::new(&mut comet, &h, &Bilinear::with_error(8))?.every(100);
///
/// let mut farthest = 0.0_f64;
/// for _ in 0..20_000 {
///     monitor.step(&StormerVerlet, &weights, &mut comet)?;
///     farthest = farthest.max(comet.q()[0].hypot(comet.q()[1]));
/// }
///
/// let report = monitor.report();
/// println!("{report}");
/// assert_eq!(report.verdict, Verdict::Fine);
/// assert!(report.energy_error > 5e-3 && report.moved < 1e-12);
/// # assert!((farthest - 1.6).abs() < 0.1);
/// # Ok::<(), shadowstep::run::RunError>(())
/// ```
///
/// prints
///
/// ```text
/// the step size is fine (20000 steps, 200 windows)
///   energy error         9.39e-3  max − min of H; 1.9e-2 of T
///   the method's part    1.71e-3  rms of H − H̄, which is from -9.05e-3 to 3.32e-4
///   H̄ wanders by        2.80e-14  3.0e-12 of the energy error, like √t
///   it changed by      -1.26e-14  and surely moved by 3.64e-14
///   it is known to      3.89e-16  4.1e-14 of the energy error
///   round-off           1.07e-14  1.1e-12 of the energy error, expected by Brouwer's law
///   fastest motion          17.2  steps a turn
///   the modified energy moved by 3.9e-12 of the energy error in 20000 steps: the energy error is the method's, and bounded
/// ```
///
/// Steps of your own kind are watched as well: ask [`needs_beta`](ShadowEnergy::needs_beta) before, and
/// [`observe`](ShadowEnergy::observe) after each.
///
/// ```
/// # use shadowstep::shadow::{Bilinear, ShadowEnergy};
/// # use shadowstep::{Motion, Scheme, UnitMasses, exact, problems::Pendulum, tables::shipped};
/// # let (scheme, h) = (shipped("yoshida4").unwrap(), exact("1/10").unwrap());
/// # let weights = scheme.weights(&h, &());
/// # let mut motion = Motion::new(Pendulum, UnitMasses, vec![0.0], vec![1.0]);
/// let mut monitor = ShadowEnergy::new(&mut motion, &h, &Bilinear::with_error(6))?.every(50);
/// for _ in 0..5000 {
///     if monitor.needs_beta() {
///         scheme.step_augmented(&weights, &mut motion);
///     } else {
///         scheme.step(&weights, &mut motion);
///     }
///     if let Some(sample) = monitor.observe(&mut motion)? {
///         assert!((sample.modified - sample.energy).abs() < 1e-5); // one of a hundred
///     }
/// }
/// # assert_eq!(monitor.report().windows, 100);
/// # Ok::<(), shadowstep::run::RunError>(())
/// ```
///
/// The step size, the scheme and the system have to stay the same, and nothing else may move the state. Where that shows, or
/// where β was not carried or the steps are not of this h, the verdict is no fine one: see [`Verdict`].
///
/// # Cost
///
/// For a hundred bodies in space, Störmer–Verlet and `f64`, what a monitor adds to the loop (medians of ratios to the loop without
/// it in the same round; runs differ by 0.5 %):
///
/// | | softened gravity | Lennard-Jones |
/// | --- | --- | --- |
/// | [`Bilinear::new(6)`](crate::shadow::Bilinear::new), a window in 100 steps | 2.3 % | 2.9 % |
/// | `Bilinear::new(8)`, a window in 100 steps | 3.0 % | 3.9 % |
/// | the same, a window in 200 steps | 1.3 % | 2.0 % |
/// | [`Bilinear::with_error(8)`](crate::shadow::Bilinear::with_error), a window in 100 steps | 6.6 % | 7.8 % |
/// | the same, a window in 1000 steps | 0.4 % | 1.0 % |
///
/// More than half of it is β: a step that carries it costs 1.19 and 1.26 of a plain one here. H itself is had from the gradient and
/// β's rate where these are known, and costs an evaluation of the potential elsewhere. `cargo bench
/// -p shadowstep --bench monitor` measures it.
#[derive(Clone, Debug)]
pub struct ShadowEnergy<N, E> {
    estimator: E,
    schedule: Schedule,
    /// The number of the present state.
    n: u64,
    /// What the newest window gave.
    newest: Newest<N>,
    statistics: Statistics<N>,
    blocks: Blocks<N>,
    recent: Recent<N>,
    /// What a plain step added to the first state of a window.
    unknown: Increments<N>,
    /// H − H̄
    method: N,
    /// The first state that was not finite, or whose energy was not.
    not_finite: Option<u64>,
}

#[derive(Clone, Debug)]
struct Newest<N> {
    n: u64,
    modified: Quiet<N>,
    has_error: bool,
    energy: N,
    kinetic: N,
}

/// What a window gives.
#[derive(Clone, Copy, Debug)]
pub struct Sample<'a, N> {
    /// The state in the middle of the window, or the one just before that.
    pub n: u64,
    /// The modified energy H̄.
    pub modified: &'a N,
    /// Its error, where the estimator gives one.
    pub error: Option<&'a N>,
    /// The energy H of the state n.
    pub energy: &'a N,
}

impl<N: Number, E: Estimator<N>> ShadowEnergy<N, E> {
    /// Begins at the motion's present state, which is number 0; the steps are of size h. There is a window at every step.
    ///
    /// # Errors
    /// A step of size 0; a state or an energy that is not finite.
    pub fn new<V: Coordinates<N>, P: Potential<N>, K: Kinetic<N>>(
        motion: &mut Motion<N, V, P, K>,
        h: &Rational,
        method: &impl Method<N, Estimator = E>,
    ) -> Result<Self, RunError> {
        if h.is_zero() {
            return Err(RunError::ZeroStep);
        }
        let (dimension, context) = (motion.q().len(), motion.context());
        let (estimator, zero) = (method.estimator(h, dimension, &context), N::zero(&context));
        let mut energy = zero.clone();
        let mut kinetic = zero.clone();
        let state = (motion.q().to_vec(), motion.p().to_vec());
        motion.assign_energies_of(&state.0, &state.1, &mut energy, &mut kinetic);
        check_value(&energy, "an energy", 0)?;
        let mut monitor = ShadowEnergy {
            schedule: Schedule::new(estimator.states(), 1),
            estimator,
            n: 0,
            statistics: Statistics::new(&energy),
            newest: Newest { n: 0, modified: Quiet::zero(&context), has_error: false, energy, kinetic },
            blocks: Blocks::new(&context),
            recent: Recent::new(h, dimension, &context),
            unknown: Increments::of_beta(zero.clone()),
            method: zero,
            not_finite: None,
        };
        monitor.take(motion)?;
        Ok(monitor)
    }

    /// One window in every so many steps: of as many states as the estimator needs, at a place among these steps that
    /// wanders from window to window. As many steps as that or fewer, and β is carried always.
    #[must_use]
    pub fn every(mut self, steps: u64) -> Self {
        self.schedule = Schedule::new(self.estimator.states(), steps);
        self
    }

    /// The number of the present state.
    pub fn n(&self) -> u64 {
        self.n
    }

    /// Whether the next step has to carry β.
    pub fn needs_beta(&self) -> bool {
        self.schedule.needs_beta(self.n + 1)
    }

    /// One step, which carries β where it is needed; gives the estimate that it completes.
    ///
    /// # Errors
    /// As [`observe`](ShadowEnergy::observe).
    #[inline]
    pub fn step<S, V, P, K>(
        &mut self,
        scheme: &S,
        weights: &Weights<S::Array<N>>,
        motion: &mut Motion<N, V, P, K>,
    ) -> Result<Option<Sample<'_, N>>, RunError>
    where
        S: Scheme + Moves<K::Class>,
        V: Coordinates<N>,
        P: Potential<N>,
        K: Kinetic<N>,
    {
        if self.needs_beta() {
            scheme.step_augmented(weights, motion);
        } else {
            // the gradient at the first state of a window is the first one of a step with β, too
            motion.keep_rate(self.schedule.begins(self.n + 1));
            scheme.step(weights, motion);
            motion.keep_rate(false);
        }
        self.observe(motion)
    }

    /// Takes the state that a step has made, a step with β where [`needs_beta`](ShadowEnergy::needs_beta) said so; gives the
    /// estimate that it completes.
    ///
    /// # Errors
    /// A state of a window, or its energy or modified energy, that is not finite. What is not finite stays so: between the
    /// windows it is found by the next one.
    #[inline]
    pub fn observe<V: Coordinates<N>, P: Potential<N>, K: Kinetic<N>>(
        &mut self,
        motion: &mut Motion<N, V, P, K>,
    ) -> Result<Option<Sample<'_, N>>, RunError> {
        self.n += 1;
        if !self.schedule.takes(self.n) {
            return Ok(None);
        }
        match self.take(motion) {
            Ok(ends) => Ok(ends.then(|| self.sample())),
            Err(error) => {
                if let RunError::NotFinite { step, .. } = error {
                    self.not_finite.get_or_insert(step.unsigned_abs());
                }
                Err(error)
            }
        }
    }

    /// Takes a state of a window; whether it ends one.
    fn take<V: Coordinates<N>, P: Potential<N>, K: Kinetic<N>>(
        &mut self,
        motion: &mut Motion<N, V, P, K>,
    ) -> Result<bool, RunError> {
        if self.schedule.is_middle(self.n) && !self.schedule.overlaps() {
            // while the gradient that the energy can be had from is kept
            motion.assign_energies(&mut self.newest.energy, &mut self.newest.kinetic);
        }
        let begins = self.schedule.begins(self.n);
        let increments = if begins { &self.unknown } else { motion.increments() };
        let (q, p) = (motion.q(), motion.p());
        check_finite(&State { n: i64::try_from(self.n).unwrap_or(i64::MAX), q, p, increments })?;
        self.recent.push(motion, (!begins && self.n > 0).then_some(increments));
        let states = self.estimator.states();
        let estimate = self.estimator.push(q, p, increments);
        // the first states of a window complete estimates with the last ones of another, which mean nothing
        if !self.schedule.ends(self.n) {
            return Ok(false);
        }
        let Some(estimate) = estimate else { return Ok(false) };
        let Newest { n, modified, has_error, energy, kinetic } = &mut self.newest;
        *n = self.n - (states as u64 / 2);
        modified.value.assign(estimate.value);
        *has_error = estimate.error.is_some();
        match estimate.error {
            Some(error) => modified.error.assign(error),
            None => modified.error.assign_zero(),
        }
        if self.schedule.overlaps() {
            motion.assign_energies_of(estimate.q, estimate.p, energy, kinetic);
        }
        self.schedule.advance();
        self.end_window(states)?;
        Ok(true)
    }

    fn end_window(&mut self, states: usize) -> Result<(), RunError> {
        let Newest { n, modified, energy, kinetic, .. } = &self.newest;
        check_value(energy, "an energy", *n)?;
        check_value(&modified.value, "a modified energy", *n)?;
        check_value(&modified.error, "a modified energy with an error", *n)?;
        self.recent.end(states);
        let quiet = self.blocks.push(modified);
        self.method.assign_difference(energy, &quiet.value);
        self.statistics.add(energy, kinetic, &self.method, modified);
        Ok(())
    }

    fn sample(&self) -> Sample<'_, N> {
        let Newest { n, modified, has_error, energy, .. } = &self.newest;
        Sample { n: *n, modified: &modified.value, error: has_error.then_some(&modified.error), energy }
    }
}

/// States may be finite where their products overflow.
fn check_value<N: Number>(value: &N, name: &str, n: u64) -> Result<(), RunError> {
    if value.is_finite() {
        return Ok(());
    }
    let what = format!("{name} of {}", value.to_text());
    Err(RunError::NotFinite { step: i64::try_from(n).unwrap_or(i64::MAX), what })
}
