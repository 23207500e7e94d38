//! Follows a run: the error of H, the modified energy by a monitor, and close encounters.
//!
//! | module | what it is |
//! | --- | --- |
//! | `energy`, `lasting_change` | the error of H, and a change of it that lasts |
//! | `monitor` | the monitor of the modified energy |
//! | `encounters` | times at which the force is large |
//! | `bodies`, `places`, `approaches` | how close planets come to each other |
//! | `particles`, [`light`] | particles of mass 0 and light bodies that come close to planets |
//! | `summary` | what a run has shown |
//! | `observer` | how a caller watches a run and stops it |

mod approaches;
pub(crate) mod bodies;
pub(crate) mod encounters;
mod energy;
mod lasting_change;
pub mod light;
pub(crate) mod monitor;
pub(crate) mod observer;
pub(crate) mod particles;
mod places;
pub(crate) mod summary;

use std::mem::take;

use shadowstep::number::saved::{Fields, Saved};
use shadowstep::shadow::run::{NotFinite, Quantity, RunError};
use shadowstep::shadow::{Criterion, Missing, Report, Verdict, WholeRun};
use shadowstep::steps::integrator::{VectorIntegrator, at_output};
use shadowstep::systems::system::Visitor;
use shadowstep::{Carried, Integrator as _, Number, Real};

pub(crate) use self::approaches::Approach;
pub use self::approaches::Interactions;
pub use self::bodies::Bodies;
use self::encounters::Encounters;
use self::energy::EnergyError;
pub use self::light::LightBody;
use crate::run::Run;
use crate::run::steps::MOST_STEPS;
use crate::scene;
use crate::scene::SceneNumber;
use crate::watch::monitor::RunMonitor;
use crate::watch::summary::{EnergySummary, ModifiedEnergySummary, Summary};

/// The monitor's estimator is E_16 with its error: 17 states a window.
const MONITOR_ORDER: u32 = 16;

/// In runs of at most this many steps H is computed at each: the monitor has no verdict on the shortest ones.
const SHORT_RUN: u64 = 64;

/// Which energies are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Energies {
    /// Those of all states.
    All,
    /// Those of the states that the monitor looks at, and that of the last state.
    Windows,
    /// Those that the run gives, of the states whose n is a multiple of this number, and those between that the monitor
    /// looks at.
    Given(u64),
}

impl Energies {
    /// Whether the monitor's H of the state n is wanted.
    fn wants(self, n: i64) -> bool {
        match self {
            Energies::All => false,
            Energies::Windows => true,
            Energies::Given(every) => !n.unsigned_abs().is_multiple_of(every),
        }
    }
}

/// The ε of planets is computed at every 16th state after the first ones.
const EPSILON_EVERY: u64 = 16;

/// Follows the states of a run in the order of time.
pub(crate) struct Watch<N: SceneNumber> {
    energies: Energies,
    energy: EnergyError<N>,
    /// Whether H is that of the trajectory of a processed scheme, while the monitor follows the kernel.
    processed: bool,
    /// Whether H is that of transformed time, which is 0 but for round-off.
    transformed: bool,
    /// The coordinate that is t, which does not turn, whatever its momentum does.
    time: Option<usize>,
    /// The names of the coordinates.
    names: Vec<String>,
    /// What a summary needs besides H; `None` where there is none.
    observed: Option<Observed<N>>,
    /// In about how many windows modified energies are compared.
    windows: u64,
    /// The n of the first state and of the last one so far.
    from: i64,
    n: i64,
}

struct Observed<N: SceneNumber> {
    /// Of a run whose number of steps is not known several, with windows at larger and larger distances; the first one
    /// has the closest.
    monitors: Vec<Spaced<N>>,
    /// Of all monitors: the states that pass unobserved, and those of them that are still to come.
    pass: u64,
    idle: u64,
    encounters: Encounters<N>,
    bodies: Option<Bodies>,
}

/// A monitor with a window every `every` steps.
struct Spaced<N: SceneNumber> {
    monitor: Box<RunMonitor<N>>,
    every: u64,
}

/// The distances of windows in a run whose number of steps is not known, whatever its end is, so that it can be
/// prolonged: at each a monitor sees twice as many windows as wanted, at most, and one of them has at least half as
/// many, wherever the run ends.
fn distances(windows: u64) -> impl Iterator<Item = u64> {
    const RATIO: u64 = 4;
    std::iter::successors(Some(1), move |every| Some(every * RATIO).filter(|every| *every <= MOST_STEPS / windows))
}

