//! The one loop of runs: it makes the states in the order of time, with their modified energies if these are wanted,
//! and shows them to columns.

use std::ops::ControlFlow::{self, Break, Continue};

use shadowstep::number::saved::{Fields, Saved as _};
use shadowstep::shadow::run::{RunError, ShadowRun, States as _, Trajectory};
use shadowstep::shadow::{BuildEstimator, Estimate, EstimatorSettings};
use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep::steps::step_to_time;
use shadowstep::{Carried, Rational};

use crate::columns::at::{At, Place, View};
use crate::columns::column::{Column, next_multiple, show};
use crate::execution::crossings::{Crossings, NEEDS_PARTS_OF_STEPS};
use crate::execution::pace::Pace;
use crate::execution::passing::{Ends, Passing};
use crate::execution::posed::{Followed, Posed, unreadable};
use crate::results::moment::{Moment, Moments};
use crate::run::Run;
use crate::run::note::Note;
use crate::run::saved_summary::SavedSummary;
use crate::run::snapshots::Snapshot;
use crate::scene::{CheckpointInterval, SceneNumber};
use crate::texts::error::Error;
use crate::watch::Watch;
use crate::watch::observer::Observer;

/// The observer is asked at each of the first states: it may stop short runs anywhere.
const ONE_BY_ONE: u64 = 256;

/// Makes a run and shows its states to columns.
pub(crate) fn follow<N: SceneNumber>(
    posed: &Posed<'_>,
    context: &N::Context,
    columns: &mut [&mut dyn Column<N>],
    observer: &mut dyn Observer,
) -> Result<Followed, Error> {
    if posed.displaced && posed.section.is_some() {
        return Err(Error::usage(NEEDS_PARTS_OF_STEPS, "write gradient_kicks = \"exact\", or remove the section"));
    }
    let (mut integrator, from) = posed.begin::<N>(context)?;
    let mut following = Following::begin(posed, (&mut *integrator, from), columns, observer, context)?;
    following.states(&mut *integrator)?;
    following.complete(&mut *integrator)
}

/// Where the states come from.
enum Source<'i, 's, N: SceneNumber> {
    Plain(Trajectory<&'i mut VectorIntegrator<'s, N>>),
    Estimated(Estimating<'i, 's, N>),
}

type Estimating<'i, 's, N> =
    ShadowRun<Trajectory<&'i mut VectorIntegrator<'s, N>>, <EstimatorSettings as BuildEstimator<N>>::Estimator>;

/// The n of a state, its estimate if there is one, and the integrator: at the state, or ahead of its estimate.
type Made<'t, 's, N> = (i64, Option<Estimate<'t, N>>, &'t mut VectorIntegrator<'s, N>);

/// Follows the states in the order of time.
struct Following<'a, 'c, N: SceneNumber> {
    posed: &'a Posed<'a>,
    columns: &'a mut [&'c mut dyn Column<N>],
    observer: &'a mut dyn Observer,
    view: View<'a, N>,
    watch: Option<Watch<N>>,
    crossings: Option<Crossings<N>>,
    ends: Ends<N>,
    /// Whether a column sees each state.
    sees_each: bool,
    /// The state from which the run is resumed; `None` at its beginning.
    from: Option<i64>,
    /// The n of the last state; where something else ends the run, the most until that is known.
    last: i64,
    is_met: bool,
    /// Whether the states are made one by one: each is seen, or the end is known to be among the next ones.
    one_by_one: bool,
    is_stopped: bool,
    /// Whether a column ended the run.
    is_ended_by_column: bool,
    /// The n of the newest output, and of the newest state that was seen: a resumed run with estimates makes some once
    /// more.
    n: i64,
    seen: i64,
    /// The n of the next output that a column takes.
    due: i64,
    /// Outputs up to this n were shown before the run was resumed.
    written: i64,
    /// The last state; until it is known the newest one, of a run with a physical end.
    state: Option<Snapshot<N>>,
    moments: Moments<N>,
    /// Evaluations of the gradient at the first state and at the last one.
    evaluations: [u64; 2],
    /// Of asking the observer.
    pace: Pace,
}

