//! The run of a scene: only what it asks for is computed.

use std::mem::take;
use std::ops::ControlFlow::{self, Break, Continue};
use std::time::{Duration, Instant};

use shadowstep::number::saved::{Fields, Saved as _};
use shadowstep::shadow::Estimate;
use shadowstep::shadow::run::RunError;
use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep::systems::system::Visitor;
use shadowstep::{Carried, MotionError};

use crate::computation::RunNumber;
use crate::crossings::Crossings;
use crate::error::Error;
use crate::follow::{Follower, follow};
use crate::note::Note;
use crate::observer::Observer;
use crate::pace::Pace;
use crate::physical_end::last_step;
use crate::results::{Checkpoint, Indicators, ModifiedEnergy, Row, Rows};
use crate::run::Run;
use crate::saved_state::SavedState;
use crate::saved_summary::SavedSummary;
use crate::scene::split::ShownCoordinates;
use crate::scene::{CheckpointInterval, EnergyAt, Outputs, Scene};
use crate::snapshots::{Snapshot, Snapshots};
use crate::start::Begin;
use crate::tangent::{FollowingVectors, VECTORS_OF_ROWS, Vectors};
use crate::values::{Extremes, ValuesOfRows};
use crate::watch::summary::Summary;
use crate::watch::{Energies, Watch};

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// With its last step.
    Complete {
        /// Evaluations of the gradient in this call; a resumed run made others before.
        force_evaluations: u64,
    },
    /// The file was complete before: nothing was done.
    AlreadyComplete,
    /// The observer stopped it.
    Stopped {
        /// After this state.
        n: i64,
    },
}

/// How a run ended, and its summary if it is complete and the observer wants one.
pub(crate) type Ended = (Outcome, Option<Summary>);

/// Runs the scene, from a checkpoint if there is one, until it is complete or the observer stops it.
pub(crate) fn run<N: RunNumber>(
    scene: &Scene,
    context: &N::Context,
    rows: &mut Rows<'_>,
    checkpoint: Option<&Checkpoint>,
    observer: &mut dyn Observer,
) -> Result<Ended, Error> {
    let saved = checkpoint.and_then(|checkpoint| checkpoint.state.as_ref());
    // the states of checkpoints are those of the steps
    let (begin, state, remainders) = match saved {
        None => (Begin::InitialState, scene.system.start::<N>(context), None),
        Some(saved) => {
            let (state, remainders) = saved.numbers(context).ok_or_else(|| unreadable(saved.n))?;
            (Begin::Step, state, Some(remainders))
        }
    };
    let integrator = scene.system.integrator(scene.steps_from(begin), state, context);
    let mut integrator = integrator.map_err(|error| inconsistent(&error))?;
    if let Some(remainders) = remainders {
        integrator.system().state_mut().set_remainders(&remainders);
    }
    let from = saved.map(|saved| saved.n);
    let vectors = vectors(scene, checkpoint)?;
    let values = scene.output.values.iter().map(|columns| ValuesOfRows::new(columns, &scene.system, context));
    let mut recorder = Recorder {
        values: values.collect(),
        extremes: Extremes::new(
            if scene.summarises(observer) { &scene.output.extremes } else { &[] },
            &scene.system,
            context,
        ),
        scene,
        run: scene.as_run(),
        context,
        rows,
        written: checkpoint.map_or(-1, |checkpoint| checkpoint.n),
        last_checkpoint: Instant::now(),
        last_state: Instant::now(),
        observer,
        from,
        shown: scene.system.shown(context),
        energy_of: scene.system.energy_of_rows(context),
        watch: None,
        vectors,
        crossings: scene.output.section.as_ref().map(|surface| Crossings::new(surface, &scene.system, context)),
        snapshots: Snapshots::new(0),
        state: (integrator.state().q().to_vec(), integrator.state().p().to_vec()),
        n: from.unwrap_or(0),
        seen: from.unwrap_or(0) - 1,
        due: 0,
        pace: Pace::new(from.unwrap_or(0).unsigned_abs() + ONE_BY_ONE),
    };
    recorder.watch = recorder.watch(&mut *integrator)?;
    recorder.resume_summary(checkpoint)?;
    let settings = scene.output.modified_energy.as_ref().map(|(settings, _)| settings);
    match follow(&mut *integrator, (from, recorder.run.steps), settings, &mut recorder)? {
        Break(()) => Ok((Outcome::Stopped { n: recorder.n }, None)),
        Continue(()) => recorder.complete(&mut *integrator),
    }
}

