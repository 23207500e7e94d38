//! The rows of an ensemble: one for each trajectory.

use std::io::Write;

use shadowstep::shadow::ensemble::Outcome;
use shadowstep_schemes::symbolic::decimal::to_text;

use super::columns::Columns;
use crate::results::Metadata;
use crate::scene::Scene;
use crate::texts::error::Error;
use crate::texts::spreadsheet::cell;

/// The metadata, a line of names, and a row for each outcome.
pub(super) fn write(
    columns: &Columns,
    scene: &Scene,
    has_modified_energy: bool,
    outcomes: &[Outcome],
    writer: &mut dyn Write,
) -> Result<(), Error> {
    for line in Metadata::of_ensemble(scene, &columns.sha256()).lines() {
        writeln!(writer, "# {line}")?;
    }
    let system = &scene.system;
    let mut csv = csv::Writer::from_writer(writer);
    let own: Vec<_> = columns.names.iter().map(|name| cell(name)).collect();
    let names = own.iter().map(AsRef::as_ref).chain(system.columns().map(String::as_str));
    let modified = ["modified_drift", "modified_start", "modified_end"].into_iter().filter(|_| has_modified_energy);
    let energies = ["energy_error", "energy_start", "energy_end"].into_iter().chain(modified);
    csv.write_record(["trajectory"].into_iter().chain(names).chain(energies).chain(["not_finite"]))?;
    for (t, (outcome, values)) in outcomes.iter().zip(&columns.rows).enumerate() {
        let Outcome { q, p, energies: [start, end], energy_error, modified_drift, modified_energies, not_finite } =
            outcome;
        let state = q.iter().take(system.coordinates_of_columns()).chain(p).map(number);
        let [first, last] = modified_energies.map_or([None; 2], |ends| ends.map(Some));
        let text = |x: Option<f64>| x.as_ref().map(number).unwrap_or_default();
        let modified = [*modified_drift, first, last].map(text);
        let energies = [*energy_error, Some(*start), Some(*end)].map(text).into_iter();
        let energies = energies.chain(modified.into_iter().filter(|_| has_modified_energy));
        let not_finite = not_finite.map(|n| n.to_string()).unwrap_or_default();
        let row = [t.to_string()].into_iter().chain(values.iter().map(to_text)).chain(state);
        csv.write_record(row.chain(energies).chain([not_finite]))?;
    }
    csv.flush()?;
    Ok(())
}

/// Text that reads back to the same bits, as in the rows of other scenes; no text of an infinite value or NaN.
fn number(x: &f64) -> String {
    if x.is_nan() { String::new() } else { format!("{x:?}") }
}