impl<N: SceneNumber> Observed<N> {
    /// Takes the state n, but for what monitors take of it.
    #[inline(always)]
    fn include(&mut self, n: i64, (q, p): (&[N], &[N])) {
        self.encounters.include(n, p);
        if let Some(bodies) = &mut self.bodies {
            bodies.include(n, q);
        }
    }

    /// This number of states passes the monitors, as far as these are idle; whether they are idle at one.
    #[inline]
    fn pass(&mut self, states: u64) -> bool {
        let Observed { monitors, pass, idle, .. } = self;
        let are_idle = *idle > 0;
        let passing = states.min(*idle);
        (*idle, *pass) = (*idle - passing, *pass + passing);
        if are_idle && *idle == 0 {
            let passed = take(pass);
            monitors.iter_mut().for_each(|spaced| spaced.monitor.pass(passed));
        }
        are_idle
    }

    /// Leaves out the monitors that have seen enough windows by the state n, of a run from `from`.
    fn leave_closer(&mut self, (from, n): (i64, i64), windows: u64) {
        let made = n.abs_diff(from);
        let has_enough = |spaced: &Spaced<N>| made / spaced.every > 2 * windows;
        while self.monitors.len() > 1 && has_enough(&self.monitors[0]) {
            self.monitors.remove(0);
        }
    }

    fn monitors_idle(&self) -> u64 {
        self.monitors.iter().map(|spaced| spaced.monitor.idle()).min().unwrap_or(u64::MAX)
    }
}

/// Of [idle](Watch::idle) states.
impl<N: SceneNumber> Visitor<N> for Watch<N> {
    fn visit(&mut self, q: &[N], p: &[N]) {
        self.n += 1;
        if let Some(observed) = &mut self.observed {
            observed.include(self.n, (q, p));
            observed.pass(1);
        }
    }

    fn visit_each(&mut self, states: &[N], dimension: usize) {
        let (first, states) = (self.n + 1, states.chunks_exact(2 * dimension));
        let count = states.len();
        self.n += i64::try_from(count).expect("there are few");
        let Some(observed) = &mut self.observed else { return };
        for (n, state) in (first..).zip(states) {
            observed.include(n, state.split_at(dimension));
        }
        observed.pass(count as u64);
    }
}

/// All that the states so far have left: one that was begun anew on the same run, or on a longer one, goes on from it
/// with the same bits.
impl<N: SceneNumber> Saved<N> for Watch<N> {
    fn fields(&mut self, to: &mut dyn Fields<N>) {
        self.energy.fields(to);
        [&mut self.from, &mut self.n].into_iter().for_each(|n| to.whole(n));
        if let Some(observed) = &mut self.observed {
            observed.leave_closer((self.from, self.n), self.windows);
            let Observed { monitors, pass, idle, encounters, bodies } = observed;
            monitors.iter_mut().for_each(|spaced| spaced.monitor.fields(to));
            [pass, idle].into_iter().for_each(|states| to.count(states));
            encounters.fields(to);
            bodies.iter_mut().for_each(|bodies| bodies.fields(to));
        }
    }
}

impl<N: SceneNumber> Watch<N> {
    /// Begins at the system's present state, which is number `from` of the run; `initial` is H at t = 0. `is_open` is
    /// whether something else may end the run before its last step.
    ///
    /// # Errors
    /// A state or an energy that is not finite.
    pub(crate) fn begin(
        integrator: &mut VectorIntegrator<'_, N>,
        run: Run<'_>,
        (from, initial): (i64, N),
        energies: Energies,
        (summarised, is_open): (bool, bool),
    ) -> Result<Self, RunError> {
        let energies = if run.steps <= SHORT_RUN { Energies::All } else { energies };
        let (mut observed, massive) = (None, integrator.system().massive_coordinates());
        if summarised {
            let every = (run.steps.saturating_sub(from.unsigned_abs()) / run.windows).max(1);
            let distances = if is_open { distances(run.windows).collect() } else { vec![every] };
            let spaced = |every| Ok(Spaced { monitor: monitor::monitor(integrator, MONITOR_ORDER, every)?, every });
            let monitors = distances.into_iter().map(spaced).collect::<Result<Vec<_>, RunError>>()?;
            let mut begun = Observed {
                monitors,
                pass: 0,
                idle: 0,
                encounters: Encounters::new(&integrator.state().p()[..massive]),
                bodies: None,
            };
            begun.idle = begun.monitors_idle();
            observed = Some(begun);
        }
        // the state of the steps was checked, which is that of the trajectory unless the scheme is a processed one
        if !initial.is_finite() {
            let value = NotFinite { quantity: Quantity::Energy, value: initial.to_text() };
            return Err(RunError::NotFinite { step: 0, value });
        }
        let mut energy = EnergyError::new(initial);
        if from == 0 {
            energy.lasting.include(0, 0.0);
        }
        let processed = integrator.is_processed();
        Ok(Watch {
            energies,
            energy,
            processed,
            transformed: false,
            time: None,
            names: Vec::new(),
            observed,
            windows: run.windows,
            from,
            n: from,
        })
    }