/// The tangent vectors of rows, at t = 0 or at the state of the checkpoint.
fn vectors(scene: &Scene, checkpoint: Option<&Checkpoint>) -> Result<Option<FollowingVectors>, Error> {
    if scene.output.chaos.is_none() {
        return Ok(None);
    }
    let mut vectors = scene.tangents(Vectors::Free(VECTORS_OF_ROWS), 1)?;
    if let Some(Checkpoint { n, vectors: saved, .. }) = checkpoint
        && !vectors.restore(*n, saved)
    {
        return Err(unreadable(*n));
    }
    Ok(Some(vectors))
}

/// Dimensions that do not agree, such as those of the state in a checkpoint.
fn inconsistent(error: &MotionError) -> Error {
    Error::usage(error.to_string(), "begin again with `restart`")
}

fn unreadable(n: i64) -> Error {
    Error::usage(format!("the state n = {n} of the checkpoint cannot be read"), "begin again with `restart`")
}

/// The next multiple of `every` after n.
fn next_multiple(n: i64, every: u64) -> i64 {
    n.saturating_add_unsigned(every - n.unsigned_abs() % every)
}

/// Where a state takes longer than this, each has its checkpoint: a program that is asked to end may not wait for the next one.
const LONG: Duration = Duration::from_millis(500);

/// The observer is asked at each of the first states: it may stop short runs anywhere.
const ONE_BY_ONE: u64 = 256;

/// What a row has besides modified energies and indicators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Due {
    energy: bool,
    state: bool,
    /// Some of the values.
    values: bool,
    /// All of them, whatever their periods are.
    all_values: bool,
}

impl Due {
    const NOTHING: Due = Due { energy: false, state: false, values: false, all_values: false };
}

/// Follows the states of a run in the order of time.
struct Recorder<'a, 'r, N: RunNumber> {
    scene: &'a Scene,
    run: Run<'a>,
    context: &'a N::Context,
    rows: &'a mut Rows<'r>,
    /// Rows up to this n are in the file already.
    written: i64,
    last_checkpoint: Instant,
    last_state: Instant,
    observer: &'a mut dyn Observer,
    /// The state from which the run is resumed; `None` at its beginning.
    from: Option<i64>,
    /// Converts states for rows, where these have other coordinates than the steps.
    shown: Option<ShownCoordinates<N>>,
    /// H for rows, where the steps conserve another function.
    energy_of: Option<EnergyAt<N>>,
    /// Follows the run for a summary.
    watch: Option<Watch<N>>,
    /// The tangent vectors of rows, which make their own steps.
    vectors: Option<FollowingVectors>,
    /// Columns of expressions.
    values: Vec<ValuesOfRows<'a, N>>,
    /// Expressions whose least and greatest values the summary has.
    extremes: Extremes<'a, N>,
    /// Finds the crossings of a surface of section.
    crossings: Option<Crossings<N>>,
    /// The states from which estimates can be computed again.
    snapshots: Snapshots<N>,
    /// The state of the newest output, in the coordinates of the steps; of a processed scheme the trajectory's where it is written.
    state: (Vec<N>, Vec<N>),
    /// The n of the newest output.
    n: i64,
    /// That of the newest state that the summary has taken: a resumed run with estimates makes some once more.
    seen: i64,
    /// No row of states or energies is due before.
    due: i64,
    /// Of asking the observer.
    pace: Pace,
}

