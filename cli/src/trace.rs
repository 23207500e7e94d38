//! `shadowstep trace`: energy and modified energy at each step of one run.

use clap::Args;
use serde::Serialize;
use shadowstep::number::Rounded;
use shadowstep_scenes::arithmetic::Computation;
use shadowstep_scenes::propagator::{Propagator, motion};
use shadowstep_scenes::run::Run;

use crate::output::Output;
use crate::progress::Progress;
use crate::report::{self, Status};
use crate::run_arguments::RunArguments;
use crate::selection::Selection;
use shadowstep_scenes::Error;

const EXAMPLE: &str = "\
Example:
  shadowstep trace --problem pendulum --scheme yoshida4 --step 1/10 --until 20 --digits 40 --csv > pendulum.csv

A line has n, t, energy, modified_energy, estimate and order: the m or k used. The estimate is the estimated error of
modified_energy, of the right size also near close encounters. With --order 1 there is no reliable estimate: it is empty, in
JSON null.";

/// Energy and modified energy at each step of one run.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Arguments {
    #[command(flatten)]
    run: RunArguments,
    /// One JSON object per step, one per line (the default)
    #[arg(long)]
    json: bool,
    /// CSV with a header
    #[arg(long, conflicts_with = "json")]
    csv: bool,
    /// Positions and momenta too
    #[arg(long)]
    states: bool,
}

/// A state of the run in JSON; numbers are texts that give the same numbers when they are read.
#[derive(Serialize)]
struct Row {
    n: i64,
    t: String,
    /// `None` for values between two states.
    energy: Option<String>,
    modified_energy: String,
    /// The estimated error; `None` if there is no reliable estimate.
    estimate: Option<String>,
    order: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    q: Option<Vec<String>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    p: Option<Vec<String>>,
}

pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let selection = Selection::read(&arguments.run)?;
    let (propagator, run) = selection.single().ok_or_else(|| {
        Error::usage("a trace is one run: give one scheme and one step", "`shadowstep drift` makes several runs")
    })?;
    if arguments.states && selection.estimator.is_between() {
        let sentence = "with --estimator bilinear and an odd --order the values are at times between the states";
        return Err(Error::usage(sentence, "use an even order, or remove --states"));
    }
    if !selection.estimator.gives_errors() {
        report::note("no error estimate at --order 1: the estimates are empty");
    }
    let mut output = Output::open(arguments.run.output.as_deref(), "--output")?;
    let bar = arguments.run.output.is_some();
    let mut write = writer(&selection, arguments, &mut output)?;
    let following =
        Following { selection: &selection, propagator, run, states: arguments.states, bar, write: &mut write };
    selection.arithmetic.compute(following)?;
    drop(write);
    output.finish()?;
    Ok(Status::Success)
}

type Writer<'a> = Box<dyn FnMut(&Row) -> Result<(), Error> + 'a>;

/// Writes rows as JSON, or as CSV under a header.
fn writer<'a>(selection: &Selection, arguments: &Arguments, output: &'a mut Output) -> Result<Writer<'a>, Error> {
    if !arguments.csv {
        return Ok(Box::new(|row| output.json(row)));
    }
    let mut csv = csv::Writer::from_writer(output);
    let values = &selection.setup.values;
    let coordinates = values.positions().iter().chain(values.momenta()).map(|(name, _)| name.as_str());
    let columns = ["n", "t", "energy", "modified_energy", "estimate", "order"];
    csv.write_record(columns.into_iter().chain(coordinates.filter(|_| arguments.states)))?;
    Ok(Box::new(move |row| {
        let (n, order) = (row.n.to_string(), row.order.to_string());
        let none = String::new();
        let [energy, estimate] = [&row.energy, &row.estimate].map(|text| text.as_ref().unwrap_or(&none));
        let fields = [&n, &row.t, energy, &row.modified_energy, estimate, &order];
        let state = [&row.q, &row.p].into_iter().flatten().flatten();
        csv.write_record(fields.into_iter().chain(state))?;
        Ok(csv.flush()?)
    }))
}

/// The run and its rows, in any number type.
struct Following<'a, 'w> {
    selection: &'a Selection,
    propagator: &'a Propagator,
    run: Run<'a>,
    states: bool,
    bar: bool,
    write: &'a mut Writer<'w>,
}

impl Computation for Following<'_, '_> {
    type Output = Result<(), Error>;

    fn compute<N: Rounded + 'static>(self, context: &N::Context) -> Self::Output {
        let Following { selection, propagator, run, states, bar, write } = self;
        let (settings, between) = (selection.estimator.clone().with_errors(true), selection.estimator.is_between());
        let progress = Progress::new(bar, run.name(), run.steps);
        let mut system = motion::<N>(&selection.setup, context);
        propagator.estimates(&selection.setup, run, &settings, context, |n, found| {
            let energy = (!between).then(|| system.energy_at(found.q, found.p));
            if energy.as_ref().is_some_and(|energy| !energy.is_finite()) {
                return Err(run.not_finite(&format!("the energy at n = {n}")));
            }
            let texts = |numbers: &[N]| states.then(|| numbers.iter().map(N::to_text).collect());
            write(&Row {
                n,
                t: N::from_rational(&run.time_of_value(n, &selection.estimator), context).to_text(),
                energy: energy.as_ref().map(N::to_text),
                modified_energy: found.value.to_text(),
                estimate: found.error.map(N::to_text),
                order: found.order,
                q: texts(found.q),
                p: texts(found.p),
            })?;
            progress.reach(n);
            Ok(())
        })
    }
}
