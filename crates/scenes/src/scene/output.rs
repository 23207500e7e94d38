//! The section [output]: what is written, where, and how often.

use std::ops::Range;
use std::path::PathBuf;
use std::time::Duration;

use shadowstep::shadow::EstimatorSettings;

use crate::document::expression::Expression;
use crate::scene::format::Format;
use crate::scene::plot::Plot;

/// What is to be written, and where. Periods are in steps: something is written at each n that is a multiple of its
/// own.
#[derive(Clone, Debug)]
pub struct Outputs {
    /// The file, and the place of its name in the scene.
    pub file: Option<(PathBuf, Range<usize>)>,
    /// How rows are written.
    pub format: Format,
    /// The period of the energy.
    pub energy: Option<u64>,
    /// The estimator of the modified energy, and the period.
    pub modified_energy: Option<(EstimatorSettings, u64)>,
    /// The period of positions and momenta.
    pub trajectory: Option<u64>,
    /// The surface at whose crossings positions and momenta are written.
    pub section: Option<Surface>,
    /// Columns of expressions, each with their period.
    pub values: Vec<ValueColumns>,
    /// Expressions whose least and greatest values the summary has.
    pub extremes: Vec<NamedExpression>,
    /// The period of the indicators of chaos.
    pub chaos: Option<u64>,
    /// How often a checkpoint is made.
    pub checkpoint: Option<CheckpointInterval>,
    /// Whether a summary of the run is made.
    pub summary: bool,
    /// In about how many windows it compares modified energies.
    pub windows: u64,
    /// Charts of the run, drawn from the rows of the file.
    pub plot: Option<Plot>,
}

impl Outputs {
    /// Whether anything is written.
    pub fn has_rows(&self) -> bool {
        let periods = [self.energy, self.chaos];
        periods.iter().any(Option::is_some)
            || (self.modified_energy.is_some() || self.has_states() || !self.values.is_empty())
    }

    /// The columns of expressions.
    pub(crate) fn named_values(&self) -> impl Iterator<Item = &NamedExpression> {
        self.values.iter().flat_map(|columns| &columns.expressions)
    }

    /// Whether positions and momenta are written.
    pub(crate) fn has_states(&self) -> bool {
        self.trajectory.is_some() || self.section.is_some()
    }
}

/// Expressions that are columns of rows.
#[derive(Clone, Debug)]
pub struct ValueColumns {
    /// Their period.
    pub every: u64,
    /// The columns.
    pub expressions: Vec<NamedExpression>,
}

/// An expression with its name, which has a place in the scene.
#[derive(Clone, Debug)]
pub struct NamedExpression {
    /// The name.
    pub name: String,
    /// Its place.
    pub at: Range<usize>,
    /// The expression, which was checked for the system.
    pub expression: Expression,
}

/// A surface of section: where a function of q and p is 0.
#[derive(Clone, Debug)]
pub struct Surface {
    /// The function.
    pub expression: Expression,
    /// How it is crossed.
    pub direction: Direction,
}

/// How a surface is crossed, in the order of the steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// The function grows.
    Up,
    /// It falls.
    Down,
    /// Either.
    Both,
}

/// How often a checkpoint is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CheckpointInterval {
    /// At each n that is a multiple of this.
    Steps(u64),
    /// After this time on the clock.
    Time(Duration),
}
