//! What every key of a document means.

use crate::document::keys::SECTIONS;
use crate::document::quantity::QUANTITIES;
use crate::document::schema::{Section, json_schema};
use crate::texts::readable::wrapped;

const INTRODUCTION: &str = "\
A scene is a TOML file with the sections [problem], [initial], [run] and [output]; with [ensemble] it describes many \
trajectories.

A number is written in digits, 0.05 or 1e-3, and is used exactly; or it is an exact expression in quotes, \"1/20\" or \
\"sqrt(2)/2\", which can contain the parameters of the problem. It is rounded once, to the digits of the run.";

/// Every key of a scene with its meaning, an example, its kind and its default.
///
/// ```
/// assert!(shadowstep_scenes::explain().contains("step = \"1/20\""));
/// ```
pub fn explain() -> String {
    let mut text = explanation(INTRODUCTION, SECTIONS);
    text += "\nQuantities of bodies in formulas of values, extremes, ends, sections and sweeps\n";
    for own in &QUANTITIES {
        text += &format!("\n  {}\n{}", own.written, wrapped(own.meaning, "      "));
    }
    text
}

/// The JSON Schema of scenes, with which editors complete and check them.
pub fn scene_schema() -> String {
    json_schema("A scene of Shadowstep", &[], &SECTIONS, &["problem"])
}

/// The keys of several sections in the same form, after an introduction.
pub fn explanation(introduction: &str, sections: impl IntoIterator<Item = &'static Section>) -> String {
    let mut text = wrapped(introduction, "");
    for section in sections {
        explain_section(&mut text, section);
        section.tables().for_each(|table| explain_section(&mut text, table));
    }
    text
}

fn explain_section(text: &mut String, section: &Section) {
    *text += &format!("\n{}\n{}", section.heading, wrapped(section.meaning, ""));
    for key in section.keys {
        *text += &format!("\n  {} = {}\n{}", key.name, key.example, wrapped(key.meaning, "      "));
        let default = key.default.map_or("Required.".to_owned(), |default| format!("Default: {default}."));
        *text += &wrapped(&format!("Kind: {}.", key.kind), "      ");
        *text += &wrapped(&default, "      ");
    }
}