impl<'a, 'c, N: SceneNumber> Following<'a, 'c, N> {
    fn begin(
        posed: &'a Posed<'a>,
        (integrator, from): (&mut VectorIntegrator<'_, N>, Option<i64>),
        columns: &'a mut [&'c mut dyn Column<N>],
        observer: &'a mut dyn Observer,
        context: &'a N::Context,
    ) -> Result<Self, Error> {
        let Posed { system, run, .. } = *posed;
        let first = from.unwrap_or(0);
        let ends = Ends::of(posed, context);
        let sees_each = columns.iter().any(|column| column.sees_each());
        let mut following = Following {
            one_by_one: sees_each || posed.section.is_some() || ends.need_system(integrator.is_processed()),
            view: View::new(system, run, context, posed.tangents()?),
            watch: None,
            crossings: posed.section.map(|surface| Crossings::new(surface, system, context)),
            ends,
            sees_each,
            from,
            last: i64::try_from(run.steps).unwrap_or(i64::MAX),
            is_met: false,
            is_stopped: false,
            is_ended_by_column: false,
            n: first,
            seen: first - 1,
            due: 0,
            written: posed.resumed.checkpoint.map_or(-1, |checkpoint| checkpoint.n),
            state: None,
            moments: Moments::new(posed.resumed.interval),
            evaluations: [0; 2],
            pace: Pace::new(first.unsigned_abs() + ONE_BY_ONE),
            posed,
            columns,
            observer,
        };
        following.watch = posed.watch(integrator, (first, following.view.energy_of.is_some()), context)?;
        following.resume_summary()?;
        Ok(following)
    }

    /// Goes on with the summary from that of the run before.
    fn resume_summary(&mut self) -> Result<(), Error> {
        let (Some(checkpoint), true) = (self.posed.resumed.checkpoint, self.posed.summarised) else { return Ok(()) };
        match (&checkpoint.summary, self.from) {
            (Some(saved), _) => {
                self.seen = saved.n;
                if saved.restore(|to| self.fields(to)) { Ok(()) } else { Err(unreadable(checkpoint.n)) }
            }
            (None, Some(n)) => {
                self.observer.note(&Note::SummaryOfPart { n });
                Ok(())
            }
            // it begins at t = 0 again
            (None, None) => Ok(()),
        }
    }

    /// All numbers that the states so far have left.
    fn fields(&mut self, to: &mut dyn Fields<N>) {
        self.watch.iter_mut().for_each(|watch| watch.fields(to));
        self.columns.iter_mut().for_each(|column| column.fields(self.view.context, to));
    }

