//! Scenes: a file says what is run and what is written, and no more than that is done.
//!
//! | file | what it is |
//! | --- | --- |
//! | [`keys`] | every key with its meaning; [`explain`] prints them, [`template`] writes scenes with them |
//! | [`reader`] | TOML values → texts, numbers and lists with their places |
//! | [`read`], [`system`], [`pairs`] | a scene's text → all that it asks for, or all its faults; what moves |
//! | [`engine`], [`interrupt`] | the run |
//! | [`format`](mod@format), [`write`], [`metadata`] | columns, rows and the head of a file |
//! | [`target`], [`resumable`], [`checkpoint`] | where rows go, and how a run goes on that was stopped |

mod checkpoint;
mod engine;
mod explain;
mod format;
mod interrupt;
mod keys;
mod metadata;
mod pairs;
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
    let begin = Instant::now();
    match perform(&scene, arguments.restart, &interrupt::asked)? {
        End::Complete { evaluations } => {
            if std::io::stderr().is_terminal() {
                let (steps, seconds) = (scene.steps, begin.elapsed().as_secs_f64());
                remark(format_args!("{steps} steps, {evaluations} force evaluations, {seconds:.3} seconds"));
            }
            Ok(Ending::Done)
        }
        End::Interrupted(n) => {
            let hint = match scene.output.checkpoint {
                Some(_) => "run the scene again to go on from there",
                None => "with `checkpoint = \"1 min\"` in [output] it could go on from there",
            };
            Err(Complaint::run(format!("{}: interrupted at n = {n}", scene.source.path), hint))
        }
    }
}

