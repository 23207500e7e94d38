//! Where the energy of pairs ends, and the box that the bodies are in.

use std::ops::Range;

use shadowstep::systems::pairs::{CutoffError, MOST_DERIVATIVES};
use shadowstep_symbolic::Exact;
use toml::de::DeValue;

use super::reader::Reader;
use crate::note::Note;
use crate::scene::{PairCutoff, SmoothEnd};
use shadowstep_schemes::document::{Placed, Section, Text, Value};

/// The value of the key `cutoff`.
pub(super) struct GivenCutoff {
    at: Text,
    /// From where on the energy falls, and with how many derivatives.
    smooth: Option<(Text, Placed<u64>)>,
}

/// The value of the key `box`.
pub(super) enum GivenBox {
    Side(Text),
    Sides(Placed<Vec<Text>>),
}

const CUTOFF: &str = "a distance, or a table: { at = \"5/2\", from = 2, derivatives = 3 }";

impl GivenCutoff {
    pub(super) fn read(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<GivenCutoff> {
        let DeValue::Table(table) = value.get_ref() else {
            return match value.get_ref() {
                DeValue::Integer(_) | DeValue::Float(_) | DeValue::String(_) => {
                    Some(GivenCutoff { at: reader.number(value)?, smooth: None })
                }
                _ => reader.toml.wrong_kind(value, CUTOFF),
            };
        };
        let section: Section<'_, '_> = reader.table(table, value, "problem.cutoff");
        let at = reader.toml.required(&section, "at").and_then(|value| reader.number(value));
        let from = reader.toml.required(&section, "from").and_then(|value| reader.number(value));
        let derivatives = reader.toml.required(&section, "derivatives").and_then(|value| {
            let range = 1..=u64::from(MOST_DERIVATIVES);
            reader.whole(value, range).map(|number| Placed { value: number, at: value.span() })
        });
        Some(GivenCutoff { at: at?, smooth: Some((from?, derivatives?)) })
    }
}

impl GivenBox {
    pub(super) fn read(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<GivenBox> {
        match value.get_ref() {
            DeValue::Array(_) => reader.numbers(value, "a list of the sides: [10, 10, 12]").map(GivenBox::Sides),
            _ => reader.number(value).map(GivenBox::Side),
        }
    }

    fn at(&self) -> &Range<usize> {
        match self {
            GivenBox::Side(text) => &text.at,
            GivenBox::Sides(list) => &list.at,
        }
    }

    fn sides(&self, reader: &mut Reader<'_>, dimensions: usize) -> Option<Vec<Exact>> {
        match self {
            GivenBox::Side(text) => Some(vec![reader.evaluate(text)?; dimensions]),
            GivenBox::Sides(list) => reader.values(list, dimensions, "side of the box"),
        }
    }
}

/// The cutoff of pairs of bodies in space, by the places of the values of keys; `Some(None)` if there is none.
pub(super) fn cutoff<'g>(
    reader: &mut Reader<'_>,
    (cutoff, of_box): (Option<&GivenCutoff>, Option<&GivenBox>),
    place: impl Fn(&str) -> Option<&'g Range<usize>>,
    dimensions: usize,
) -> Option<Option<PairCutoff>> {
    let Some(cutoff) = cutoff else {
        return match place("cutoff").or(place("box")) {
            // it has its own fault
            Some(_) if place("cutoff").is_some() => None,
            Some(at) => {
                let help = "add the distance up to which bodies interact, at most half of the box: cutoff = 2.5";
                reader.toml.wrong(at, "a box requires a cutoff", help)
            }
            None => Some(None),
        };
    };
    if let Some(at) = place("neighbours") {
        return reader.toml.wrong(at, "a chain of neighbours has no cutoff", "keep one of the two");
    }
    // what is given must have a value
    let radius = reader.evaluate(&cutoff.at);
    let smooth = match &cutoff.smooth {
        Some((from, derivatives)) => {
            reader.evaluate(from).map(|from| Some(SmoothEnd { from, derivatives: derivatives.value as u32 }))
        }
        None => Some(None),
    };
    let sides = match (of_box, place("box")) {
        (Some(sides), _) => sides.sides(reader, dimensions).map(Some),
        (None, Some(_)) => None,
        (None, None) => Some(None),
    };
    let cutoff_of_pairs = PairCutoff { radius: radius?, smooth: smooth?, sides: sides? };
    if let Some(error) = cutoff_of_pairs.error(dimensions) {
        let (at, help) = match error {
            CutoffError::Radius => (&cutoff.at.at, "write a positive distance: cutoff = 2.5"),
            CutoffError::Switch => {
                let (from, _) = cutoff.smooth.as_ref()?;
                (&from.at, "write a distance below the cutoff: { at = \"5/2\", from = 2, derivatives = 3 }")
            }
            CutoffError::Derivatives => (&cutoff.smooth.as_ref()?.1.at, "write derivatives = 3"),
            CutoffError::Side { .. } => (of_box?.at(), "make the box larger, or the cutoff smaller"),
        };
        return reader.toml.wrong(at, error.to_string(), help);
    }
    if cutoff_of_pairs.smooth.is_none() {
        reader.notes.push(Note::AbruptCutoff);
    }
    Some(Some(cutoff_of_pairs))
}

#[cfg(test)]
mod tests {
    use shadowstep::tables::Source;

    use crate::arithmetic::Arithmetic;
    use crate::scene::System;

    /// The faults of a system of pairs with these lines in [problem], without their places.
    fn faults(lines: &str) -> String {
        let text = format!(
            "[problem]\npair = \"1/r2^3\"\ndimensions = 2\nbodies = 2\n{lines}\n[initial]\nq = [[0, 0], [1, 0]]\np = [0, 0, 0, 0]\n"
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
            ("cutoff = 0", "5:10", "the cutoff must be a positive distance"),
            ("cutoff = { at = 2, from = 2, derivatives = 3 }", "5:27", "must be below the cutoff"),
            ("cutoff = { at = 2, from = 1, derivatives = 9 }", "5:44", "1 to 8"),
            ("cutoff = { at = 2, from = 1 }", "5:10", "derivatives"),
            ("cutoff = { at = 2, form = 1 }", "5:20", "form"),
            ("cutoff = true", "5:10", "a distance, or a table"),
            (
                "cutoff = 2\nbox = [5, 3.9]",
                "6:7",
                "at least twice as long as the cutoff along each axis; axis 2 is shorter",
            ),
            ("cutoff = 2\nbox = [5, 5, 5]", "6:7", "a number for each side of the box"),
            ("box = 5", "5:7", "a box requires a cutoff"),
            ("cutoff = 2\nneighbours = \"free\"", "6:14", "a chain of neighbours has no cutoff"),
            ("cutoff = \"sqrt(\"", "5:16", "unexpected end"),
        ] {
            let found = faults(lines);
            assert_eq!(found.is_empty(), message.is_empty(), "{lines}: {found}");
            assert!(found.contains(place) && found.contains(message), "{lines}: {found}");
        }
    }
}
