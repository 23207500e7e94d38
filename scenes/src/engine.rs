//! The run of a scene: only what it asks for is computed.

use std::time::Instant;

use shadowstep::run::{RunError, ShadowRun, States, Trajectory};
use shadowstep::{Kinetic, Motion, Moves, Number, Potential, Scheme};

use crate::error::Error;
use crate::estimator::Chosen;
use crate::note::Note;
use crate::observer::Observer;
use crate::results::{Checkpoint, ModifiedEnergy, Row, Rows, SavedState};
use crate::run::Run;
use crate::scene::{CheckpointInterval, ClassifiedKinetic, Scene};
use crate::snapshots::{Snapshots, State};

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// With its last step.
    Complete {
        /// Evaluations of the gradient in this call; a resumed run made others before.
        force_evaluations: u64,
    },
    /// The observer stopped it.
    Stopped {
        /// After this state.
        n: i64,
    },
}

/// Runs the scene, from a checkpoint if there is one, until it is complete or the observer stops it.
pub(crate) fn follow<N: Number + 'static>(
    scene: &Scene,
    context: &N::Context,
    rows: &mut Rows<'_>,
    checkpoint: Option<&Checkpoint>,
    observer: &mut dyn Observer,
) -> Result<Outcome, Error> {
    let (mut q, mut p) = scene.system.start::<N>(context);
    let saved = checkpoint.and_then(|checkpoint| checkpoint.state.as_ref());
    if let Some(saved) = saved {
        (q, p) = saved.numbers(context).ok_or_else(|| unreadable(saved.n))?;
    }
    let recorder = Recorder {
        scene,
        run: scene.as_run(),
        context,
        rows,
        written: checkpoint.map_or(-1, |checkpoint| checkpoint.n),
        last_checkpoint: Instant::now(),
        observer,
    };
    let from = saved.map(|saved| saved.n);
    let potential = scene.system.potential(context);
    let scheme = &scene.scheme.scheme;
    match scene.system.kinetic(context) {
        ClassifiedKinetic::Quadratic(kinetic) => recorder.record(scheme, Motion::new(potential, kinetic, q, p), from),
        ClassifiedKinetic::General(kinetic) => {
            let scheme = scheme.clone().for_every_kinetic().expect("the scheme was read for this T");
            recorder.record(&scheme, Motion::new(potential, kinetic, q, p), from)
        }
    }
}

fn unreadable(n: i64) -> Error {
    Error::usage(format!("the state n = {n} of the checkpoint cannot be read"), "begin again with --restart")
}

/// Follows the states of a run in the order of time.
struct Recorder<'a, 'r, N: Number> {
    scene: &'a Scene,
    run: Run<'a>,
    context: &'a N::Context,
    rows: &'a mut Rows<'r>,
    /// Rows up to this n are in the file already.
    written: i64,
    last_checkpoint: Instant,
    observer: &'a mut dyn Observer,
}

/// The fault with the scene's names for the coordinates and momenta, which the runtime numbers.
fn renamed(error: RunError, scene: &Scene) -> RunError {
    let RunError::NotFinite { step, what } = &error else { return error };
    let name = what.split_once(" = ").and_then(|(name, value)| {
        let names = match name.get(..1)? {
            "q" => &scene.system.coordinates,
            "p" => &scene.system.momenta,
            _ => return None,
        };
        let number: usize = name.get(1..)?.parse().ok()?;
        Some(format!("{} = {value}", names.get(number.checked_sub(1)?)?))
    });
    RunError::NotFinite { step: *step, what: name.unwrap_or_else(|| what.clone()) }
}

/// What moves, with a kinetic energy of any class.
type Moving<N, K> = Motion<N, Vec<N>, Box<dyn Potential<N>>, K>;