impl<N: RunNumber> Recorder<'_, '_, N> {
    /// Follows the run for a summary, if the observer wants one.
    fn watch(&self, integrator: &mut VectorIntegrator<'_, N>) -> Result<Option<Watch<N>>, Error> {
        if !self.scene.summarises(self.observer) {
            return Ok(None);
        }
        let run = (self.run, self.from.unwrap_or(0));
        let energies = match (self.scene.output.energy, &self.energy_of) {
            (Some(every), None) => Energies::Given(every),
            _ => Energies::Windows,
        };
        let watch = Watch::of_run(&self.scene.system, integrator, run, energies, self.context);
        watch.map(Some).map_err(|error| self.named(&error))
    }

    /// Goes on with the summary from that of the run before.
    fn resume_summary(&mut self, checkpoint: Option<&Checkpoint>) -> Result<(), Error> {
        let (Some(checkpoint), Some(_)) = (checkpoint, &self.watch) else { return Ok(()) };
        match (&checkpoint.summary, self.from) {
            (Some(saved), _) => {
                self.seen = saved.n;
                if saved.restore(|to| self.fields_of_summary(to)) { Ok(()) } else { Err(unreadable(checkpoint.n)) }
            }
            (None, Some(n)) => {
                self.observer.note(&Note::SummaryOfPart { n });
                Ok(())
            }
            // it begins at t = 0 again
            (None, None) => Ok(()),
        }
    }

    /// All numbers that the states so far have left for the summary.
    fn fields_of_summary(&mut self, to: &mut dyn Fields<N>) {
        self.watch.iter_mut().for_each(|watch| watch.fields(to));
        self.extremes.fields(self.context, to);
    }

    /// The error of the run, with the scene's names of coordinates and momenta.
    fn named(&self, error: &RunError) -> Error {
        let system = &self.scene.system;
        let failed = self.run.failed_naming(error, &system.coordinates, &system.momenta);
        match (failed, system.transformed_time()) {
            (Error::Run { message, .. }, Some(_)) if matches!(error, RunError::NotFinite { .. }) => Error::run(
                format!("{message}; time is transformed, which requires U < 0 and T + p_t > 0"),
                "remove [time] if U changes its sign on the orbit; otherwise try a smaller step size",
            ),
            (failed, _) => failed,
        }
    }

    /// The rows of the state n, at which the system is.
    fn present(&mut self, n: i64, integrator: &mut VectorIntegrator<'_, N>) -> Result<(), Error> {
        if n < self.due {
            self.observer.progress(n);
            return Ok(());
        }
        let Outputs { energy, trajectory, chaos, .. } = self.scene.output;
        let periods = [energy, trajectory, chaos].into_iter().flatten().chain(self.values.iter().map(|own| own.every));
        self.due = periods.map(|every| next_multiple(n, every)).min().unwrap_or(i64::MAX);
        self.due = self.due.min(i64::try_from(self.run.steps).unwrap_or(i64::MAX));
        let (due, chaos) = (self.due_at(n), self.is_due(chaos, n));
        if due == Due::NOTHING && !chaos {
            self.observer.progress(n);
            return Ok(());
        }
        at_output(integrator, |integrator| {
            let energy = self.needs_energy(due).then(|| self.energy(integrator));
            self.row(n, (integrator.state().q(), integrator.state().p()), energy.as_ref(), (due, None))
        })
    }

    /// The rows of the state n with its modified energy.
    #[inline(never)]
    fn estimated(
        &mut self,
        n: i64,
        found: &Estimate<'_, N>,
        integrator: &mut VectorIntegrator<'_, N>,
    ) -> Result<(), Error> {
        let (mut q, mut p) = take(&mut self.state);
        let [found_q, found_p] = found.state();
        q.iter_mut().zip(found_q).for_each(|(own, q)| own.assign(q));
        p.iter_mut().zip(found_p).for_each(|(own, p)| own.assign(p));
        let due = self.due_at(n);
        let every = self.scene.output.modified_energy.as_ref().map(|(_, every)| *every);
        let modified = self.is_due(every, n).then(|| ModifiedEnergy::of(found));
        if due != Due::NOTHING || n.unsigned_abs() == self.run.steps {
            integrator.postprocess_state(&mut q, &mut p);
        }
        let energy = self.needs_energy(due).then(|| match &mut self.energy_of {
            Some(energy_of) => energy_of(&q, &p),
            None => integrator.energy_at(&q, &p),
        });
        self.row(n, (&q, &p), energy.as_ref(), (due, modified))?;
        self.state = (q, p);
        Ok(())
    }

