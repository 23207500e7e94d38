//! What is kept at the present q.

/// What is kept: nothing, a force (the gradient, or the force of gradient kicks), or the force with its rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kept {
    Nothing,
    Gradient,
    GradientAndRate,
}

impl Kept {
    /// Whether a force is there, with its rate if that is wanted.
    #[inline(always)]
    pub(crate) fn suffices(self, with_rate: bool) -> bool {
        match self {
            Kept::Nothing => false,
            Kept::Gradient => !with_rate,
            Kept::GradientAndRate => true,
        }
    }
}
