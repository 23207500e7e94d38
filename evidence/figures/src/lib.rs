//! The figures of Moan and Niesen, “On an asymptotic method for computing the modified energy for symplectic methods”,
//! computed again, and additional ones: charts as SVG, data as CSV, and a report as one page of HTML.
//!
//! [`reproduce`] computes what its folder does not have yet, on all cores, and writes the files. Each result is saved
//! when it is complete, so that an interrupted call can be repeated without computing it again.
//!
//! ```no_run
//! use shadowstep_figures::{Request, reproduce};
//!
//! let request = Request { names: vec!["scattering".to_owned()], quick: true, folder: "figures".into() };
//! let summary = reproduce(&request, &mut ())?;
//! println!("{}\n{}", summary.report.display(), summary.verdicts);
//! # Ok::<(), shadowstep_figures::Error>(())
//! ```
//!
//! A figure is a file in `evidence/figures/` and its line in the list `FIGURES`; everything else walks that list.
//!
//! | module | what it is |
//! | --- | --- |
//! | `reproduction` | from a request to the files |
//! | `figures` | the list of all figures, and one file for each |
//! | `figure`, `drawing` | a figure of the list; what several drawings need |
//! | `results` | the results that figures request |
//! | `calculation`, `run`, `estimator` | the calculations, and the runs and estimators that they are of |
//! | `measured`, `states`, `escape`, `noise` | what is measured along runs at many digits, and in double precision |
//! | `series` | how much the modified Hamiltonian varies as a series |
//! | `fit`, `interval` | lines through points, intervals of confidence, and what they decide |
//! | `numbers` | numbers in texts |
//! | `data` | results → CSV |

mod calculation;
mod data;
mod drawing;
mod escape;
mod estimator;
mod figure;
mod figures;
mod fit;
mod interval;
mod measured;
mod noise;
mod numbers;
mod reproduction;
mod results;
mod run;
mod series;
mod states;

pub use reproduction::{Reproduction, Request, reproduce, written};
pub use shadowstep_studies::{Error, Observer, Progress};