    /// The outcome of a run with its last state, and the summary.
    fn complete(mut self, integrator: &mut VectorIntegrator<'_, N>) -> Result<Ended, Error> {
        let energy = match self.scene.output.modified_energy {
            None => {
                self.state = (integrator.state().q().to_vec(), integrator.state().p().to_vec());
                at_output(integrator, |integrator| integrator.system().energy())
            }
            Some(_) => integrator.energy_at(&self.state.0, &self.state.1),
        };
        self.ends_in_the_domain(&energy)?;
        let outcome = Outcome::Complete { force_evaluations: integrator.state().evaluations() };
        let ended = (outcome, self.summary(&energy));
        self.end_at_time(integrator)?;
        Ok(ended)
    }

    /// H of the present state for a row.
    fn energy(&mut self, integrator: &mut VectorIntegrator<'_, N>) -> N {
        match &mut self.energy_of {
            Some(energy_of) => energy_of(integrator.state().q(), integrator.state().p()),
            None => integrator.system().energy(),
        }
    }

    /// Where time is transformed and the run ends at a physical time, makes the last step to it, and its row.
    fn end_at_time(&mut self, integrator: &mut VectorIntegrator<'_, N>) -> Result<(), Error> {
        let scene = self.scene;
        let Some(until) = scene.physical_end() else { return Ok(()) };
        if !last_step(integrator, (&self.state.0, &self.state.1), (self.run, until))? {
            return Ok(());
        }
        let due = Due { state: scene.output.trajectory.is_some(), ..self.due_everywhere() };
        if due == Due::NOTHING {
            return Ok(());
        }
        let n = i64::try_from(self.run.steps).unwrap_or(i64::MAX - 1) + 1;
        let energy = self.needs_energy(due).then(|| self.energy(integrator));
        let state = (integrator.state().q(), integrator.state().p());
        self.write((n, self.time(n, state.0)), state, energy.as_ref(), (due, None, None))
    }

    /// `energy` is that of the last state.
    fn summary(&mut self, energy: &N) -> Option<Summary> {
        let mut watch = self.watch.take()?;
        watch.include_energy(i64::try_from(self.run.steps).unwrap_or(i64::MAX), energy);
        let mut summary = watch.summary(self.run)?;
        summary.extremes = self.extremes.found();
        Some(summary)
    }

    /// The gradient may have values where the potential has none, as that of log(x) for x < 0: a run that got there is
    /// not complete, whether its energies are written or not.
    fn ends_in_the_domain(&self, energy: &N) -> Result<(), Error> {
        match energy.is_finite() {
            true => Ok(()),
            false => Err(self.run.not_finite(&format!("the energy at the end, n = {},", self.run.steps))),
        }
    }

    /// Whether something with this period is to be written at n, as at the last state of a run that its condition ends.
    fn is_due(&self, every: Option<u64>, n: i64) -> bool {
        let is_end = n.unsigned_abs() == self.run.steps && self.scene.end().is_met;
        n > self.written && every.is_some_and(|every| n.unsigned_abs().is_multiple_of(every) || is_end)
    }

    /// What is due at n.
    fn due_at(&self, n: i64) -> Due {
        let Outputs { energy, trajectory, .. } = self.scene.output;
        Due {
            energy: self.is_due(energy, n),
            state: self.is_due(trajectory, n),
            values: self.values.iter().any(|own| self.is_due(Some(own.every), n)),
            all_values: false,
        }
    }

    /// What rows have that belong to no n: positions and momenta, and what is written at all.
    fn due_everywhere(&self) -> Due {
        let values = !self.values.is_empty();
        Due { energy: self.scene.output.energy.is_some(), state: true, values, all_values: values }
    }

    fn needs_energy(&self, due: Due) -> bool {
        due.energy || (due.values && self.values.iter().any(ValuesOfRows::needs_energy))
    }

