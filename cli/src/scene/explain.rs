//! What every key of a scene means.

use crate::complaint::{Complaint, Ending};
use crate::output::Output;
use crate::readable::wrapped;
use crate::scene::keys::{self, SECTIONS};
use std::io::Write;

const INTRODUCTION: &str = "\
A scene is a TOML file with the sections [problem], [initial], [run] and [output].

A number is written in digits, 0.05 and 1e-3, and is taken exactly as it is written; or it is an exact expression in \
quotes, \"1/20\" or \"sqrt(2)/2\", in which the parameters of the problem have their names. It is rounded once, to the \
digits of the run.";

/// Prints all keys.
pub(crate) fn explain() -> Result<Ending, Complaint> {
    let mut output = Output::open(None, "")?;
    let mut text = wrapped(INTRODUCTION, "");
    for section in &SECTIONS {
        text += &format!("\n[{}]\n{}", section.name, wrapped(section.meaning, ""));
        for key in keys::of(section.name) {
            text += &format!("\n  {} = {}\n{}", key.name, key.example, wrapped(key.meaning, "      "));
            let default = key.default.map_or("It is needed.".to_owned(), |default| format!("Default: {default}."));
            text += &wrapped(&default, "      ");
        }
    }
    write!(output, "{text}")?;
    output.finish()?;
    Ok(Ending::Done)
}
