//! `plot` in [output]: the charts and their file.

use super::reader::Reader;
use crate::document::schema::Table;
use crate::scene::plot::{Content, Picture, Plot};
use crate::scene::{Outputs, System};
use crate::texts::refusal::{Refusal, refuse};
use shadowstep_schemes::document::{Placed, Text};

/// The charts, if the rows that they are drawn from are written.
pub(super) fn read(
    reader: &mut Reader<'_>,
    output: &Table<'_, '_>,
    system: Option<&System>,
    outputs: &Outputs,
) -> Option<Plot> {
    let table = output.table("plot");
    let file = match &table {
        Some(table) => table.text("file"),
        None => output.text("plot"),
    }?;
    if !file.value.ends_with(".svg") || file.value.ends_with("/.svg") || file.value == ".svg" {
        let message = format!("`{}` is not the name of an SVG file", file.value);
        return reader.toml.wrong(&file.at, message, "give a name such as kepler.svg");
    }
    let path = reader.path(&file)?;
    if outputs.file.as_ref().is_some_and(|(rows, _)| *rows == path) {
        return reader.toml.wrong(&file.at, "the plot has the name of the file for the rows", "give it another name");
    }
    let texts = match table.and_then(|table| table.list("of")) {
        None => vec![Placed { value: "energies".to_owned(), at: file.at.clone() }],
        Some(of) => of.value.into_iter().map(|Text { value, at, .. }| Placed { value, at }).collect(),
    };
    let pictures = pictures(reader, &texts, system?, outputs)?;
    Some(Plot { file: path, at: file.at, pictures })
}

fn pictures(
    reader: &mut Reader<'_>,
    texts: &[Placed<String>],
    system: &System,
    outputs: &Outputs,
) -> Option<Vec<Picture>> {
    let mut pictures: Vec<Picture> = Vec::new();
    for Placed { value: text, at } in texts {
        let picture = reader.found(at, Picture::read(text, system))?;
        reader.found(at, has_rows(&picture, outputs))?;
        if pictures.contains(&picture) {
            return reader.toml.wrong(at, format!("`{text}` is given twice"), "keep one");
        }
        pictures.push(picture);
    }
    Some(pictures)
}

/// Refuses a chart of what the rows do not have.
fn has_rows(picture: &Picture, outputs: &Outputs) -> Result<(), Refusal> {
    let Picture { text, content } = picture;
    let (is_there, message, hint) = match content {
        Content::Energies => (
            outputs.energy.is_some() || outputs.modified_energy.is_some(),
            format!("the chart `{text}` requires rows with energies"),
            "add `energy = true` or `modified_energy = true`",
        ),
        Content::Orbit { .. } | Content::Distances(_) if outputs.section.is_some() => (
            false,
            format!("the chart `{text}` is a curve, and the crossings of a section are points"),
            "draw the rows of the file with another program, or write `trajectory = true`",
        ),
        Content::Orbit { .. } | Content::Distances(_) => (
            outputs.trajectory.is_some(),
            format!("the chart `{text}` requires rows with positions and momenta"),
            "add `trajectory = true`",
        ),
    };
    if is_there { Ok(()) } else { refuse(message, hint) }
}