/// Runs a scene from its beginning, or from its checkpoint, until it is complete or told to `stop`.
fn perform(scene: &Scene, restart: bool, stop: &dyn Fn() -> bool) -> Result<End, Complaint> {
    let (target, checkpoint) = Target::open(scene, restart)?;
    let mut rows = Rows { target, format: scene.output.format, columns: columns(scene) };
    match &checkpoint {
        Some(checkpoint) => remark(format_args!("taken up at n = {} of {}", checkpoint.n, scene.steps)),
        None => {
            steps::remark_on_end(&scene.h, scene.steps, &scene.until);
            rows.head(&Metadata::of(scene))?;
        }
    }
    let checkpoint = checkpoint.as_ref();
    let end = match scene.arithmetic {
        Arithmetic::Double => follow::<f64>(scene, &(), &mut rows, checkpoint, stop),
        Arithmetic::Digits(_, precision) => follow::<Float>(scene, &precision, &mut rows, checkpoint, stop),
    };
    match &end {
        Ok(End::Complete { .. }) => rows.target.finish()?,
        Err(Complaint::Run { .. }) => rows.target.give_up()?,
        // interrupted, or the disk is full: a later run may go on
        Ok(End::Interrupted(_)) | Err(_) => {}
    }
    end
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;
    use std::io::Write;
    use std::path::Path;

    const KEPLER: &str = "[problem]\nname = \"kepler\"";

    /// What moves in 20 steps at 30 digits with a checkpoint at each `interrupt`, and what else the output is.
    fn scene(folder: &Path, system: &str, output: &str) -> Scene {
        let text = format!(
            "{system}\n[run]\nscheme = \"ruth3\"\nstep = \"1/20\"\nsteps = 20\ndigits = 30\n\
             [output]\nfile = \"out.csv\"\ncheckpoint = \"1 h\"\n{output}\n"
        );
        let path = folder.join("scene.toml");
        fs::write(&path, text).unwrap();
        Scene::read(source(path.to_str().unwrap()).unwrap()).unwrap()
    }

    /// Stops after so many states, then after twice as many of those that are made from there, and so on; gives the
    /// bytes of the file and the n of the stops.
    fn with_stops(system: &str, output: &str, each: usize) -> (String, Vec<i64>) {
        let folder = tempfile::tempdir().unwrap();
        let scene = scene(folder.path(), system, output);
        let mut stops = Vec::new();
        loop {
            let states = Cell::new(0);
            let stop = || {
                states.set(states.get() + 1);
                states.get() > each * (stops.len() + 1)
            };
            match perform(&scene, false, &stop).unwrap() {
                End::Complete { .. } => break,
                End::Interrupted(n) => stops.push(n),
            }
            // a run that is killed may have written more than its checkpoint knows of
            let partial = fs::OpenOptions::new().append(true).open(folder.path().join("out.csv.partial"));
            partial.unwrap().write_all(b"a row, and the half of").unwrap();
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "the file and its scene");
        (fs::read_to_string(folder.path().join("out.csv")).unwrap(), stops)
    }

    #[test]
    fn wherever_a_run_is_stopped_its_file_has_the_same_bytes() {
        for output in [
            "trajectory = true",
            "energy = { every = 3 }\ntrajectory = { every = 2 }",
            "modified_energy = { order = 1 }",
            "modified_energy = { order = 4, every = 3 }\nenergy = true",
            "modified_energy = { max_order = 6 }\ntrajectory = { every = 5 }",
            "modified_energy = { max_order = 30 }",
            "modified_energy = { max_order = 6, rule = \"robust\" }\nenergy = { every = 4 }",
            "modified_energy = { estimator = \"bilinear\", order = 6 }",
            "modified_energy = { estimator = \"bilinear\", max_order = 8, accuracy = \"1e-9\", every = 2 }",
        ] {
            let (whole, stops) = with_stops(KEPLER, output, 1000);
            assert_eq!((stops.len(), whole.lines().last().unwrap().split(',').next()), (0, Some("20")), "{output}");
            for each in [5, 7, 8, 12, 13, 19, 20] {
                let (bytes, stops) = with_stops(KEPLER, output, each);
                assert!(!stops.is_empty() && stops.is_sorted(), "{output}: {stops:?}");
                assert_eq!(bytes, whole, "{output}: {stops:?}");
            }
        }
    }

    #[test]
    fn so_has_that_of_pairs_of_bodies_and_of_a_general_kinetic_energy() {
        let pairs = "[problem]\npair = \"-m_i*m_j/sqrt(r2)\"\ndimensions = 2\nbodies = { m = [1, 2, \"sqrt(3)\"] }\n\
                     masses = \"m\"\n[initial]\nq = [0, 0, 1, 0, 0, 2]\nv = [0, \"1/3\", 1, 0, 0, 0]";
        let kinetic = "[problem]\npotential = \"q^2/2\"\ncoordinates = [\"q\"]\nkinetic = \"sqrt(1 + pq^2)\"\n\
                       [initial]\nq = [1]\np = [\"1/3\"]";
        for system in [pairs, kinetic] {
            for output in ["trajectory = true", "modified_energy = { max_order = 6 }\nenergy = { every = 3 }"] {
                let (whole, _) = with_stops(system, output, 1000);
                for each in [5, 8, 13] {
                    let (bytes, stops) = with_stops(system, output, each);
                    assert!(!stops.is_empty());
                    assert_eq!(bytes, whole, "{output}: {stops:?}");
                }
            }
        }
    }

    #[test]
    fn no_more_is_done_again_than_an_estimate_needs() {
        let folder = tempfile::tempdir().unwrap();
        let scene = scene(folder.path(), KEPLER, "modified_energy = { order = 2 }");
        // each fifth state is kept, and the estimates after n need one at or before n - 5: D_2, and three states for its
        // error; the run that goes on from 10 has its first estimate at 16, and so it keeps no state 15
        let mut first = 0;
        for (n, kept) in [(4, None), (6, Some(0)), (16, Some(10)), (17, Some(10)), (19, Some(10)), (20, Some(10))] {
            let states = Cell::new(first - 1);
            let stop = || {
                states.set(states.get() + 1);
                states.get() == n
            };
            assert!(matches!(perform(&scene, false, &stop).unwrap(), End::Interrupted(at) if at == n));
            let text = fs::read_to_string(folder.path().join("out.csv.checkpoint")).unwrap();
            let state = serde_json::from_str::<serde_json::Value>(&text).unwrap()["checkpoint"]["state"]["n"].as_i64();
            assert_eq!(state, kept, "at n = {n}");
            // the first estimate of the run that goes on from there
            first = kept.map_or(0, |kept| kept + 6);
        }
    }

    #[test]
    fn a_plain_run_evaluates_the_gradient_once_a_step_and_once_to_begin() {
        let folder = tempfile::tempdir().unwrap();
        let mut scene = scene(folder.path(), KEPLER, "energy = true");
        scene.scheme = crate::library::scheme("stormer-verlet").unwrap();
        let End::Complete { evaluations } = perform(&scene, false, &|| false).unwrap() else {
            panic!("it is complete")
        };
        assert_eq!(evaluations, 21);
    }
}
