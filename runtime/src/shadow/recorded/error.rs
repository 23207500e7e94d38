//! What a log cannot be used for.

use thiserror::Error;

use crate::shadow::EstimatorError;
use crate::shadow::run::RunError;
use crate::steps::step_size::StepSizeError;

/// A log that cannot be used, with the place of what is wrong.
#[derive(Clone, PartialEq, Error)]
pub enum RecordedError {
    /// Arrays whose numbers of rows differ.
    #[error("{name} has {found} numbers, and {rows} states of {columns} numbers are {}", .rows * .columns)]
    Shape {
        /// Which array.
        name: &'static str,
        /// Its numbers.
        found: usize,
        /// The states of the log.
        rows: usize,
        /// How many numbers it has for a state.
        columns: usize,
    },
    /// A log without coordinates.
    #[error("the states of the log have no coordinates")]
    NoCoordinates,
    /// A state with another number of coordinates than the masses.
    #[error("{name} of state {n} has {found} numbers, and there are {dimension} masses: one for each coordinate")]
    Dimension {
        /// q, p or the gradient.
        name: &'static str,
        /// n of the state.
        n: i64,
        /// Its numbers.
        found: usize,
        /// The number of masses.
        dimension: usize,
    },
    /// A logged number that is not finite.
    #[error("{name} of state {n} is {value}{}; a log needs finite numbers", place(*.coordinate, *.dimension))]
    NotFinite {
        /// q, p, the gradient, U or the rate.
        name: &'static str,
        /// n of the state.
        n: i64,
        /// Counted from 0; `None` for U and the rate.
        coordinate: Option<usize>,
        /// The number of coordinates.
        dimension: usize,
        /// The number.
        value: f64,
    },
    /// A mass that is not positive and finite.
    #[error("the mass of coordinate {coordinate} is {mass}; it must be positive and finite")]
    Mass {
        /// Counted from 0.
        coordinate: usize,
        /// The value.
        mass: f64,
    },
    /// States with gradients after states without them.
    #[error(
        "state {n} has {found}, and the states before have not: all states of a log have gradients, or all have \
            rates, or all have increments"
    )]
    Mixed {
        /// n of the state.
        n: i64,
        /// A gradient, a rate or increments.
        found: &'static str,
    },
    /// A window that begins before the newest state.
    #[error("a window cannot begin at state {n}: the newest state is {newest}, and windows come in the order of time")]
    Backwards {
        /// n of its first state.
        n: i64,
        /// n of the newest state.
        newest: i64,
    },
    /// Box vectors that have no volume, or are not finite.
    #[error("the box vectors {vectors:?} span no volume")]
    Box {
        /// The rows of the matrix.
        vectors: [[f64; 3]; 3],
    },
    /// Coordinates that are not of particles in space.
    #[error("a periodic box needs three coordinates for each particle, and there are {dimension}")]
    NotInSpace {
        /// The number of coordinates.
        dimension: usize,
    },
    /// A particle that moved too far for its image to be known.
    #[error(
        "particle {particle} moved by {turns:.2} of box vector {vector} from state {} to {n}, at least: which image \
         it came to is not decided; log states more often, or unwrapped positions", .n - 1
    )]
    Undecided {
        /// n of the state after the move.
        n: i64,
        /// Counted from 0.
        particle: usize,
        /// Counted from 0.
        vector: usize,
        /// The move in box vectors, by the nearest image.
        turns: f64,
    },
    /// Positions, or momenta at half steps, of too few states.
    #[error(
        "momenta at half steps need {needed} rows for {states} states: those before and after each state; there are {found}"
    )]
    HalfSteps {
        /// The number of states.
        states: usize,
        /// One more than the states.
        needed: usize,
        /// The rows.
        found: usize,
    },
    /// A step size that is not valid.
    #[error(transparent)]
    StepSize(#[from] StepSizeError),
    /// Settings of an estimator that are not valid.
    #[error(transparent)]
    Estimator(#[from] EstimatorError),
    /// A number that is not finite.
    #[error(transparent)]
    Run(#[from] RunError),
}

shadowstep_schemes::debug_as_text!(RecordedError);

/// The coordinate, also as one of a particle in space.
fn place(coordinate: Option<usize>, dimension: usize) -> String {
    match coordinate {
        None => String::new(),
        Some(coordinate) if dimension.is_multiple_of(3) => {
            format!(
                " at coordinate {coordinate}: {} of particle {}, counted from 0",
                ["x", "y", "z"][coordinate % 3],
                coordinate / 3
            )
        }
        Some(coordinate) => format!(" at coordinate {coordinate}, counted from 0"),
    }
}
