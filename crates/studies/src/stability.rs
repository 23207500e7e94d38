//! Numerical stability on hard cases: what theory predicts of splitting schemes, what happens, and whether it agrees.
//!
//! [`examine`] makes the trials of the requested cases on all cores. Each result is saved when it is complete, so that
//! an interrupted call can be repeated without computing it again.
//!
//! ```
//! use shadowstep_scenes::arithmetic::Arithmetic;
//! use shadowstep_scenes::library::scheme;
//! use shadowstep_studies::stability::{Suite, entries, examine};
//!
//! let suite = Suite::new(vec![scheme("yoshida4")?], Arithmetic::DOUBLE, true);
//! let folder = tempfile::tempdir()?;
//! let findings = examine(&suite, &entries(&["oscillator".to_owned()])?, folder.path(), &mut ())?;
//! println!("{}", findings[0].1.statements[0].found);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A case is a table `cases/NAME.toml` with what theory predicts, the trials and the chart, a file beside it that
//! implements `Case`, what is computed and judged, and its line of the list `CASES`; everything else walks that list.
//!
//! | module | what it is |
//! | --- | --- |
//! | `examination` | from a request to the findings |
//! | [`Suite`], [`files`] | what is examined; the page, the charts and the table that are written |
//! | `cases` | the list of all cases, and a table and a file for each |
//! | `case`, `table`, `trial` | what a case is; its table; a trial of it |
//! | `prelude` | what most cases use |
//! | `systems`, `integrator` | systems of cases; a system with its stepper as scenes make it, in a number type or in one that is hidden |
//! | `linear_step`, `growth` | a step of the oscillator as a matrix; how fast a linear system grows |
//! | `area` | areas of pairs of tangent vectors |
//! | `watched`, `long_run`, `scene_run` | a run with a monitor; long runs of shipped problems; a run of a scene with its summary |

mod area;
mod case;
mod cases;
mod examination;
pub mod files;
mod growth;
mod integrator;
mod linear_step;
mod long_run;
mod prelude;
mod scene_run;
mod suite;
mod systems;
mod table;
mod trial;
mod watched;

pub use case::CaseEntry;
pub use examination::{entries, examine, names};
pub use suite::Suite;
