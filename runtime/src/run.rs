//! Trajectories with the states that an estimator needs on both sides, and the energy drift.

mod drift;
mod permanent;
mod stretches;

pub use drift::{EnergyDrift, energy_drift};
pub use permanent::{PermanentChange, Quiet, Seen};

use num_traits::Zero;
use thiserror::Error;

use crate::Rational;
use crate::kinetic::Kinetic;
use crate::motion::{Coordinates, Increments, Motion};
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
    /// What the step to it added to q, p and β.
    pub increments: &'a Increments<N>,
}

/// Where the states come from that an estimator takes: a [`Trajectory`], or the exact flow.
pub trait States {
    /// The kind of their numbers.
    type Number: Number;

    /// Goes to the next state in the order of time; `None` at the end.
    ///
    /// # Errors
    /// A state that is not finite.
    fn advance(&mut self) -> Result<Option<State<'_, Self::Number>>, RunError>;
}

/// A state made before it is its turn.
#[derive(Clone)]
struct Stored<N> {
    q: Vec<N>,
    p: Vec<N>,
    increments: Increments<N>,
}

/// The states of a trajectory in the order of time: for an estimator n = −reach, …, steps + reach with the β of each
/// step, or [plain](Trajectory::plain) ones without β.
///
/// States before 0 are made with the scheme's exact inverse from the state 0.
pub struct Trajectory<'s, S: Scheme, N: Number, V, P, K> {
    scheme: &'s S,
    weights: Weights<S::Array<N>>,
    motion: Motion<N, V, P, K>,
    augmented: bool,
    /// The states that the motion begins with or comes from, the earliest last.
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
        motion: Motion<N, V, P, K>,
        h: &Rational,
        steps: u64,
        reach: usize,
    ) -> Result<Self, RunError> {
        let mut trajectory = Self::after(scheme, motion, h, 0)?;
        trajectory.last = last(steps, reach);
        trajectory.step_back(reach)?;
        Ok(trajectory)
    }

    /// The states n = `from`, …, steps without β and increments, which are 0 in all of them; the motion is at the state `from`.
    ///
    /// They have the bits of the states with β, and the bits of a trajectory from 0 where `from` is one of its states.
    ///
    /// # Errors
    /// A step of size 0; an energy at `from` that is not finite.
    pub fn plain(
        scheme: &'s S,
        motion: Motion<N, V, P, K>,
        h: &Rational,
        from: i64,
        steps: u64,
    ) -> Result<Self, RunError> {
        let mut trajectory = Self::after(scheme, motion, h, from)?;
        trajectory.last = last(steps, 0);
        trajectory.augmented = false;
        trajectory.before.push(stored(&trajectory.motion));
        trajectory.n -= 1;
        Ok(trajectory)
    }

    /// The states after `from`, with β, up to a `last` one to be set; the motion is at the state `from`.
    fn after(scheme: &'s S, mut motion: Motion<N, V, P, K>, h: &Rational, from: i64) -> Result<Self, RunError> {
        if h.is_zero() {
            return Err(RunError::ZeroStep);
        }
        let energy = motion.energy();
        if !energy.is_finite() {
            let what = format!("an energy of {}", energy.to_text());
            return Err(RunError::NotFinite { step: from, what });
        }
        let weights = scheme.weights::<N>(h, &motion.context());
        Ok(Trajectory {
            scheme,
            weights,
            motion,
            augmented: true,
            before: Vec::new(),
            present: None,
            n: from,
            last: from,
        })
    }

    /// Makes the states −reach, …, 0 from the present one, which is 0, and goes back to it.
    fn step_back(&mut self, reach: usize) -> Result<(), RunError> {
        let Trajectory { scheme, weights, motion, before, .. } = self;
        let start = stored(motion);
        let mut later = start.clone();
        for n in 1..=reach as i64 {
            scheme.step_back_augmented(weights, motion);
            check(motion, -n)?;
            // the step from −n to −n + 1 adds what the step back took
            later.increments.assign(motion.increments());
            later.increments.negate();
            let earlier = stored(motion);
            before.push(std::mem::replace(&mut later, earlier));
        }
        later.increments.assign_zero();
        before.push(later);
        motion.q_mut().iter_mut().zip(&start.q).for_each(|(own, q)| own.assign(q));
        motion.p_mut().iter_mut().zip(&start.p).for_each(|(own, p)| own.assign(p));
        self.n = -(reach as i64) - 1;
        Ok(())
    }

    /// The system, for energies and counts.
    pub fn motion(&mut self) -> &mut Motion<N, V, P, K> {
        &mut self.motion
    }
}

