//! The states of a trajectory in the order of time, with those that an estimator needs on both sides.

use crate::number::{Number, Real};
use crate::shadow::run::error::{RunError, check_energy};
use crate::shadow::run::state::{States, TrajectoryState, last};
use crate::steps::integrator::Integrator;
use crate::systems::coordinates::Coordinates;
use crate::systems::increments::{Carried, OwnedIncrements};
use crate::systems::state::{Saved, State};
use crate::systems::summation::Summation;
use crate::systems::system::Visitor;

/// The states of a trajectory in the order of time: for an estimator n = −reach, …, steps + reach with the increments
/// of each step, or [plain](Trajectory::plain) ones without them.
///
/// States before 0 are made with the scheme's exact inverse from the state 0.
pub struct Trajectory<I: Integrator> {
    integrator: I,
    augmented: bool,
    /// States that are computed before their turn, the earliest last.
    before: Vec<Stored<I::Number>>,
    present: Option<Stored<I::Number>>,
    n: i64,
    last: i64,
}

/// A state that is computed before its turn.
#[derive(Clone)]
struct Stored<N> {
    q: Vec<N>,
    p: Vec<N>,
    increments: OwnedIncrements<N>,
}

impl<N: Number> Stored<N> {
    fn of<V: Coordinates<N>, S: Summation<N>>(state: &State<N, V, S>) -> Self {
        Stored { q: state.q().to_vec(), p: state.p().to_vec(), increments: state.increments().to_owned() }
    }
}

/// From this number of steps on [`Trajectory::reach`] saves a state and makes them at once.
const AT_ONCE: i64 = 4;

impl<I: Integrator<Number: Real>> Trajectory<I> {
    /// Begins at the system's present state.
    ///
    /// # Errors
    /// An initial energy, or a state before 0, that is not finite; steps that do not suit the system: see
    /// [`Integrator::check`].
    pub fn new(integrator: I, steps: u64, reach: usize) -> Result<Self, RunError> {
        let mut trajectory = Self::after(integrator, 0)?;
        trajectory.extend(steps, reach);
        trajectory.step_back(reach)?;
        Ok(trajectory)
    }

    /// The states n = `from`, …, steps, whose increments are all 0; the system is at the state `from`.
    ///
    /// They have the bits of the states with increments, and the bits of a trajectory from 0 where `from` is one of its
    /// states.
    ///
    /// # Errors
    /// An energy at `from` that is not finite; steps that do not suit the system.
    pub fn plain(integrator: I, from: i64, steps: u64) -> Result<Self, RunError> {
        let mut trajectory = Self::after(integrator, from)?;
        trajectory.extend(steps, 0);
        trajectory.augmented = false;
        trajectory.before.push(Stored::of(trajectory.integrator.state()));
        trajectory.n -= 1;
        Ok(trajectory)
    }

    /// The states after `from`, with increments, up to a last one that [`extend`](Self::extend) sets; the system is at
    /// the state `from`.
    pub(super) fn after(mut integrator: I, from: i64) -> Result<Self, RunError> {
        integrator.check()?;
        check_energy(&integrator.system().energy(), integrator.state().q(), from)?;
        Ok(Trajectory { integrator, augmented: true, before: Vec::new(), present: None, n: from, last: from })
    }

    /// Sets the last state, which the estimate of the state `steps` needs.
    pub(super) fn extend(&mut self, steps: u64, reach: usize) {
        self.last = last(steps, reach);
    }

    /// Makes the states −reach, …, 0 from the present one, which is 0, and returns to it.
    pub(super) fn step_back(&mut self, reach: usize) -> Result<(), RunError> {
        let Trajectory { integrator, before, .. } = self;
        let (mut later, saved) = (Stored::of(integrator.state()), Saved::of(integrator.state()));
        for n in 1..=reach as i64 {
            integrator.step_back(Carried::Increments);
            TrajectoryState::of(integrator.state(), -n).check()?;
            // the step from −n to −n + 1 adds what the step back took
            later.increments.assign(integrator.state().increments());
            later.increments.negate();
            let earlier = Stored::of(integrator.state());
            before.push(std::mem::replace(&mut later, earlier));
        }
        later.increments.assign_zero();
        before.push(later);
        saved.restore(integrator.system().state_mut());
        self.n = -(reach as i64) - 1;
        Ok(())
    }