    /// Writes a row if anything is due.
    fn row(
        &mut self,
        n: i64,
        (q, p): (&[N], &[N]),
        energy: Option<&N>,
        (due, modified): (Due, Option<ModifiedEnergy<N>>),
    ) -> Result<(), Error> {
        self.observer.progress(n);
        if let Some(energy) = energy.filter(|energy| !energy.is_finite()) {
            return Err(self.run.not_finite(&format!("the energy at n = {n}, {},", energy.to_text())));
        }
        if let (Some(watch), Some(energy), None) = (&mut self.watch, energy.filter(|_| due.energy), &self.energy_of) {
            watch.include_energy(n, energy);
        }
        let chaos = self.indicators(n);
        if due == Due::NOTHING && modified.is_none() && chaos.is_none() {
            return Ok(());
        }
        self.write((n, self.time(n, q)), (q, p), energy, (due, modified, chaos))
    }

    /// The indicators of chaos up to the state n, if they are due.
    fn indicators(&mut self, n: i64) -> Option<Indicators> {
        let is_due = self.is_due(self.scene.output.chaos, n);
        let vectors = self.vectors.as_mut().filter(|_| is_due)?;
        Some(Indicators::of(vectors.end()))
    }

    /// The row of a crossing between the state n, at which the system is, and the state before.
    fn cross(&mut self, n: i64, integrator: &mut VectorIntegrator<'_, N>) -> Result<(), Error> {
        let Some(mut crossings) = self.crossings.take() else { return Ok(()) };
        let written = crossings.state(n, integrator, |integrator, part| {
            if n <= self.written {
                return Ok(());
            }
            let time = self.run.time_of_crossing(n - 1, part, self.context);
            let (q, p) = (integrator.state().q().to_vec(), integrator.state().p().to_vec());
            let time = self.scene.system.time_of(&q).unwrap_or(&time).clone();
            let due = self.due_everywhere();
            let energy = self.needs_energy(due).then(|| self.energy(integrator));
            self.write((n - 1, time), (&q, &p), energy.as_ref(), (due, None, None))
        });
        self.crossings = Some(crossings);
        written.unwrap_or(Ok(()))
    }

    /// The time of the state n.
    fn time(&self, n: i64, q: &[N]) -> N {
        let time = self.scene.system.time_of(q);
        time.cloned().unwrap_or_else(|| self.run.time_in(n, self.context))
    }

    /// Writes a row; `energy` is H where it is needed.
    fn write(
        &mut self,
        (n, time): (i64, N),
        (q, p): (&[N], &[N]),
        energy: Option<&N>,
        (due, modified_energy, chaos): (Due, Option<ModifiedEnergy<N>>, Option<Indicators>),
    ) -> Result<(), Error> {
        let mut values = Vec::new();
        for place in 0..self.values.len() {
            let is_due = due.all_values || self.is_due(Some(self.values[place].every), n);
            self.values[place].append(is_due.then_some(((q, p), &time, energy)), &mut values);
        }
        let state = match &mut self.shown {
            Some(shown) if due.state => shown.of_state(q, p),
            _ => (q, p),
        };
        let (energy, state) = (energy.filter(|_| due.energy), due.state.then_some(state));
        self.rows.row(&Row { n, t: &time, energy, modified_energy, chaos, values, state })
    }

    /// Makes a checkpoint where it is time for one, at the last state, from which the run can be prolonged, or where the run is stopped: then it ends.
    ///
    /// `state` is the one from which the run can be resumed; `None` for the state at t = 0.
    fn ends(&mut self, n: i64, state: impl FnOnce(&Self) -> Option<Snapshot<N>>) -> Result<ControlFlow<()>, Error> {
        let stops = self.observer.stops();
        let is_last = n.unsigned_abs() == self.run.steps;
        let due = self.scene.output.checkpoint;
        let due = due.is_some_and(|interval| self.is_time_for_a_checkpoint(n, interval) || is_last);
        if n > self.written && (due || stops) {
            self.checkpoint(n, state(self).as_ref())?;
        }
        Ok(if stops { Break(()) } else { Continue(()) })
    }