    /// Follows the planets of a system that has some, too; in transformed time H is H'.
    #[must_use]
    pub(crate) fn of_system(mut self, system: &scene::System, integrator: &VectorIntegrator<'_, N>) -> Self {
        self.transformed = system.transformed_time().is_some();
        self.names.clone_from(&system.coordinates);
        self.time = system.explicit_time.then(|| system.q.len() - 1);
        if let Some(observed) = &mut self.observed {
            let h = <f64 as Number>::from_rational(integrator.step_size().exact(), &());
            observed.bodies = Bodies::of(system, EPSILON_EVERY, Some(h));
            if let Some(bodies) = &mut observed.bodies {
                bodies.include(self.n, integrator.state().q());
            }
        }
        self
    }

    /// What the next step is to carry along.
    pub(crate) fn carried(&self) -> Carried {
        match &self.observed {
            Some(Observed { monitors, idle: 0, .. })
                if monitors.iter().any(|spaced| spaced.monitor.needs_increments()) =>
            {
                Carried::Increments
            }
            _ => Carried::Nothing,
        }
    }

    /// How many of the next states need not be [included](Watch::include): it is enough that they are visited.
    pub(crate) fn idle(&self) -> u64 {
        match &self.observed {
            Some(observed) if self.energies != Energies::All => observed.idle,
            _ => 0,
        }
    }

    /// The integrator is at the present state again, after evaluations elsewhere.
    pub(crate) fn state_restored(&mut self) {
        let monitors = self.observed.iter_mut().flat_map(|observed| &mut observed.monitors);
        monitors.for_each(|spaced| spaced.monitor.state_restored());
    }

    /// Takes the state n, which a step has made: the one after the last one that it took. Of a processed scheme, the
    /// monitor and encounters follow the kernel; H is that of the trajectory.
    pub(crate) fn include(&mut self, n: i64, integrator: &mut VectorIntegrator<'_, N>) {
        self.n = n;
        if self.energies == Energies::All {
            self.energy.include(n, &at_output(integrator, |integrator| integrator.system().energy()));
        }
        let Some(observed) = &mut self.observed else { return };
        observed.include(n, (integrator.state().q(), integrator.state().p()));
        if observed.pass(1) {
            return;
        }
        observed.leave_closer((self.from, n), self.windows);
        let [Spaced { monitor, .. }, others @ ..] = &mut observed.monitors[..] else { return };
        for Spaced { monitor, .. } in others {
            match monitor.idle() {
                0 => drop(monitor.observe(integrator.system())),
                _ => monitor.pass(1),
            }
        }
        if monitor.idle() > 0 {
            monitor.pass(1);
            observed.idle = observed.monitors_idle();
            return;
        }
        // what is not finite is found by the run as well, or by the verdict
        let found = monitor.observe(integrator.system()).ok().flatten();
        // of a processed scheme the trajectory is known at the present state only
        let processed = integrator.is_processed();
        let ends = found.is_some();
        let middle = found.filter(|_| !processed).map(|sample| (sample.n, sample.energy.clone()));
        let is_own = (processed && ends) || monitor.takes_kinetic(monitor.n());
        let middle = middle.filter(|(n, _)| !monitor.takes_kinetic(*n));
        observed.idle = observed.monitors_idle();
        if let Some((middle, energy)) = middle {
            let n = self.from + i64::try_from(middle).unwrap_or(i64::MAX);
            if self.energies.wants(n) {
                self.energy.include(n, &energy);
            }
        }
        if is_own && self.energies.wants(n) {
            self.energy.include(n, &at_output(integrator, |integrator| integrator.system().energy()));
        }
    }

