//! What holds the coordinates of a state.

/// Holds the coordinates of a state: an array `[N; D]`, or a `Vec<N>` or `Box<[N]>` where the dimension is known at run
/// time only.
pub trait Coordinates<N>: AsRef<[N]> + AsMut<[N]> + Clone {}

impl<N, V: AsRef<[N]> + AsMut<[N]> + Clone> Coordinates<N> for V {}