    #[cold]
    fn checkpoint(&mut self, n: i64, state: Option<&Snapshot<N>>) -> Result<(), Error> {
        let vectors = match &self.vectors {
            None => Some(Vec::new()),
            Some(vectors) => vectors.saved(),
        };
        match (state.map(SavedState::of), vectors) {
            (Some(None), _) | (_, None) => self.observer.note(&Note::NoCheckpoint { n }),
            (saved, Some(vectors)) => {
                let is_watched = self.watch.is_some();
                let summary =
                    is_watched.then(|| SavedSummary::of(self.seen, |to| self.fields_of_summary(to))).flatten();
                self.rows.target.keep(n, saved.flatten(), vectors, summary)?;
            }
        }
        self.last_checkpoint = Instant::now();
        Ok(())
    }

    fn is_time_for_a_checkpoint(&mut self, n: i64, interval: CheckpointInterval) -> bool {
        let now = Instant::now();
        let took = now.duration_since(std::mem::replace(&mut self.last_state, now));
        took >= LONG
            || match interval {
                CheckpointInterval::Steps(every) => n.unsigned_abs().is_multiple_of(every),
                CheckpointInterval::Time(time) => now.duration_since(self.last_checkpoint) >= time,
            }
    }
}

impl<N: RunNumber> Follower<N> for Recorder<'_, '_, N> {
    fn begin(&mut self, reach: i64, integrator: &mut VectorIntegrator<'_, N>) {
        self.snapshots = Snapshots::new(reach);
        if let Some(from) = self.from {
            self.snapshots.begin(Snapshot::of(from, integrator.state()));
        }
    }

    fn carried(&self) -> Carried {
        self.watch.as_ref().map_or(Carried::Nothing, Watch::carried)
    }

    fn next(&self, n: i64) -> i64 {
        if self.crossings.is_some() || !self.extremes.is_empty() {
            return n + 1;
        }
        let checkpoint = match self.scene.output.checkpoint {
            Some(CheckpointInterval::Steps(every)) => next_multiple(n, every),
            _ => i64::MAX,
        };
        let idle = self.watch.as_ref().map_or(u64::MAX, Watch::idle);
        let watched = n.saturating_add_unsigned(idle).saturating_add(1);
        let looked_up = i64::try_from(self.pace.next(n.unsigned_abs())).unwrap_or(i64::MAX);
        self.due.min(checkpoint).min(watched).min(looked_up).max(n + 1)
    }

    fn visitor(&mut self) -> Option<&mut dyn Visitor<N>> {
        self.watch.as_mut().map(|watch| -> &mut dyn Visitor<N> { watch })
    }

    fn state(&mut self, n: i64, integrator: &mut VectorIntegrator<'_, N>) {
        if self.scene.output.modified_energy.is_some() {
            self.snapshots.offer(n, integrator.state());
        }
        if n <= self.seen || n.unsigned_abs() > self.run.steps {
            return;
        }
        self.seen = n;
        self.extremes.include(n, self.run, integrator);
        // it has begun at the first state
        if let Some(watch) = self.watch.as_mut().filter(|_| n > self.from.unwrap_or(0)) {
            watch.include(n, integrator);
        }
    }

    fn output(
        &mut self,
        n: i64,
        estimate: Option<&Estimate<'_, N>>,
        integrator: &mut VectorIntegrator<'_, N>,
    ) -> Result<ControlFlow<()>, Error> {
        self.n = n;
        if let Some(vectors) = &mut self.vectors {
            vectors.reach(n);
        }
        self.pace.looks_up(n.unsigned_abs());
        match estimate {
            None => {
                self.cross(n, integrator)?;
                self.present(n, integrator)?;
                self.ends(n, |_| Some(Snapshot::of(n, integrator.state())))
            }
            Some(found) => {
                self.estimated(n, found, integrator)?;
                self.ends(n, |recorder| recorder.snapshots.for_those_after(n).cloned())
            }
        }
    }

    fn failed(&mut self, error: RunError) -> Result<(), Error> {
        Err(self.named(&error))
    }
}
