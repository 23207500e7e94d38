//! The figures of Moan and Niesen, “On an asymptotic method for computing the modified energy for symplectic methods”,
//! computed again, and additional ones: charts as SVG, data as CSV, and a report as one page of HTML.
//!
//! [`reproduce`] computes what its folder does not have yet, on all cores, and writes the files. Each result is saved
//! when it is complete, so that an interrupted call can be repeated without computing it again.
//!
//! ```no_run
//! use shadowstep_studies::figures::{Request, reproduce};
//!
//! let request = Request { names: vec!["scattering".to_owned()], quick: true, folder: "figures".into() };
//! let summary = reproduce(&request, &mut ())?;
//! println!("{}\n{}", summary.report.display(), summary.verdicts);
//! # Ok::<(), shadowstep_studies::Error>(())
//! ```
//!
//! A figure is a table `all/NAME.toml` with what the paper states, families of runs and charts, a file beside it
//! that draws them and judges what is stated, and its line in the list `FIGURES`; everything else walks that list.
//!
//! | module | what it is |
//! | --- | --- |
//! | `reproduction` | from a request to the files |
//! | `all` | the list of all figures, and a table and a file for each |
//! | `figure`, `table`, `drawing` | a figure of the list; its table; a figure while it is drawn |
//! | `prelude` | what most figures use |
//! | `results` | the results that figures request |
//! | `calculation`, `run`, `estimator` | the calculations, and the runs and estimators that they are of |
//! | `measured`, `states`, `escape`, `noise` | what is measured along runs at many digits, and in double precision |
//! | `series` | how much the modified Hamiltonian varies as a series |
//! | `fit`, `interval` | lines through points, intervals of confidence, and what they decide |
//! | `numbers` | numbers in texts |
//! | `data` | results → CSV |

mod all;
mod calculation;
mod data;
mod drawing;
mod escape;
mod estimator;
mod figure;
mod fit;
mod interval;
mod measured;
mod noise;
mod numbers;
mod prelude;
mod reproduction;
mod results;
mod run;
mod series;
mod states;
mod table;

pub use reproduction::{Reproduction, Request, reproduce, written};
