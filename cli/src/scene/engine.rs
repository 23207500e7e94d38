//! The run of a scene: what is asked for, and nothing else.

use std::collections::VecDeque;
use std::time::Instant;

use shadowstep::run::{RunError, ShadowRun, States, Trajectory};
use shadowstep::{Kinetic, Motion, Moves, Number, Potential, Scheme};

use crate::complaint::{Complaint, remark};
use crate::estimator::Chosen;
use crate::progress::Progress;
use crate::run::{OrderSetting, Run};
use crate::scene::checkpoint::{Checkpoint, Saved};
use crate::scene::read::{Cadence, Scene};
use crate::scene::system::Classed;
use crate::scene::write::{Modified, Row, Rows};

/// How a run ended.
pub(crate) enum End {
    /// With its last step.
    Complete {
        /// Of the gradient, in this run of the program.
        evaluations: u64,
    },
    /// It was interrupted after this n.
    Interrupted(i64),
}

/// Runs the scene, from a checkpoint if there is one, until it is complete or told to `stop`.
pub(crate) fn follow<N: Number + 'static>(
    scene: &Scene,
    context: &N::Context,
    rows: &mut Rows,
    checkpoint: Option<&Checkpoint>,
    stop: &dyn Fn() -> bool,
) -> Result<End, Complaint> {
    let order = scene.output.modified.as_ref().map(|(chosen, _)| {
        let (name, value) = chosen.order_setting();
        OrderSetting { name, value }
    });
    let run = Run { propagator: &scene.scheme.name, h: &scene.h, steps: scene.steps, order };
    let progress = Progress::new(scene.output.file.is_some(), run.name(), run.steps);
    let (mut q, mut p) = scene.system.start::<N>(context);
    let saved = checkpoint.and_then(|checkpoint| checkpoint.state.as_ref());
    if let Some(saved) = saved {
        (q, p) = saved.numbers(context).ok_or_else(|| unreadable(saved.n))?;
    }
    let recorder = Recorder {
        scene,
        run,
        context,
        rows,
        written: checkpoint.map_or(-1, |checkpoint| checkpoint.n),
        last_checkpoint: Instant::now(),
        heard: &progress.listener(),
        stop,
    };
    let from = saved.map(|saved| saved.n);
    let potential = scene.system.potential(context);
    let scheme = &scene.scheme.scheme;
    match scene.system.kinetic(context) {
        Classed::Quadratic(kinetic) => recorder.take(scheme, Motion::new(potential, kinetic, q, p), from),
        Classed::General(kinetic) => {
            let scheme = scheme.clone().for_every_kinetic().expect("the scheme was read for this T");
            recorder.take(&scheme, Motion::new(potential, kinetic, q, p), from)
        }
    }
}

fn unreadable(n: i64) -> Complaint {
    Complaint::usage(format!("the state n = {n} of the checkpoint cannot be read"), "--restart begins again")
}

/// Takes the states of a run in the order of time.
struct Recorder<'a, N: Number> {
    scene: &'a Scene,
    run: Run<'a>,
    context: &'a N::Context,
    rows: &'a mut Rows,
    /// Rows up to this n are in the file already.
    written: i64,
    last_checkpoint: Instant,
    heard: &'a dyn Fn(i64),
    stop: &'a dyn Fn() -> bool,
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

impl<N: Number + 'static> Recorder<'_, N> {
    /// Takes the states of the run from its beginning, or after the state `from`.
    fn take<K, S>(mut self, scheme: &S, motion: Moving<N, K>, from: Option<i64>) -> Result<End, Complaint>
    where
        K: Kinetic<N>,
        S: Scheme + Moves<K::Class>,
    {
        match &self.scene.output.modified {
            None => self.plain(scheme, motion, from.unwrap_or(0)),
            Some((estimator, _)) => self.shadowed(scheme, motion, from, estimator),
        }
    }

