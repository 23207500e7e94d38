//! What is kept at the present q.

/// What is kept: nothing, a force (the gradient, or that of gradient kicks), or the force with its rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kept {
    Nothing,
    Gradient,
    GradientAndRate,
}