    /// The system with its stepper, for energies and counts.
    pub fn integrator(&mut self) -> &mut I {
        &mut self.integrator
    }

    /// Whether the following steps compute increments: q and p have the same bits with and without.
    pub fn set_augmented(&mut self, augmented: bool) {
        self.augmented = augmented;
    }

    /// Goes to the state n, or to the last one if that comes before: the states between are made in less time than by
    /// [`advance`](States::advance), with the same bits and checks.
    ///
    /// # Errors
    /// As `advance`.
    #[inline]
    pub fn reach(&mut self, n: i64) -> Result<(), RunError> {
        if n <= self.n { Ok(()) } else { self.make_until(n, None) }
    }

    /// The same, and the visitor sees the states between and the last one; of a run that fails also some that are not
    /// finite.
    ///
    /// # Errors
    /// As `advance`.
    pub fn reach_visited(&mut self, n: i64, visitor: &mut dyn Visitor<I::Number>) -> Result<(), RunError> {
        if n <= self.n { Ok(()) } else { self.make_until(n, Some(visitor)) }
    }

    /// Goes on from the state n, which the caller has set the integrator to: it is one of those that were made.
    pub fn go_on_from(&mut self, n: i64) {
        self.n = n;
    }

    fn make_until(&mut self, n: i64, mut visitor: Option<&mut dyn Visitor<I::Number>>) -> Result<(), RunError> {
        let n = n.min(self.last);
        while self.n < n && (self.augmented || !self.before.is_empty() || n - self.n < AT_ONCE) {
            let state = self.advance()?;
            if let (Some(visitor), Some(state)) = (&mut visitor, state) {
                visitor.visit(state.q, state.p);
            }
        }
        if self.n >= n {
            return Ok(());
        }
        let (from, saved) = (self.n, Saved::of(self.integrator.state()));
        match visitor {
            Some(visitor) => self.integrator.steps_visited(n.abs_diff(from), visitor),
            None => self.integrator.steps(n.abs_diff(from)),
        }
        self.n = n;
        if TrajectoryState::of(self.integrator.state(), n).check().is_ok() {
            return Ok(());
        }
        // what is not finite stays so: the first such state is found one by one
        saved.restore(self.integrator.system().state_mut());
        self.n = from;
        (from..n).try_for_each(|_| self.step().map(drop))
    }

    /// The next step, whose state must be finite.
    #[inline]
    fn step(&mut self) -> Result<TrajectoryState<'_, I::Number>, RunError> {
        self.n += 1;
        self.integrator.step(if self.augmented { Carried::Increments } else { Carried::Nothing });
        let state = TrajectoryState::of(self.integrator.state(), self.n);
        state.check()?;
        Ok(state)
    }
}

impl<I: Integrator<Number: Real>> States for Trajectory<I> {
    type Number = I::Number;

