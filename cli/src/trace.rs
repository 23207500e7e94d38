//! Energy and modified energy at each step of one run.

use rug::Float;
use serde::Serialize;
use shadowstep::number::Rounded;

use crate::arguments::TraceArguments;
use crate::arithmetic::Arithmetic;
use crate::complaint::{Complaint, Ending, remark};
use crate::output::Output;
use crate::progress::Progress;
use crate::propagator::{Propagator, motion};
use crate::run::Run;
use crate::selection::Selection;

/// A state of the run, as JSON has it; numbers are texts that read back to the same numbers.
#[derive(Serialize)]
struct Row {
    n: i64,
    t: String,
    /// None for values between two states.
    energy: Option<String>,
    modified_energy: String,
    /// Of the error; none where none can be relied on.
    estimate: Option<String>,
    order: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    q: Option<Vec<String>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    p: Option<Vec<String>>,
}

pub(crate) fn trace(arguments: &TraceArguments) -> Result<Ending, Complaint> {
    let selection = Selection::read(&arguments.run)?;
    let (propagator, run) = selection.single().ok_or_else(|| {
        Complaint::usage("a trace is of one run: one scheme and one step", "`shadowstep drift` makes many runs")
    })?;
    if arguments.states && selection.estimator.is_between() {
        let sentence = "with --estimator bilinear and an odd --order the values belong to times between the states";
        return Err(Complaint::usage(sentence, "take an even order, or leave out --states"));
    }
    if !selection.estimator.tells_error() {
        remark("with --order 1 no estimate of the error can be relied on; the estimates are left empty");
    }
    let mut output = Output::open(arguments.run.output.as_deref(), "--output")?;
    let bar = arguments.run.output.is_some();
    let mut write = writer(&selection, arguments, &mut output)?;
    match selection.arithmetic {
        Arithmetic::Double => follow::<f64>(&selection, propagator, run, &(), arguments.states, bar, &mut write)?,
        Arithmetic::Digits(_, precision) => {
            follow::<Float>(&selection, propagator, run, &precision, arguments.states, bar, &mut write)?
        }
    }
    drop(write);
    output.finish()?;
    Ok(Ending::Done)
}

type Writer<'a> = Box<dyn FnMut(&Row) -> Result<(), Complaint> + 'a>;

/// Writes rows as JSON, or as CSV under a header.
fn writer<'a>(
    selection: &Selection,
    arguments: &TraceArguments,
    output: &'a mut Output,
) -> Result<Writer<'a>, Complaint> {
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

/// Makes the run and writes its rows.
fn follow<N: Rounded + 'static>(
    selection: &Selection,
    propagator: &Propagator,
    run: Run<'_>,
    context: &N::Context,
    states: bool,
    bar: bool,
    write: &mut Writer<'_>,
) -> Result<(), Complaint> {
    let (method, between) = (selection.estimator.method(true), selection.estimator.is_between());
    let progress = Progress::new(bar, run.name(), run.steps);
    let mut system = motion::<N>(&selection.setup, context);
    propagator.estimates(&selection.setup, run, &method, context, |n, found| {
        let energy = (!between).then(|| system.energy_of(found.q, found.p));
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
