//! What a picture shows.

use shadowstep::Rational;

/// What is drawn: places of axes and of a column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    pub(crate) x: usize,
    /// The second axis of a map; without one, curves are drawn.
    pub(crate) y: Option<usize>,
    /// The axis with a curve for each value.
    pub(crate) curves: Option<usize>,
    /// The axis with a map for each value.
    pub(crate) panels: Option<usize>,
    /// The column with the values.
    pub(crate) value: usize,
    pub(crate) of_several: OfSeveral,
    /// Of the values; where it is not given, that which suits them.
    pub(crate) scale: Option<Scale>,
    /// The values at the ends of a map's colours; where they are not given, the least and the largest one.
    pub(crate) range: Option<[Rational; 2]>,
    pub(crate) title: Option<String>,
    /// What the values are called.
    pub(crate) label: Option<String>,
}

/// What is shown of several runs at the same place, which differ in other axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OfSeveral {
    Mean,
    Largest,
    Least,
}

/// The scale of the values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scale {
    Linear,
    Logarithmic,
}
