//! Where the energy of pairs ends, and the box that the bodies are in.

use shadowstep::systems::pairs::CutoffError;
use shadowstep_schemes::symbolic::Exact;

use super::reader::Reader;
use crate::document::schema::Table;
use crate::run::note::Note;
use crate::scene::{PairCutoff, SmoothEnd};

/// The cutoff of pairs of bodies in space; `Some(None)` if there is none.
pub(super) fn cutoff(
    reader: &mut Reader<'_>,
    problem: &Table<'_, '_>,
    dimensions: usize,
) -> Option<Option<PairCutoff>> {
    if problem.get("cutoff").is_none() {
        return Some(None);
    }
    let table = problem.table("cutoff");
    // what is given must have a value
    let radius = match &table {
        Some(table) => reader.value(table, "at"),
        None => reader.value(problem, "cutoff"),
    };
    let smooth = match &table {
        Some(table) => smooth(reader, table).map(Some),
        None => Some(None),
    };
    let sides = match problem.get("box") {
        Some(_) => sides(reader, problem, dimensions).map(Some),
        None => Some(None),
    };
    let of_pairs = PairCutoff { radius: radius?.1, smooth: smooth?, sides: sides? };
    if let Some(error) = of_pairs.error(dimensions) {
        let of_table = |key: &str| table.as_ref().map_or(problem.place("cutoff"), |table| table.place(key));
        let (at, help) = match error {
            CutoffError::Radius => (of_table("at"), "write a positive distance: cutoff = 2.5"),
            CutoffError::Switch => {
                (of_table("from"), "write a distance below the cutoff: { at = \"5/2\", from = 2, derivatives = 3 }")
            }
            CutoffError::Derivatives => (of_table("derivatives"), "write derivatives = 3"),
            CutoffError::Side { .. } => (problem.place("box"), "make the box larger, or the cutoff smaller"),
        };
        return reader.toml.wrong(&at, error.to_string(), help);
    }
    if of_pairs.smooth.is_none() {
        reader.notes.push(Note::AbruptCutoff);
    }
    Some(Some(of_pairs))
}

fn smooth(reader: &mut Reader<'_>, table: &Table<'_, '_>) -> Option<SmoothEnd> {
    let (_, from) = reader.value(table, "from")?;
    Some(SmoothEnd { from, derivatives: u32::try_from(table.whole("derivatives")?).ok()? })
}

/// The sides of the box along each axis.
fn sides(reader: &mut Reader<'_>, problem: &Table<'_, '_>, dimensions: usize) -> Option<Vec<Exact>> {
    match problem.list("box") {
        Some(sides) => reader.values(&sides, dimensions, "side of the box"),
        None => Some(vec![reader.value(problem, "box")?.1; dimensions]),
    }
}
