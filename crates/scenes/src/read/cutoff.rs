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

#[cfg(test)]
mod tests {
    use shadowstep::tables::Source;

    use crate::run::arithmetic::Arithmetic;
    use crate::scene::System;

    /// The faults of a system of pairs with these lines in [problem], without their places.
    fn faults(lines: &str) -> String {
        let text = format!(
            "[problem]\npair = \"1/r2^3\"\ndimensions = 2\nbodies = 2\n{lines}\n[initial]\nq = [[0, 0], [1, 0]]\np = \
                [0, 0, 0, 0]\n"
        );
        match System::read(&Source { path: "test.toml".to_owned(), text }, Arithmetic::DOUBLE) {
            Ok(_) => String::new(),
            Err(faults) => faults.to_string(),
        }
    }

    #[test]
    fn what_cannot_be_is_refused_with_its_place() {
        for (lines, place, message) in [
            ("cutoff = 2.5\nbox = 5", "", ""),
            ("cutoff = { at = 2, from = \"3/2\", derivatives = 8 }\nbox = [4, 5]", "", ""),
            ("cutoff = 0", "5:10", "cutoff must be positive, not 0"),
            ("cutoff = { at = 2, from = 2, derivatives = 3 }", "5:27", "must be below the cutoff"),
            ("cutoff = { at = 2, from = 1, derivatives = 9 }", "5:44", "1 to 8"),
            ("cutoff = { at = 2, from = 1 }", "5:10", "derivatives"),
            ("cutoff = { at = 2, form = 1 }", "5:20", "form"),
            ("cutoff = true", "5:10", "a positive number, or a table"),
            (
                "cutoff = 2\nbox = [5, 3.9]",
                "6:7",
                "at least twice as long as the cutoff along each axis; axis 2 is shorter",
            ),
            ("cutoff = 2\nbox = [5, 5, 5]", "6:7", "a number for each side of the box"),
            ("box = 5", "5:7", "box requires `cutoff`"),
            ("cutoff = 2\nneighbours = \"free\"", "5:10", "neighbours and cutoff are both given"),
            ("cutoff = \"sqrt(\"", "5:16", "unexpected end"),
        ] {
            let found = faults(lines);
            assert_eq!(found.is_empty(), message.is_empty(), "{lines}: {found}");
            assert!(found.contains(place) && found.contains(message), "{lines}: {found}");
        }
    }
}
