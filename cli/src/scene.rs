//! Scenes: a file says what is run and what is written, and no more than that is done.
//!
//! | file | what it is |
//! | --- | --- |
//! | [`keys`] | every key with its meaning; [`explain`] prints them, [`template`] writes scenes with them |
//! | [`reader`] | TOML values → texts, numbers and lists with their places |
//! | [`read`], [`system`] | a scene's text → all that it asks for, or all its faults |
//! | [`engine`], [`interrupt`] | the run |
//! | [`write`], [`metadata`] | rows and the head of a file |
//! | [`target`], [`resumable`], [`checkpoint`] | where rows go, and how a run goes on that was stopped |

mod checkpoint;
mod engine;
mod explain;
mod interrupt;
mod keys;
mod metadata;
mod read;
mod reader;
mod resumable;
mod system;
mod target;
mod template;
mod write;

pub(crate) use explain::explain;
pub(crate) use template::template;

use std::fs;
use std::io::{ErrorKind, IsTerminal};
use std::time::Instant;

use rug::Float;
use shadowstep_schemes::fault::Source;

use crate::arguments::SceneRunArguments;
use crate::arithmetic::Arithmetic;
use crate::complaint::{Complaint, Ending, remark};
use crate::scene::engine::{End, follow};
use crate::scene::metadata::Metadata;
use crate::scene::read::Scene;
use crate::scene::target::Target;
use crate::scene::write::{Columns, Rows};
use crate::steps;

/// Runs a scene.
pub(crate) fn run(arguments: &SceneRunArguments) -> Result<Ending, Complaint> {
    let scene = Scene::read(source(&arguments.scene)?)?;
    interrupt::listen();
    let (target, checkpoint) = Target::open(&scene, arguments.restart)?;
    let mut rows = Rows { target, format: scene.output.format, columns: columns(&scene) };
    match &checkpoint {
        Some(checkpoint) => remark(format_args!("taken up at n = {} of {}", checkpoint.n, scene.steps)),
        None => {
            steps::remark_on_end(&scene.h, scene.steps, &scene.until);
            rows.head(&Metadata::of(&scene))?;
        }
    }
    let begin = Instant::now();
    let end = match scene.arithmetic {
        Arithmetic::Double => follow::<f64>(&scene, &(), &mut rows, checkpoint.as_ref()),
        Arithmetic::Digits(_, precision) => follow::<Float>(&scene, &precision, &mut rows, checkpoint.as_ref()),
    };
    match end {
        Ok(End::Complete { evaluations }) => {
            rows.target.finish()?;
            if std::io::stderr().is_terminal() {
                let (steps, seconds) = (scene.steps, begin.elapsed().as_secs_f64());
                remark(format_args!("{steps} steps, {evaluations} force evaluations, {seconds:.3} seconds"));
            }
            Ok(Ending::Done)
        }
        Ok(End::Interrupted(n)) => {
            let hint = match scene.output.checkpoint {
                Some(_) => "run the scene again to go on from there",
                None => "with `checkpoint = \"1 min\"` in [output] it could go on from there",
            };
            Err(Complaint::run(format!("{}: interrupted at n = {n}", scene.source.path), hint))
        }
        Err(complaint) => {
            if let Complaint::Run { .. } = complaint {
                rows.target.give_up()?;
            }
            Err(complaint)
        }
    }
}

fn columns(scene: &Scene) -> Columns {
    let asked = &scene.output;
    let names = scene.system.coordinates.iter().chain(&scene.system.momenta);
    Columns {
        energy: asked.energy.is_some(),
        modified: asked.modified.is_some(),
        state: names.filter(|_| asked.trajectory.is_some()).cloned().collect(),
    }
}

fn source(path: &str) -> Result<Source, Complaint> {
    let refuse = |sentence: String| {
        Complaint::usage(sentence, "give the path of a scene; `shadowstep scene kepler > scene.toml` writes one")
    };
    match fs::read_to_string(path) {
        Ok(text) if text.trim().is_empty() => Err(refuse(format!("{path} is empty"))),
        Ok(text) => Ok(Source { path: path.to_owned(), text }),
        Err(error) if error.kind() == ErrorKind::NotFound => Err(refuse(format!("there is no file {path}"))),
        Err(error) if error.kind() == ErrorKind::InvalidData => Err(refuse(format!("{path} is no text in UTF-8"))),
        Err(error) => Err(refuse(format!("{path} cannot be read: {error}"))),
    }
}