impl<S, N, V, P, K> States for Trajectory<'_, S, N, V, P, K>
where
    S: Scheme + Moves<K::Class>,
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
{
    type Number = N;

    fn advance(&mut self) -> Result<Option<State<'_, N>>, RunError> {
        if self.n >= self.last {
            return Ok(None);
        }
        self.n += 1;
        let n = self.n;
        self.present = self.before.pop();
        if let Some(Stored { q, p, increments }) = &self.present {
            return Ok(Some(State { n, q, p, increments }));
        }
        if self.augmented {
            self.scheme.step_augmented(&self.weights, &mut self.motion);
        } else {
            self.scheme.step(&self.weights, &mut self.motion);
        }
        check(&self.motion, n)?;
        let motion = &self.motion;
        Ok(Some(State { n, q: motion.q(), p: motion.p(), increments: motion.increments() }))
    }
}

/// The number of the last state that the estimate of the state `steps` needs.
pub(crate) fn last(steps: u64, reach: usize) -> i64 {
    i64::try_from(steps).unwrap_or(i64::MAX).saturating_add(reach as i64)
}

fn stored<N, V, P, K>(motion: &Motion<N, V, P, K>) -> Stored<N>
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
{
    Stored { q: motion.q().to_vec(), p: motion.p().to_vec(), increments: motion.increments().clone() }
}

fn check<N, V, P, K>(motion: &Motion<N, V, P, K>, n: i64) -> Result<(), RunError>
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
{
    check_finite(&State { n, q: motion.q(), p: motion.p(), increments: motion.increments() })
}

/// Refuses a state in which something is not a finite number.
pub(crate) fn check_finite<N: Number>(state: &State<'_, N>) -> Result<(), RunError> {
    let State { n, q, p, increments } = *state;
    let beta = &increments.beta;
    if beta.is_finite() && q.iter().chain(p).all(Number::is_finite) {
        return Ok(());
    }
    let named = |name: &'static str, values: &[N]| {
        let index = values.iter().position(|x| !x.is_finite())?;
        Some(format!("{name}{} = {}", index + 1, values[index].to_text()))
    };
    let what = named("q", q).or_else(|| named("p", p)).unwrap_or_else(|| format!("beta = {}", beta.to_text()));
    Err(RunError::NotFinite { step: n, what })
}

/// An estimate and its n: the state n, or the middle between it and the next one.
pub type Estimated<'a, N> = (i64, Estimate<'a, N>);

/// States with the modified energies of n = 0, …, steps, or between them.
pub struct ShadowRun<T, E> {
    states: T,
    estimator: E,
    h: Rational,
    reach: i64,
    /// How many states after the n of an estimate it needs: as many, or one more where it belongs to n + 1/2.
    after: i64,
    /// How many states are to come before the one that completes the first estimate.
    missing: usize,
}