    /// Takes H of a state of the run, which has it.
    pub(crate) fn include_energy(&mut self, n: i64, energy: &N) {
        if self.energies != Energies::All {
            self.energy.include(n, energy);
        }
    }

    /// The error of H.
    pub(crate) fn energy(&self) -> EnergySummary {
        let energy = &self.energy;
        let whole = |difference: &N| energy.relative(difference).filter(|_| !self.transformed);
        let relative = |difference: &N| whole(difference).map(|part| part.to_text());
        EnergySummary {
            initial: energy.initial.to_text(),
            largest: energy.largest.to_text(),
            largest_relative: relative(&energy.largest),
            at: energy.at,
            last: energy.last.to_text(),
            last_relative: relative(&energy.last),
            states: energy.states,
        }
    }

    /// What has been found, if a summary is made.
    pub(crate) fn summary(self, run: Run<'_>) -> Option<Summary> {
        let mut energy = self.energy();
        let mut initial = self.energy.initial.clone();
        initial.make_absolute();
        let Watch { observed, from, n, transformed, processed, time, names, .. } = self;
        let Observed { monitors, pass, encounters, mut bodies, .. } = observed?;
        let Spaced { mut monitor, .. } = monitors.into_iter().next()?;
        monitor.pass(pass);
        let mut report = monitor.report();
        report.coordinate_names = names;
        // the estimator of summaries is always the same
        if let Some(advice) = &mut report.advice {
            advice.order = None;
        }
        report.fastest_coordinate = report.fastest_coordinate.filter(|(coordinate, _)| Some(*coordinate) != time);
        let [largest, last] = [&self.energy.largest, &self.energy.last].map(|error| part_of_kinetic(error, &report));
        let range = (!processed).then(|| self.energy.lasting.range());
        let report = report.of_run(WholeRun { range, largest, last, transformed });
        let verdict = report.verdict;
        // parts of an H(0) that is round-off say nothing
        if report.windows > 0 && initial <= report.round_off && !verdict.loses_the_energy() {
            (energy.largest_relative, energy.last_relative) = (None, None);
        }
        let lasting = self.energy.lasting.found().filter(|_| may_have_been_missed(verdict));
        let (encounters, closest) = encounters.found(n);
        let (interactions, light) = bodies.as_mut().map(Bodies::found).unwrap_or_default();
        // what was measured is not excluded
        let is_excluded = !verdict.loses_the_energy() && lasting.is_none();
        let modified_energy = modified_energy(&report, is_excluded);
        let mut summary = Summary {
            run: run.name(),
            h: run.h.exact().clone(),
            transformed,
            from,
            to: n,
            energy,
            has_windows: report.windows > 0,
            modified_energy,
            encounters,
            closest,
            extremes: Vec::new(),
            interactions,
            light,
            bounded: verdict.is_bounded(),
            verdict: verdict.to_string(),
            conclusion: report.conclusion(),
            reason: report.reason(),
        };
        if let Some(change) = &lasting {
            summary.name_lasting_change(change, report.kinetic.to_f64());
        }
        if lasting.is_some() || changes(&report, verdict) {
            summary.name_close_planets();
        }
        summary.name_light_bodies();
        Some(summary)
    }
}

/// What the windows show of H̄, if there are some whose sums do not overflow, and whether they exclude a net change.
fn modified_energy<N: Real>(report: &Report<N>, is_excluded: bool) -> Option<ModifiedEnergySummary> {
    let bound = report.permanent_bound.as_ref().filter(|_| is_excluded);
    let bound = bound.map(|bound| if *bound < report.range { &report.range } else { bound });
    let sums = [&report.method_resolution, &report.round_off, &report.range];
    (report.windows > 0 && sums.into_iter().all(N::is_finite)).then(|| ModifiedEnergySummary {
        method: report.method().map(|[rms, ..]| rms.to_text()),
        method_resolution: report.method_resolution.to_text(),
        round_off: report.round_off.to_text(),
        permanent_change: report.range.to_text(),
        permanent_bound: bound.map(N::to_text),
        resolution: report.resolution.as_ref().map(N::to_text),
        windows: report.windows,
    })
}

