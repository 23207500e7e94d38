//! Speed against error: work–precision diagrams of splitting schemes, and advice on scheme and step size.
//!
//! | module | what it is |
//! | --- | --- |
//! | [`study`], `calculation` | the runs of several schemes on a problem; what is computed and saved |
//! | [`problem`] | a system, an interval of time, a number type |
//! | [`reference`](mod@reference) | the positions with which those of the schemes are compared, and their own error |
//! | [`length`] | the length of a run in transformed time |
//! | `positions` | positions at the times at which errors are taken |
//! | [`series`] | the runs of a scheme, from its stability limit down to round-off |
//! | [`run`] | one run: errors of position and energy, the modified energy |
//! | `timing` | the time of a step |
//! | `work` | what else a step costs: Hessian–vector products, flows of a dominant part |
//! | [`of`], [`order`], `best` | which error; the measured order; the scheme that needs the least for an error |
//! | [`advise`], `choice`, `verified`, `convenient`, [`no_advice`] | advice on scheme and step size, or why there is none |
//! | [`schemes`] | the schemes that are compared if none are named |
//! | [`files`] | what is written: data, charts, a page |
//! | `charts` | work–precision diagrams |
//! | [`tables`] | the best schemes for each decade of an error, and measured orders |
//! | `records` | the results as CSV and JSON lines |
//! | [`size`] | sizes beyond the range of `f64` |

pub mod advise;
mod best;
mod calculation;
mod charts;
mod choice;
mod convenient;
pub mod files;
pub mod length;
pub mod no_advice;
pub mod of;
pub mod order;
mod positions;
pub mod problem;
mod records;
pub mod reference;
mod reference_scheme;
pub mod run;
pub mod schemes;
pub mod series;
pub mod size;
pub mod study;
pub mod tables;
pub(crate) mod timing;
mod verified;
pub(crate) mod work;