impl<'s, S, N, V, P, K, E> ShadowRun<Trajectory<'s, S, N, V, P, K>, E>
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
        let mut run = Self::resume(scheme, motion, h, 0, steps, method)?;
        run.states.step_back(run.reach as usize)?;
        Ok(run)
    }

    /// Takes a run up again: the estimates of n = `from` + reach + 1, …, steps, with the bits of the run from 0.
    ///
    /// The motion is at the state `from` of that run. An estimate depends on the states n − reach, …, n + reach and
    /// what the steps between them added only. States after 0 are all made by steps forward; those before 0 are not, and
    /// so the estimates of n ≤ reach cannot be had this way.
    ///
    /// # Errors
    /// A step of size 0; an energy at `from` that is not finite.
    pub fn resume(
        scheme: &'s S,
        motion: Motion<N, V, P, K>,
        h: &Rational,
        from: i64,
        steps: u64,
        method: &impl Method<N, Estimator = E>,
    ) -> Result<Self, RunError> {
        // the reach is known only where h is known to be no 0
        let trajectory = Trajectory::after(scheme, motion, h, from)?;
        let estimator = method.estimator(h, trajectory.motion.q().len(), &trajectory.motion.context());
        let mut run = ShadowRun::of(trajectory, estimator, h);
        run.states.last = last(steps, run.reach as usize);
        Ok(run)
    }

    /// The system, for energies and counts.
    pub fn motion(&mut self) -> &mut Motion<N, V, P, K> {
        self.states.motion()
    }
}

impl<T: States, E: Estimator<T::Number>> ShadowRun<T, E> {
    /// The states begin as many before the first estimate as the estimator needs.
    pub(crate) fn of(states: T, estimator: E, h: &Rational) -> Self {
        let missing = estimator.states() - 1;
        let reach = missing / 2;
        ShadowRun { states, estimator, h: h.clone(), reach: reach as i64, after: (missing - reach) as i64, missing }
    }

    /// How many states before 0, and after the last one, the estimator needs.
    pub fn reach(&self) -> i64 {
        self.reach
    }

    /// Whether the estimates belong to the times between the states, (n + 1/2)h, n = 0, …, steps − 1.
    pub fn is_between(&self) -> bool {
        self.after > self.reach
    }

