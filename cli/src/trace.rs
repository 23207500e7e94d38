//! `shadowstep trace`: energy and modified energy at each step of runs.

mod rows;

use clap::{ArgGroup, Args};
use shadowstep::shadow::Estimate;
use shadowstep_scenes::computation::{Computation, RunNumber};
use shadowstep_scenes::estimates::Estimates;
use shadowstep_scenes::propagator::Propagator;
use shadowstep_scenes::run::Run;
use shadowstep_scenes::{EnergyAt, Error, ShownCoordinates, Summary};
use shadowstep_schemes::symbolic::decimal::to_text;

use crate::headings::OUTPUT;
use crate::interrupt::Interrupt;
use crate::output::Output;
use crate::plot::{KINDS, PlotArguments, Plots, RunLines, Values};
use crate::progress::Progress;
use crate::report::{self, Status};
use crate::run_arguments::{RunArguments, usage};
use crate::selection::Selection;
use rows::{ModifiedEnergy, Row, RunName, Writer, writer};

const EXAMPLES: &str = "\
Examples:
  shadowstep trace pendulum --scheme yoshida4 --step 1/10 --until 20 \\
      --digits 40 --csv > pendulum.csv
  shadowstep trace kepler --scheme yoshida4 --step 1/20 --until 40 \\
      --plot kepler.svg --plot-of energies,orbit=x:y";

const MORE: &str = "\
A line has n, t, energy, modified_energy, estimate and order: the m or k used. The estimate is the estimated error of \
modified_energy, of the right size also near close encounters. With --order 1 there is no reliable estimate: it is \
empty, in JSON null. Lines of several runs begin with scheme and step. In transformed time --until is a physical \
time, too: a last line, without a modified energy, is for the state after a step to it.

The summary of each run is \
written to stderr: for CSV as text, for JSON as one object a line, {\"summary\": …}.";

/// What can be done after an interruption.
const NOT_RESUMED: &str = "begin again; `shadowstep run` with a checkpoint in its scene can be resumed";

/// Energy and modified energy at each step.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{KINDS}\n\n{MORE}"), override_usage = usage("trace"))]
#[command(group = ArgGroup::new("written").multiple(true))]
pub(crate) struct Arguments {
    #[command(flatten)]
    run: RunArguments,
    /// One JSON object per step, one per line (the default)
    #[arg(long, help_heading = OUTPUT)]
    json: bool,
    /// CSV with a header (the default for a file whose name ends in .csv)
    #[arg(long, conflicts_with = "json", help_heading = OUTPUT)]
    csv: bool,
    /// Positions and momenta too
    #[arg(long, help_heading = OUTPUT)]
    states: bool,
    #[command(flatten)]
    plot: PlotArguments,
}

impl Arguments {
    /// A plot alone is without rows.
    fn writes_rows(&self) -> bool {
        !self.plot.is_given() || self.json || self.csv || self.states || self.run.output.output.is_some()
    }

    /// Whether rows are CSV.
    fn writes_csv(&self) -> bool {
        let is_named_so =
            |path: &std::path::PathBuf| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"));
        self.writes_rows() && (self.csv || !self.json && self.run.output.output.as_ref().is_some_and(is_named_so))
    }
}

pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let selection = Selection::read(&arguments.run)?;
    let interrupt = Interrupt::listen("trace", NOT_RESUMED);
    let mut plots = arguments.plot.read(
        &selection.problem.system,
        &selection.problem.title,
        selection.count(),
        arguments.run.output.force,
    )?;
    refuse_states_between(&selection, arguments.states, plots.as_ref().is_some_and(|(plots, _)| plots.needs_states()))?;
    if !selection.estimator.gives_errors() {
        report::note("no error estimate at --order 1: the estimates are empty");
    }
    let mut output = Output::of(&arguments.run.output)?;
    let bar = arguments.run.output.output.is_some() || !arguments.writes_rows();
    let several = selection.count() > 1;
    let mut write = writer(&selection, arguments.writes_csv(), arguments.states, &mut output)?;
    let mut summaries = Vec::new();
    for (number, (propagator, run)) in (1..).zip(selection.runs()) {
        let progress = Progress::of_run(bar, selection.numbered(number, run), selection.expected_steps(run));
        let (selection, interrupt, write) = (&selection, &interrupt, &mut write);
        let plots = plots.as_mut().map(|(plots, _)| plots);
        let following = TraceRun { selection, propagator, run, several, arguments, progress, interrupt, write, plots };
        summaries.extend(selection.arithmetic.compute(following)?);
    }
    drop(write);
    output.finish()?;
    if let Some((plots, files)) = &plots {
        files.write(&plots.svgs())?;
    }
    let json = arguments.writes_rows() && !arguments.writes_csv();
    summaries.iter().for_each(|summary| report::summary(summary, json));
    let fine = !arguments.run.strict || summaries.iter().all(Summary::is_bounded);
    Ok(if fine { Status::Success } else { Status::NegativeAnswer })
}

