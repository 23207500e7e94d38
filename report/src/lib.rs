//! Charts as SVG, and reports as one page of HTML, which contains its charts and needs neither scripts nor a network.
//!
//! | file | what it is |
//! | --- | --- |
//! | [`chart`] | curves → SVG |
//! | [`page`] | sections with charts, tables and statements → HTML |
//! | [`verdict`] | whether results agree with a statement |
//! | `indices` | subscripts in texts |

pub mod chart;
mod indices;
pub mod page;
pub mod verdict;

pub use shadowstep_scenes::Error;
