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
//! | module | what it is |
//! | --- | --- |
//! | `scene` | the content of a scene: plain data |
//! | [`keys`], [`schema`] | a row for each key: documents are checked by them, and [`scene_text`] writes scenes |
//! | [`family`] | scenes that differ in the values of some names |
//! | [`ensemble`], [`lanes`] | many trajectories of such a family; their systems as one system of lanes |
//! | `read` | a scene's text → a scene, or all its faults |
//! | [`posed`], `follow` | a run with all that determines it; the one loop of runs |
//! | [`mod@column`], [`at`] | what takes states, and a state as it sees it |
//! | `execute`, `engine`, `moment`, `snapshots`, `saved_state` | the run of a scene into rows, which can be resumed |
//! | `crossings` | where a run crosses a surface of section |
//! | `observer`, `note` | how a caller watches a run and stops it |
//! | `results` | rows, the head of a file, checkpoints, and where they go |
//! | `whole_file`, [`lock`], `temporary` | files that get their names when they are complete, and that one process has alone |
//! | [`arithmetic`] | number types and their digits |
//! | [`expression`], [`evaluator`] | formulas in the numbers of a state, and conditions on them |
//! | [`reserved_names`] | names with a meaning of their own: in such formulas, as columns, in emitted code |
//! | [`library`] | schemes by their names: shipped ones and files |
//! | [`scheme_record`] | everything that is known about a scheme |
//! | [`sampling`] | schemes for Hamiltonian Monte Carlo on a Gaussian target, as records |
//! | [`estimator`] | estimators of the modified energy with their settings |
//! | [`run`], [`steps`], [`propagator`] | one run of a scheme or of the exact flow with one step size |
//! | [`integrate`] | a run into memory |
//! | [`tangent`], [`chaos`] | tangent vectors beside a run, and the indicators of chaos that they give |
//! | [`derivatives`] | derivatives of a run by the initial state, the step size and numbers of the scene, forwards and backwards |
//! | [`drift`] | the drift of the modified energy of a run, and that on the exact flow; [`cpu_time`] is what it costs |
//! | [`plot`] | what charts of a run show |
//! | `split` | how H is split into parts: each kind of split has its file |
//! | [`estimates`], [`start`] | the modified energies along such a run; a system at a state with its stepper |
//! | `frequency`, [`stability`] | the fastest oscillation at the start, and the stability limit of the scheme |
//! | [`watch`] | what a run shows: the error of H, the modified energy, close encounters, the verdict |
//! | [`spreadsheet`] | cells of CSV that spreadsheets would compute |
//! | [`object`] | objects of JSON whose keys keep their order |
//! | [`readable`], `error`, `refusal` | numbers and texts for people; what can go wrong |
//! | `shell` | words of commands that users copy |

pub mod arithmetic;
pub mod at;
pub mod chaos;
pub mod column;
pub mod columns;
pub mod computation;
pub mod cpu_time;
mod crossings;
pub mod derivatives;
pub mod drift;
mod engine;
pub mod ensemble;
mod error;
pub mod estimates;
pub mod estimator;
pub mod evaluator;
mod execute;
mod explain;
pub mod expression;
mod extremes;
pub mod extremum;
pub mod family;
mod follow;
mod frequency;
pub mod integrate;
pub mod keys;
pub mod lanes;
pub mod library;
pub mod lock;
pub mod modified_hamiltonian;
mod moment;
mod note;
pub mod object;
mod observer;
pub mod outside;
mod pace;
mod passing;
pub mod posed;
pub mod propagator;
mod quantity;
mod quantity_of_bodies;
mod read;
pub mod readable;
mod refusal;
pub mod reserved_names;
mod results;
pub mod run;
mod run_number;
pub mod sampling;
mod saved_state;
mod saved_summary;
mod scene;
pub mod schema;
pub mod scheme_record;
mod shell;
mod shipped;
mod snapshots;
pub mod spreadsheet;
pub mod stability;
pub mod start;
pub mod steps;
pub mod tangent;
mod template;
mod temporary;
pub mod watch;
mod whole_file;

pub use engine::Outcome;
pub use error::{Error, NotWritten, not_written};
pub use explain::{explain, explanation, scene_schema};
pub use frequency::Frequency;
pub use note::Note;
pub use observer::Observer;
pub use read::{first_map, source};
pub use refusal::{Refusal, Unsupported};
pub use results::{FileOptions, elementary_functions, hexadecimal};
pub use scene::plot;
pub use scene::split::{
    CanonicalCoordinates, Class, CloseEncounters, Formulas, KineticAndPotential, Linear, Needs, Planets,
    ShownCoordinates, SlowForces, TransformedTime,
};
pub use scene::{
    CheckpointInterval, Direction, EnergyAt, EnergyOfBodies, Format, Formula, InitialValueProblem, KineticEnergy,
    NamedExpression, Outputs, OwnPotential, PairEnergy, Parts, PotentialEnergy, Scene, SceneNumber, Surface, System,
    SystemIn,
};
pub use shell::shell_word;
pub use shipped::{SHIPPED_SCENES, ShippedScene, scene_text};
pub use temporary::{Temporary, remove_temporary_files};
pub use watch::summary::{EnergySummary, Extreme, ModifiedEnergySummary, Summary};
pub use watch::{Approach, Encounter, Interactions, LightBody, ParticleApproach};
pub use whole_file::WholeFile;
