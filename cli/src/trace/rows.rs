//! The rows of `trace`, as JSON lines or CSV.

use serde::Serialize;
use shadowstep_scenes::Error;
use shadowstep_scenes::spreadsheet::cell;

use crate::output::Output;
use crate::selection::Selection;

/// A state of a run in JSON; numbers are texts that give the same numbers when they are read.
#[derive(Serialize)]
pub(super) struct Row {
    /// Which run it is, if there are several.
    #[serde(flatten)]
    pub(super) run: Option<RunName>,
    pub(super) n: i64,
    pub(super) t: String,
    /// `None` for values between two states.
    pub(super) energy: Option<String>,
    /// `None` for the state at a physical time, to which the last step is shorter.
    #[serde(flatten)]
    pub(super) modified: Option<ModifiedEnergy>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) q: Option<Vec<String>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) p: Option<Vec<String>>,
}

#[derive(Serialize)]
pub(super) struct ModifiedEnergy {
    pub(super) modified_energy: String,
    /// The estimated error; `None` if there is no reliable estimate.
    pub(super) estimate: Option<String>,
    pub(super) order: u32,
}

#[derive(Clone, Serialize)]
pub(super) struct RunName {
    pub(super) scheme: String,
    pub(super) step: String,
}

pub(super) type Writer<'a> = Box<dyn FnMut(&Row) -> Result<(), Error> + 'a>;

/// Writes rows as JSON, or as CSV under a header.
pub(super) fn writer<'a>(
    selection: &Selection,
    csv: bool,
    states: bool,
    output: &'a mut Output,
) -> Result<Writer<'a>, Error> {
    if !csv {
        return Ok(Box::new(|row| output.json(row)));
    }
    let mut csv = csv::Writer::from_writer(output);
    let system = &selection.problem.system;
    let (coordinates, positions) = (system.columns().map(String::as_str), system.coordinates_of_columns());
    let columns = ["n", "t", "energy", "modified_energy", "estimate", "order"];
    let run = ["scheme", "step"].into_iter().filter(|_| selection.count() > 1);
    csv.write_record(run.chain(columns).chain(coordinates.filter(|_| states)))?;
    Ok(Box::new(move |row| {
        let (n, none) = (row.n.to_string(), String::new());
        let order = row.modified.as_ref().map_or_else(String::new, |modified| modified.order.to_string());
        let (modified, estimate) = match &row.modified {
            Some(modified) => (&modified.modified_energy, modified.estimate.as_ref().unwrap_or(&none)),
            None => (&none, &none),
        };
        let energy = row.energy.as_ref().unwrap_or(&none);
        let names = row.run.as_ref().map(|run| [&run.scheme, &run.step].map(|text| cell(text).into_owned()));
        let run = names.iter().flatten();
        let fields = [&n, &row.t, energy, modified, estimate, &order];
        let positions = row.q.iter().flatten().take(positions);
        let state = positions.chain(row.p.iter().flatten());
        csv.write_record(run.chain(fields).chain(state))?;
        Ok(csv.flush()?)
    }))
}
