//! What every key of a scene means.

use crate::keys::{ENSEMBLE, ENSEMBLE_KEYS, KEYS, Key, SECTIONS, Section};
use crate::readable::wrapped;

const INTRODUCTION: &str = "\
A scene is a TOML file with the sections [problem], [initial], [run] and [output]; with [ensemble] it describes many trajectories.

A number is written in digits, 0.05 or 1e-3, and is used exactly; or it is an exact expression in quotes, \"1/20\" or \
\"sqrt(2)/2\", which can contain the parameters of the problem. It is rounded once, to the digits of the run.";

/// Every key of a scene with its meaning, an example and its default.
///
/// ```
/// assert!(shadowstep_scenes::explain().contains("step = \"1/20\""));
/// ```
pub fn explain() -> String {
    explanation(INTRODUCTION, SECTIONS.iter().chain([&ENSEMBLE]), KEYS.iter().chain(&ENSEMBLE_KEYS))
}

/// The keys of several sections in the same form, after an introduction.
pub fn explanation<'a>(
    introduction: &str,
    sections: impl IntoIterator<Item = &'a Section>,
    keys: impl IntoIterator<Item = &'a Key, IntoIter: Clone>,
) -> String {
    let mut text = wrapped(introduction, "");
    let keys = keys.into_iter();
    for section in sections {
        text += &format!("\n{}\n{}", section.heading, wrapped(section.meaning, ""));
        for key in keys.clone().filter(|key| key.section == section.name) {
            text += &format!("\n  {} = {}\n{}", key.name, key.example, wrapped(key.meaning, "      "));
            let default = key.default.map_or("Required.".to_owned(), |default| format!("Default: {default}."));
            text += &wrapped(&default, "      ");
        }
    }
    text
}
