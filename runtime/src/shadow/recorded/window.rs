//! How many states that follow each other an observer needs.

/// The states of a window, which follow each other by a step: as many as one estimate with its error needs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Window {
    /// E_8 of nine states. Its error is its last term: the difference of E_8 and the mean of E_7 over the first and the
    /// last eight of them. What an estimate has that the next ones have not, as from states that are stored with few
    /// digits, is added to it by a diagnosis. The smoothness of the forces is computed from orthogonal polynomials of
    /// degree 5 to 8.
    Nine,
    /// E_8 with the error of [`Bilinear::with_error`](crate::shadow::Bilinear::with_error), of the state in the middle
    /// and four windows of nine states on either side. The smoothness of the forces is computed from their eighth
    /// differences, which show smaller faults.
    #[default]
    Seventeen,
}

impl Window {
    /// How many states these are.
    pub const fn states(self) -> usize {
        match self {
            Window::Nine => 9,
            Window::Seventeen => 17,
        }
    }
}
