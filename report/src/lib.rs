//! Charts and heat maps as SVG, and reports as one page of HTML, which contains its charts and needs neither scripts nor a network.
//!
//! | file | what it is |
//! | --- | --- |
//! | [`chart`] | curves → SVG |
//! | [`page`] | sections with charts, tables and statements → HTML |
//! | [`verdict`] | whether results agree with a statement |
//! | [`heat_map`] | cells over two quantities, coloured by a third → SVG |
//! | `indices` | subscripts in texts |
//! | `labels` | widths of texts, labels without overlaps |
//! | `picture` | what all pictures have in common: sizes of texts, colours on dark screens |
//! | `ticks` | round numbers and decades on an axis |

pub mod chart;
pub mod heat_map;
mod indices;
mod labels;
pub mod page;
mod picture;
mod ticks;
pub mod verdict;

pub use shadowstep_scenes::Error;