    /// Without β, thus without states beyond both ends.
    fn plain<K, S>(&mut self, scheme: &S, motion: Moving<N, K>, from: i64) -> Result<End, Complaint>
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
                return Ok(End::Interrupted(n));
            }
        }
        let motion = trajectory.motion();
        let energy = motion.energy();
        self.ends_in_the_domain(&energy)?;
        Ok(End::Complete { evaluations: motion.evaluations() })
    }

    /// With β and an estimate at each state; taken up after the state `from`.
    fn shadowed<K, S>(
        &mut self,
        scheme: &S,
        motion: Moving<N, K>,
        from: Option<i64>,
        estimator: &Chosen,
    ) -> Result<End, Complaint>
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
        let mut snapshots = Snapshots { reach: shadow.reach(), kept: VecDeque::new() };
        if let Some(from) = from {
            snapshots.kept.push_back((from, q.clone(), p.clone()));
        }
        while let Some((n, found)) = shadow.advance().map_err(failed)? {
            q.iter_mut().zip(found.q).for_each(|(own, q)| own.assign(q));
            p.iter_mut().zip(found.p).for_each(|(own, p)| own.assign(p));
            let every = self.scene.output.modified.as_ref().map(|(_, every)| *every);
            let modified = self.is_due(every, n).then(|| Modified {
                modified_energy: found.value.to_text(),
                estimate: found.error.map(N::to_text),
                order: found.order,
            });
            let energy = self.is_due(self.scene.output.energy, n).then(|| shadow.motion().energy_of(&q, &p));
            self.row(n, &q, &p, energy.as_ref(), modified)?;
            snapshots.offer(n, &q, &p);
            if self.ends(n, snapshots.for_those_after(n))? {
                return Ok(End::Interrupted(n));
            }
        }
        let energy = shadow.motion().energy_of(&q, &p);
        self.ends_in_the_domain(&energy)?;
        Ok(End::Complete { evaluations: shadow.motion().evaluations() })
    }

    /// The gradient may have values where the potential has none, as that of log(x) for x < 0: a run that got there is
    /// not complete, whether its energies are written or not.
    fn ends_in_the_domain(&self, energy: &N) -> Result<(), Complaint> {
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
        modified: Option<Modified>,
    ) -> Result<(), Complaint> {
        (self.heard)(n);
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
        self.rows.row(&Row { n, t, energy, modified, q: texts(q), p: texts(p) })
    }

    /// Makes a checkpoint where it is time for one, or where the run is interrupted: then it ends.
    ///
    /// `state` is what to go on from; `None` for the state at t = 0.
    fn ends(&mut self, n: i64, state: Option<State<'_, N>>) -> Result<bool, Complaint> {
        let interrupted = (self.stop)();
        let due = match self.scene.output.checkpoint {
            None => false,
            Some(Cadence::Steps(every)) => n.unsigned_abs().is_multiple_of(every),
            Some(Cadence::Time(time)) => self.last_checkpoint.elapsed() >= time,
        };
        if n > self.written && (due || interrupted) {
            match state.map(|(n, q, p)| Saved::of(n, q, p)) {
                Some(None) => remark(format_args!("no checkpoint at n = {n}: a number is beyond 1e-10000 or 1e10000")),
                saved => self.rows.target.keep(n, saved.flatten())?,
            }
            self.last_checkpoint = Instant::now();
        }
        Ok(interrupted)
    }
}

/// n, q and p.
type State<'a, N> = (i64, &'a [N], &'a [N]);

/// The newest states from which modified energies can be taken up: each `reach`-th.
struct Snapshots<N> {
    reach: i64,
    /// The oldest first.
    kept: VecDeque<(i64, Vec<N>, Vec<N>)>,
}

impl<N: Number> Snapshots<N> {
    /// The last state at or before n − reach is the newest kept one or the one before it.
    const KEPT: usize = 2;

    fn offer(&mut self, n: i64, q: &[N], p: &[N]) {
        if n % self.reach.max(1) == 0 {
            self.kept.push_back((n, q.to_vec(), p.to_vec()));
            if self.kept.len() > Self::KEPT {
                self.kept.pop_front();
            }
        }
    }

    /// The state from which the estimates after n can be had: the one of n + 1 needs more than `reach` states before.
    fn for_those_after(&self, n: i64) -> Option<State<'_, N>> {
        let (n, q, p) = self.kept.iter().rev().find(|(earlier, ..)| earlier + self.reach <= n)?;
        Some((*n, q, p))
    }
}
