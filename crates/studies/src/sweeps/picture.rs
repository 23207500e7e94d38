//! \[picture\]: a map of a value over two axes, or curves over one.

mod cells;
mod draw;
mod drawn;
mod written;

pub(crate) use cells::{Cells, double, number_of};
pub(crate) use drawn::Picture;

#[cfg(test)]
mod tests;
