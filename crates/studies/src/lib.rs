//! Studies: calculations on all cores whose outcomes are saved one by one, and what is made of them: charts, verdicts,
//! a page of HTML.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`work_precision`] | speed against error, and advice on scheme and step size |
//! | [`sweeps`] | many runs of a scene over axes of parameters |
//! | [`emit`] | schemes as code of other ecosystems |
//! | [`figures`] | the figures of Moan and Niesen's paper, computed again |
//! | [`stability`] | hard cases: what theory predicts, and what happens |
//!
//! What these have in common:
//!
//! | module | what it is |
//! | --- | --- |
//! | `calculation` | what calculations are |
//! | `store` | the file of outcomes, and the calculations that it lacks |
//! | `threads`, `progress` | groups of calculations on all cores; how much is done |
//! | `observer` | how a caller follows it |
//! | [`chart`] | curves → SVG |
//! | `claim` | claims as data: texts of TOML, charts by their texts |
//! | `heat_map` | cells over two quantities, coloured by a third → SVG |
//! | `named` | the parts of a study by their names |
//! | [`finding`] | what a part of a study has shown: charts, results, statements, tables |
//! | [`verdict`] | whether results agree with a statement |
//! | [`files`] | the files in the folder of a study |
//! | [`page`] | findings → HTML, which needs neither scripts nor a network |
//! | `picture` | what all pictures are made of: lines, cells, texts and axes |

mod calculation;
pub mod chart;
mod claim;
pub mod emit;
pub mod figures;
pub mod files;
pub mod finding;
mod heat_map;
mod named;
mod observer;
pub mod page;
mod picture;
mod progress;
pub mod stability;
mod store;
pub mod sweeps;
mod threads;
pub mod verdict;
pub mod work_precision;

pub use calculation::{Calculation, Continues};
use named::named;
pub use observer::{Observer, Progress};
pub use shadowstep_scenes::Error;
pub use store::Store;
