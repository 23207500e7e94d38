//! Scenes: a TOML file describes a system, the splitting scheme and the steps of its run, and what is written. Nothing
//! else is computed.
//!
//! Reading a scene gives the scene, or all faults with their places. Its run writes to its file or to a writer:
//!
//! ```
//! use shadowstep::tables::Source;
//! use shadowstep_scenes::{Outcome, Scene};
//!
//! let text = r#"
//! [problem]
//! name = "kepler"
//! [run]
//! scheme = "stormer-verlet"
//! step = "1/20"
//! steps = 40
//! digits = 30
//! [output]
//! energy = { every = 20 }
//! "#;
//! let scene = Scene::read(Source { path: "scene.toml".to_owned(), text: text.to_owned() })?;
//! let mut rows = Vec::new();
//! let outcome = scene.run_into(&mut rows, &mut ())?;
//! assert_eq!(outcome, Outcome::Complete { steps: 40, force_evaluations: 41 });
//!
//! let csv = String::from_utf8(rows).unwrap();
//! let rows: Vec<&str> = csv.lines().filter(|line| !line.starts_with('#')).collect();
//! assert_eq!(rows.len(), 4);
//! assert_eq!(rows[0], "n,t,energy");
//! assert!(rows[1].starts_with("0,0"), "{}", rows[1]);
//! # Ok::<(), shadowstep_scenes::Error>(())
//! ```
//!
//! A scene with `file` and `checkpoint` in \[output\] is run by [`Scene::run_to_file`]: when an [`Observer`] stops it,
//! another call resumes it, and the file has the same bytes in the end.
//!
//! ```
//! use shadowstep_scenes::{FileOptions, Observer, Outcome, Scene};
//!
//! struct StopAt(i64);
//!
//! impl Observer for StopAt {
//!     fn progress(&mut self, n: i64) {
//!         self.0 -= i64::from(n > 0);
//!     }
//!
//!     fn stops(&mut self) -> bool {
//!         self.0 == 0
//!     }
//! }
//!
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("scene.toml");
//! std::fs::write(&path, r#"
//! problem.name = "pendulum"
//! run = { scheme = "yoshida4", step = "1/10", steps = 30, digits = "double" }
//! output = { trajectory = true, file = "pendulum.csv", checkpoint = 10 }
//! "#)?;
//! let scene = Scene::open(&path)?;
//! assert_eq!(scene.run_to_file(FileOptions::default(), &mut StopAt(12))?, Outcome::Stopped { n: 12 });
//! assert!(matches!(scene.run_to_file(FileOptions::default(), &mut ())?, Outcome::Complete { .. }));
//! let csv = std::fs::read_to_string(folder.path().join("pendulum.csv"))?;
//! assert!(csv.lines().last().unwrap().starts_with("30,"));
//! # Ok::<(), shadowstep_scenes::Error>(())
//! ```
//!
//! Each room uses only those before it.
//!
//! | room | what it is |
//! | --- | --- |
//! | `texts` | errors, numbers and texts for people and for programs |
//! | `files` | files that get their names when they are complete, and that one process has alone |
//! | [`run`] | what a run is made with: its step size, its number type, its start |
//! | `document` | the language of documents: keys, formulas, names of schemes |
//! | `scene` | the content of a scene: plain data |
//! | `motion` | how a system moves by a scheme: propagators, tangent vectors, the stability limit |
//! | [`watch`] | what a run shows: the error of H, the modified energy, close encounters, the verdict |
//! | `results` | rows, the head of a file, checkpoints, and where they go |
//! | [`columns`] | a state, and what takes it: columns of rows, values of formulas |
//! | `execution` | the one loop of runs; the run of a scene into rows, a run into memory |
//! | `read` | a scene's text → a scene, or all its faults; families of scenes |
//! | `analyses` | what is computed of runs and of schemes, as records |

mod analyses;
pub mod columns;
mod document;
mod execution;
mod files;
mod motion;
mod read;
mod results;
pub mod run;
mod scene;
mod texts;
pub mod watch;

pub use analyses::{chaos, derivatives, drift, ensemble, estimates, sampling, scheme_record};
pub use columns::{at, column, evaluator, extremum};
pub use document::{expression, keys, library, reserved_names, schema};
pub use execution::{computation, integrate, posed};
pub use files::{lock, outside};
pub use motion::{lanes, modified_hamiltonian, propagator, stability, tangent};
pub use read::family;
pub use run::{arithmetic, cpu_time, estimator, start, steps};
pub use texts::{object, readable, spreadsheet};

pub use document::explain::{explain, explanation, scene_schema};
pub use document::shipped::{SHIPPED_SCENES, ShippedScene, scene_text};
pub use execution::engine::Outcome;
pub use files::temporary::{Temporary, remove_temporary_files};
pub use files::whole_file::WholeFile;
pub use motion::frequency::Frequency;
pub use read::{first_map, source};
pub use results::{FileOptions, elementary_functions, hexadecimal};
pub use run::note::Note;
pub use scene::plot;
pub use scene::split::{
    CanonicalCoordinates, CloseEncounters, Formulas, Linear, Planets, ShownCoordinates, TransformedTime,
};
pub use scene::{
    CheckpointInterval, Direction, EnergyAt, Format, Formula, InitialValueProblem, KineticEnergy, NamedExpression,
    Outputs, OwnPotential, Parts, PotentialEnergy, Scene, SceneNumber, Surface, System,
};
pub use texts::error::{Error, NotWritten, not_written};
pub use texts::refusal::Refusal;
pub use texts::shell::shell_word;
pub use watch::observer::Observer;
pub use watch::summary::{EnergySummary, ModifiedEnergySummary, Summary};
