//! What is kept at the present q.

/// What is kept: nothing, a force (the gradient, or the force of gradient kicks), or the force with its rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum KeptForce {
    Nothing,
    Gradient,
    GradientAndRate,
}

impl KeptForce {
    /// Whether a force is there, with its rate if that is wanted.
    #[inline(always)]
    pub(crate) fn suffices(self, with_rate: bool) -> bool {
        match self {
            KeptForce::Nothing => false,
            KeptForce::Gradient => !with_rate,
            KeptForce::GradientAndRate => true,
        }
    }
}