/// Refuses to show states beside modified energies that are between them.
fn refuse_states_between(selection: &Selection, rows: bool, plot: bool) -> Result<(), Error> {
    if !selection.estimator.is_between() || !(rows || plot) {
        return Ok(());
    }
    let sentence = "with --estimator bilinear and an odd --order the values are at times between the states";
    let hint = if rows { "use an even order, or remove --states" } else { "use an even order, or --plot-of energies" };
    Err(Error::usage(sentence, hint))
}

/// The run and its rows, in any number type.
struct TraceRun<'a, 'w> {
    selection: &'a Selection,
    propagator: &'a Propagator,
    run: Run<'a>,
    several: bool,
    arguments: &'a Arguments,
    progress: Progress,
    interrupt: &'a Interrupt,
    write: &'a mut Writer<'w>,
    plots: Option<&'a mut Plots>,
}

impl Computation for TraceRun<'_, '_> {
    type Output = Result<Option<Summary>, Error>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output {
        let TraceRun { selection, propagator, run, several, arguments, mut progress, interrupt, write, plots } = self;
        let Selection { arithmetic, estimator, problem, until, .. } = selection;
        let (settings, system) = (estimator.clone().with_errors(true), &problem.system);
        let (arithmetic, summarised) = (*arithmetic, !arguments.run.no_summary);
        let until = Some(until).filter(|_| system.transformed_time().is_some());
        let estimates = Estimates { system, propagator, run, arithmetic, settings: &settings, summarised, until };
        let mut rows = StatesOfRun {
            selection,
            run,
            context,
            name: several.then(|| RunName { scheme: run.propagator.to_owned(), step: to_text(run.h.exact()) }),
            energy_of: system.energy(context),
            shown: system.shown(context),
            lines: plots.as_ref().map(|plots| plots.run(run.name(), selection.expected_steps(run))),
            lines_need_states: plots.as_ref().is_some_and(|plots| plots.needs_states()),
            write: arguments.writes_rows().then_some(write),
            states: arguments.states,
        };
        let finished = estimates.take::<N>(context, &mut |n, estimate| {
            progress.reach(n);
            interrupt.check(run, n, NOT_RESUMED)?;
            let [q, p] = estimate.state().map(|numbers| numbers.cloned().collect::<Vec<_>>());
            rows.take(n, (&q, &p), Some(estimate))
        })?;
        // values between states have no row for a state
        if let Some((q, p)) = finished.at_until.filter(|_| !estimator.is_between()) {
            rows.take(i64::try_from(finished.steps).unwrap_or(i64::MAX - 1) + 1, (&q, &p), None)?;
        }
        if let (Some(plots), Some(lines)) = (plots, rows.lines) {
            plots.add(lines);
        }
        Ok(finished.summary)
    }
}

/// Writes the states of a run, with their energies, and draws them.
struct StatesOfRun<'a, 'w, N: RunNumber> {
    selection: &'a Selection,
    run: Run<'a>,
    context: &'a N::Context,
    name: Option<RunName>,
    energy_of: EnergyAt<N>,
    shown: Option<ShownCoordinates<N>>,
    lines: Option<RunLines<N>>,
    lines_need_states: bool,
    /// `None` if a plot is all that is made.
    write: Option<&'a mut Writer<'w>>,
    /// Whether rows have q and p.
    states: bool,
}

impl<N: RunNumber> StatesOfRun<'_, '_, N> {
    /// Takes a state in the coordinates of the steps, or with an estimate between two states what belongs to that.
    fn take(&mut self, n: i64, (own_q, own_p): (&[N], &[N]), estimate: Option<&Estimate<'_, N>>) -> Result<(), Error> {
        let Selection { estimator, problem, .. } = self.selection;
        let energy = (!estimator.is_between()).then(|| (self.energy_of)(own_q, own_p));
        if energy.as_ref().is_some_and(|energy| !energy.is_finite()) {
            return Err(self.run.not_finite(&format!("the energy at n = {n}")));
        }
        let t = match problem.system.time_of(own_q) {
            Some(t) => t.clone(),
            None => N::from_rational(&self.run.time_of_value(n, estimator), self.context),
        };
        let (q, p) = match &mut self.shown {
            Some(shown) => shown.of_state(own_q, own_p),
            None => (own_q, own_p),
        };
        let modified_energy = estimate.map(|estimate| estimate.value);
        let error = estimate.and_then(|estimate| estimate.error);
        if let Some(lines) = &mut self.lines {
            let numbers = q.iter().chain(p).filter(|_| self.lines_need_states);
            let state = &*numbers.map(N::to_f64).collect::<Vec<_>>();
            let (n, t, energy) = (n.unsigned_abs(), t.to_f64(), energy.as_ref());
            lines.take(&Values { n, t, energy, modified_energy, estimate: error, state });
        }
        let Some(write) = &mut self.write else { return Ok(()) };
        let texts = |numbers: &[N]| self.states.then(|| numbers.iter().map(N::to_text).collect());
        write(&Row {
            run: self.name.clone(),
            n,
            t: t.to_text(),
            energy: energy.as_ref().map(N::to_text),
            modified: estimate.map(|estimate| ModifiedEnergy {
                modified_energy: estimate.value.to_text(),
                estimate: estimate.error.map(N::to_text),
                order: estimate.order,
            }),
            q: texts(q),
            p: texts(p),
        })
    }
}