    /// The next n with its estimate, of the state n or of the middle between it and the next one; `None` after the last.
    ///
    /// # Errors
    /// A state that is not finite, up to the last one that the estimator needs, or a modified energy that is not.
    pub fn advance(&mut self) -> Result<Option<Estimated<'_, T::Number>>, RunError> {
        loop {
            let Some(State { n, q, p, increments }) = self.states.advance()? else { return Ok(None) };
            if self.missing > 0 {
                self.missing -= 1;
                self.estimator.push(q, p, increments);
                continue;
            }
            let Some(estimate) = self.estimator.push(q, p, increments) else { return Ok(None) };
            let n = n - self.after;
            // states may be finite where their products overflow
            if !estimate.value.is_finite() {
                let what = format!("a modified energy of {}", estimate.value.to_text());
                return Err(RunError::NotFinite { step: n, what });
            }
            return Ok(Some((n, estimate)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinetic::UnitMasses;
    use crate::problems::Kepler;
    use crate::shadow::{Central, Rule, Stop};
    use crate::tables::{TableScheme, shipped};

    const SCHEMES: [&str; 3] = ["stormer-verlet", "yoshida4", "ruth3"];

    fn motion(q: Vec<f64>, p: Vec<f64>) -> Motion<f64, Vec<f64>, Kepler, UnitMasses> {
        Motion::new(Kepler, UnitMasses, q, p)
    }

    fn start() -> Motion<f64, Vec<f64>, Kepler, UnitMasses> {
        motion(vec![0.4, 0.0], vec![0.0, 2.0])
    }

    fn step() -> Rational {
        Rational::new(1.into(), 20.into())
    }

    /// n, q and p of the states from 0 on.
    fn plain(scheme: &TableScheme, steps: u64) -> Vec<(i64, Vec<f64>, Vec<f64>)> {
        let mut trajectory = Trajectory::plain(scheme, start(), &step(), 0, steps).unwrap();
        let mut states = Vec::new();
        while let Some(state) = trajectory.advance().unwrap() {
            states.push((state.n, state.q.to_vec(), state.p.to_vec()));
        }
        states
    }

    #[test]
    fn a_plain_trajectory_has_the_states_of_one_with_beta() {
        for name in SCHEMES {
            let scheme = shipped(name).unwrap();
            let states = plain(&scheme, 50);
            assert_eq!(states.len(), 51);
            let mut with_beta = Trajectory::new(&scheme, start(), &step(), 50, 3).unwrap();
            while let Some(State { n, q, p, .. }) = with_beta.advance().unwrap() {
                if (0..=50).contains(&n) {
                    assert_eq!((n, q, p), (states[n as usize].0, &*states[n as usize].1, &*states[n as usize].2));
                }
            }
        }
    }

    #[test]
    fn a_plain_trajectory_costs_its_steps_only() {
        let scheme = shipped("stormer-verlet").unwrap();
        let mut trajectory = Trajectory::plain(&scheme, start(), &step(), 0, 40).unwrap();
        while trajectory.advance().unwrap().is_some() {}
        assert_eq!(trajectory.motion().evaluations(), 41);
    }

    #[test]
    fn a_plain_trajectory_taken_up_has_the_same_states() {
        for name in SCHEMES {
            let scheme = shipped(name).unwrap();
            let states = plain(&scheme, 50);
            let (n, q, p) = states[20].clone();
            let mut later = Trajectory::plain(&scheme, motion(q, p), &step(), n, 50).unwrap();
            for (n, q, p) in &states[20..] {
                let state = later.advance().unwrap().unwrap();
                assert_eq!((state.n, state.q, state.p), (*n, &**q, &**p), "{name}");
            }
            assert!(later.advance().unwrap().is_none());
        }
    }

    /// n, value, error and m.
    type Owned = (i64, f64, Option<f64>, u32);

    fn estimates<E: Estimator<f64>>(
        mut run: ShadowRun<Trajectory<'_, TableScheme, f64, Vec<f64>, Kepler, UnitMasses>, E>,
    ) -> Vec<Owned> {
        let mut all = Vec::new();
        while let Some((n, found)) = run.advance().unwrap() {
            all.push((n, *found.value, found.error.copied(), found.order));
        }
        all
    }

    #[test]
    fn modified_energies_taken_up_are_the_same() {
        let methods = [
            Central::fixed_with_error(4),
            Central::fixed(1),
            Central::best(9, Stop::Full),
            Central::best(20, Stop::Early),
            Central::best_with_error(9, Stop::Full, Rule::Robust),
        ];
        for name in SCHEMES {
            let scheme = shipped(name).unwrap();
            let states = plain(&scheme, 60);
            for method in &methods {
                let run = ShadowRun::new(&scheme, start(), &step(), 60, method).unwrap();
                let reach = run.reach() as usize;
                let all = estimates(run);
                assert_eq!(all.len(), 61);
                for from in [0, 1, 17, 59] {
                    let (n, q, p) = states[from].clone();
                    let run = ShadowRun::resume(&scheme, motion(q, p), &step(), n, 60, method).unwrap();
                    let expected = all.get(from + reach + 1..).unwrap_or_default();
                    assert_eq!(estimates(run), expected, "{name}, {method:?}, from {from}");
                }
            }
        }
    }

    #[test]
    fn a_step_of_size_0_is_refused_by_all() {
        let scheme = shipped("stormer-verlet").unwrap();
        let h = Rational::zero();
        assert_eq!(Trajectory::new(&scheme, start(), &h, 9, 2).err(), Some(RunError::ZeroStep));
        assert_eq!(Trajectory::plain(&scheme, start(), &h, 0, 9).err(), Some(RunError::ZeroStep));
        assert_eq!(ShadowRun::new(&scheme, start(), &h, 9, &Central::fixed(2)).err(), Some(RunError::ZeroStep));
    }
}
