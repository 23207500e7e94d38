//! What all pictures are made of: lines, cells, texts and axes, in pixels.
//!
//! | module | what it is |
//! | --- | --- |
//! | `elements` | lines, paths and texts as SVG; places; colours that a style sheet can change |
//! | `markers` | shapes about a point, of curves and of cells |
//! | `side` | ticks and labels along a side of a rectangle |
//! | `ticks` | round numbers and decades on a scale |
//! | `sheet` | the whole picture, with its title and notes |
//! | `text` | widths of texts, labels without overlaps, raised and lowered characters |
//! | `indices` | subscripts in texts |

pub(crate) mod elements;
pub(crate) mod indices;
pub(crate) mod markers;
pub(crate) mod sheet;
pub(crate) mod side;
pub(crate) mod text;
pub(crate) mod ticks;