    fn run(&self) -> Run<'a> {
        Run { steps: self.last.unsigned_abs(), ..self.posed.run }
    }

    fn failed(&self, error: &RunError) -> Error {
        self.posed.named(self.run(), error)
    }

    /// The loop: makes the states that a column or the summary wants, and shows them.
    fn states(&mut self, integrator: &mut VectorIntegrator<'_, N>) -> Result<(), Error> {
        let mut source = self.source(integrator)?;
        let mut reached = None;
        loop {
            let made = match &mut source {
                Source::Plain(trajectory) => self.next_state(trajectory, reached)?,
                Source::Estimated(run) => self.next_estimate(run)?,
            };
            let Some((n, estimate, integrator)) = made else { return Ok(()) };
            if self.output(n, estimate.as_ref(), integrator)?.is_break() {
                return Ok(());
            }
            reached = Some(n);
        }
    }

    /// States without those beyond both ends, or states with estimates and their errors.
    fn source<'i, 's>(&mut self, integrator: &'i mut VectorIntegrator<'s, N>) -> Result<Source<'i, 's, N>, Error> {
        let (from, steps) = (self.from.unwrap_or(0), self.last.unsigned_abs());
        let Some(settings) = self.posed.estimator else {
            let trajectory = Trajectory::plain(integrator, from, steps);
            return trajectory.map(Source::Plain).map_err(|error| self.failed(&error));
        };
        let settings = settings.clone().with_errors(true);
        let begun = match self.from {
            None => ShadowRun::new(integrator, steps, &settings),
            Some(from) => ShadowRun::resume(integrator, from, steps, &settings),
        };
        let mut run = begun.map_err(|error| self.failed(&error))?;
        let first = self.from.map(|from| Snapshot::of(from, run.integrator().state()));
        self.moments.estimate(run.reach(), first);
        Ok(Source::Estimated(run))
    }

    /// The next state that is to be seen or shown, made with increments only where the summary needs them.
    fn next_state<'t, 's>(
        &mut self,
        trajectory: &'t mut Trajectory<&mut VectorIntegrator<'s, N>>,
        reached: Option<i64>,
    ) -> Result<Option<Made<'t, 's, N>>, Error> {
        if let Some(reached) = reached
            && let before = self.next(reached) - 1
            && before > reached
        {
            trajectory.set_augmented(false);
            self.pass(trajectory, (reached, before)).map_err(|error| self.failed(&error))?;
        }
        trajectory.set_augmented(self.needs_increments());
        let made = trajectory.advance().map_err(|error| self.failed(&error))?;
        let Some(n) = made.map(|state| state.n) else { return Ok(None) };
        let integrator = &mut **trajectory.integrator();
        if self.see(n, integrator) {
            let last = self.state.as_ref().expect("the state before was kept");
            last.restore(integrator);
            return Ok(None);
        }
        Ok(Some((n, None, integrator)))
    }

    /// The next estimate: each state is made with increments, and seen.
    fn next_estimate<'t, 'i, 's>(
        &mut self,
        run: &'t mut Estimating<'i, 's, N>,
    ) -> Result<Option<Made<'t, 's, N>>, Error> {
        let next = run.advance_with(|n, trajectory| {
            self.see(n, *trajectory.integrator());
        });
        let next = match next {
            // states beyond the last one are made for estimates only
            Err(_) if self.is_ended_by_column => None,
            next => next.map_err(|error| self.failed(&error))?,
        };
        let next = next.filter(|((n, _), _)| *n <= self.last);
        Ok(next.map(|((n, estimate), trajectory)| (n, Some(estimate), &mut **trajectory.integrator())))
    }

    /// Whether the next step carries increments along.
    fn needs_increments(&self) -> bool {
        let of_watch = self.watch.as_ref().is_some_and(|watch| watch.carried() == Carried::Increments);
        of_watch || self.sees_each && self.columns.iter().any(|column| column.needs_increments())
    }

    /// Makes the states up to n, which need not be seen or shown: the summary and the end take what they need of them.
    /// Where the end comes before n, they are made again, one by one.
    fn pass(
        &mut self,
        trajectory: &mut Trajectory<&mut VectorIntegrator<'_, N>>,
        (from, n): (i64, i64),
    ) -> Result<(), RunError> {
        let Following { watch, ends, view, .. } = self;
        if ends.are_none() {
            return match watch {
                Some(watch) => trajectory.reach_visited(n, watch),
                None => trajectory.reach(n),
            };
        }
        let before = Snapshot::of(from, trajectory.integrator().state());
        let mut passing = Passing { watch, ends, view, n: from, has_ended: false };
        let made = trajectory.reach_visited(n, &mut passing);
        let has_ended = passing.finish();
        self.seen = passing.n;
        if !has_ended {
            return made;
        }
        self.one_by_one = true;
        before.restore(trajectory.integrator());
        trajectory.go_on_from(from);
        Ok(())
    }

    /// The n of the next state after n that is to be seen, or shown.
    fn next(&self, n: i64) -> i64 {
        if self.one_by_one {
            return n + 1;
        }
        let checkpoint = match self.posed.resumed.interval {
            Some(CheckpointInterval::Steps(every)) => next_multiple(n, every),
            _ => i64::MAX,
        };
        let idle = self.watch.as_ref().map_or(u64::MAX, Watch::idle);
        let watched = n.saturating_add_unsigned(idle).saturating_add(1);
        let looked_up = i64::try_from(self.pace.next(n.unsigned_abs())).unwrap_or(i64::MAX);
        self.due.min(checkpoint).min(watched).min(looked_up).max(n + 1).min(self.last)
    }

    /// Sees the state n, at which the integrator is. Whether it is past the physical end, so that the state before is
    /// the last one.
    fn see(&mut self, n: i64, integrator: &mut VectorIntegrator<'_, N>) -> bool {
        self.moments.offer(n, integrator.state());
        if n == 0 {
            self.evaluations[0] = integrator.state().evaluations();
        }
        if n > self.last {
            return false;
        }
        if self.ends.are_passed(integrator.state().q()) {
            (self.last, self.ends.until) = (n - 1, None);
            return true;
        }
        if n >= 0 && (self.sees_each || self.ends.test.is_some()) {
            self.see_each(n, integrator);
        }
        // it has begun at the first state
        if let Some(watch) = self.watch.as_mut().filter(|_| n > self.seen && n > self.from.unwrap_or(0)) {
            watch.include(n, integrator);
        }
        self.seen = self.seen.max(n);
        if n == self.last || self.ends.until.is_some() {
            self.evaluations[1] = integrator.state().evaluations();
            match &mut self.state {
                Some(state) => state.update(n, integrator.state()),
                None => self.state = Some(Snapshot::of(n, integrator.state())),
            }
        }
        false
    }

    /// What sees each state, with which the run may end.
    fn see_each(&mut self, n: i64, integrator: &mut VectorIntegrator<'_, N>) {
        let (run, is_new) = (self.posed.run, n > self.seen);
        for column in self.columns.iter_mut().filter(|column| is_new && column.sees_each()) {
            if column.see(n, run, integrator) {
                (self.last, self.is_ended_by_column) = (n, true);
            }
        }
        if let Some(test) = self.ends.test.as_mut().filter(|_| n > 0)
            && at_output(integrator, |integrator| test.is_met(integrator.system(), || run.time(n)))
        {
            (self.last, self.is_met) = (n, true);
        }
        if self.last == n {
            self.ends.until = None;
        }
    }

    /// Shows the output of n. Without an estimate the integrator is at the state n; with one it is ahead, and the
    /// estimate has the state.
    fn output(
        &mut self,
        n: i64,
        estimate: Option<&Estimate<'_, N>>,
        integrator: &mut VectorIntegrator<'_, N>,
    ) -> Result<ControlFlow<()>, Error> {
        self.n = n;
        if let Some(vectors) = &mut self.view.vectors {
            vectors.reach(n);
        }
        self.pace.look_up(n.unsigned_abs());
        if estimate.is_none() {
            self.cross(n, integrator)?;
        }
        if (n >= self.due || n >= self.last) && n > self.written {
            self.due = self.columns.iter().map(|column| column.next(n)).min().unwrap_or(i64::MAX);
            let is_last = n == self.last;
            let is_met = self.is_met && is_last;
            let Following { view, columns, watch, .. } = self;
            match estimate {
                None => at_output(integrator, |integrator| {
                    show(columns, watch, &mut At { is_last, is_met, ..view.at(n, integrator) })
                })?,
                estimate => show(columns, watch, &mut At { is_last, is_met, estimate, ..view.at(n, integrator) })?,
            }
        }
        self.observer.progress(n);
        self.keep_if_due(n, integrator)?;
        Ok(if self.is_stopped || n >= self.last { Break(()) } else { Continue(()) })
    }

    /// Shows the crossing between the state n, at which the integrator is, and the state before.
    fn cross(&mut self, n: i64, integrator: &mut VectorIntegrator<'_, N>) -> Result<(), Error> {
        let Following { view, columns, watch, crossings: Some(crossings), written, .. } = self else { return Ok(()) };
        let evaluations = integrator.state().evaluations();
        let shown = crossings.state(n, integrator, |integrator, part| {
            if n <= *written {
                return Ok(());
            }
            let time = view.run.time_of_crossing(n - 1, part, view.context);
            let at = At { place: Place::Crossing, time: Some(time), ..view.at(n - 1, integrator) };
            show(columns, &mut None, &mut { at })
        });
        if let Some(watch) = watch.as_mut().filter(|_| integrator.state().evaluations() != evaluations) {
            watch.state_restored();
        }
        shown.unwrap_or(Ok(()))
    }

    /// Keeps a moment where it is time for one, at the last state, from which the run can be prolonged, or where the
    /// run is stopped: then it ends.
    fn keep_if_due(&mut self, n: i64, integrator: &VectorIntegrator<'_, N>) -> Result<(), Error> {
        self.is_stopped = self.observer.stops();
        if n <= self.written || !(self.moments.is_due(n, self.last) || self.is_stopped) {
            return Ok(());
        }
        self.keep(n, || Snapshot::of(n, integrator.state()))
    }

    /// Keeps the moment of the state n.
    #[cold]
    fn keep(&mut self, n: i64, state: impl FnOnce() -> Snapshot<N>) -> Result<(), Error> {
        let vectors = match &self.view.vectors {
            None => Some(Vec::new()),
            Some(vectors) => vectors.saved(),
        };
        let (Some(state), Some(vectors)) = (self.moments.begin(n, state), vectors) else {
            self.observer.note(&Note::NoCheckpoint { n });
            return Ok(());
        };
        let summarised = self.posed.summarised;
        let summary = summarised.then(|| SavedSummary::of(self.seen, |to| self.fields(to))).flatten();
        let moment = Moment { n, is_last: n == self.last, state, vectors, summary };
        self.columns.iter_mut().try_for_each(|column| column.keep(&moment))?;
        self.moments.is_kept_at_end = moment.is_last;
        Ok(())
    }

    /// What has become of the run, and its last state once more.
    fn complete(mut self, integrator: &mut VectorIntegrator<'_, N>) -> Result<Followed, Error> {
        let (n, run) = (self.n, self.run());
        let mut followed = Followed {
            n,
            is_met: self.is_met || self.is_ended_by_column,
            is_stopped: self.is_stopped,
            evaluations: integrator.state().evaluations(),
            own_evaluations: self.evaluations[1].saturating_sub(self.evaluations[0]),
            energy: None,
            summary: None,
            vectors: None,
        };
        if self.is_stopped {
            return Ok(followed);
        }
        followed.n = self.last;
        let last = self.state.take().expect("the last state was seen");
        if self.moments.lacks_end() && self.last > self.written {
            // that it is the last one was known later
            self.keep(self.last, || last.clone())?;
        }
        let (mut q, mut p) = (last.q, last.p);
        integrator.postprocess_state(&mut q, &mut p);
        let energy = integrator.energy_at(&q, &p);
        // the gradient may have values where the potential has none, as that of log(x) for x < 0
        if !energy.is_finite() {
            return Err(run.not_finite(&format!("the energy at the end, n = {},", self.last)));
        }
        if let Some(watch) = &mut self.watch {
            watch.include_energy(self.last, &energy);
        }
        let Following { view, columns, watch, last: n, .. } = &mut self;
        let energy = Some(energy).filter(|_| view.energy_of.is_none());
        let mut at = At { other: Some((q.clone(), p.clone())), energy, ..view.at(*n, integrator) };
        columns.iter_mut().try_for_each(|column| column.end(&mut at))?;
        followed.energy = watch.as_ref().map(Watch::energy);
        followed.summary = watch.take().and_then(|watch| watch.summary(run));
        if let Some(until) = self.posed.until.filter(|_| !followed.is_met) {
            self.end_at_time(integrator, (&q, &p), until)?;
        }
        followed.vectors = self.view.vectors;
        Ok(followed)
    }

    /// Makes the last step from the last state to the physical end, and shows its state.
    fn end_at_time(
        &mut self,
        integrator: &mut VectorIntegrator<'_, N>,
        (q, p): (&[N], &[N]),
        until: &Rational,
    ) -> Result<(), Error> {
        let until = N::from_rational(until, self.view.context);
        if q.last() == Some(&until) {
            return Ok(());
        }
        integrator.system().state_mut().set(q, p);
        if step_to_time(integrator, &until).is_none() {
            let message = format!("{}: no last step to t = {until} has a finite state", self.run().name());
            return Err(Error::run(message, "try a smaller step size"));
        }
        let at = At { place: Place::PhysicalEnd, ..self.view.at(self.last + 1, integrator) };
        show(self.columns, &mut None, &mut { at })
    }
}

#[cfg(test)]
mod tests;