impl<N: Number + 'static> Recorder<'_, '_, N> {
    /// Records the run from its beginning, or after the state `from`.
    fn record<K, S>(mut self, scheme: &S, motion: Moving<N, K>, from: Option<i64>) -> Result<Outcome, Error>
    where
        K: Kinetic<N>,
        S: Scheme + Moves<K::Class>,
    {
        match &self.scene.output.modified_energy {
            None => self.plain(scheme, motion, from.unwrap_or(0)),
            Some((estimator, _)) => self.shadowed(scheme, motion, from, estimator),
        }
    }

    /// Without β, thus without states beyond both ends.
    fn plain<K, S>(&mut self, scheme: &S, motion: Moving<N, K>, from: i64) -> Result<Outcome, Error>
    where
        K: Kinetic<N>,
        S: Scheme + Moves<K::Class>,
    {
        let run = self.run;
        let scene = self.scene;
        let failed = |error| run.failed(&renamed(error, scene));
        let mut trajectory = Trajectory::plain(scheme, motion, run.h, from, run.steps).map_err(failed)?;
        while let Some(n) = trajectory.advance().map_err(failed)?.map(|state| state.n) {
            let motion = trajectory.motion();
            let energy = self.is_due(self.scene.output.energy, n).then(|| motion.energy());
            self.row(n, motion.q(), motion.p(), energy.as_ref(), None)?;
            if self.ends(n, Some((n, motion.q(), motion.p())))? {
                return Ok(Outcome::Stopped { n });
            }
        }
        let motion = trajectory.motion();
        let energy = motion.energy();
        self.ends_in_the_domain(&energy)?;
        Ok(Outcome::Complete { force_evaluations: motion.evaluations() })
    }

    /// With β and an estimate at each state; resumed after the state `from`.
    fn shadowed<K, S>(
        &mut self,
        scheme: &S,
        motion: Moving<N, K>,
        from: Option<i64>,
        estimator: &Chosen,
    ) -> Result<Outcome, Error>
    where
        K: Kinetic<N>,
        S: Scheme + Moves<K::Class>,
    {
        let run = self.run;
        let scene = self.scene;
        let failed = |error| run.failed(&renamed(error, scene));
        let (mut q, mut p) = (motion.q().to_vec(), motion.p().to_vec());
        let method = estimator.method(true);
        let mut shadow = match from {
            None => ShadowRun::new(scheme, motion, run.h, run.steps, &method),
            Some(from) => ShadowRun::resume(scheme, motion, run.h, from, run.steps, &method),
        }
        .map_err(failed)?;
        let mut snapshots = Snapshots::new(shadow.reach());
        if let Some(from) = from {
            snapshots.begin(from, &q, &p);
        }
        while let Some((n, found)) = shadow.advance().map_err(failed)? {
            q.iter_mut().zip(found.q).for_each(|(own, q)| own.assign(q));
            p.iter_mut().zip(found.p).for_each(|(own, p)| own.assign(p));
            let every = self.scene.output.modified_energy.as_ref().map(|(_, every)| *every);
            let modified = self.is_due(every, n).then(|| ModifiedEnergy {
                modified_energy: found.value.to_text(),
                estimate: found.error.map(N::to_text),
                order: found.order,
            });
            let energy = self.is_due(self.scene.output.energy, n).then(|| shadow.motion().energy_of(&q, &p));
            self.row(n, &q, &p, energy.as_ref(), modified)?;
            snapshots.offer(n, &q, &p);
            if self.ends(n, snapshots.for_those_after(n))? {
                return Ok(Outcome::Stopped { n });
            }
        }
        let energy = shadow.motion().energy_of(&q, &p);
        self.ends_in_the_domain(&energy)?;
        Ok(Outcome::Complete { force_evaluations: shadow.motion().evaluations() })
    }

    /// The gradient may have values where the potential has none, as that of log(x) for x < 0: a run that got there is
    /// not complete, whether its energies are written or not.
    fn ends_in_the_domain(&self, energy: &N) -> Result<(), Error> {
        match energy.is_finite() {
            true => Ok(()),
            false => Err(self.run.not_finite(&format!("the energy at the end, n = {},", self.run.steps))),
        }
    }

    /// Whether something with this period is to be written at n.
    fn is_due(&self, every: Option<u64>, n: i64) -> bool {
        n > self.written && every.is_some_and(|every| n.unsigned_abs().is_multiple_of(every))
    }

    /// Writes a row if anything is due.
    fn row(
        &mut self,
        n: i64,
        q: &[N],
        p: &[N],
        energy: Option<&N>,
        modified: Option<ModifiedEnergy>,
    ) -> Result<(), Error> {
        self.observer.progress(n);
        if let Some(energy) = energy.filter(|energy| !energy.is_finite()) {
            return Err(self.run.not_finite(&format!("the energy at n = {n}, {},", energy.to_text())));
        }
        let state_is_due = self.is_due(self.scene.output.trajectory, n);
        if energy.is_none() && modified.is_none() && !state_is_due {
            return Ok(());
        }
        let texts = |numbers: &[N]| state_is_due.then(|| numbers.iter().map(N::to_text).collect());
        let t = N::from_rational(&self.run.time(n), self.context).to_text();
        let energy = energy.map(N::to_text);
        self.rows.row(&Row { n, t, energy, modified_energy: modified, q: texts(q), p: texts(p) })
    }

    /// Makes a checkpoint where it is time for one, or where the run is stopped: then it ends.
    ///
    /// `state` is the one from which the run can be resumed; `None` for the state at t = 0.
    fn ends(&mut self, n: i64, state: Option<State<'_, N>>) -> Result<bool, Error> {
        let stops = self.observer.stops();
        let due = match self.scene.output.checkpoint {
            None => false,
            Some(CheckpointInterval::Steps(every)) => n.unsigned_abs().is_multiple_of(every),
            Some(CheckpointInterval::Time(time)) => self.last_checkpoint.elapsed() >= time,
        };
        if n > self.written && (due || stops) {
            match state.map(|(n, q, p)| SavedState::of(n, q, p)) {
                Some(None) => self.observer.note(&Note::NoCheckpoint { n }),
                saved => self.rows.target.keep(n, saved.flatten())?,
            }
            self.last_checkpoint = Instant::now();
        }
        Ok(stops)
    }
}