    fn advance(&mut self) -> Result<Option<TrajectoryState<'_, I::Number>>, RunError> {
        if self.n >= self.last {
            return Ok(None);
        }
        let Some(stored) = self.before.pop() else { return self.step().map(Some) };
        self.n += 1;
        let Stored { q, p, increments } = self.present.insert(stored);
        Ok(Some(TrajectoryState { n: self.n, q, p, increments: increments.view() }))
    }

    fn is_compensated(&self) -> bool {
        self.integrator.state().is_compensated()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::steps::stepper::Stepper;
    use crate::steps::tables::{TableScheme, shipped};
    use crate::systems::kinetic::UnitMasses;
    use crate::systems::motion::Motion;
    use crate::systems::problems::Kepler;

    type Comet = Motion<f64, Vec<f64>, Kepler, UnitMasses>;

    fn motion(q: Vec<f64>, p: Vec<f64>) -> Comet {
        Motion::new(Kepler, UnitMasses, q, p).unwrap()
    }

    fn start() -> Comet {
        motion(vec![0.4, 0.0], vec![0.0, 2.0])
    }

    fn steppers() -> impl Iterator<Item = Stepper<TableScheme, f64>> {
        ["stormer-verlet", "yoshida4", "ruth3"]
            .into_iter()
            .map(|name| Stepper::new(shipped(name).unwrap(), "1/20").unwrap())
    }

    /// n, q and p of the states from 0 on.
    fn plain(stepper: &Stepper<TableScheme, f64>, steps: u64) -> Vec<(i64, Vec<f64>, Vec<f64>)> {
        let mut trajectory = Trajectory::plain(stepper.with(start()), 0, steps).unwrap();
        let mut states = Vec::new();
        while let Some(state) = trajectory.advance().unwrap() {
            states.push((state.n, state.q.to_vec(), state.p.to_vec()));
        }
        states
    }

    #[test]
    fn a_plain_trajectory_has_the_states_of_one_with_increments() {
        for stepper in steppers() {
            let states = plain(&stepper, 50);
            assert_eq!(states.len(), 51);
            let mut augmented = Trajectory::new(stepper.with(start()), 50, 3).unwrap();
            while let Some(TrajectoryState { n, q, p, .. }) = augmented.advance().unwrap() {
                if (0..=50).contains(&n) {
                    assert_eq!((n, q, p), (states[n as usize].0, &*states[n as usize].1, &*states[n as usize].2));
                }
            }
        }
    }

    #[test]
    fn a_plain_trajectory_costs_its_steps_only() {
        let stepper = Stepper::new(shipped("stormer-verlet").unwrap(), "1/20").unwrap();
        let mut trajectory = Trajectory::plain(stepper.with(start()), 0, 40).unwrap();
        while trajectory.advance().unwrap().is_some() {}
        assert_eq!(trajectory.integrator().state().evaluations(), 41);
    }

    #[test]
    fn the_end_is_reached_with_the_same_bits() {
        for stepper in steppers() {
            let (_, q, p) = plain(&stepper, 50).pop().unwrap();
            let mut trajectory = Trajectory::plain(stepper.with(start()), 0, 50).unwrap();
            for stop in [0, 3, 17] {
                trajectory.reach(stop).unwrap();
            }
            assert_eq!(trajectory.advance().unwrap().unwrap().n, 18);
            trajectory.reach(70).unwrap();
            assert_eq!(trajectory.integrator().state().q(), q);
            assert_eq!(trajectory.integrator().state().p(), p);
            assert!(trajectory.advance().unwrap().is_none());
            // towards the origin: the force is infinite there
            let mut lost = Trajectory::plain(stepper.with(motion(vec![0.05, 0.0], vec![-1.0, 0.0])), 0, 20).unwrap();
            let error = lost.reach(20);
            let mut again = Trajectory::plain(stepper.with(motion(vec![0.05, 0.0], vec![-1.0, 0.0])), 0, 20).unwrap();
            assert_eq!(error.err(), (0..3).find_map(|_| again.advance().err()));
        }
    }

    /// Keeps the states that it sees.
    #[derive(Default)]
    struct Seen(Vec<(Vec<f64>, Vec<f64>)>);

    impl Visitor<f64> for Seen {
        fn visit(&mut self, q: &[f64], p: &[f64]) {
            self.0.push((q.to_vec(), p.to_vec()));
        }
    }

    #[test]
    fn states_that_are_reached_are_visited() {
        for stepper in steppers() {
            let states = plain(&stepper, 50);
            let mut trajectory = Trajectory::plain(stepper.with(start()), 0, 50).unwrap();
            let mut seen = Seen::default();
            // the state at the beginning, too few steps to be made at once, and many
            for stop in [0, 3, 17, 17, 70] {
                trajectory.reach_visited(stop, &mut seen).unwrap();
            }
            let expected: Vec<_> = states.into_iter().map(|(_, q, p)| (q, p)).collect();
            assert_eq!(seen.0, expected);
        }
    }

    #[test]
    fn a_resumed_plain_trajectory_has_the_same_states() {
        for stepper in steppers() {
            let states = plain(&stepper, 50);
            let (n, q, p) = states[20].clone();
            let mut resumed = Trajectory::plain(stepper.with(motion(q, p)), n, 50).unwrap();
            for (n, q, p) in &states[20..] {
                let state = resumed.advance().unwrap().unwrap();
                assert_eq!((state.n, state.q, state.p), (*n, &**q, &**p), "{:?}", stepper.scheme());
            }
            assert!(resumed.advance().unwrap().is_none());
        }
    }
}