/// Whether a monitor that saw no lasting change of H may have missed one between its windows, or before them.
fn may_have_been_missed(verdict: Verdict) -> bool {
    matches!(verdict, Verdict::Bounded | Verdict::Undecided(Missing::Resolution))
}

/// Whether a cause is to be named: H or the modified energy changes in a way that the scheme does not explain.
fn changes<N: Real>(report: &Report<N>, verdict: Verdict) -> bool {
    match verdict {
        Verdict::Undecided(_) => report.permanent_change.is_some(),
        Verdict::TooLarge(Criterion::NotFinite) => false,
        verdict => !verdict.is_bounded(),
    }
}

/// An error of H as a part of the mean T.
fn part_of_kinetic<N: Real>(error: &N, report: &Report<N>) -> f64 {
    let mut part = error.clone();
    part.make_absolute();
    part.divide(&report.kinetic);
    part.to_f64()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::watch::observer::testing;

    fn summary_of(text: &str) -> Summary {
        testing::summary(&testing::read(text))
    }

    fn summary(end: &str, digits: &str) -> Summary {
        let text = format!(
            "problem.name = \"henon-heiles\"\ninitial = {{ q = [0, \"7/10\"], p = [\"9/10\", 0] }}\n\
             run = {{ scheme = \"yoshida4\", step = \"1/10\", until = 1000, end = \"{end}\", digits = \"{digits}\" \
             }}\noutput.energy = true"
        );
        summary_of(&text)
    }

    /// H and T of the pendulum are largest in a small part of a period, whose middles of windows miss it.
    #[test]
    fn the_energy_error_is_that_of_all_phases() {
        let percent = |every: u32| {
            let found = summary_of(&format!(
                "problem.name = \"pendulum\"\ninitial = {{ q = [3], p = [0] }}\n\
                 run = {{ scheme = \"stormer-verlet\", step = \"1/2\", until = 20000, digits = \"double\" \
                 }}\noutput.energy.every = {every}"
            ));
            let (_, after) = found.conclusion.split_once("the energy error is ").expect("bounded");
            after.split_once(" % of T").expect("above a thousandth").0.parse::<f64>().unwrap()
        };
        // 1000 independent states, where the standard deviation of T is 1.6 of its mean
        let (all, some) = (percent(1), percent(1000));
        assert!((some / all - 1.0).abs() < 0.15, "{some} and {all} %");
    }

    /// The run leaves the well, and its energy is lost in the last steps, which are in no window of the monitor.
    #[test]
    fn an_energy_that_is_lost_at_the_end_is_no_round_off() {
        for (end, digits) in
            [("x^2 + y^2 > 1e3", "double"), ("x^2 + y^2 > 1e20", "double"), ("x^2 + y^2 > 1e6", "double-double")]
        {
            let found = summary(end, digits);
            assert!(!found.is_bounded(), "{end}: {}", found.verdict_with_reason());
            assert!(found.reason().contains("he energy error is"), "{}", found.reason());
        }
        assert!(summary("t > 5", "double").is_bounded());
    }

    const PARTS: &str = "parts = \"wisdom-holman\"";

    fn planets(parts: &str, bodies: &str, run: &str, rows: &str) -> Summary {
        let text = format!(
            "problem = {{ {parts}, units = {{ length = \"AU\", time = \"year\", mass = \"solar\" }} }}\n\
             body = [{{ mass = 1 }}, {bodies}]\nrun = {{ scheme = \"stormer-verlet\", {run}, digits = \"double\" \
             }}\noutput.energy = {rows}"
        );
        summary_of(&text)
    }

    /// Planets with steps of many revolutions: one is thrown out after 34 of 5000 steps, before the third window of the
    /// monitor. Then two that meet after 25 of 5000.
    #[test]
    fn an_energy_that_changes_before_the_windows_is_not_bounded() {
        let thrown = "{ mass = 1e-3, a = 5.2, e = 0.05 }, { mass = 3e-4, a = 9.5, M = 100 }";
        let met = "{ mass = 0.00042, a = 1 }, { mass = 0.00042, a = 1.147, M = 151 }";
        let found = planets(PARTS, thrown, "step = 100, steps = 5000", "true");
        assert!(!found.is_bounded() && found.reason().contains("and did not come back"), "{found}");
        for rows in ["true", "{ every = 5 }"] {
            let found = planets(PARTS, met, "step = \"1/10\", steps = 5000", rows);
            assert_eq!(found.verdict(), "the splitting is not valid in a close encounter", "{rows}: {found}");
        }
    }

    /// The attraction of planets that come near goes from kicks to drifts, within as few steps as there are in the
    /// shell.
    #[test]
    fn shells_with_too_few_steps_are_not_forces_that_are_not_smooth() {
        let parts = "parts = \"wisdom-holman-heliocentric\", encounters = { within = 0.2 }";
        let bodies = "{ mass = 0.000264, a = 1 }, { mass = 0.000264, a = 1.207, M = 278 }";
        let [coarse, fine] =
            ["1/40", "1/80"].map(|h| planets(parts, bodies, &format!("step = \"{h}\", until = 200"), "true"));
        assert_eq!(coarse.verdict(), "the step size is too large", "{coarse}");
        assert!(coarse.reason().contains("goes from kicks to drifts within too few steps"), "{coarse}");
        assert!(fine.is_bounded(), "{fine}");
    }

    /// The centre of mass is at rest: its momentum is round-off of the others, which does not turn.
    #[test]
    fn a_centre_of_mass_at_rest_is_not_lost() {
        let text = crate::document::shipped::scene_text("relativity").unwrap().replace("365.25*10000", "365.25*100");
        let found = summary_of(&text);
        assert!(found.is_bounded() && !found.reason().contains("may be lost"), "{found}");
    }

    /// H − H̄ is printed where it is known: not of a binary whose pericentres are so close that H̄ is known less well
    /// than H, but on a circle, where H is constant and H̄ another number.
    #[test]
    fn the_methods_part_is_no_number_where_h_is_known_better() {
        let number = |text: &str| text.parse::<f64>().unwrap();
        let binary = planets(
            "parts = \"wisdom-holman\", elements = \"jacobi\"",
            "{ mass = 0.5, a = 1, e = 0.1 }, { mass = 0.8, a = 8, e = 0.2, i = 88 }",
            "step = \"1/20\", until = 400",
            "{ every = 100 }",
        );
        let modified = binary.modified_energy().unwrap();
        assert_eq!(modified.method, None, "{binary}");
        assert!(number(&modified.method_resolution) > number(&binary.energy().largest), "{binary}");
        let text = binary.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(text.contains("method's part of H not resolved: H̄ is known to"), "{text}");
        let circle = summary_of(
            "problem = { name = \"kepler\", parameters = { eccentricity = 0 } }\n\
             run = { scheme = \"stormer-verlet\", step = \"1/20\", until = 300, digits = \"double\" }\noutput.energy = true",
        );
        // where T, its Poisson bracket with U and r are 1/2, 0 and 1, H̄ − H is h²/24 |U_q|² or −h²/12 pᵀU_qq p but for
        // h⁴
        let method = number(circle.modified_energy().unwrap().method.as_ref().unwrap());
        assert!((method / (1.0 / 400.0 / 24.0) - 1.0).abs() < 1e-2, "{circle}");
        assert!(number(&circle.energy().largest) < method / 10.0, "{circle}");
    }

    /// Kepler orbits whose pericentre is in no window: what windows take for a permanent change, or for round-off, is
    /// little of the error of H.
    #[test]
    fn what_windows_miss_is_not_decided_by_them() {
        let kepler = |q: &str, p: &str, run: &str| {
            let text = format!(
                "problem = {{ potential = \"-1/sqrt(x^2 + y^2)\", coordinates = [\"x\", \"y\"] }}\ninitial = {{ q = \
                    {q}, p = {p} }}\n\
                 run = {{ {run}, digits = \"double\" }}\noutput.energy = true"
            );
            summary_of(&text)
        };
        let run = "scheme = \"omelyan-8s11f11gp\", step = 0.00544636, steps = 3975";
        let found = kepler("[-1.9548, 0]", "[0, -0.152061]", run);
        assert_eq!(found.verdict(), "undecided", "{found}");
        assert!(found.reason().contains("6.2 % were a permanent change: a longer run may tell"), "{found}");
        let run = "scheme = \"morales8-17\", step = 0.0316472, steps = 182";
        let found = kepler("[-0.301966, 0.556644]", "[-1.39117, 0.472062]", run);
        assert_eq!(found.verdict(), "bounded", "{found}");
    }
}
